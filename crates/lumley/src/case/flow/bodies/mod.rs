//! `[[bodies]]` and `[motion]`: rigid bodies, and the mesh that follows them.

mod apart;
mod drives;
mod massless;
mod probes;
mod refusal;
mod wet;

pub use probes::BodyProbes;

use super::{FlowFile, March, MotionSection};
use crate::case::CaseError;
use crate::case::ask::Ask;
use lumley_body::Tree;
use lumley_fem::{PlanarMesh, Point};
use lumley_fom::coupling::{BodySetup, Coupling};
use lumley_fom::motion::MotionParameters;

/// The bodies of a flow, checked, and how flow and mesh go with them.
///
/// ```
/// use lumley::case::Case;
/// let text = lumley::cases::find("oscillating-cylinder").expect("a case of lumley's own").text;
/// let Case::Flow(case) = Case::parse("x/case.toml".as_ref(), text, true, &[])? else {
///     panic!("it has a [flow]");
/// };
/// let bodies = case.bodies.expect("it has [[bodies]]");
/// assert_eq!(bodies.tree.label(1), "cylinder.y");
/// assert!(bodies.tree.coordinates().iter().all(|coordinate| coordinate.prescribed));
/// # Ok::<(), lumley::case::CaseError>(())
/// ```
#[derive(Debug, Clone)]
pub struct BodiesChoice {
    /// The bodies with their joints; formulas have become functions.
    pub tree: Tree,
    /// In m/s².
    pub gravity: Point,
    /// How flow and bodies find their common motion.
    pub coupling: Coupling,
    /// How the mesh follows.
    pub mesh: MotionParameters,
    /// What is told of a body at given times.
    pub probes: Option<BodyProbes>,
}

impl BodiesChoice {
    /// What the flow is set up with.
    pub fn setup(&self) -> BodySetup {
        let Self { tree, gravity, coupling, mesh, .. } = self;
        let bodies = tree.bodies().to_vec();
        BodySetup { bodies, gravity: *gravity, coupling: *coupling, mesh: *mesh }
    }
}

/// The bodies of a case on its mesh; `times` are the first and the last, in s.
pub(super) fn bodies(
    ask: &Ask,
    file: &FlowFile,
    mesh: &PlanarMesh,
    march: &March,
    times: &[f64],
) -> Result<Option<BodiesChoice>, CaseError> {
    if file.bodies.is_empty() {
        return alone(ask, file).map(|()| None);
    }
    let still = "no bodies: [steady] seeks the steady flow on a mesh at rest; without [[bodies]] every wall stays";
    ask.that(march.unsteady().is_some(), "bodies", file.bodies.len(), still)?;
    let MotionSection { stiffness, rigid_zone, coupling, gravity } =
        file.motion.unwrap_or_default();
    let parameters = MotionParameters { stiffness, rigid_zone };
    parameters.check().map_err(|error| refusal::of_mesh(ask, error))?;
    check_names(ask, file)?;
    let driven = drives::functions(ask, &file.bodies, times)?;
    let tree = Tree::new(&driven, gravity).map_err(|e| refusal::of_tree(ask, &file.bodies, e))?;
    wet::check(ask, file, mesh)?;
    massless::check(ask, &tree, coupling)?;
    apart::check(ask, &tree, mesh)?;
    let probes = file.output.probes.as_ref();
    let probes = probes.map(|section| probes::probes(ask, section, &tree, march)).transpose()?;
    Ok(Some(BodiesChoice { tree, gravity, coupling, mesh: parameters, probes }))
}

/// What only goes with bodies must not be there without them.
fn alone(ask: &Ask, file: &FlowFile) -> Result<(), CaseError> {
    let moved = "[[bodies]] with name, centre, joint and boundary: they are what moves";
    ask.that(file.motion.is_none(), "motion", "a table", moved)?;
    let told = "[[bodies]]: output.probes tells where a body is";
    ask.that(file.output.probes.is_none(), "output.probes", "a table", told)
}

/// Names stand in keys, in the heads of tables and in files.
fn check_names(ask: &Ask, file: &FlowFile) -> Result<(), CaseError> {
    for (k, body) in file.bodies.iter().enumerate() {
        let name = &body.name;
        let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
        let ok = name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(plain);
        let expected = "letters, digits, - and _, a letter first";
        ask.that(ok, &format!("bodies.{k}.name"), format!("\"{name}\""), expected)?;
    }
    Ok(())
}
