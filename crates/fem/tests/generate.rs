//! Generated meshes: areas and lengths of curved bodies, quality, conformity, sizes, refusals.

use lumley_fem::generate::{Channel, GenerateError};
use lumley_fem::{MeshDescription, Point};
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn channel(text: &str) -> Result<Channel, toml::de::Error> {
    toml::from_str(text)
}

/// The channel of Schaefer and Turek (1996) with layers round the cylinder.
fn schaefer_turek(size: f64, on_body: f64, growth: f64) -> Result<Channel, toml::de::Error> {
    channel(&format!(
        "x = [0, 2.2]\ny = [0, 0.41]\nsize = {size}\ngrowth = {growth}\n
         [[bodies]]\nname = 'cylinder'\nsize = {on_body}
         shape = {{ kind = 'disc', centre = [0.2, 0.2], radius = 0.05 }}
         layers = {{ first = {}, growth = 1.3, count = 3 }}",
        on_body / 4.0
    ))
}

/// An L with layers, a thin ellipse with layers, a triangle, and a disc close to it.
const MIXED: &str = "
    x = [-5, 10]\ny = [-4, 4]\nsize = 0.5
    [[bodies]]\nname = 'l'\nsize = 0.15
    shape = { kind = 'polygon', corners = [[0, 0], [0, 2], [0.6, 2], [0.6, 0.6], [2, 0.6], [2, 0]] }
    layers = { first = 0.03, growth = 1.3, count = 3 }
    [[bodies]]\nname = 'wing'\nsize = 0.15
    shape = { kind = 'ellipse', centre = [-1.5, -1], semi_axes = [1.2, 0.1], angle = 0.4 }
    layers = { first = 0.02, growth = 1.3, count = 4 }
    [[bodies]]\nname = 'wedge'\nsize = 0.1
    shape = { kind = 'polygon', corners = [[3, 1], [4, 2.8], [3, 3]] }
    [[bodies]]\nname = 'disc'\nsize = 0.1
    shape = { kind = 'disc', centre = [2.45, 2], radius = 0.5 }";

/// Area of a MIXED channel: polygons by hand.
const MIXED_AREA: f64 = 15.0 * 8.0 - (1.2 + 0.84) - PI * 1.2 * 0.1 - 1.0 - PI * 0.25;

/// Two discs a tenth of their diameter apart.
const TWO: &str = "
    x = [-5, 10]\ny = [-4, 4]\nsize = 0.5
    [[bodies]]\nname = 'a'\nsize = 0.1\nshape = { kind = 'disc', centre = [0, 0], radius = 0.5 }
    layers = { first = 0.01, growth = 1.2, count = 2 }
    [[bodies]]\nname = 'b'\nsize = 0.1\nshape = { kind = 'disc', centre = [0, 1.1], radius = 0.5 }";

fn samples() -> Result<Vec<(&'static str, Channel, f64)>, toml::de::Error> {
    let cylinder = PI * 0.05 * 0.05;
    let twenty = (0..20).fold(String::new(), |bodies, k| {
        let centre = [1.0 + 0.5 * f64::from(k % 5), 0.5 + 0.5 * f64::from(k / 5)];
        bodies + &disc(&format!("d{k}"), centre, 0.1)
    });
    let whole = "triangles = { x = [0, 2.2], y = [0, 0.41] }\n";
    let all_triangles = Channel {
        triangles: Some(toml::from_str("x = [0, 2.2]\ny = [0, 0.41]")?),
        ..schaefer_turek(0.04, 0.012, 0.2)?
    };
    Ok(vec![
        ("coarse", schaefer_turek(0.05, 0.013, 0.2)?, 0.902 - cylinder),
        ("fine", schaefer_turek(0.02, 0.007, 0.12)?, 0.902 - cylinder),
        ("triangles", all_triangles, 0.902 - cylinder),
        ("mixed", channel(MIXED)?, MIXED_AREA),
        ("two", channel(TWO)?, 120.0 - 0.5 * PI),
        ("twenty", channel(&format!("x=[0, 8]\ny=[0, 2.6]\nsize=0.1\n{twenty}"))?, 20.8 - 0.2 * PI),
        ("bodiless", channel("x = [0, 3]\ny = [0, 1]\nsize = 0.13")?, 3.0),
        ("filled", channel(&format!("x = [0, 2.2]\ny = [0, 0.41]\nsize = 0.05\n{whole}"))?, 0.902),
    ])
}

