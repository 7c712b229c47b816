use super::PodChoice;
use super::document::Document;
use super::error::{CaseError, Place};
use super::sections::{PodSection, TransferMethod, TransferSection};
use lumley_fem::transfer::Transfer;
use lumley_pod::{ALGORITHMS, Truncation};
use std::fmt::{self, Display};

/// Questions to the document, so that a wrong value is refused with its place.
pub(super) struct Ask<'a>(pub &'a Document);

impl Ask<'_> {
    pub fn refuse(&self, key: &str, value: impl Display, expected: &str) -> CaseError {
        CaseError::Value {
            place: self.0.place(key),
            key: key.to_owned(),
            value: value.to_string(),
            expected: expected.to_owned(),
        }
    }

    pub fn that(
        &self,
        ok: bool,
        key: &str,
        value: impl Display,
        expected: &str,
    ) -> Result<(), CaseError> {
        if ok { Ok(()) } else { Err(self.refuse(key, value, expected)) }
    }

    pub fn positive(&self, key: &str, value: f64, unit: &str) -> Result<(), CaseError> {
        let expected = format!("a positive, finite number in {unit}");
        self.that(value.is_finite() && value > 0.0, key, Number(value), &expected)
    }

    pub fn not_negative(&self, key: &str, value: f64, unit: &str) -> Result<(), CaseError> {
        let expected = format!("zero or a positive, finite number in {unit}");
        self.that(value.is_finite() && value >= 0.0, key, Number(value), &expected)
    }

    pub fn finite(&self, key: &str, value: f64, unit: &str) -> Result<(), CaseError> {
        self.that(value.is_finite(), key, Number(value), &format!("a finite number in {unit}"))
    }

    /// The place of a key, or of what is nearest around it.
    pub fn place(&self, key: &str) -> Place {
        self.0.place_around(key)
    }

    /// For a key that must be there.
    pub fn missing(&self, key: &str, expected: &str) -> CaseError {
        let (place, key) = (self.place(key), key.to_owned());
        CaseError::Missing { place, key, expected: expected.to_owned() }
    }

    /// `[transfer]` for a mesh of so many nodes.
    pub fn transfer(
        &self,
        section: &TransferSection,
        nodes: usize,
    ) -> Result<Transfers, CaseError> {
        let (power, neighbours) = (section.power, section.neighbours);
        let number = "a positive, finite number";
        self.that(power.is_finite() && power > 0.0, "transfer.power", Number(power), number)?;
        let expected = format!("at least 1 and at most the mesh's {nodes} nodes");
        let ok = (1..=nodes).contains(&neighbours);
        self.that(ok, "transfer.neighbours", neighbours, &expected)?;
        let inverse_distance = Transfer::InverseDistance { power, neighbours };
        let chosen = match section.method {
            TransferMethod::FiniteElement => Transfer::FiniteElement {},
            TransferMethod::InverseDistance => inverse_distance,
        };
        Ok(Transfers { chosen, inverse_distance })
    }

    /// `[pod]`, of so many snapshots.
    pub fn pod(&self, pod: &PodSection, snapshots: usize) -> Result<PodChoice, CaseError> {
        let names: Vec<&str> = ALGORITHMS.iter().map(|algorithm| algorithm.name).collect();
        let method = pod.method.as_str();
        self.that(names.contains(&method), "pod.method", method, &names.join(", "))?;
        let truncation = match (pod.modes, pod.energy) {
            (Some(modes), Some(_)) => {
                let expected = "either pod.modes or pod.energy, not both";
                return Err(self.refuse("pod.modes", modes, expected));
            }
            (Some(modes), None) => {
                self.that(modes >= 1, "pod.modes", modes, "at least 1")?;
                Truncation::Modes(modes)
            }
            (None, energy) => {
                let share = energy.unwrap_or(0.9999);
                let expected = "a share of the energy above 0 and at most 1, such as 0.9999";
                self.that(share > 0.0 && share <= 1.0, "pod.energy", Number(share), expected)?;
                Truncation::Energy(share)
            }
        };
        if let Some(every) = pod.every {
            let expected = format!(
                "from 2 to the {snapshots} snapshots of the record: with 5, a second POD of the fifth, the tenth, ..."
            );
            self.that((2..=snapshots).contains(&every), "pod.every", every, &expected)?;
        }
        let PodSection { center, every, .. } = *pod;
        Ok(PodChoice { method: method.to_owned(), truncation, center, every })
    }
}

/// The two ways to the fixed grid.
pub(super) struct Transfers {
    /// The one that the case asks for.
    pub chosen: Transfer,
    /// The paper's, which may be measured beside it.
    pub inverse_distance: Transfer,
}

/// A number in its shortest form: 1e300, not three hundred digits.
pub(super) struct Number(pub f64);

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.0)
    }
}
