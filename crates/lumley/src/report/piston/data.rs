//! What the report of a piston run is made from.

/// The constants of the piston, (33)(34).
///
/// ```
/// use lumley::report::Parameters;
///
/// let canonical = Parameters {
///     viscosity: 0.2,
///     spring_length: 0.95,
///     stiffness: 39.5,
///     damping: 0.1,
///     mass: 0.5,
///     force_factor: 1.0,
///     initial_position: 0.9,
///     initial_flow: "zero".into(),
///     domain_length: 1.1,
///     end: 2.0,
///     ..Parameters::default()
/// };
/// assert_eq!(canonical.initial_velocity, 0.0);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Parameters {
    /// ν, in m²/s.
    pub viscosity: f64,
    /// x0, length of the spring at rest, in m.
    pub spring_length: f64,
    /// K, in N/m.
    pub stiffness: f64,
    /// b, in N s/m.
    pub damping: f64,
    /// m, in kg.
    pub mass: f64,
    /// `c_F`, in kg/m: the fluid acts on the body with −c_F ν u_x(X).
    pub force_factor: f64,
    /// X(0), in m.
    pub initial_position: f64,
    /// X'(0), in m/s.
    pub initial_velocity: f64,
    /// u(x, 0) in words.
    pub initial_flow: String,
    /// L, in m.
    pub domain_length: f64,
    /// T, in s.
    pub end: f64,
    /// The full model's time scheme, mesh and element in words.
    pub discretisation: String,
}

/// Body and velocity of one model over the snapshot times, as far as it came.
///
/// ```
/// use lumley::report::Trajectory;
///
/// let blew_up_at_once = Trajectory::default();
/// assert!(blew_up_at_once.position.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trajectory {
    /// X, in m.
    pub position: Vec<f64>,
    /// X', in m/s.
    pub velocity: Vec<f64>,
    /// ν u_x at the fluid's side of the interface, in m²/s².
    pub traction: Vec<f64>,
    /// v(x, t) in m/s at all nodes of the fixed grid, one time after the other.
    pub field: Vec<f64>,
}

/// Where the modes of a reduced model live.
///
/// ```
/// use lumley::report::Frame;
///
/// assert_eq!(Frame::default(), Frame::FixedGrid);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Frame {
    /// On the fixed grid over fluid and solid.
    #[default]
    FixedGrid,
    /// In the frame of the moving mesh, where the interface stands still.
    Reference,
}

/// The modes of one frame and the snapshots projected on them.
///
/// ```
/// use lumley::report::ModeSet;
///
/// let set = ModeSet {
///     nodes: vec![0.0, 0.5, 1.0],
///     modes: vec![vec![0.0, 1.4, 0.0]],
///     projected: vec![vec![0.0, 0.1, 0.2, 0.1]],
/// };
/// assert_eq!(set.modes[0].len(), set.nodes.len());
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ModeSet {
    /// Nodes: x in m on the fixed grid, ξ = x/X in the reference frame.
    pub nodes: Vec<f64>,
    /// Modes at the nodes, orthonormal in L2: in m^(−1/2) on the fixed grid, dimensionless in the
    /// reference frame.
    pub modes: Vec<Vec<f64>>,
    /// `a_n(t)` of the snapshots, n = 1, 2, ...: in m^(3/2)/s on the fixed grid, in m/s in the
    /// reference frame.
    pub projected: Vec<Vec<f64>>,
}

/// How a run of a reduced model ended.
///
/// ```
/// use lumley::report::Outcome;
///
/// let ended = Outcome::BlewUp { time: 0.49, message: "|a| exceeds 1e6".into() };
/// assert_ne!(ended, Outcome::Finished { res_percent: 1.65 });
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// It reached the end.
    Finished {
        /// Res(N), (32), in %.
        res_percent: f64,
    },
    /// It did not.
    BlewUp {
        /// When, in s.
        time: f64,
        /// What the model said.
        message: String,
    },
}

