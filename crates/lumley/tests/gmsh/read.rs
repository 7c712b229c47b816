use crate::{CORNERS, Outcome, TRIANGLE, data, parse, text};
use lumley::format::FormatError;
use lumley::format::gmsh::{GmshError, read};
use lumley_fem::{MeshDescription, Point};
use std::f64::consts::PI;

/// Twice the area between a quadratic edge and the origin, and the edge's length.
fn edge([a, b, m]: [Point; 3]) -> (f64, f64) {
    let (mut twice_area, mut length) = (0.0, 0.0);
    for (t, weight) in lumley_fem::quadrature::gauss_legendre(6) {
        let at = |d: usize| {
            let value = (1.0 - t) * (1.0 - 2.0 * t) * a[d] + t * (2.0 * t - 1.0) * b[d];
            let slope = (4.0 * t - 3.0) * a[d] + (4.0 * t - 1.0) * b[d];
            (value + 4.0 * t * (1.0 - t) * m[d], slope + (4.0 - 8.0 * t) * m[d])
        };
        let ((x, dx), (y, dy)) = (at(0), at(1));
        twice_area += weight * (x * dy - y * dx);
        length += weight * dx.hypot(dy);
    }
    (twice_area, length)
}

/// The area of all cells, by Gauss's theorem.
fn area(mesh: &MeshDescription) -> f64 {
    let triangles =
        mesh.triangles.iter().flat_map(|t| (0..3).map(|k| [t[k], t[(k + 1) % 3], t[k + 3]]));
    let others =
        mesh.quadrilaterals.iter().flat_map(|q| (0..4).map(|k| [q[k], q[(k + 1) % 4], q[k + 4]]));
    triangles.chain(others).map(|e| 0.5 * edge(e.map(|node| mesh.points[node])).0).sum()
}

fn lengths(mesh: &MeshDescription) -> Vec<(&str, f64)> {
    let length = |edges: &[[usize; 3]]| {
        edges.iter().map(|e| edge(e.map(|node| mesh.points[node])).1).sum::<f64>()
    };
    mesh.boundaries.iter().map(|b| (b.name.as_str(), length(&b.edges))).collect()
}

/// Versions, encodings and orders: 74 triangles, 16 quadrilaterals, the same boundaries. The polygon of n
/// edges in the disc has n/2 r² sin(2π/n) of its area; quadratic edges nearly all of it.
#[test]
fn all_formats_give_the_same_mesh() -> Outcome {
    for order in [1, 2] {
        let mut areas = Vec::new();
        for kind in ["v22_ascii", "v22_binary", "v41_ascii", "v41_binary"] {
            let name = format!("{kind}_{order}.msh");
            let mesh = read(data(&name))?;
            assert_eq!((mesh.triangles.len(), mesh.quadrilaterals.len()), (74, 16), "{name}");
            let found = lengths(&mesh);
            let names: Vec<_> = found.iter().map(|(name, _)| *name).collect();
            assert_eq!(names, ["left", "right", "walls", "disc"], "{name}");
            for ((side, length), exact) in found.iter().zip([1.0, 1.0, 6.0]) {
                assert!((length - exact).abs() < 1e-12, "{name}: {side} is {length} m long");
            }
            let n = mesh.boundaries[3].edges.len() as f64;
            let r = 0.2;
            let (length, disc, tolerance) = match order {
                1 => (2.0 * n * r * (PI / n).sin(), 0.5 * n * r * r * (2.0 * PI / n).sin(), 1e-12),
                _ => (2.0 * PI * r, PI * r * r, 1e-3),
            };
            assert!((found[3].1 - length).abs() < tolerance, "{name}: disc of {} m", found[3].1);
            let area = area(&mesh);
            assert!((area - 3.0 + disc).abs() < tolerance, "{name}: {area} m²");
            areas.push(area);
        }
        assert!(areas.iter().all(|area| (area - areas[0]).abs() < 1e-13), "{areas:?}");
    }
    Ok(())
}

/// Text and binary files of a version differ in nothing but the last digits.
#[test]
fn text_and_binary_are_the_same() -> Outcome {
    for (version, order) in [("v22", 1), ("v22", 2), ("v41", 1), ("v41", 2)] {
        let [a, b] =
            ["ascii", "binary"].map(|kind| read(data(&format!("{version}_{kind}_{order}.msh"))));
        let (a, b) = (a?, b?);
        assert_eq!((&a.triangles, &a.quadrilaterals), (&b.triangles, &b.quadrilaterals));
        assert_eq!(a.boundaries, b.boundaries);
        for (p, q) in a.points.iter().zip(&b.points) {
            assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 1e-15, "{version}: {p:?}, {q:?}");
        }
    }
    Ok(())
}