/// Values and gradients of 1-D quadratics with nodes at 0, 1/2, 1 in the order end, end, middle.
fn quadratics(t: f64) -> [(f64, f64); 3] {
    [
        ((1.0 - t) * (1.0 - 2.0 * t), 4.0 * t - 3.0),
        (t * (2.0 * t - 1.0), 4.0 * t - 1.0),
        (4.0 * t * (1.0 - t), 4.0 - 8.0 * t),
    ]
}

/// Area to the left of a quadratic edge towards the origin, `½ ∫ x × dx`, by a rule that is exact for it.
fn sector([a, b, m]: [Point; 3]) -> f64 {
    const GAUSS: [(f64, f64); 2] = [(0.211_324_865_405_187_1, 0.5), (0.788_675_134_594_812_9, 0.5)];
    let at = |t: f64| {
        let sum = |d: usize, of: fn((f64, f64)) -> f64| -> f64 {
            [a, b, m].iter().zip(quadratics(t)).map(|(node, function)| of(function) * node[d]).sum()
        };
        let [x, dx] = [sum(0, |f| f.0), sum(0, |f| f.1)];
        let [y, dy] = [sum(1, |f| f.0), sum(1, |f| f.1)];
        x * dy - dx * y
    };
    GAUSS.into_iter().map(|(t, w)| 0.5 * w * at(t)).sum()
}

/// Edges of a cell: end, end, middle, counterclockwise.
fn edges(cell: &[usize]) -> Vec<[usize; 3]> {
    let corners = if cell.len() == 6 { 3 } else { 4 };
    (0..corners).map(|k| [cell[k], cell[(k + 1) % corners], cell[corners + k]]).collect()
}

fn cells(mesh: &MeshDescription) -> impl Iterator<Item = &[usize]> {
    let triangles = mesh.triangles.iter().map(|t| &t[..]);
    triangles.chain(mesh.quadrilaterals.iter().map(|q| &q[..]))
}

/// The area of a cell by Gauss's theorem: with quadratic edges it depends on nothing else.
fn area(mesh: &MeshDescription, cell: &[usize]) -> f64 {
    edges(cell).iter().map(|edge| sector(edge.map(|node| mesh.points[node]))).sum()
}

fn total_area(mesh: &MeshDescription) -> f64 {
    cells(mesh).map(|cell| area(mesh, cell)).sum()
}

fn angles(mesh: &MeshDescription) -> impl Iterator<Item = f64> {
    mesh.triangles
        .iter()
        .flat_map(|t| (0..3).map(move |k| [t[k], t[(k + 1) % 3], t[(k + 2) % 3]]))
        .map(|corners| {
            let [a, b, c] = corners.map(|node| mesh.points[node]);
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
            (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]).to_degrees()
        })
}

/// Every edge is in one cell and has one name, or is in two cells, once in each direction and with the same
/// middle; every node is used.
#[test]
fn meshes_conform() -> Outcome {
    for (name, channel, _) in samples()? {
        let mesh = channel.mesh()?;
        let mut sides: HashMap<[usize; 2], usize> = HashMap::new();
        for [a, b, middle] in cells(&mesh).flat_map(edges) {
            assert_eq!(
                sides.insert([a, b], middle),
                None,
                "{name}: edge {a} {b} is met once each way"
            );
        }
        let rim: HashSet<_> =
            sides.keys().filter(|[a, b]| !sides.contains_key(&[*b, *a])).collect();
        for ([a, b], middle) in &sides {
            assert!(sides.get(&[*b, *a]).is_none_or(|other| other == middle), "{name}: one middle");
        }
        let named: Vec<_> = mesh.boundaries.iter().flat_map(|boundary| &boundary.edges).collect();
        assert_eq!(named.len(), rim.len(), "{name}: as many names as edges of the rim");
        let mut once = HashSet::new();
        for [a, b, middle] in named {
            let direction = [[*a, *b], [*b, *a]].into_iter().find(|edge| rim.contains(edge));
            let edge = direction.ok_or(format!("{name}: {a} {b} is not on the rim"))?;
            assert!(once.insert(edge), "{name}: edge {a} {b} is named once");
            assert_eq!(sides[&edge], *middle, "{name}: the middle of {a} {b}");
        }
        let used: HashSet<_> = cells(&mesh).flatten().collect();
        assert_eq!(used.len(), mesh.points.len(), "{name}: every node is used");
        let names: Vec<_> = mesh.boundaries.iter().map(|b| b.name.as_str()).collect();
        assert_eq!(names[..4], ["left", "right", "bottom", "top"], "{name}");
    }
    Ok(())
}