/// A run of a reduced model with one number of modes.
///
/// ```
/// use lumley::report::{Outcome, RomRun};
///
/// let run = RomRun { modes: 6, outcome: Outcome::Finished { res_percent: 1.65 }, step_us: 1.9 };
/// assert_eq!(run.res_percent(), Some(1.65));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RomRun {
    /// N.
    pub modes: usize,
    /// How it ended.
    pub outcome: Outcome,
    /// Time per step, in µs.
    pub step_us: f64,
}

impl RomRun {
    /// Res(N) in %, if the run reached the end.
    pub fn res_percent(&self) -> Option<f64> {
        match self.outcome {
            Outcome::Finished { res_percent } => Some(res_percent),
            Outcome::BlewUp { .. } => None,
        }
    }

    /// The same where a figure should show it: errors of more than ten times the velocity would
    /// only flatten the others.
    pub(super) fn drawn_percent(&self) -> Option<f64> {
        self.res_percent().filter(|&res| res <= 1000.0)
    }
}

/// All runs of one reduced model, and one of them at full length.
///
/// ```
/// use lumley::report::RomResults;
///
/// let multiplier = RomResults { name: "multiplier".into(), shown: 6, ..RomResults::default() };
/// assert!(multiplier.runs.is_empty());
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RomResults {
    /// What the model is called, for legends.
    pub name: String,
    /// The runs, by number of modes.
    pub runs: Vec<RomRun>,
    /// Where its modes live.
    pub frame: Frame,
    /// The number of modes of the trajectory and the coefficients below.
    pub shown: usize,
    /// Steps of a run that reaches the end.
    pub steps: usize,
    /// Its cost at equal accuracy, where a full model was found to compare with.
    pub equal: Option<EqualAccuracy>,
    /// What the model computed with `shown` modes.
    pub trajectory: Trajectory,
    /// `a_n(t)` that it computed, n = 1, 2, ..., in the unit of the frame's projected ones.
    pub coefficients: Vec<Vec<f64>>,
}

impl RomResults {
    /// The run with the shown number of modes.
    pub(super) fn shown_run(&self) -> Option<&RomRun> {
        self.runs.iter().find(|run| run.modes == self.shown)
    }

    /// Res of the shown run in %, if it reached the end.
    pub(super) fn shown_res(&self) -> Option<f64> {
        self.shown_run().and_then(RomRun::res_percent).filter(|res| res.is_finite())
    }
}

/// A model of some resolution and its cost.
///
/// ```
/// use lumley::report::Variant;
///
/// let coarse = Variant { size: 50, step: 5e-3, steps: 400, step_us: 4.8, error_percent: 1.7 };
/// assert_eq!(coarse.seconds(), 400.0 * 4.8e-6);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Variant {
    /// Cells of a full model, modes of a reduced one.
    pub size: usize,
    /// Step, in s.
    pub step: f64,
    /// Steps to the end.
    pub steps: usize,
    /// Time per step, in µs.
    pub step_us: f64,
    /// Its difference from the run's full model in the norm of (32), in %; 0 for that model itself.
    pub error_percent: f64,
}

impl Variant {
    /// Time of the whole computation, in s.
    pub fn seconds(&self) -> f64 {
        self.steps as f64 * self.step_us * 1e-6
    }
}

/// A reduced model beside the cheapest full model that is no less accurate.
///
/// ```
/// use lumley::report::{EqualAccuracy, Variant};
///
/// let model = |step_us| Variant { steps: 200, step_us, ..Variant::default() };
/// let equal = EqualAccuracy { reduced: model(0.5), full: model(5.0) };
/// assert!((equal.ratio() - 10.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EqualAccuracy {
    /// The shown run, with the longest step that keeps its accuracy.
    pub reduced: Variant,
    /// The full model.
    pub full: Variant,
}

impl EqualAccuracy {
    /// How many times as fast the reduced model is.
    pub fn ratio(&self) -> f64 {
        self.full.seconds() / self.reduced.seconds()
    }
}

/// The error of one way to bring the velocity to the fixed grid.
///
/// ```
/// use lumley::report::TransferError;
///
/// let idw = TransferError { method: "inverse distance".into(), error_percent: 0.8 };
/// # let _ = idw;
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TransferError {
    /// Method and its parameters.
    pub method: String,
    /// Largest error over time relative to the largest norm, both L2(Ω), in %.
    pub error_percent: f64,
}
