//! Areas and lengths of curved domains against exact ones.

use crate::{orders, some};
use lumley_fem::{MeshDescription, NamedBoundary, PlanarMesh, Point};
use std::f64::consts::{FRAC_PI_2, PI};

/// Rings of nodes round a centre: ring k has 6 k nodes and the radius k; the mesh is made of every second.
struct Rings;

impl Rings {
    fn node(ring: usize, index: usize) -> usize {
        if ring == 0 { 0 } else { 1 + 3 * ring * (ring - 1) + index % (6 * ring) }
    }

    fn points(rings: usize, radius: f64) -> Vec<Point> {
        let mut points = vec![[0.0; 2]];
        for ring in 1..=rings {
            for index in 0..6 * ring {
                let (sin, cos) = (PI * index as f64 / (3 * ring) as f64).sin_cos();
                points.push([cos, sin].map(|x| radius * x * ring as f64 / rings as f64));
            }
        }
        points
    }

    /// Triangles between ring `ring` and the next but one, in one of the six sectors.
    fn triangles(ring: usize, sector: usize) -> Vec<[usize; 6]> {
        let node = |up: usize, along: usize| Self::node(ring + up, sector * (ring + up) + along);
        let mut triangles = Vec::new();
        for k in (0..=ring).step_by(2) {
            triangles.push(
                [[0, 0], [2, 0], [2, 2], [1, 0], [2, 1], [1, 1]]
                    .map(|[up, along]| node(up, k + along)),
            );
            if k < ring {
                triangles.push(
                    [[0, 0], [2, 2], [0, 2], [1, 1], [1, 2], [0, 1]]
                        .map(|[up, along]| node(up, k + along)),
                );
            }
        }
        triangles
    }
}

/// A disc about the origin: triangles inside, two layers of quadrilaterals round them up to the rim.
fn disc(layers: usize, radius: f64) -> MeshDescription {
    let rings = 2 * layers;
    let (mut points, around) = (Rings::points(rings, radius), 6 * rings);
    let inside = 0..rings;
    let triangles = inside
        .step_by(2)
        .flat_map(|ring| (0..6).flat_map(move |sector| Rings::triangles(ring, sector)))
        .collect();
    let first = Rings::node(rings, 0);
    let node = |up: usize, along: usize| first + up * around + along % around;
    for up in [1.0, 2.0, 3.0, 4.0] {
        let far = 1.0 + up / rings as f64;
        for along in 0..around {
            let point = points[node(0, along)];
            points.push(point.map(|x| far * x));
        }
    }
    let quadrilateral = |up: usize, along: usize| {
        [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1], [1, 1]]
            .map(|[u, a]| node(up + u, along + a))
    };
    let starts = || (0..around).step_by(2);
    let quadrilaterals = [0, 2].into_iter().flat_map(|up| starts().map(move |a| (up, a)));
    let rim = starts().map(|a| [node(4, a), node(4, a + 2), node(4, a + 1)]).collect();
    MeshDescription {
        quadrilaterals: quadrilaterals.map(|(up, a)| quadrilateral(up, a)).collect(),
        triangles,
        boundaries: vec![NamedBoundary { name: "rim".into(), edges: rim }],
        points,
    }
}

#[test]
fn area_and_rim_of_a_disc_are_of_order_four() {
    let (mut areas, mut rims) = (vec![], vec![]);
    for layers in [2, 4, 8, 16] {
        let mesh = PlanarMesh::new(disc(layers, 0.5)).expect("valid");
        let radius = 0.5 * (1.0 + 2.0 / layers as f64);
        areas.push((mesh.quality().area / (PI * radius * radius) - 1.0).abs());
        let rim = mesh.topology().boundary("rim").expect("the rim");
        rims.push((mesh.boundary_length(rim) / (2.0 * PI * radius) - 1.0).abs());
    }
    for (name, errors) in [("area", &areas), ("rim", &rims)] {
        for order in orders(errors) {
            assert!((order - 4.0).abs() < 0.1, "{name}: {errors:?}, order {order}");
        }
    }
    assert!(areas[3] < 1e-7 && rims[3] < 1e-7, "{areas:?} {rims:?}");
}

/// A quarter of a ring: two arcs and two straight sides.
#[test]
fn sides_of_a_mixed_ring_are_what_they_should() {
    let ring = |[x, y]: Point| {
        let (sin, cos) = (FRAC_PI_2 * y).sin_cos();
        [(1.0 + x) * cos, (1.0 + x) * sin]
    };
    let exact = [1.0, PI, 1.0, FRAC_PI_2];
    let error = |n: usize| {
        let mesh =
            PlanarMesh::new(MeshDescription::structured([n, 2 * n], some, ring)).expect("valid");
        let lengths = mesh.topology().boundaries().iter().map(|b| mesh.boundary_length(b));
        let worst = lengths.zip(exact).map(|(l, e)| (l / e - 1.0).abs()).fold(0.0, f64::max);
        worst.max((mesh.quality().area / (0.75 * PI) - 1.0).abs())
    };
    let errors: Vec<f64> = [2, 4, 8].into_iter().map(error).collect();
    assert!(orders(&errors).iter().all(|order| *order > 3.9), "{errors:?}");
}
