//! What a run asks of a model, full or reduced alike.

mod piston;
mod reduced_piston;

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
    /// The velocity in `frame`, in m/s; `v` has as many entries as the frame has unknowns.
    ///
    /// # Errors
    /// [`StepError`] where the model does not know the frame or its transfer fails.
    fn sample(&self, frame: &Frame, v: &mut [f64]) -> Result<(), StepError>;
    /// The bodies in the flow.
    fn bodies(&self) -> &[BodyState];
    /// Writes a checkpoint.
    ///
    /// # Errors
    /// The failure of the medium.
    fn save(&self, to: &mut dyn Write) -> io::Result<()>;
    /// Takes a checkpoint of a model of the same case; what follows is the same bit for bit.
    ///
    /// # Errors
    /// A checkpoint that is damaged, of another case, or cannot be read.
    fn restore(&mut self, from: &mut dyn Read) -> io::Result<()>;
}

/// Watches a run: is called on the initial state and after each interval of the schedule.
///
/// ```
/// use lumley::model::{Model, Observer};
/// use lumley::run::Work;
/// struct Count(usize);
/// impl<M: Model> Observer<M> for Count {
///     fn observe(&mut self, _: &M, _: usize, _: &Work) -> Result<(), lumley::Error> {
///         self.0 += 1;
///         Ok(())
///     }
/// }
/// ```
pub trait Observer<M: Model> {
    /// Called with the model at snapshot number `snapshot`, after this `work`.
    ///
    /// # Errors
    /// Whatever stops the run.
    fn observe(&mut self, model: &M, snapshot: usize, work: &Work) -> Result<(), crate::Error>;
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
}

impl Frame {
    /// The name under which a record keeps it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Fixed { .. } => "fixed",
            Self::Reference => "reference",
        }
    }

    /// Unit of its coordinates.
    pub fn length_unit(&self) -> &'static str {
        match self {
            Self::Fixed { .. } => "m",
            Self::Reference => "1",
        }
    }
}

/// What one step tells of itself.
///
/// ```
/// let report = lumley::model::StepReport { iterations: 2, residual: 1e-13 };
/// assert_eq!(report.iterations, 2);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepReport {
    /// Newton iterations, or 0 where there are none.
    pub iterations: usize,
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
