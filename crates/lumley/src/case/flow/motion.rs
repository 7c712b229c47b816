use super::boundaries::check_names;
use super::fields::TimeTable;
use super::recording::MovingSection;
use super::{BoundaryKind, FlowFile};
use crate::case::CaseError;
use crate::case::ask::Ask;
use crate::case::formula::Variables;
use crate::case::term::{Scalar, Term};
use crate::format::csv;
use lumley_fem::{Boundary, PlanarMesh, Point};
use lumley_fom::motion::{MotionFunction, MotionParameters, RigidMotion};
use std::collections::HashMap;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// Which boundaries move, and how the mesh follows.
///
/// ```
/// use lumley::case::MotionChoice;
/// use lumley_fom::motion::MotionParameters;
/// let still = MotionChoice { parameters: MotionParameters::default(), boundaries: vec![] };
/// assert!(still.boundaries.is_empty());
/// ```
#[derive(Debug, Clone)]
pub struct MotionChoice {
    /// How the mesh follows.
    pub parameters: MotionParameters,
    /// What moves, in the order of the mesh's boundaries.
    pub boundaries: Vec<MovingChoice>,
}

/// A boundary with a prescribed rigid motion.
///
/// ```
/// use lumley::case::MovingChoice;
/// use lumley_fom::motion::RigidMotion;
/// let function = |t: f64| RigidMotion { translation: [0.0, t.sin()], angle: 0.0 };
/// let body = MovingChoice {
///     name: "cylinder".into(),
///     pivot: [0.0, 0.0],
///     function: std::sync::Arc::new(function),
/// };
/// assert_eq!((body.function)(0.0).translation, [0.0, 0.0]);
/// ```
#[derive(Clone)]
pub struct MovingChoice {
    /// The boundary.
    pub name: String,
    /// The point about which it turns, in m, where it is in the mesh.
    pub pivot: Point,
    /// Where it is at a time in s.
    pub function: MotionFunction,
}

impl fmt::Debug for MovingChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, pivot, .. } = self;
        let mut debug = f.debug_struct("MovingChoice");
        debug.field("name", name).field("pivot", pivot).finish_non_exhaustive()
    }
}

/// What moves, and how; `times` are the first and the last, in s.
pub(super) fn motion(
    ask: &Ask,
    file: &FlowFile,
    mesh: &PlanarMesh,
    folder: &Path,
    times: &[f64],
) -> Result<Option<MotionChoice>, CaseError> {
    let Some(section) = &file.motion else { return Ok(None) };
    let still = "no [motion]: [steady] seeks the steady flow on a mesh at rest";
    ask.that(file.steady.is_none(), "motion", "a table", still)?;
    let (stiffness, rigid_zone) = (section.stiffness, section.rigid_zone);
    let parameters = MotionParameters { stiffness, rigid_zone };
    let place = || ask.place("motion");
    let wrong = |source| CaseError::Motion { place: place(), source: Box::new(source) };
    parameters.check().map_err(wrong)?;
    if section.boundaries.is_empty() {
        let expected = "[motion.boundaries.NAME] for every boundary that moves";
        return Err(ask.missing("motion.boundaries", expected));
    }
    check_names(ask, "motion.boundaries", section.boundaries.keys(), mesh)?;
    let mut boundaries = Vec::new();
    for boundary in mesh.topology().boundaries() {
        let Some(moving) = section.boundaries.get(&boundary.name) else { continue };
        check_body(ask, file, mesh, boundary)?;
        let key = format!("motion.boundaries.{}", boundary.name);
        let function = function(ask, &key, moving, folder, times)?;
        let pivot = moving.pivot;
        ask.finite(&format!("{key}.pivot"), pivot[0], "m")?;
        ask.finite(&format!("{key}.pivot"), pivot[1], "m")?;
        boundaries.push(MovingChoice { name: boundary.name.clone(), pivot, function });
    }
    Ok(Some(MotionChoice { parameters, boundaries }))
}

/// A moving boundary is the whole outline of a body, and the fluid sticks to it.
fn check_body(
    ask: &Ask,
    file: &FlowFile,
    mesh: &PlanarMesh,
    boundary: &Boundary,
) -> Result<(), CaseError> {
    let name = &boundary.name;
    let mut edges_at: HashMap<usize, usize> = HashMap::new();
    for &edge in &boundary.edges {
        let [a, b, _] = mesh.topology().edges()[edge].nodes;
        *edges_at.entry(a).or_default() += 1;
        *edges_at.entry(b).or_default() += 1;
    }
    if let Some((&end, _)) = edges_at.iter().filter(|(_, count)| **count != 2).min() {
        let [x, y] = mesh.nodes()[end];
        let expected = format!(
            "the closed outline of a body; it ends at ({x:?}, {y:?}) m, where another boundary begins"
        );
        return Err(ask.refuse(&format!("motion.boundaries.{name}"), "a table", &expected));
    }
    let kind = file.flow.boundaries.get(name).map(|section| section.kind);
    let expected = "\"no-slip\": the boundary moves, and the fluid at it has its velocity";
    let ok = kind.is_none_or(|kind| kind == BoundaryKind::NoSlip);
    ask.that(ok, &format!("flow.boundaries.{name}.kind"), "another", expected)
}

fn function(
    ask: &Ask,
    key: &str,
    moving: &MovingSection,
    folder: &Path,
    times: &[f64],
) -> Result<MotionFunction, CaseError> {
    let terms = [("x", &moving.x, "m"), ("y", &moving.y, "m"), ("angle", &moving.angle, "rad")];
    if let Some(name) = &moving.table {
        if let Some((stray, ..)) = terms.iter().find(|(_, term, _)| term.is_some()) {
            let expected = "either table or x, y and angle, not both";
            return Err(ask.refuse(&format!("{key}.{stray}"), "given", expected));
        }
        return table(ask, key, name, folder);
    }
    if terms.iter().all(|(_, term, _)| term.is_none()) {
        let expected = "table, or one or more of x, y and angle: numbers or formulas of t";
        return Err(ask.missing(key, expected));
    }
    let read = |(name, term, unit): (&str, &Option<Term>, &str)| {
        let key = format!("{key}.{name}");
        let term = term.clone().unwrap_or(Term::Number(0.0));
        let scalar = Scalar::read(ask, &key, &term, Variables::Time, unit)?;
        for &time in times {
            let value = scalar.value([0.0; 2], time);
            let expected = format!("finite values; at t = {time:?} s it gives {value}");
            ask.that(value.is_finite(), &key, &term, &expected)?;
        }
        Ok(scalar)
    };
    let [x, y, angle] = terms;
    let (x, y, angle) = (read(x)?, read(y)?, read(angle)?);
    Ok(Arc::new(move |t| {
        let value = |scalar: &Scalar| scalar.value([0.0; 2], t);
        RigidMotion { translation: [value(&x), value(&y)], angle: value(&angle) }
    }))
}

fn table(ask: &Ask, key: &str, name: &str, folder: &Path) -> Result<MotionFunction, CaseError> {
    let key = format!("{key}.table");
    let expected = |e| format!("a table of t in s, x and y in m, angle in rad: {e}");
    let rows = csv::read_rows::<3>(&folder.join(name));
    let table = TimeTable::new(&rows.map_err(|e| ask.refuse(&key, name, &expected(e)))?);
    Ok(Arc::new(move |t| {
        let [x, y, angle] = table.at(t);
        RigidMotion { translation: [x, y], angle }
    }))
}
