//! The mesh: how it looks, and how good its cells are.

use super::FlowReport;
use super::rings::{Ring, bounds, rings};
use crate::report::figure::{Axis, Curves, Drawing, Figure, LineChart, Plan, Series};
use crate::report::html::{Section, Table};
use crate::report::literal;
use crate::report::number::{count, significant};
use lumley_fem::{CellQuality, PlanarMesh, Point};

/// Highest picture of the whole mesh and of what is near a body.
const WHOLE: f64 = 420.0;
const NEAR: f64 = 520.0;

/// Bars of a histogram.
const BARS: usize = 24;

pub(super) fn section(report: &FlowReport) -> Section {
    let section = Section::new("The mesh");
    let Some(mesh) = &report.scene.mesh else {
        return section.paragraph("The mesh of this run is not on the disk.");
    };
    section.figure(picture(mesh)).figure(histograms(mesh)).table(&table(mesh))
}

/// The whole mesh, and below it what is near the bodies.
fn picture(mesh: &PlanarMesh) -> Figure {
    let (lower, upper) = bounds(mesh.nodes().iter());
    // Lines on the rim are to be seen in their full width.
    let rim = 0.005 * (upper[0] - lower[0]).max(upper[1] - lower[1]);
    let (from, to) = (lower.map(|c| c - rim), upper.map(|c| c + rim));
    let mut drawings = vec![layers(mesh, Plan::new(from, to)).draw(WHOLE)];
    let caption =
        "The mesh; edges are the curves that the cells have, boundaries are coloured by their \
        names."
            .to_string();
    let bodies: Vec<Ring> = rings(mesh).into_iter().filter(Ring::is_body).collect();
    let caption = match near(&bodies, (lower, upper)) {
        None => caption,
        Some((from, to)) => {
            drawings.push(layers(mesh, Plan::new(from, to)).without_legend().draw(NEAR));
            caption
                + if bodies.len() == 1 {
                    " Below, near the body."
                } else {
                    " Below, near the bodies."
                }
        }
    };
    let caption = caption + " Where cells are too small to be seen some edges are left out.";
    Drawing::stack(&drawings).figure("mesh", &caption)
}

/// A rectangle around the bodies with as much space around them as they take, if it shows less than half of
/// the mesh.
fn near(bodies: &[Ring], (lower, upper): (Point, Point)) -> Option<(Point, Point)> {
    let corners: Vec<Point> =
        bodies.iter().map(Ring::bounds).flat_map(|(lower, upper)| [lower, upper]).collect();
    let (from, to) = bounds(corners.iter());
    let size = [0, 1].map(|d| to[d] - from[d]);
    let space = 0.75 * size[0].max(size[1]);
    let from = [0, 1].map(|d| (from[d] - space).max(lower[d]));
    let to = [0, 1].map(|d| (to[d] + space).min(upper[d]));
    let area = |from: Point, to: Point| (to[0] - from[0]) * (to[1] - from[1]);
    (!bodies.is_empty() && area(from, to) < 0.5 * area(lower, upper)).then_some((from, to))
}

fn layers(mesh: &PlanarMesh, plan: Plan) -> Plan {
    let topology = mesh.topology();
    let inside = (0..topology.edges().len()).filter(|&e| topology.edges()[e].right.is_some());
    let plan = plan.curves(Curves::fine(inside.map(|edge| mesh.edge(edge)).collect()));
    topology.boundaries().iter().enumerate().fold(plan, |plan, (k, boundary)| {
        let edges = boundary.edges.iter().map(|&edge| mesh.edge(edge)).collect();
        plan.curves(Curves::line(&literal(&boundary.name), edges).colour(k))
    })
}

fn histograms(mesh: &PlanarMesh) -> Figure {
    let cells = mesh.cell_qualities();
    let of = |value: fn(&CellQuality) -> f64| cells.iter().map(value).collect::<Vec<f64>>();
    let jacobian = histogram(&of(|c| c.scaled_jacobian), (0.0, 1.0));
    let aspects = of(|c| c.aspect);
    let largest = aspects.iter().copied().fold(2.0, f64::max);
    let aspect = histogram(&aspects, (1.0, largest));
    let panel = |name: &str, (x, y): &(Vec<f64>, Vec<f64>), colour: usize| {
        LineChart::new(Axis::new(name, ""), Axis::new("cells", "%"))
            .series(Series::area("", x, y).colour(colour))
            .draw_at(346.0, 190.0)
    };
    let drawing =
        Drawing::panels(2, &[panel("scaled Jacobian", &jacobian, 0), panel("aspect", &aspect, 1)]);
    let caption = "Quality of the cells. The scaled Jacobian is the smallest over the largest determinant \
        of a cell’s map: 1 for straight cells, 0 for one about to fold. The aspect tells how much longer \
        than wide a cell is, 1 at best; along walls long cells are wanted.";
    drawing.figure("quality", caption)
}

/// The outline of a histogram over `range`, in percent of the values.
fn histogram(values: &[f64], (lo, hi): (f64, f64)) -> (Vec<f64>, Vec<f64>) {
    let width = (hi - lo) / BARS as f64;
    let mut counts = [0_usize; BARS];
    for value in values {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let bar = ((value - lo) / width).clamp(0.0, BARS as f64 - 1.0) as usize;
        counts[bar] += 1;
    }
    let share = |count: usize| 100.0 * count as f64 / values.len().max(1) as f64;
    let ends = (0..BARS).flat_map(|k| [k, k + 1]).map(|k| lo + k as f64 * width);
    (ends.collect(), counts.iter().flat_map(|&count| [share(count); 2]).collect())
}

fn table(mesh: &PlanarMesh) -> Table {
    let quality = mesh.quality();
    let row = |name: &str, value: String| vec![name.to_string(), value];
    let place = |cell: usize| {
        let [x, y] = mesh.centre(cell).map(|c| significant(c, 3));
        format!(" at ({x}, {y})")
    };
    let worst = |value: lumley_fem::Extreme| significant(value.value, 3) + &place(value.cell);
    Table::new(&[]).labels(2).rows([
        row("triangles", count(quality.triangles)),
        row("quadrilaterals", count(quality.quadrilaterals)),
        row("area (m^{2})", significant(quality.area, 6)),
        row("smallest scaled Jacobian", worst(quality.scaled_jacobian)),
        row("largest aspect", worst(quality.aspect)),
        row("shortest edge (m)", worst(quality.shortest_edge)),
        row("longest edge (m)", worst(quality.longest_edge)),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_of_a_histogram() {
        let (x, y) = histogram(&[0.0, 0.01, 1.0, 7.0], (0.0, 1.0));
        assert_eq!((x.len(), y.len()), (2 * BARS, 2 * BARS));
        assert_eq!((y[0], y[1], y[2]), (50.0, 50.0, 0.0));
        assert_eq!((x[2 * BARS - 1], y[2 * BARS - 1]), (1.0, 50.0));
        assert!(histogram(&[], (0.0, 1.0)).1.iter().all(|y| *y == 0.0));
    }
}