/// Quadrilaterals of eight nodes get the centre that those of nine have.
#[test]
fn eight_nodes_become_nine() -> Outcome {
    let whole = area(&read(data("v41_ascii_2.msh"))?);
    for name in ["eight_nodes_ascii.msh", "eight_nodes_binary.msh"] {
        let mesh = read(data(name))?;
        assert_eq!((mesh.triangles.len(), mesh.quadrilaterals.len()), (74, 16), "{name}");
        assert!((area(&mesh) - whole).abs() < 1e-13, "{name}");
        for cell in &mesh.quadrilaterals {
            let mean =
                |d: usize| cell[..4].iter().map(|&node| mesh.points[node][d]).sum::<f64>() / 4.0;
            let centre = mesh.points[cell[8]];
            assert!((centre[0] - mean(0)).hypot(centre[1] - mean(1)) < 1e-12, "{name}: {centre:?}");
        }
    }
    let curved = parse(
        text(
            &[
                "1 0 0 0",
                "2 1 0 0",
                "3 1 1 0",
                "4 0 1 0",
                "5 .5 -.2 0",
                "6 1 .5 0",
                "7 .5 1 0",
                "8 0 .5 0",
            ],
            &[
                "1 16 2 9 1 1 2 3 4 5 6 7 8",
                "2 8 2 1 1 1 2 5",
                "3 8 2 1 1 2 3 6",
                "4 8 2 1 1 3 4 7",
                "5 8 2 1 1 4 1 8",
            ],
        )
        .as_bytes(),
    )?;
    let centre = curved.points[curved.quadrilaterals[0][8]];
    assert!(
        (centre[0] - 0.5).hypot(centre[1] - 0.4) < 1e-15,
        "half of what the edge is bent: {centre:?}"
    );
    Ok(())
}

/// The line between the surfaces is in the file, but in no group, and not on the rim.
#[test]
fn lines_within_are_left_out() -> Outcome {
    let mesh = read(data("all_saved.msh"))?;
    assert_eq!(mesh.boundaries, read(data("v41_ascii_1.msh"))?.boundaries);
    Ok(())
}

/// Without names there are no boundaries: how many edges and where.
#[test]
fn unnamed_edges_are_counted() -> Outcome {
    let error = read(data("no_names.msh")).expect_err("no names");
    let rim: usize = read(data("v41_ascii_1.msh"))?.boundaries.iter().map(|b| b.edges.len()).sum();
    let FormatError::Gmsh { source: GmshError::Unnamed { count, .. }, .. } = error else {
        panic!("{error}")
    };
    assert_eq!(count, rim);
    let error =
        parse(text(&CORNERS, &TRIANGLE[..3]).as_bytes()).expect_err("an edge without a line");
    let expected = GmshError::Unnamed { count: 1, first: [[0.0, 1.0], [0.0, 0.0]] };
    assert!(matches!(&error, FormatError::Gmsh { source, .. } if *source == expected), "{error}");
    Ok(())
}

/// Clockwise cells are turned round; nodes that no cell has are dropped, wherever they are.
#[test]
fn cells_are_turned_and_nodes_dropped() -> Outcome {
    let nodes = [&CORNERS[..], &["9 7 7 7"]].concat();
    let elements = [&["1 2 2 9 1 1 4 2", "7 15 2 9 1 9"], &TRIANGLE[1..]].concat();
    let mesh = parse(text(&nodes, &elements).as_bytes())?;
    let straight = parse(text(&CORNERS, &TRIANGLE).as_bytes())?;
    assert_eq!(mesh, straight);
    assert!((area(&mesh) - 0.5).abs() < 1e-15);
    let middles = mesh.triangles[0].map(|node| mesh.points[node])[3..].to_vec();
    assert_eq!(middles, [[0.5, 0.0], [0.5, 0.5], [0.0, 0.5]]);
    Ok(())
}

/// Triangles of six nodes in clockwise order keep each middle on its edge.
#[test]
fn middles_turn_with_their_cell() -> Outcome {
    let nodes = [&CORNERS[..], &["5 .5 -.1 0", "6 .5 .5 0", "7 0 .5 0"]].concat();
    let lines = ["2 8 2 1 1 1 2 5", "3 8 2 1 1 2 4 6", "4 8 2 1 1 4 1 7"];
    let elements = [&["1 9 2 9 1 1 4 2 7 6 5"], &lines[..]].concat();
    let mesh = parse(text(&nodes, &elements).as_bytes())?;
    assert_eq!(mesh.triangles, [[0, 1, 2, 3, 4, 5]]);
    assert!((area(&mesh) - 0.5 - 0.1 * 2.0 / 3.0).abs() < 1e-15, "{}", area(&mesh));
    Ok(())
}

#[test]
fn info_tells_the_boundaries() -> Outcome {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lumley"));
    let output = command.arg("info").arg(data("v41_binary_2.msh")).output()?;
    let said = String::from_utf8(output.stdout)?;
    assert!(output.status.success() && said.contains("74 triangles, 16 quadrilaterals"), "{said}");
    assert!(said.contains("walls: ") && said.contains("6.000000 m"), "{said}");
    Ok(())
}
