//! A ring between the circles r = 1 m and r = 2 m, where solutions are known.

use crate::{Outcome, moving};
use lumley_fem::{MeshDescription, NamedBoundary, PlanarMesh, Point};
use lumley_fom::motion::{MeshMotion, MotionParameters, RigidMotion, Stiffness};
use std::f64::consts::PI;

/// `n` layers of `6 n` cells, in a pattern of quadrilaterals and pairs of triangles.
fn ring(n: usize) -> PlanarMesh {
    let around = 12 * n;
    let node = |up: usize, along: usize| up * around + along % around;
    let mut description = MeshDescription::default();
    for up in 0..=2 * n {
        let radius = 1.0 + up as f64 / (2 * n) as f64;
        for along in 0..around {
            let (sin, cos) = (2.0 * PI * along as f64 / around as f64).sin_cos();
            description.points.push([radius * cos, radius * sin]);
        }
    }
    for (i, j) in (0..n).flat_map(|i| (0..6 * n).map(move |j| (i, j))) {
        let at = |up: usize, along: usize| node(2 * i + up, 2 * j + along);
        let [a, b, c, d] = [at(0, 0), at(2, 0), at(2, 2), at(0, 2)];
        let [ab, bc, cd, da, centre] = [at(1, 0), at(2, 1), at(1, 2), at(0, 1), at(1, 1)];
        if (i + 2 * j) % 5 < 2 {
            description.triangles.extend([[a, b, c, ab, bc, centre], [a, c, d, centre, cd, da]]);
        } else {
            description.quadrilaterals.push([a, b, c, d, ab, bc, cd, da, centre]);
        }
    }
    for (name, up) in [("inner", 0), ("outer", 2 * n)] {
        let edge = |j| [node(up, 2 * j), node(up, 2 * j + 2), node(up, 2 * j + 1)];
        let edges = (0..6 * n).map(edge).collect();
        description.boundaries.push(NamedBoundary { name: name.into(), edges });
    }
    PlanarMesh::new(description).expect("a valid ring")
}

/// Where the nodes go when the inner circle moves and the outer one stays.
fn moved(mesh: &PlanarMesh, stiffness: Stiffness, motion: RigidMotion) -> Vec<Point> {
    let parameters = MotionParameters { stiffness, rigid_zone: 0.0 };
    let inner = [moving("inner", [0.0; 2])];
    let mesh_motion = MeshMotion::new(mesh, &inner, &parameters).expect("a sound motion");
    let mut nodes = mesh.nodes().to_vec();
    mesh_motion.place(&[motion], &mut nodes);
    nodes
}

/// Largest distance of the nodes from where the exact shares h(r) and g(r) put them, on three meshes.
fn errors(stiffness: Stiffness, motion: RigidMotion, [h, g]: [fn(f64) -> f64; 2]) -> Vec<f64> {
    let error = |n: usize| {
        let mesh = ring(n);
        let exact = |&[x, y]: &Point| {
            let r = x.hypot(y);
            let translation = motion.translation.map(|d| h(r) * d);
            RigidMotion { translation, angle: g(r) * motion.angle }.place([0.0; 2], [x, y])
        };
        let nodes = moved(&mesh, stiffness, motion);
        let gap = |(a, b): (&Point, Point)| (a[0] - b[0]).hypot(a[1] - b[1]);
        nodes.iter().zip(mesh.nodes().iter().map(exact)).map(gap).fold(0.0, f64::max)
    };
    [3, 6, 12].into_iter().map(error).collect()
}

fn check_order(errors: &[f64], order: f64, last: f64) {
    let orders = errors.windows(2).map(|e| (e[0] / e[1]).log2());
    assert!(orders.into_iter().all(|found| found > order), "{errors:?}");
    assert!(errors[2] < last, "{errors:?}");
}

fn logarithm(r: f64) -> f64 {
    (2.0 / r).log2()
}

fn linear(r: f64) -> f64 {
    2.0 - r
}

/// `h = log(2/r)/log 2` is harmonic, and quadratic cells have it to the third order and more.
#[test]
fn uniform_stiffness_gives_the_logarithm() {
    let motion = RigidMotion { translation: [0.2, -0.1], angle: 1.3 };
    check_order(&errors(Stiffness::Uniform {}, motion, [logarithm; 2]), 2.9, 2e-5);
}

/// `div(1/r grad(2 - r)) = 0`. Distances are from chords, to the second order.
#[test]
fn stiffness_by_distance_gives_a_linear_share_of_displacements() {
    let motion = RigidMotion { translation: [0.2, -0.1], angle: 1.3 };
    check_order(&errors(Stiffness::default(), motion, [linear, logarithm]), 1.9, 1e-4);
}

#[test]
fn where_all_boundaries_translate_all_nodes_do() -> Outcome {
    let mesh = ring(3);
    let both = [moving("outer", [0.3, 0.1]), moving("inner", [0.0; 2])];
    let motion = RigidMotion { translation: [12.0, -0.7], angle: 0.0 };
    for stiffness in [
        Stiffness::Uniform {},
        Stiffness::Distance { scale: Some(0.1), power: 2.0 },
        Stiffness::CellSize { power: 1.0 },
    ] {
        let parameters = MotionParameters { stiffness, rigid_zone: 0.1 };
        let mesh_motion = MeshMotion::new(&mesh, &both, &parameters)?;
        let mut nodes = mesh.nodes().to_vec();
        mesh_motion.place(&[motion; 2], &mut nodes);
        for ([x, y], [a, b]) in nodes.iter().zip(mesh.nodes()) {
            assert!((x - a - 12.0).abs() < 2e-14 && (y - b + 0.7).abs() < 2e-14);
        }
    }
    Ok(())
}
