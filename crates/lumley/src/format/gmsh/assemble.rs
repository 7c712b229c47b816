use super::GmshError;
use super::elements::Kind;
use super::raw::{Element, Node, Raw};
use lumley_fem::{MeshDescription, NamedBoundary, Point};
use std::collections::{BTreeMap, HashMap};

/// Largest z that is rounding, in extents of the mesh.
const FLAT: f64 = 1e-10;

/// Makes quadratic cells and named boundaries of what stands in a file.
pub(super) fn assemble(raw: &Raw) -> Result<MeshDescription, GmshError> {
    let mut nodes = Nodes::new(raw)?;
    let mut middles = given_middles(raw, &nodes)?;
    let mut mesh = MeshDescription {
        points: vec![],
        triangles: vec![],
        quadrilaterals: vec![],
        boundaries: vec![],
    };
    for cell in raw.elements.iter().filter(|element| element.kind != Kind::Line) {
        let mut given = nodes.of(raw, cell)?;
        turn_counterclockwise(&nodes.points, &mut given);
        let count = given.corners.len();
        let centre = given.centre;
        let middle: Vec<usize> = (0..count)
            .map(|k| [given.corners[k], given.corners[(k + 1) % count]])
            .map(|edge| middles.of(edge, &mut nodes.points))
            .collect();
        match (given.corners.as_slice(), middle.as_slice()) {
            (&[a, b, c], &[d, e, f]) => mesh.triangles.push([a, b, c, d, e, f]),
            (&[a, b, c, d], &[e, f, g, h]) => {
                let centre = centre.unwrap_or_else(|| nodes.centre([a, b, c, d], [e, f, g, h]));
                mesh.quadrilaterals.push([a, b, c, d, e, f, g, h, centre]);
            }
            _ => unreachable!("cells have three or four corners"),
        }
    }
    if mesh.triangles.is_empty() && mesh.quadrilaterals.is_empty() {
        return Err(GmshError::NoCells);
    }
    mesh.points = nodes.points;
    mesh.boundaries = boundaries(raw, &mesh, &nodes.places)?;
    drop_unused(&mut mesh);
    Ok(mesh)
}

/// The nodes of a file and where they come in the mesh.
struct Nodes {
    points: Vec<Point>,
    places: HashMap<u64, usize>,
}

/// Nodes of a cell or a line: corners, middles of edges where the file has them, and the centre likewise.
struct Given {
    corners: Vec<usize>,
    middles: Vec<usize>,
    centre: Option<usize>,
}

impl Nodes {
    fn new(raw: &Raw) -> Result<Self, GmshError> {
        let mut places = HashMap::with_capacity(raw.nodes.len());
        for (place, node) in raw.nodes.iter().enumerate() {
            if places.insert(node.number, place).is_some() {
                return Err(GmshError::NodeTwice { node: node.number });
            }
        }
        let nodes = Self { points: raw.nodes.iter().map(|n| [n.at[0], n.at[1]]).collect(), places };
        nodes.check_flat(raw)?;
        Ok(nodes)
    }

    /// Nodes that belong to cells lie in the plane.
    fn check_flat(&self, raw: &Raw) -> Result<(), GmshError> {
        let mut used: Vec<&Node> = Vec::new();
        for element in &raw.elements {
            for number in raw.corners(element) {
                used.push(&raw.nodes[self.place(element, *number)?]);
            }
        }
        let extent = used.iter().fold(0.0, |max: f64, n| max.max(n.at[0].abs()).max(n.at[1].abs()));
        match used.iter().find(|node| node.at[2].abs() > FLAT * extent) {
            Some(node) => Err(GmshError::NotPlanar { node: node.number, z: node.at[2] }),
            None => Ok(()),
        }
    }

    fn place(&self, element: &Element, node: u64) -> Result<usize, GmshError> {
        let missing = GmshError::NoSuchNode { element: element.number, node };
        self.places.get(&node).copied().ok_or(missing)
    }

    fn of(&self, raw: &Raw, element: &Element) -> Result<Given, GmshError> {
        let places = raw.corners(element).iter().map(|&node| self.place(element, node));
        let mut corners = places.collect::<Result<Vec<_>, _>>()?;
        let (count, edges) = match element.kind {
            Kind::Triangle => (3, 3),
            Kind::Quadrilateral => (4, 4),
            Kind::Line | Kind::Point => (2, 1),
        };
        let mut middles = corners.split_off(count);
        let centre = (middles.len() > edges).then(|| middles.pop()).flatten();
        Ok(Given { corners, middles, centre })
    }

    /// Appends the centre that the eight other nodes give to a quadrilateral.
    fn centre(&mut self, corners: [usize; 4], middles: [usize; 4]) -> usize {
        let sum =
            |nodes: [usize; 4], d: usize| -> f64 { nodes.map(|n| self.points[n][d]).iter().sum() };
        let centre = [0, 1].map(|d| 0.5 * sum(middles, d) - 0.25 * sum(corners, d));
        self.points.push(centre);
        self.points.len() - 1
    }
}

