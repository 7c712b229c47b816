use crate::{Note, Truncation};

/// The eigenvalues that an algorithm computed, and which of them it can vouch for.
#[derive(Debug, Clone)]
pub(crate) struct Spectrum {
    /// Eigenvalues, largest first, none negative.
    pub values: Vec<f64>,
    /// Those at or under this are noise.
    pub floor: f64,
    /// Energy that the algorithm loses by squaring; nothing where it does not square, so that what
    /// is under the floor is round-off of the snapshots themselves and the number above it is
    /// their rank.
    pub squaring: Option<f64>,
    /// Energy that an approximation left out and no eigenvalue holds.
    pub left_out: Option<f64>,
}

impl Spectrum {
    /// * `round_off`: energy that round-off of the snapshots can have
    ///
    /// Returns nothing where there is no more energy than that.
    pub fn new(mut values: Vec<f64>, round_off: f64, squaring: Option<f64>) -> Option<Self> {
        for value in &mut values {
            *value = value.max(0.0);
        }
        values.first().filter(|l| **l >= f64::MIN_POSITIVE && **l > round_off)?;
        Some(Self {
            values,
            floor: round_off.max(squaring.unwrap_or(0.0)),
            squaring,
            left_out: None,
        })
    }

    /// Energy of the snapshots.
    pub fn total(&self) -> f64 {
        self.values.iter().sum::<f64>() + self.left_out.unwrap_or(0.0)
    }

    /// Eigenvalues above the floor.
    pub fn rank(&self) -> usize {
        self.values.iter().take_while(|l| **l > self.floor).count()
    }

    /// Number of modes that are asked for, whether or not they can be had.
    pub fn asked(&self, truncation: Truncation) -> usize {
        match truncation {
            Truncation::Modes(modes) => modes,
            Truncation::Energy(fraction) => {
                let wanted = fraction * self.total();
                let mut sum = 0.0;
                let short = |l: &&f64| {
                    sum += **l;
                    sum < wanted
                };
                1 + self.values.iter().take_while(short).count().min(self.values.len() - 1)
            }
        }
    }

    /// Number of modes to keep, with a warning if more were asked for. An energy asked for is not
    /// warned about: what the modes under the floor hold is round-off.
    pub fn keep(&self, truncation: Truncation) -> (usize, Option<Note>) {
        let (asked, rank) = (self.asked(truncation), self.rank());
        let kept = asked.min(rank);
        let Truncation::Modes(requested) = truncation else { return (kept, None) };
        let note = if requested <= rank {
            None
        } else if self.squaring.is_none() || rank == self.values.len() {
            Some(Note::Rank { requested, rank })
        } else {
            Some(Note::NoiseFloor { requested, kept, floor: self.floor })
        };
        (kept, note)
    }
}
