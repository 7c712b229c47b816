use super::wet::Wet;
use lumley_fem::{Boundary, PlanarMesh, Point};

/// Which boundary a body has met, if it has: one of its nodes is in another body, or not within the walls any more. The
/// numbers of both boundaries.
pub(super) fn find(mesh: &PlanarMesh, wet: &[Wet]) -> Option<[usize; 2]> {
    let boundaries = mesh.topology().boundaries();
    let own: Vec<usize> = wet.iter().map(|wet| wet.boundary).collect();
    let walls = || (0..boundaries.len()).filter(|k| !own.contains(k));
    for &body in &own {
        let nodes = || boundaries[body].edges.iter().map(|&edge| mesh.edge(edge)[0]);
        let mut others = own.iter().filter(|&&other| other != body);
        if let Some(&other) =
            others.find(|&&other| nodes().any(|node| encloses(mesh, [&boundaries[other]], node)))
        {
            return Some([body, other]);
        }
        let all = || walls().map(|k| &boundaries[k]);
        if let Some(node) = nodes().find(|node| !encloses(mesh, all(), *node)) {
            let distance = |k: &usize| nearest(mesh, &boundaries[*k], node);
            let wall = walls().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
            return Some([body, wall]);
        }
    }
    None
}

/// The body that is nearest to another boundary, that boundary, and the distance of their nodes, in m.
pub(super) fn nearest_pair(mesh: &PlanarMesh, wet: &[Wet]) -> Option<([usize; 2], f64)> {
    let boundaries = mesh.topology().boundaries();
    let mut pairs = Vec::new();
    for &Wet { boundary: body, .. } in wet {
        for other in (0..boundaries.len()).filter(|&k| k != body) {
            let nodes = boundaries[body].edges.iter().flat_map(|&edge| mesh.edge(edge));
            let distances = nodes.map(|node| nearest(mesh, &boundaries[other], node));
            pairs.push(([body, other], distances.fold(f64::INFINITY, f64::min)));
        }
    }
    pairs.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Whether an odd number of chords of these boundaries crosses the ray from a point to the left.
fn encloses<'a>(
    mesh: &PlanarMesh,
    boundaries: impl IntoIterator<Item = &'a Boundary>,
    [x, y]: Point,
) -> bool {
    let edges = boundaries.into_iter().flat_map(|boundary| &boundary.edges);
    let chords = edges.flat_map(|&edge| {
        let [a, b, middle] = mesh.edge(edge);
        [[a, middle], [middle, b]]
    });
    let crosses = |[a, b]: &[Point; 2]| {
        (a[1] <= y) != (b[1] <= y) && a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) <= x
    };
    chords.filter(crosses).count() % 2 == 1
}

/// Distance of a point from the nearest node of a boundary, in m.
fn nearest(mesh: &PlanarMesh, boundary: &Boundary, [x, y]: Point) -> f64 {
    let nodes = boundary.edges.iter().flat_map(|&edge| mesh.edge(edge));
    nodes.map(|[a, b]| (a - x).hypot(b - y)).fold(f64::INFINITY, f64::min)
}
