use lumley_fem::{Boundary, PlanarMesh, Point};

/// A boundary as chords between its nodes, to measure distances from.
#[derive(Debug)]
pub(super) struct Outline {
    groups: Vec<Group>,
    whole: Rectangle,
    centre: Point,
}

/// Chords that follow each other, and the rectangle round them.
#[derive(Debug)]
struct Group {
    rectangle: Rectangle,
    chords: Vec<[Point; 2]>,
}

#[derive(Debug, Clone, Copy)]
struct Rectangle {
    low: Point,
    high: Point,
}

impl Outline {
    pub fn new(mesh: &PlanarMesh, boundary: &Boundary) -> Self {
        let halves = |&edge: &usize| {
            let [a, b, middle] = mesh.edge(edge);
            [[a, middle], [middle, b]]
        };
        let chords: Vec<[Point; 2]> = boundary.edges.iter().flat_map(halves).collect();
        // Groups about as long as there are groups: few of either are looked at.
        let groups = chords.chunks(chords.len().isqrt()).map(Group::new).collect();
        Self { groups, whole: Rectangle::round(&chords), centre: centre(&chords) }
    }

    /// Distance of a point from the nearest chord, in m.
    pub fn distance(&self, point: Point) -> f64 {
        let nearest = self.groups.iter().fold(f64::INFINITY, |best, group| {
            if group.rectangle.squared_distance(point) >= best {
                return best;
            }
            let distances = group.chords.iter().map(|chord| squared_distance(point, chord));
            distances.fold(best, f64::min)
        });
        nearest.sqrt()
    }

    /// The longer side of the rectangle round it, in m.
    pub fn extent(&self) -> f64 {
        let Rectangle { low, high } = self.whole;
        (high[0] - low[0]).max(high[1] - low[1])
    }

    /// The centroid of the line, in m.
    pub fn centre(&self) -> Point {
        self.centre
    }
}

impl Group {
    fn new(chords: &[[Point; 2]]) -> Self {
        Self { rectangle: Rectangle::round(chords), chords: chords.to_vec() }
    }
}

impl Rectangle {
    fn round(chords: &[[Point; 2]]) -> Self {
        let of = |f: fn(f64, f64) -> f64, start: f64| {
            let x = |d: usize| chords.as_flattened().iter().map(|p| p[d]).fold(start, f);
            [x(0), x(1)]
        };
        Self { low: of(f64::min, f64::INFINITY), high: of(f64::max, f64::NEG_INFINITY) }
    }

    fn squared_distance(&self, point: Point) -> f64 {
        let beyond = |d: usize| (self.low[d] - point[d]).max(point[d] - self.high[d]).max(0.0);
        beyond(0).powi(2) + beyond(1).powi(2)
    }
}

fn squared_distance(point: Point, [a, b]: &[Point; 2]) -> f64 {
    let (along, arm) = ([b[0] - a[0], b[1] - a[1]], [point[0] - a[0], point[1] - a[1]]);
    let square = along[0] * along[0] + along[1] * along[1];
    let t = ((arm[0] * along[0] + arm[1] * along[1]) / square).clamp(0.0, 1.0);
    (arm[0] - t * along[0]).powi(2) + (arm[1] - t * along[1]).powi(2)
}

fn centre(chords: &[[Point; 2]]) -> Point {
    let length = |[a, b]: &[Point; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    let total: f64 = chords.iter().map(length).sum();
    let mean = |d: usize| {
        let moment = |c: &[Point; 2]| length(c) * 0.5 * (c[0][d] + c[1][d]);
        chords.iter().map(moment).sum::<f64>() / total
    };
    [mean(0), mean(1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumley_fem::MeshDescription;

    /// Distances by hand: the groups do not show.
    #[test]
    fn distances_from_a_side_of_a_square() -> Result<(), lumley_fem::MeshError> {
        let description = MeshDescription::structured([37, 2], |_| false, |p| p);
        let mesh = PlanarMesh::new(description)?;
        let bottom = mesh.topology().boundary("bottom").expect("the bottom");
        let outline = Outline::new(&mesh, bottom);
        for (point, distance) in
            [([0.3, 0.2], 0.2), ([0.99, -0.4], 0.4), ([1.3, 0.4], 0.5), ([-3.0, -4.0], 5.0)]
        {
            assert!((outline.distance(point) - distance).abs() < 1e-15, "{point:?}");
        }
        assert!((outline.extent() - 1.0).abs() < 1e-15);
        assert!((outline.centre()[0] - 0.5).abs() < 1e-15 && outline.centre()[1] == 0.0);
        Ok(())
    }
}