/// Turns the corners of a clockwise cell round, the first one kept.
fn turn_counterclockwise(points: &[Point], cell: &mut Given) {
    let corners: Vec<Point> = cell.corners.iter().map(|&node| points[node]).collect();
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    let twice_area: f64 = ends.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
    if twice_area < 0.0 {
        cell.corners[1..].reverse();
    }
}

/// The middle nodes of edges.
struct Middles(HashMap<[usize; 2], usize>);

fn key([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

impl Middles {
    /// The middle of an edge; the straight one is appended where the file has none.
    fn of(&mut self, [a, b]: [usize; 2], points: &mut Vec<Point>) -> usize {
        *self.0.entry(key([a, b])).or_insert_with(|| {
            points.push([0, 1].map(|d| 0.5 * (points[a][d] + points[b][d])));
            points.len() - 1
        })
    }
}

/// The middles that elements of second order have in the file.
fn given_middles(raw: &Raw, nodes: &Nodes) -> Result<Middles, GmshError> {
    let mut middles = HashMap::new();
    for element in &raw.elements {
        let given = nodes.of(raw, element)?;
        for (k, &middle) in given.middles.iter().enumerate() {
            let [a, b] = [given.corners[k], given.corners[(k + 1) % given.corners.len()]];
            if *middles.entry(key([a, b])).or_insert(middle) != middle {
                return Err(GmshError::TwoMiddles { ends: [a, b].map(|node| nodes.points[node]) });
            }
        }
    }
    Ok(Middles(middles))
}

/// The named lines on the rim, in the order of the groups' numbers.
fn boundaries(
    raw: &Raw,
    mesh: &MeshDescription,
    places: &HashMap<u64, usize>,
) -> Result<Vec<NamedBoundary>, GmshError> {
    let names = named_edges(raw, mesh, places)?;
    let mut boundaries: BTreeMap<i32, Vec<[usize; 3]>> = BTreeMap::new();
    let mut unnamed = Vec::new();
    for [a, b, middle] in rim(mesh) {
        match names.get(&key([a, b])) {
            Some(group) => boundaries.entry(*group).or_default().push([a, b, middle]),
            None => unnamed.push([a, b]),
        }
    }
    if let Some(first) = unnamed.first() {
        let first = first.map(|node| mesh.points[node]);
        return Err(GmshError::Unnamed { count: unnamed.len(), first });
    }
    let named = boundaries.into_iter();
    Ok(named
        .map(|(group, edges)| NamedBoundary { name: raw.names[&group].clone(), edges })
        .collect())
}

/// The physical group with a name that each line is in.
fn named_edges(
    raw: &Raw,
    mesh: &MeshDescription,
    places: &HashMap<u64, usize>,
) -> Result<HashMap<[usize; 2], i32>, GmshError> {
    let mut names: HashMap<[usize; 2], i32> = HashMap::new();
    for line in raw.elements.iter().filter(|element| element.kind == Kind::Line) {
        let ends = [raw.corners(line)[0], raw.corners(line)[1]].map(|node| places[&node]);
        let groups = raw.groups(line).iter().map(|group| group.saturating_abs());
        for group in groups.filter(|group| raw.names.contains_key(group)) {
            let other = *names.entry(key(ends)).or_insert(group);
            if raw.names[&other] != raw.names[&group] {
                let [first, second] = [other, group].map(|group| raw.names[&group].clone());
                let ends = ends.map(|node| mesh.points[node]);
                return Err(GmshError::TwoNames { ends, first, second });
            }
        }
    }
    Ok(names)
}

/// The edges that are in one cell only: end, end, middle, in the order of the cells.
fn rim(mesh: &MeshDescription) -> Vec<[usize; 3]> {
    let triangles =
        mesh.triangles.iter().flat_map(|t| (0..3).map(|k| [t[k], t[(k + 1) % 3], t[3 + k]]));
    let quadrilaterals =
        mesh.quadrilaterals.iter().flat_map(|q| (0..4).map(|k| [q[k], q[(k + 1) % 4], q[4 + k]]));
    let all = || triangles.clone().chain(quadrilaterals.clone());
    let mut cells: HashMap<[usize; 2], usize> = HashMap::new();
    all().for_each(|[a, b, _]| *cells.entry(key([a, b])).or_default() += 1);
    all().filter(|&[a, b, _]| cells[&key([a, b])] == 1).collect()
}

/// Drops the nodes that no cell uses.
fn drop_unused(mesh: &mut MeshDescription) {
    const UNUSED: usize = usize::MAX;
    let mut places = vec![UNUSED; mesh.points.len()];
    let cells = mesh.triangles.iter().flatten().chain(mesh.quadrilaterals.iter().flatten());
    cells.for_each(|&node| places[node] = 0);
    let used = places.iter_mut().filter(|place| **place != UNUSED);
    used.enumerate().for_each(|(count, place)| *place = count);
    let mut place = places.iter();
    mesh.points.retain(|_| place.next().is_some_and(|&place| place != UNUSED));
    let edges = mesh.boundaries.iter_mut().flat_map(|boundary| boundary.edges.iter_mut().flatten());
    let nodes = mesh.triangles.iter_mut().flatten().chain(mesh.quadrilaterals.iter_mut().flatten());
    nodes.chain(edges).for_each(|node| *node = places[*node]);
}
