use super::plane::{add, dot, orientation, scale, subtract};
use super::size::SizeField;
use crate::Point;

/// A star with a triangle worse than this is not made worse.
const GOOD: f64 = 0.6;

/// Moves each corner after the first `fixed` to the centre of mass of the triangles round it, the mass of a
/// triangle being its area over the fourth power of the wanted size (centroidal patches, Chen 2004): a corner
/// in a uniform mesh of the wanted size stays. No triangle is turned over.
pub(super) fn smooth(
    points: &mut [Point],
    fixed: usize,
    triangles: &[[usize; 3]],
    field: &SizeField,
) {
    let sizes: Vec<f64> = points.iter().map(|&p| field.at(p)).collect();
    let stars = Stars::new(points.len(), triangles);
    for corner in fixed..points.len() {
        let star = stars.of(corner);
        let old = points[corner];
        let before = worst(points, triangles, star);
        points[corner] = centre_of_mass(points, triangles, star, &sizes);
        if worst(points, triangles, star) < before.min(GOOD) {
            points[corner] = old;
        }
    }
}

/// The triangles round each corner.
struct Stars {
    start: Vec<usize>,
    triangles: Vec<usize>,
}

impl Stars {
    fn new(corners: usize, triangles: &[[usize; 3]]) -> Self {
        let mut start = vec![0; corners + 1];
        triangles.iter().flatten().for_each(|&corner| start[corner + 1] += 1);
        (0..corners).for_each(|corner| start[corner + 1] += start[corner]);
        let mut next = start.clone();
        let mut round = vec![0; 3 * triangles.len()];
        for (triangle, corners) in triangles.iter().enumerate() {
            for &corner in corners {
                round[next[corner]] = triangle;
                next[corner] += 1;
            }
        }
        Self { start, triangles: round }
    }

    fn of(&self, corner: usize) -> &[usize] {
        &self.triangles[self.start[corner]..self.start[corner + 1]]
    }
}

fn centre_of_mass(
    points: &[Point],
    triangles: &[[usize; 3]],
    star: &[usize],
    sizes: &[f64],
) -> Point {
    let (mut moment, mut total) = ([0.0; 2], 0.0);
    for &triangle in star {
        let corners = triangles[triangle].map(|corner| points[corner]);
        let size = triangles[triangle].iter().map(|&corner| sizes[corner]).sum::<f64>() / 3.0;
        let mass = orientation(corners) / size.powi(4);
        let centre = scale(1.0 / 3.0, corners.into_iter().fold([0.0; 2], add));
        moment = add(moment, scale(mass, centre));
        total += mass;
    }
    scale(1.0 / total, moment)
}

fn worst(points: &[Point], triangles: &[[usize; 3]], star: &[usize]) -> f64 {
    let qualities = star.iter().map(|&t| quality(triangles[t].map(|corner| points[corner])));
    qualities.fold(f64::INFINITY, f64::min)
}

/// 1 for an equilateral triangle, 0 for a flat one, negative when it is turned over.
fn quality(corners: [Point; 3]) -> f64 {
    let [a, b, c] = corners;
    let squares = [[a, b], [b, c], [c, a]].map(|[p, q]| subtract(q, p)).map(|e| dot(e, e));
    2.0 * 3.0_f64.sqrt() * orientation(corners) / squares.iter().sum::<f64>()
}
