use crate::case::CaseError;
use crate::case::ask::{Ask, Number};
use crate::case::flow::{BodyProbesSection, March};
use crate::case::suggest::nearest;
use lumley_body::Tree;

/// What is told of a body at given times: `[output.probes]`.
///
/// ```
/// use lumley::case::BodyProbes;
/// let probes = BodyProbes { times: vec![0.55], body: 1, coordinates: vec![("theta".into(), 0)] };
/// assert_eq!(probes.coordinates[0].0, "theta");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct BodyProbes {
    /// When, in s, increasing.
    pub times: Vec<f64>,
    /// Number of the body on whose boundary the load is taken.
    pub body: usize,
    /// Coordinates: names in the results, and numbers in the tree.
    pub coordinates: Vec<(String, usize)>,
}

/// What a probe tells anyway.
const TAKEN: [&str; 4] = ["time", "fx", "fy", "mg"];

pub(super) fn probes(
    ask: &Ask,
    section: &BodyProbesSection,
    tree: &Tree,
    march: &March,
) -> Result<BodyProbes, CaseError> {
    let end = march.unsteady().map_or(0.0, |time| time.end);
    check_times(ask, &section.times, end)?;
    let body = body(ask, &section.body, tree)?;
    let labels: Vec<String> = (0..tree.coordinates().len()).map(|k| tree.label(k)).collect();
    let coordinate = |(name, label): (&String, &String)| {
        let key = format!("output.probes.coordinates.{name}");
        let free = format!("a name other than {}, which every probe tells", TAKEN.join(", "));
        ask.that(!TAKEN.contains(&name.as_str()), &key, label, &free)?;
        let expected = || one_of("a coordinate of the bodies", label, &labels);
        let found = labels.iter().position(|known| known == label);
        Ok((name.clone(), found.ok_or_else(|| ask.refuse(&key, label, &expected()))?))
    };
    let coordinates = section.coordinates.iter().map(coordinate).collect::<Result<_, _>>()?;
    Ok(BodyProbes { times: section.times.clone(), body, coordinates })
}

fn check_times(ask: &Ask, times: &[f64], end: f64) -> Result<(), CaseError> {
    let key = "output.probes.times";
    ask.that(!times.is_empty(), key, "[]", "one or more times in s")?;
    let within = format!("times in s from 0 to time.end = {end:?} s");
    for &time in times {
        ask.that((0.0..=end).contains(&time), key, Number(time), &within)?;
    }
    let after = times.windows(2).find(|pair| pair[1] <= pair[0]);
    let Some([before, time]) = after else { return Ok(()) };
    let expected = format!("times that increase; it comes after {before:?} s");
    Err(ask.refuse(key, Number(*time), &expected))
}

/// The number of a body that has a boundary.
fn body(ask: &Ask, name: &str, tree: &Tree) -> Result<usize, CaseError> {
    let wet = tree.bodies().iter().filter(|body| body.boundary.is_some());
    let wet: Vec<String> = wet.map(|body| body.name.clone()).collect();
    let expected = || one_of("a body with a boundary", name, &wet);
    let found = tree.body(name).filter(|_| wet.iter().any(|known| known == name));
    found.ok_or_else(|| ask.refuse("output.probes.body", name, &expected()))
}

/// What is expected where another name was found.
fn one_of(what: &str, found: &str, known: &[String]) -> String {
    let words: Vec<&str> = known.iter().map(String::as_str).collect();
    let hint = nearest(found, &words).map_or(String::new(), |w| format!("; did you mean {w}?"));
    format!("{what}: {}{hint}", words.join(", "))
}