/// The areas of all cells are positive, their sum is that of the channel without the bodies, and triangles
/// are well shaped.
#[test]
fn cells_are_sound() -> Outcome {
    for (name, channel, exact) in samples()? {
        let mesh = channel.mesh()?;
        let smallest = cells(&mesh).map(|cell| area(&mesh, cell)).fold(f64::INFINITY, f64::min);
        assert!(smallest > 0.0, "{name}: a cell of {smallest} m²");
        let error = total_area(&mesh) / exact - 1.0;
        assert!(error.abs() < 1e-5, "{name}: area wrong by {error:e}");
        let least = angles(&mesh).fold(180.0, f64::min);
        assert!(least > 20.0, "{name}: an angle of {least}°");
    }
    Ok(())
}

/// Middles are where quadratic maps are good: near the centres of their edges, even at the tips of an ellipse and
/// in the layers round them.
#[test]
fn edges_are_bent_little() -> Outcome {
    for (name, channel, _) in samples()? {
        let mesh = channel.mesh()?;
        for edge in cells(&mesh).flat_map(edges) {
            let [p, q, m] = edge.map(|node| mesh.points[node]);
            let centre = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
            let bend =
                (m[0] - centre[0]).hypot(m[1] - centre[1]) / (p[0] - q[0]).hypot(p[1] - q[1]);
            assert!(bend < 0.1, "{name}: an edge at {m:?} is bent by {bend} of its length");
        }
    }
    Ok(())
}

/// Middles on the curve make the area right to the fourth order of the size.
#[test]
fn curved_areas_converge_with_order_four() -> Outcome {
    let shapes = [
        ("{ kind = 'disc', centre = [0, 0], radius = 0.5 }", PI * 0.25),
        ("{ kind = 'ellipse', centre = [0, 0], semi_axes = [0.8, 0.4], angle = 0.5 }", PI * 0.32),
    ];
    for (shape, inside) in shapes {
        let error = |size: f64| -> Result<f64, Box<dyn std::error::Error>> {
            let text = format!(
                "x = [-3, 4]\ny = [-2, 2]\nsize = 0.8\ngrowth = 0.3
                 [[bodies]]\nname = 'b'\nshape = {shape}\nsize = {size}"
            );
            Ok((total_area(&channel(&text)?.mesh()?) - 28.0 + inside).abs())
        };
        let errors = [0.08, 0.04, 0.02].map(error).into_iter().collect::<Result<Vec<_>, _>>()?;
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((order - 4.0).abs() < 0.3, "{shape}: order {order}, errors {errors:?}");
        }
    }
    Ok(())
}

/// Nodes of curved boundaries lie on them, and a disc has nodes at its four extreme points.
#[test]
fn nodes_lie_on_the_bodies() -> Outcome {
    let mesh = schaefer_turek(0.05, 0.013, 0.2)?.mesh()?;
    let cylinder = &mesh.boundaries[4];
    assert_eq!(cylinder.name, "cylinder");
    for node in cylinder.edges.iter().flatten() {
        let [x, y] = mesh.points[*node];
        let radius = (x - 0.2).hypot(y - 0.2);
        assert!((radius - 0.05).abs() < 1e-16, "a node at {radius}");
    }
    for extreme in [[0.15, 0.2], [0.25, 0.2], [0.2, 0.15], [0.2, 0.25]] {
        let distance = |edge: &[usize; 3]| {
            let [x, y] = mesh.points[edge[0]];
            (x - extreme[0]).hypot(y - extreme[1])
        };
        assert!(cylinder.edges.iter().map(distance).fold(1.0, f64::min) < 1e-15, "{extreme:?}");
    }
    Ok(())
}

