use super::crossing::crossings;
use crate::{Boundary, PlanarMesh, Point};

/// The solids that stand in the holes of a mesh, by the names of their boundaries.
///
/// A body is what its closed boundary goes round: the same quadratic edges as those of the cells, so that no
/// point between them belongs to both or to none.
///
/// ```
/// use lumley_fem::generate::Channel;
/// use lumley_fem::{PlanarMesh, transfer::Bodies};
/// # let channel: Channel = toml::from_str("
/// #     x = [0, 2]\ny = [0, 1]\nsize = 0.2\n[[bodies]]\nname = 'cylinder'\nsize = 0.05
/// #     shape = { kind = 'disc', centre = [0.7, 0.5], radius = 0.1 }")?;
/// let mesh = PlanarMesh::new(channel.mesh()?)?; // a channel round a disc at (0.7, 0.5)
/// let bodies = Bodies::new(&mesh, &["cylinder"])?;
/// assert_eq!(bodies.containing(&mesh, [0.72, 0.5]), Some(0));
/// assert_eq!(bodies.containing(&mesh, [1.5, 0.5]), None);
/// assert!(Bodies::new(&mesh, &["left"]).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Bodies {
    /// Start, end and middle of the edges of each.
    curves: Vec<Vec<[usize; 3]>>,
}

/// Why a boundary is not the outline of a body.
///
/// ```
/// let error = lumley_fem::transfer::BodyError::Open { name: "left".into(), node: 4 };
/// assert!(error.to_string().starts_with("the boundary `left` is not closed: it ends at node 4"));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BodyError {
    /// There is no boundary of that name.
    #[error("there is no boundary `{name}` for a body; the mesh has {known:?}")]
    Unknown {
        /// The name.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// A name stands twice.
    #[error("the boundary `{0}` is given for two bodies: name each once")]
    Twice(String),
    /// The boundary does not come back to where it starts.
    #[error(
        "the boundary `{name}` is not closed: it ends at node {node}; a body is what one named boundary goes round"
    )]
    Open {
        /// Its name.
        name: String,
        /// A node with one edge of it only.
        node: usize,
    },
    /// The fluid is within the boundary.
    #[error(
        "the boundary `{0}` goes round the fluid, not round a body: leave it out of the bodies"
    )]
    RoundTheFluid(String),
}

impl Bodies {
    /// The bodies within the boundaries of these names; they are numbered in this order.
    ///
    /// # Errors
    /// Every variant of [`BodyError`].
    pub fn new(mesh: &PlanarMesh, names: &[&str]) -> Result<Self, BodyError> {
        let topology = mesh.topology();
        let mut curves = Vec::with_capacity(names.len());
        for (k, &name) in names.iter().enumerate() {
            if names[..k].contains(&name) {
                return Err(BodyError::Twice(name.into()));
            }
            let Some(boundary) = topology.boundary(name) else {
                let known = topology.boundaries().iter().map(|b| b.name.clone()).collect();
                return Err(BodyError::Unknown { name: name.into(), known });
            };
            curves.push(outline(mesh, boundary)?);
        }
        Ok(Self { curves })
    }

    /// No body at all.
    pub fn none() -> Self {
        Self { curves: vec![] }
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.curves.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.curves.is_empty()
    }

    /// The number of the body that a point, in m, is in: an odd number of edges crosses the ray from the point
    /// to the left.
    pub fn containing(&self, mesh: &PlanarMesh, [x, y]: Point) -> Option<usize> {
        let is_inside = |curve: &Vec<[usize; 3]>| {
            let edges = curve.iter().map(|nodes| nodes.map(|node| mesh.nodes()[node]));
            let crossed = edges.flat_map(|edge| crossings(&edge, y)).flatten();
            crossed.filter(|&crossing| crossing <= x).count() % 2 == 1
        };
        self.curves.iter().position(is_inside)
    }

    /// [`containing`](Self::containing) for the points at `xs`, increasing, of the line `y`: the number of the
    /// body plus one, zero in none.
    ///
    /// Every crossing switches its body on or off for all points from there on.
    pub(super) fn on_line(&self, mesh: &PlanarMesh, y: f64, xs: &[f64], codes: &mut [usize]) {
        codes.fill(0);
        for (code, curve) in (1..).zip(&self.curves) {
            for nodes in curve {
                let edge = nodes.map(|node| mesh.nodes()[node]);
                for crossing in crossings(&edge, y).into_iter().flatten() {
                    if let Some(first) = codes.get_mut(xs.partition_point(|&x| x < crossing)) {
                        *first ^= code;
                    }
                }
            }
        }
        let mut inside = 0;
        for code in codes {
            inside ^= *code;
            *code = inside;
        }
    }
}

/// The edges of a closed boundary that has the fluid on its outer side.
fn outline(mesh: &PlanarMesh, boundary: &Boundary) -> Result<Vec<[usize; 3]>, BodyError> {
    let edges = boundary.edges.iter().map(|&edge| mesh.topology().edges()[edge].nodes);
    let curve: Vec<[usize; 3]> = edges.collect();
    let mut ends: Vec<(usize, i32)> =
        curve.iter().flat_map(|&[start, end, _]| [(start, 1), (end, -1)]).collect();
    ends.sort_unstable();
    let open =
        ends.chunk_by(|a, b| a.0 == b.0).find(|at| at.iter().map(|end| end.1).sum::<i32>() != 0);
    if let Some(at) = open {
        return Err(BodyError::Open { name: boundary.name.clone(), node: at[0].0 });
    }
    let cross = |[a, b]: [usize; 2]| {
        let ([p, q], [r, s]) = (mesh.nodes()[a], mesh.nodes()[b]);
        p * s - q * r
    };
    let twice_area: f64 = curve.iter().map(|&[a, b, m]| cross([a, m]) + cross([m, b])).sum();
    // The fluid is at the left of the edges.
    if twice_area > 0.0 {
        return Err(BodyError::RoundTheFluid(boundary.name.clone()));
    }
    Ok(curve)
}
