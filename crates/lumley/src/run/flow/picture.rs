use crate::case::FlowCase;
use lumley_fem::{Point, UniformGrid};

/// Most nodes in one direction: a page hardly has more pixels.
const NODES: f64 = 480.0;
/// Most numbers of all pictures together, 256 MB of them.
const NUMBERS: f64 = 32e6;
/// Numbers at a node: u, v, p and vorticity.
const COMPONENTS: f64 = 4.0;

/// The grid of the `pictures`: where the record is, else round the whole mesh; square as far as it goes.
pub(super) fn grid(case: &FlowCase, pictures: usize) -> UniformGrid {
    let (lower, upper) = match &case.record {
        Some(record) => record.grid.bounds(),
        None => bounds(case.mesh.nodes()),
    };
    let size = [0, 1].map(|d| upper[d] - lower[d]);
    let most = NUMBERS / COMPONENTS / pictures.max(1) as f64;
    let widest = size[0].max(size[1]);
    let spacing = (widest / NODES).max((size[0] * size[1] / most).sqrt());
    UniformGrid::rectangle(lower, upper, size.map(|length| nodes(length, spacing)))
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a positive number of at most a few hundred"
)]
fn nodes(length: f64, spacing: f64) -> usize {
    1 + (length / spacing).round().max(1.0) as usize
}

/// Lower and upper corner.
fn bounds(points: &[Point]) -> (Point, Point) {
    let corner = |start: f64, choose: fn(f64, f64) -> f64| {
        [0, 1].map(|d| points.iter().map(|point| point[d]).fold(start, choose))
    };
    (corner(f64::INFINITY, f64::min), corner(f64::NEG_INFINITY, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    fn nodes(name: &str, pictures: usize) -> [usize; 2] {
        let text = crate::cases::find(name).expect("it comes with lumley").text;
        let case = Case::parse("case.toml".as_ref(), text, true, &[]).expect("a case");
        let Case::Flow(case) = case else { panic!("it has a [flow]") };
        grid(&case, pictures).nodes()
    }

    #[test]
    fn pictures_are_fine_and_not_too_large() {
        assert_eq!(nodes("cavity", 1), [481, 481]);
        assert_eq!(nodes("cylinder-2d2", 100), [481, 90]);
        // The record of the oscillating cylinder: 15 m by 6 m.
        let [nx, ny] = nodes("oscillating-cylinder", 100);
        let numbers = 100.0 * COMPONENTS * (nx * ny) as f64;
        assert!((0.9 * NUMBERS..1.1 * NUMBERS).contains(&numbers), "{nx} x {ny}");
    }
}
