use crate::Error;
use crate::record::Record;
use crate::summary::{BodyProbe, PistonProbe, Probe};

/// Times of the reference table, in s.
const TIMES: [f64; 2] = [1.0, 2.0];

/// The full-order model at the times of the reference table, where it has a snapshot then, and at its end.
pub(super) fn probes(record: &Record) -> Result<Vec<Probe>, Error> {
    let series = ["position", "velocity", "velocity-mid", "traction"];
    let [position, velocity, middle, traction] = series.map(|name| record.series(name));
    let (position, velocity, middle, traction) = (position?, velocity?, middle?, traction?);
    let times = record.times();
    let asked =
        |k: usize| k + 1 == times.len() || TIMES.iter().any(|time| (times[k] - time).abs() < 1e-9);
    let probe = |k: usize| {
        Probe::Piston(PistonProbe {
            time: times[k],
            body: BodyProbe { position: position.at(k)[0], velocity: velocity.at(k)[0] },
            velocity_mid: middle.at(k)[0],
            traction: traction.at(k)[0],
        })
    };
    Ok((0..times.len()).filter(|k| asked(*k)).map(probe).collect())
}
