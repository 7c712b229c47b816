//! What must hold to the last bit.

use crate::counting::allocations;
use crate::{Outcome, disc, disc_motion, moving};
use lumley_fem::{PlanarMesh, Point};
use lumley_fom::motion::{
    MeshMotion, Motion, MotionParameters, MovingBoundary, PrescribedMotion, RigidMotion, Stiffness,
};
use std::sync::Arc;

const MOTION: RigidMotion = RigidMotion { translation: [0.3, -0.7], angle: 0.9 };

fn nodes_of(mesh: &PlanarMesh, boundary: &str) -> Vec<usize> {
    let topology = mesh.topology();
    let boundary = topology.boundary(boundary).expect("a boundary of the mesh");
    boundary.edges.iter().flat_map(|&edge| topology.edges()[edge].nodes).collect()
}

#[test]
fn boundaries_are_where_they_belong() -> Outcome {
    let (mesh, pivot) = (disc()?, [0.4, 0.2]);
    let parameters = MotionParameters { rigid_zone: 0.2, ..MotionParameters::default() };
    let motion = MeshMotion::new(&mesh, &[moving("disc", pivot)], &parameters)?;
    let mut moved = mesh.clone();
    motion.carry(&[MOTION], 0.0, &mut moved)?;
    for node in nodes_of(&mesh, "disc") {
        assert_eq!(moved.nodes()[node], MOTION.place(pivot, mesh.nodes()[node]));
        let [x, y] = MOTION.place(pivot, [0.0; 2]);
        let radius = (moved.nodes()[node][0] - x).hypot(moved.nodes()[node][1] - y);
        assert!((radius - 0.5).abs() < 4e-16, "still a disc: {radius}");
    }
    for node in ["left", "right", "bottom", "top"].iter().flat_map(|side| nodes_of(&mesh, side)) {
        assert_eq!(moved.nodes()[node], mesh.nodes()[node]);
    }
    Ok(())
}

/// Every cell with a node in the zone keeps its shape, and those beyond do not.
#[test]
fn the_zone_moves_rigidly() -> Outcome {
    let (mesh, zone) = (disc()?, 0.2);
    let motion = disc_motion(&mesh, Stiffness::default(), zone)?;
    let mut moved = mesh.clone();
    motion.carry(&[MOTION], 0.0, &mut moved)?;
    let is_near = |&node: &usize| mesh.nodes()[node][0].hypot(mesh.nodes()[node][1]) < 0.5 + zone;
    let is_rigid =
        |node: &usize| moved.nodes()[*node] == MOTION.place([0.0; 2], mesh.nodes()[*node]);
    let mut rigid = 0;
    for cell in 0..mesh.topology().cells() {
        let nodes = mesh.topology().cell_nodes(cell);
        let inside = nodes.iter().any(is_near);
        assert_eq!(nodes.iter().all(is_rigid), inside, "cell {cell}");
        rigid += usize::from(inside);
    }
    assert!(rigid > 50, "{rigid} rigid cells");
    Ok(())
}

#[test]
fn a_body_that_comes_back_brings_the_mesh_back() -> Outcome {
    let mesh = disc()?;
    let motion = disc_motion(&mesh, Stiffness::default(), 0.1)?;
    let mut moved = mesh.clone();
    motion.carry(&[MOTION], 0.0, &mut moved)?;
    assert_ne!(moved, mesh);
    motion.carry(&[RigidMotion::REST], 1.0, &mut moved)?;
    assert_eq!(moved, mesh);
    Ok(())
}

/// A motion about one pivot is a motion about another with a translation more.
#[test]
fn the_pivot_does_not_matter() -> Outcome {
    let (mesh, pivot) = (disc()?, [3.0, 5.0]);
    let parameters = MotionParameters::default();
    let place = |pivot: Point, position: RigidMotion| -> Result<Vec<Point>, _> {
        let mut nodes = mesh.nodes().to_vec();
        MeshMotion::new(&mesh, &[moving("disc", pivot)], &parameters)?
            .place(&[position], &mut nodes);
        Ok::<_, Box<dyn std::error::Error>>(nodes)
    };
    let [x, y] = MOTION.place([0.0; 2], pivot);
    let translation = [x - pivot[0], y - pivot[1]];
    let (a, b) = (place([0.0; 2], MOTION)?, place(pivot, RigidMotion { translation, ..MOTION })?);
    let gap = a.iter().zip(&b).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
    assert!(gap < 2e-14, "{gap:e} m");
    Ok(())
}

#[test]
fn a_step_allocates_nothing() -> Outcome {
    let mut mesh = disc()?;
    let motion = disc_motion(&mesh, Stiffness::default(), 0.1)?;
    let swing = |t: f64| RigidMotion { translation: [0.0, t.sin()], angle: 0.3 * t };
    let mut prescribed = PrescribedMotion::new(motion, vec![Arc::new(swing)])?;
    let before = allocations();
    assert!(before > 0, "the counter counts");
    for step in 0..10 {
        prescribed.carry(0.1 * f64::from(step), &mut mesh)?;
    }
    assert_eq!(allocations(), before);
    assert_eq!(prescribed.positions(), [swing(0.1 * 9.0)]);
    let boundaries: Vec<&MovingBoundary> = prescribed.motion().boundaries().collect();
    assert_eq!(boundaries, [&moving("disc", [0.0; 2])]);
    Ok(())
}
