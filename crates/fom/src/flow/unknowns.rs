use super::rigid::RigidBodies;
use super::slip::Slides;
use super::{Condition, FlowError, periodic};
use lumley_fem::PlanarMesh;
use lumley_fem::space::NodalSpace;

/// What of the velocity at a dof on the rim of cells is unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NodeUnknowns {
    /// The x component is this unknown, the y component the next.
    Free(usize),
    /// The component along the boundary; number of the slide, and the unknown.
    Slides(usize, usize),
    /// The velocities of the coordinates that move a body, along as many directions from this on.
    Rigid {
        /// Number of the body among the wet ones.
        body: usize,
        /// Its first direction.
        first: usize,
    },
    /// Nothing: the condition of this boundary gives it.
    Held(usize),
}

/// The unknowns of a flow whose interior velocities and slopes of the pressure are eliminated in the cells:
/// those of bodies first, then velocities, then a mean pressure for each cell.
#[derive(Debug, Clone)]
pub(super) struct Unknowns {
    /// By shared velocity dof.
    pub nodes: Vec<NodeUnknowns>,
    /// By cell; one is none where no boundary is free, for then the pressure is known up to a constant.
    pub pressures: Vec<Option<usize>>,
    /// Number of all.
    pub count: usize,
    /// Pairs of cells that periodic boundaries make neighbours.
    pub periodic: Vec<[usize; 2]>,
}

/// Which condition counts at a dof where several meet, strongest first.
fn strength(condition: &Condition) -> u8 {
    match condition {
        Condition::NoSlip => 0,
        Condition::Velocity(_) => 1,
        Condition::Slip => 2,
        Condition::TractionFree | Condition::Periodic { .. } => 3,
    }
}

impl Unknowns {
    /// Numbers the unknowns; `slides` are the dofs that move along a boundary.
    pub fn new(
        mesh: &PlanarMesh,
        space: &NodalSpace,
        conditions: &[Condition],
        slides: &Slides,
        rigid: &RigidBodies,
    ) -> Result<Self, FlowError> {
        let stands_for = periodic::representatives(mesh, space, conditions)?;
        let shared = space.dofs().shared();
        let mut strongest = vec![None::<usize>; shared];
        for (number, boundary) in mesh.topology().boundaries().iter().enumerate() {
            for dof in space.dofs().on_boundary(mesh.topology(), boundary) {
                let held = &mut strongest[stands_for[dof]];
                let stronger =
                    |old: &usize| strength(&conditions[*old]) <= strength(&conditions[number]);
                if !held.as_ref().is_some_and(stronger) {
                    *held = Some(number);
                }
            }
        }
        let mut moved = vec![None; shared];
        rigid.nodes(slides.count()).for_each(|(dof, node)| moved[dof] = Some(node));
        let mut count = rigid.count();
        let mut nodes: Vec<NodeUnknowns> = Vec::with_capacity(shared);
        for dof in 0..shared {
            let first = stands_for[dof];
            nodes.push(match moved[dof] {
                Some(node) => node,
                None if first < dof => nodes[first],
                None => number(dof, strongest[dof], conditions, slides, &mut count),
            });
        }
        let pinned = !conditions.iter().any(|c| matches!(c, Condition::TractionFree));
        let cells = mesh.topology().cells();
        let last = cells - usize::from(pinned);
        let pressures = (0..cells).map(|cell| (cell < last).then_some(count + cell)).collect();
        let periodic = periodic::neighbours(mesh, conditions, space, &stands_for);
        Ok(Self { nodes, pressures, count: count + last, periodic })
    }

    /// Whether the pressure is known up to a constant only.
    pub fn pinned(&self) -> bool {
        self.pressures.last().is_some_and(Option::is_none)
    }
}

/// The unknowns of a dof; a dof at a kink of a slip boundary does not move against it.
fn number(
    dof: usize,
    boundary: Option<usize>,
    conditions: &[Condition],
    slides: &Slides,
    count: &mut usize,
) -> NodeUnknowns {
    let first = *count;
    let Some(boundary) = boundary else {
        *count += 2;
        return NodeUnknowns::Free(first);
    };
    match (&conditions[boundary], slides.of(dof)) {
        (Condition::Velocity(_) | Condition::NoSlip, _) | (Condition::Slip, None) => {
            NodeUnknowns::Held(boundary)
        }
        (Condition::Slip, Some(slide)) => {
            *count += 1;
            NodeUnknowns::Slides(slide, first)
        }
        (Condition::TractionFree | Condition::Periodic { .. }, _) => {
            *count += 2;
            NodeUnknowns::Free(first)
        }
    }
}