/// Rows of layers have the heights that were asked for.
#[test]
fn layers_have_their_heights() -> Outcome {
    let mesh = schaefer_turek(0.05, 0.012, 0.2)?.mesh()?;
    let radius = |node: usize| (mesh.points[node][0] - 0.2).hypot(mesh.points[node][1] - 0.2);
    let (mut level, mut height) = (0.05, 0.003);
    let round = mesh.boundaries[4].edges.len();
    let layers = &mesh.quadrilaterals[mesh.quadrilaterals.len() - 3 * round..];
    for row in layers.chunks(round) {
        for cell in row {
            let (bottom, top) = (radius(cell[0]), radius(cell[1]));
            assert!((bottom - level).abs() < 1e-15 && (top - level - height).abs() < 1e-15);
        }
        level += height;
        height *= 1.3;
    }
    Ok(())
}

/// Edges of triangles are as long as the size field says: on average, and each within a factor.
#[test]
fn sizes_are_obeyed() -> Outcome {
    for growth in [0.1, 0.2, 0.3] {
        let text = format!(
            "x = [-6, 6]\ny = [-6, 6]\nsize = 0.7\ngrowth = {growth}
             triangles = {{ x = [-4, 4], y = [-4, 4] }}
             [[bodies]]\nname = 'b'\nsize = 0.1
             shape = {{ kind = 'disc', centre = [0, 0], radius = 0.5 }}"
        );
        let mesh = channel(&text)?.mesh()?;
        let ratio = |[a, b, middle]: [usize; 3]| {
            let [p, q, m] = [a, b, middle].map(|node| mesh.points[node]);
            let wanted = (0.1 + growth * (m[0].hypot(m[1]) - 0.5)).min(0.7);
            (p[0] - q[0]).hypot(p[1] - q[1]) / wanted
        };
        let mut ratios: Vec<f64> =
            mesh.triangles.iter().flat_map(|t| edges(t)).map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        let [least, median, most] =
            [0, 50, 100].map(|part| ratios[(ratios.len() - 1) * part / 100]);
        assert!((0.85..1.15).contains(&median), "growth {growth}: median {median}");
        assert!(least > 0.4 && most < 2.0, "growth {growth}: {least} to {most}");
    }
    Ok(())
}

/// Between bodies that nearly touch there are at least two cells.
#[test]
fn gaps_are_resolved() -> Outcome {
    let mesh = channel(TWO)?.mesh()?;
    let across: HashSet<_> = mesh.boundaries[5].edges.iter().flatten().collect();
    let layers: HashSet<_> = mesh.quadrilaterals.iter().flatten().collect();
    let spans = |t: &&[usize; 6]| {
        t[..3].iter().any(|n| across.contains(n)) && t[..3].iter().any(|n| layers.contains(n))
    };
    assert_eq!(mesh.triangles.iter().filter(spans).count(), 0);
    Ok(())
}

/// About 1 000, 5 000 and 20 000 cells.
#[test]
fn schaefer_turek_in_three_sizes() -> Outcome {
    let sizes =
        [(1000, 0.042, 0.012, 0.2), (5000, 0.0175, 0.006, 0.12), (20_000, 0.0083, 0.003, 0.07)];
    for (wanted, size, on_body, growth) in sizes {
        let mesh = schaefer_turek(size, on_body, growth)?.mesh()?;
        let cells = mesh.triangles.len() + mesh.quadrilaterals.len();
        assert!((0.85..1.15).contains(&(cells as f64 / f64::from(wanted))), "{cells}");
        let least = angles(&mesh).fold(180.0, f64::min);
        assert!(least > 20.0, "{cells} cells: an angle of {least}°");
    }
    Ok(())
}

/// Bit for bit.
#[test]
fn the_same_input_gives_the_same_mesh() -> Outcome {
    for (name, channel, _) in samples()? {
        assert_eq!(channel.mesh()?, channel.mesh()?, "{name}");
    }
    Ok(())
}

fn refused(text: &str) -> Result<GenerateError, Box<dyn std::error::Error>> {
    let mesh = channel(text)?.mesh();
    mesh.err().ok_or_else(|| format!("{text}: no error").into())
}

const BASE: &str = "x = [0, 4]\ny = [0, 2]\nsize = 0.2\n";

fn disc(name: &str, centre: Point, radius: f64) -> String {
    format!(
        "[[bodies]]\nname = '{name}'\nsize = 0.1
         shape = {{ kind = 'disc', centre = {centre:?}, radius = {radius} }}\n"
    )
}

fn polygon(corners: &str) -> String {
    format!(
        "[[bodies]]\nname = 'p'\nsize = 0.1\nshape = {{ kind = 'polygon', corners = {corners} }}\n"
    )
}

