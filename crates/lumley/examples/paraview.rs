//! Writes a series for ParaView: a mesh of curved triangles and quadrilaterals that moves, with fields that are
//! formulas. `python/check_vtu.py --sample` looks at it through VTK.
//!
//! ```text
//! cargo run --release --example paraview -- DIR
//! ```

use lumley::format::vtu::{Collection, Frame, Values, VtuWriter};
use lumley_fem::space::NodalSpace;
use lumley_fem::{MeshDescription, PlanarMesh, Point};
use std::error::Error;
use std::path::PathBuf;

/// Where the point (x, y) of the unit square is at a time: quadratic, so that the cells fit exactly.
fn place([x, y]: Point, time: f64) -> Point {
    [2.0 * x + 0.3 * (1.0 + time) * y * y, y - 0.2 * x * x + 0.1 * x * y]
}

/// Quadratic in the coordinates of the square, so that it is in the space on the curved cells too.
fn velocity([x, y]: Point) -> Point {
    [1.0 + x - 2.0 * x * y + y * y, x * x - 3.0 * y + x * y]
}

fn pressure([x, y]: Point) -> f64 {
    x * x + 2.0 * x * y - y
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args_os().nth(1).ok_or("the folder to write to?")?);
    std::fs::create_dir_all(&folder)?;
    let some = |[i, j]: [usize; 2]| (i + 2 * j) % 5 < 2;
    let square = PlanarMesh::new(MeshDescription::structured([8, 6], some, |p| p))?;
    let space = NodalSpace::velocity(square.topology());
    let references = space.points(&square);
    let velocities: Vec<Point> = references.iter().map(|&p| velocity(p)).collect();
    let pressures: Vec<f64> = references.iter().map(|&p| pressure(p)).collect();
    let point_fields = [
        ("velocity", Values::Vectors(&velocities)),
        ("pressure", Values::Scalars(&pressures)),
        ("reference", Values::Vectors(&references)),
    ];
    let (writer, mut mesh) = (VtuWriter::new(&space), square.clone());
    let mut series = Collection::new(folder.join("sample.pvd"));
    for k in 0..3 {
        let time = 0.5 * f64::from(k);
        for (node, &reference) in mesh.nodes_mut().iter_mut().zip(square.nodes()) {
            *node = place(reference, time);
        }
        mesh.check()?;
        let areas: Vec<f64> = mesh.cell_qualities().iter().map(|cell| cell.area).collect();
        let cell_fields = [("area", Values::Scalars(&areas))];
        let points = space.points(&mesh);
        let file = format!("sample-{k}.vtu");
        let frame =
            Frame { time, points: &points, point_fields: &point_fields, cell_fields: &cell_fields };
        writer.write(&folder.join(&file), &frame)?;
        series.push(time, &file)?;
    }
    Ok(())
}
