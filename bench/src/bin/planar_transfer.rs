//! Times the transfer of a velocity from a moving planar mesh to a fixed grid, and measures what it loses.
//!
//! ```text
//! planar_transfer REPEATS
//! ```
//!
//! A channel of 21 m x 12 m with a disc that has moved, about 100 thousand velocity nodes, a grid of 500 x 300.
//! Prints a line of JSON for each mesh and method: CPU times in ms (medians, one thread) of following the mesh
//! and of the velocity at the grid's nodes; the root mean square and the largest error of the fluid's values
//! away from the disc; the grid's nodes in the disc and how many of all were taken for the wrong medium.

use lumley_fem::generate::Channel;
use lumley_fem::space::NodalSpace;
use lumley_fem::transfer::{Bodies, Place, PlanarFlow, PlanarTransfer, Transfer};
use lumley_fem::{PlanarMesh, Point, PointLocator, UniformGrid};
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Value, json};
use std::env;
use std::error::Error;

const CENTRE: Point = [8.0, 6.0];
const RADIUS: f64 = 0.5;
const TIME: f64 = 0.3;
const SOLID: Point = [7.0, -7.0];

const METHODS: [(&str, Transfer); 2] = [
    ("finite elements", Transfer::FiniteElement {}),
    ("inverse distance", Transfer::InverseDistance { power: 2.0, neighbours: 8 }),
];

/// Largest size of the cells, and where triangles are, along x and along y.
const MESHES: [(&str, f64, [[f64; 2]; 2]); 2] = [
    ("quadrilaterals, triangles near the disc", 0.105, [[6.5, 12.0], [4.5, 7.5]]),
    ("triangles", 0.15, [[0.0, 21.0], [0.0, 12.0]]),
];

fn main() -> Result<(), Box<dyn Error>> {
    let repeats = env::args().nth(1).ok_or("planar_transfer REPEATS")?.parse()?;
    for (name, size, triangles) in MESHES {
        let mesh = moved(size, triangles)?;
        let locator = PointLocator::new(&mesh);
        println!("{}", json!({ "mesh": name, "locate": locate(&locator, &mesh, repeats) }));
        for (method, transfer) in METHODS {
            let mut line = measure(&mesh, transfer, repeats)?;
            line["mesh"] = name.into();
            line["method"] = method.into();
            println!("{line}");
        }
    }
    Ok(())
}

/// The centre of the disc after its motion.
fn centre() -> Point {
    let shift = shift();
    [CENTRE[0] + shift[0], CENTRE[1] + shift[1]]
}

fn shift() -> Point {
    [0.4 * TIME.sin(), 0.2 * TIME.cos() - 0.2]
}

/// The motion of the disc fades away from it; the sides of the channel stay.
fn moved(size: f64, [x, y]: [[f64; 2]; 2]) -> Result<PlanarMesh, Box<dyn Error>> {
    let channel: Channel = serde_json::from_value(json!({
        "x": [0.0, 21.0], "y": [0.0, 12.0], "size": size,
        "triangles": { "x": x, "y": y },
        "bodies": [{
            "name": "disc", "size": 0.0157,
            "shape": { "kind": "disc", "centre": CENTRE, "radius": RADIUS },
            "layers": { "first": 0.005, "growth": 1.3, "count": 4 },
        }],
    }))?;
    let mut mesh = PlanarMesh::new(channel.mesh()?)?;
    let shift = shift();
    for node in mesh.nodes_mut() {
        let from_disc = distance(*node, CENTRE) - RADIUS;
        let fade = if from_disc < 4.0 { (-(from_disc / 1.5).powi(2)).exp() } else { 0.0 };
        *node = [node[0] + fade * shift[0], node[1] + fade * shift[1]];
    }
    mesh.check()?;
    Ok(mesh)
}

fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn flow([x, y]: Point) -> Point {
    [x.sin() * (1.3 * y).cos(), (0.7 * x).cos() * y.sin()]
}

fn grid() -> UniformGrid {
    UniformGrid::rectangle([0.0; 2], [21.0, 12.0], [500, 300])
}

/// All nodes of the grid, one by one.
fn locate(locator: &PointLocator, mesh: &PlanarMesh, repeats: usize) -> Value {
    let grid = grid();
    let mut found = 0;
    let mut moving = locator.clone();
    let update = median(repeats, || moving.update(mesh));
    let all = median(repeats, || {
        found = (0..grid.len()).filter(|&k| moving.locate(mesh, grid.point(k)).is_some()).count();
    });
    json!({ "update": update, "all": all, "found": found })
}

fn measure(mesh: &PlanarMesh, method: Transfer, repeats: usize) -> Result<Value, Box<dyn Error>> {
    let (grid, space) = (grid(), NodalSpace::velocity(mesh.topology()));
    let velocity: Vec<Point> = space.points(mesh).into_iter().map(flow).collect();
    let solid = |_: usize, _: Point| SOLID;
    let flow = PlanarFlow { mesh, space: &space, velocity: &velocity, solid: &solid };
    let mut transfer = PlanarTransfer::new(method, grid.clone(), Bodies::new(mesh, &["disc"])?)?;
    let mut out = vec![f64::NAN; 2 * grid.len()];
    let update = median(repeats, || {
        transfer.update(mesh);
    });
    transfer.transfer(flow, &mut out)?;
    let evaluate = median(repeats, || transfer.transfer(flow, &mut out).expect("done before"));
    let mut line = errors(&grid, transfer.places(), &out);
    line["nodes"] = space.dofs().len().into();
    line["cells"] = mesh.topology().cells().into();
    line["update"] = update.into();
    line["evaluate"] = evaluate.into();
    line["total"] = (update + evaluate).into();
    Ok(line)
}

fn errors(grid: &UniformGrid, places: &[Place], out: &[f64]) -> Value {
    let (mut squares, mut largest, mut counted, mut solid, mut wrong) = (0.0, 0.0_f64, 0, 0, 0);
    for (k, place) in places.iter().enumerate() {
        let (x, v) = (grid.point(k), [out[k], out[grid.len() + k]]);
        let from_disc = distance(x, centre()) - RADIUS;
        solid += usize::from(from_disc < 0.0);
        let is_solid = matches!(place, Place::Solid(_));
        wrong += usize::from(is_solid != (from_disc < 0.0) || is_solid != (v == SOLID));
        if from_disc > 0.05 {
            for (v, exact) in v.into_iter().zip(flow(x)) {
                squares += (v - exact).powi(2);
                largest = largest.max((v - exact).abs());
                counted += 1;
            }
        }
    }
    let rms = (squares / f64::from(counted)).sqrt();
    json!({ "rms_error": rms, "max_error": largest, "solid": solid, "wrong_medium": wrong })
}

/// Median CPU time in ms.
fn median(repeats: usize, mut work: impl FnMut()) -> f64 {
    let once = |_| {
        let start = cpu_ms();
        work();
        cpu_ms() - start
    };
    let mut times: Vec<f64> = (0..repeats).map(once).collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// CPU time of the process in ms, all threads together.
fn cpu_ms() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 * 1e3 + 1e-6 * time.tv_nsec as f64
}