/// Bodies that overlap, contain each other, or touch; with layers too.
#[test]
fn overlaps_are_refused() -> Outcome {
    let pairs = [
        (disc("a", [1.0, 1.0], 0.3), disc("b", [1.5, 1.0], 0.3)),
        (disc("a", [1.0, 1.0], 0.5), disc("b", [1.1, 1.0], 0.1)),
        (disc("a", [1.1, 1.0], 0.1), disc("b", [1.0, 1.0], 0.5)),
        (
            disc("a", [1.0, 1.0], 0.3),
            disc("b", [1.7, 1.0], 0.3) + "layers = { first = 0.11, growth = 1, count = 1 }\n",
        ),
        (disc("a", [1.0, 1.0], 0.3), disc("b", [1.0, 1.0], 0.3)),
    ];
    for (a, b) in pairs {
        let error = refused(&format!("{BASE}{a}{b}"))?;
        let GenerateError::Overlap { first, second, .. } = &error else { panic!("{error}") };
        assert_eq!((first.as_str(), second.as_str()), ("a", "b"));
    }
    let error = refused(&format!(
        "{BASE}{}{}",
        disc("a", [1.0, 1.0], 0.3),
        polygon("[[0.5, 0.9], [3, 0.9], [3, 1.0]]")
    ))?;
    assert!(matches!(error, GenerateError::Overlap { .. }), "{error}");
    Ok(())
}

#[test]
fn walls_are_kept() -> Outcome {
    let layers = "layers = { first = 0.1, growth = 1, count = 2 }\n";
    let cases = [
        (disc("a", [1.0, 0.2], 0.3), "the bottom"),
        (disc("a", [1.0, 1.75], 0.25), "the top"),
        (disc("a", [-3.0, 1.0], 0.25), "the left side"),
        (disc("a", [3.7, 1.0], 0.2) + layers, "the right side"),
    ];
    for (body, expected) in cases {
        let error = refused(&format!("{BASE}{body}"))?;
        assert!(
            matches!(error, GenerateError::Outside { side, .. } if side == expected),
            "{error}"
        );
    }
    let error = refused(&format!(
        "{BASE}triangles = {{ x = [0.8, 2], y = [0.5, 1.5] }}\n{}",
        disc("a", [1.0, 1.0], 0.3)
    ))?;
    assert!(matches!(error, GenerateError::Outside { side: "triangles.x[0]", .. }), "{error}");
    let error = refused(&format!("{BASE}triangles = {{ x = [-0.1, 2], y = [0.5, 1.5] }}\n"))?;
    assert!(matches!(error, GenerateError::Rectangle { .. }), "{error}");
    Ok(())
}

#[test]
fn polygons_that_cross_themselves_are_refused() -> Outcome {
    let crossing = [
        "[[1, 0.5], [2, 1.5], [2, 0.5], [1, 1.5]]",
        "[[1, 0.5], [2, 0.5], [2, 0.5], [1, 1.5]]",
        "[[1, 0.5], [2, 0.5], [1.5, 0.5], [1.2, 1.5]]",
        "[[1, 0.5], [2, 0.5], [2, 1.5], [1.5, 0.5], [1, 1.5]]",
        "[[1, 1], [2, 1], [3, 1]]",
    ];
    for corners in crossing {
        let error = refused(&format!("{BASE}{}", polygon(corners)))?;
        assert!(matches!(error, GenerateError::CrossesItself { .. }), "{corners}: {error}");
    }
    let error = refused(&format!("{BASE}{}", polygon("[[1, 1], [2, 1]]")))?;
    assert!(matches!(error, GenerateError::FewCorners { corners: 2, .. }), "{error}");
    let slot = polygon(
        "[[1, 0.5], [3, 0.5], [3, 1.5], [2.1, 1.5], [2.1, 0.7], [2, 0.7], [2, 1.5], [1, 1.5]]",
    );
    assert!(channel(&format!("{BASE}{slot}"))?.mesh().is_ok(), "without layers the slot is meshed");
    let error =
        refused(&format!("{BASE}{slot}layers = {{ first = 0.03, growth = 1, count = 2 }}\n"))?;
    assert!(matches!(error, GenerateError::LayersFold { .. }), "{error}");
    Ok(())
}

