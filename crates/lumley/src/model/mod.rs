//! What a run asks of a model, full or reduced alike.

mod flow;
mod nodal_fields;
mod piston;
mod reduced_piston;
mod view;

pub use flow::{FlowModel, Stepping};
pub(crate) use nodal_fields::NodalFields;

use crate::record::{FrameDescription, Quantity, Support};
use crate::run::Work;
use lumley_body::BodyState;
use lumley_fem::UniformGrid;
use lumley_fem::transfer::Transfer;
use std::io::{self, Read, Write};

/// A model that can be run and recorded.
///
/// ```
/// use lumley::model::{Frame, Model};
/// use lumley::case::PistonCase;
/// let text = lumley::cases::find("piston").expect("a case of lumley's own").text;
/// let case = PistonCase::parse("piston/case.toml".as_ref(), text, true, &[])?;
/// let mut model = lumley::run::full_order(&case)?;
/// model.step(case.schedule.step)?;
/// let frame = Frame::Fixed { grid: case.grid.clone(), transfer: case.transfer };
/// let mut v = vec![0.0; case.grid.len()];
/// model.sample(&frame, &mut v)?;
/// assert!(v.iter().all(|v| v.is_finite()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Model {
    /// Simulated time, in s.
    fn time(&self) -> f64;
    /// One time step of `dt` in s.
    ///
    /// # Errors
    /// [`StepError`]: the model is then half-moved and must be discarded.
    fn step(&mut self, dt: f64) -> Result<StepReport, StepError>;
    /// The longest step that the model would make now, in s; `None` where the case decides.
    fn suggested_step(&self) -> Option<f64> {
        None
    }
    /// The fields of `frame`, component after component; `v` has as many entries as the frame has unknowns.
    ///
    /// # Errors
    /// [`StepError`] where the model does not know the frame or its transfer fails.
    fn sample(&self, frame: &Frame, v: &mut [f64]) -> Result<(), StepError>;
    /// The bodies in the flow whose motion is a part of the model.
    fn bodies(&self) -> &[BodyState];
    /// Forgets what a checkpoint does not keep, such as an old factorisation: this run, and one that goes on
    /// from a checkpoint here, then are the same bit for bit.
    fn forget(&mut self) {}
    /// Writes a checkpoint.
    ///
    /// # Errors
    /// The failure of the medium.
    fn save(&self, to: &mut dyn Write) -> io::Result<()>;
    /// Takes a checkpoint of a model of the same case; what follows is the same bit for bit as of a model that
    /// was made to [`forget`](Self::forget) there.
    ///
    /// # Errors
    /// A checkpoint that is damaged, of another case, or cannot be read.
    fn restore(&mut self, from: &mut dyn Read) -> io::Result<()>;
}

/// Watches a run: is called on the initial state and at each stop.
///
/// ```
/// use lumley::model::{Model, Observer, Stop};
/// use lumley::run::Work;
/// struct Count(usize);
/// impl<M: Model> Observer<M> for Count {
///     fn observe(&mut self, _: &M, _: Stop, _: &Work) -> Result<(), lumley::Error> {
///         self.0 += 1;
///         Ok(())
///     }
/// }
/// ```
pub trait Observer<M: Model> {
    /// Called with the model at a stop, after this `work`.
    ///
    /// # Errors
    /// Whatever stops the run.
    fn observe(&mut self, model: &M, stop: Stop, work: &Work) -> Result<(), crate::Error>;

    /// Called after each step, of `dt` in s.
    ///
    /// # Errors
    /// Whatever stops the run.
    fn stepped(&mut self, _: &M, _: &StepReport, _dt: f64) -> Result<(), crate::Error> {
        Ok(())
    }
}

/// An instant at which a run is observed.
///
/// ```
/// let stop = lumley::model::Stop { number: 20, time: 0.2 };
/// assert_eq!(stop.number, 20);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Its number; 0 is the start.
    pub number: usize,
    /// When, in s, without the round-off of summed steps.
    pub time: f64,
}

/// Where a field is sampled.
///
/// ```
/// use lumley::model::Frame;
/// assert_eq!(Frame::Reference.name(), "reference");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Frame {
    /// A fixed grid: transfer and characteristic function are behind it, paper eqs. (27)-(30).
    Fixed {
        /// The grid, in m.
        grid: UniformGrid,
        /// How the moving mesh's field comes to it.
        transfer: Transfer,
    },
    /// The nodes of the model's own reference mesh: x = xi X(t) for the piston.
    Reference,
    /// A fixed grid again, on which a flow is drawn: velocity, pressure and vorticity.
    Picture {
        /// The grid, in m.
        grid: UniformGrid,
    },
}

impl Frame {
    /// The name under which a record keeps it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Fixed { .. } => "fixed",
            Self::Reference => "reference",
            Self::Picture { .. } => "picture",
        }
    }

    /// Unit of its coordinates.
    pub fn length_unit(&self) -> &'static str {
        match self {
            Self::Fixed { .. } | Self::Picture { .. } => "m",
            Self::Reference => "1",
        }
    }

    /// What a record says of it, with fields of these components on the nodes of `support`.
    pub fn describe(&self, support: Support, components: Vec<Quantity>) -> FrameDescription {
        let (name, length_unit) = (self.name().into(), self.length_unit().into());
        FrameDescription { name, support, length_unit, components }
    }
}

/// What one step tells of itself.
///
/// ```
/// let report = lumley::model::StepReport { iterations: 2, ..Default::default() };
/// assert_eq!(report.renewals, 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepReport {
    /// Iterations, Newton's or the linear solver's, or 0 where there are none.
    pub iterations: usize,
    /// New factorisations of the linear solver.
    pub renewals: usize,
    /// Last relative residual, or 0 where there is none.
    pub residual: f64,
}

/// Why a model did not make its step.
///
/// ```
/// use lumley::model::StepError;
/// let error = StepError::UnknownFrame { frame: "reference" };
/// assert!(error.to_string().contains("reference"));
/// ```
#[derive(Debug, thiserror::Error)]
pub enum StepError {
    /// The full-order piston failed.
    #[error(transparent)]
    Piston(#[from] lumley_fom::PistonError),
    /// The flow failed.
    #[error(transparent)]
    Flow(#[from] lumley_fom::flow::FlowError),
    /// A reduced model failed.
    #[error(transparent)]
    Reduced(#[from] lumley_rom::ReducedError),
    /// The field did not come to the fixed grid.
    #[error(transparent)]
    Transfer(#[from] lumley_fem::transfer::TransferError),
    /// The model has no such frame.
    #[error("this model cannot be sampled in the {frame} frame; take the fixed grid")]
    UnknownFrame {
        /// The frame asked for.
        frame: &'static str,
    },
}