/// Values out of range are named, and no value makes it run on for ever or fall over.
#[test]
fn values_are_checked() -> Outcome {
    let body = disc("a", [1.0, 1.0], 0.3);
    let wrong = [
        ("size = 0.2", "size = 0"),
        ("size = 0.2", "size = nan"),
        ("size = 0.2", "size = 0.2\ngrowth = -0.1"),
        ("size = 0.2", "size = 0.2\ngrowth = nan"),
        ("size = 0.1", "size = -0.1"),
        ("size = 0.1", "size = inf"),
        ("radius = 0.3", "radius = 0"),
        ("centre = [1.0, 1.0]", "centre = [nan, 1.0]"),
        ("size = 0.1", "size = 0.1\nlayers = { first = 0, growth = 1, count = 1 }"),
        ("size = 0.1", "size = 0.1\nlayers = { first = 0.1, growth = 1, count = 0 }"),
        ("size = 0.1", "size = 0.1\nlayers = { first = 0.1, growth = 1e9, count = 999 }"),
    ];
    for (from, to) in wrong {
        let text = format!("{BASE}{body}").replacen(from, to, 1);
        let error = refused(&text)?;
        assert!(matches!(error, GenerateError::Quantity { .. }), "{to}: {error}");
    }
    for (from, to) in [("[0, 4]", "[4, 0]"), ("[0, 2]", "[0, inf]"), ("[0, 2]", "[nan, 2]")] {
        let error = refused(&format!("{BASE}{body}").replacen(from, to, 1))?;
        assert!(matches!(error, GenerateError::Interval { .. }), "{to}: {error}");
    }
    for name in ["", "left", "b"] {
        let bodies = disc(name, [1.0, 1.0], 0.1) + &disc("b", [2.0, 1.0], 0.1);
        let error = refused(&format!("{BASE}{bodies}"))?;
        assert!(matches!(error, GenerateError::Name { .. }), "{name}: {error}");
    }
    assert!(channel(&format!("{BASE}sizes = 1")).is_err(), "an unknown key");
    Ok(())
}

/// Sizes that would take all memory are refused at once.
#[test]
fn too_many_cells_are_refused() -> Outcome {
    let body = disc("a", [1.0, 1.0], 0.3);
    let many = [
        ("size = 0.2", "size = 0.2\nlimit = 100"),
        ("size = 0.2", "size = 1e-9"),
        ("size = 0.2", "size = 1e-300"),
        ("size = 0.1", "size = 1e-9"),
        ("size = 0.1", "size = 1e-300"),
        ("size = 0.2", "size = 0.2\nlimit = 0"),
        ("size = 0.2", "size = 0.003\nlimit = 50_000"),
        ("size = 0.1", "size = 0.1\nlayers = { first = 0.0001, growth = 1, count = 1000 }\n"),
    ];
    for (from, to) in many {
        let text = format!("{BASE}limit = 20_000\n{body}").replacen(from, to, 1);
        let text =
            if to.contains("limit") { text.replacen("limit = 20_000\n", "", 1) } else { text };
        let error = refused(&text)?;
        assert!(matches!(error, GenerateError::TooManyCells { .. }), "{to}: {error}");
    }
    Ok(())
}

/// Narrow gaps between bodies and to the wall are meshed well; those too narrow for the bodies' size are not
/// meshed badly, but refused.
#[test]
fn narrow_gaps_are_meshed_or_refused() -> Outcome {
    for (gap, size) in [(0.01, 0.1), (0.004, 0.1), (0.001, 0.005)] {
        let bodies = disc("a", [1.0, 1.0], 0.3)
            + &disc("b", [1.6 + gap, 1.0], 0.3)
            + &disc("c", [2.5, 0.3 + gap], 0.3);
        let bodies = bodies.replace("size = 0.1", &format!("size = {size}"));
        let mesh = channel(&format!("{BASE}{bodies}"))?.mesh()?;
        let least = angles(&mesh).fold(180.0, f64::min);
        assert!(least > 20.0, "gap {gap}: an angle of {least}°");
    }
    for place in ["[1.600_001, 1.0]", "[1.0, 0.300_001]"] {
        let b = disc("b", [0.0; 2], 0.3).replace("[0.0, 0.0]", place);
        let a = if place.starts_with("[1.6") { disc("a", [1.0, 1.0], 0.3) } else { String::new() };
        let error = refused(&format!("{BASE}{a}{b}"))?;
        assert!(matches!(error, GenerateError::Gap { gap, .. } if gap < 2e-6), "{error}");
    }
    Ok(())
}
