//! Reports: one self-contained page for a run, and its figures.
//!
//! [`PistonReport`], [`FlowReport`] and [`PodReport`] take plain vectors and give a [`Report`]: strings, which the
//! caller writes where it wants. The page needs no network, no script to be complete, and no file
//! beside it. [`figure`] and [`html`] are the parts that reports are made of.

#[cfg(test)]
mod checks;
mod energy;
pub mod figure;
mod flow;
pub mod html;
mod markup;
mod number;
mod piston;
mod pod;
mod provenance;
#[cfg(test)]
pub(crate) mod wellformed;

pub use flow::{
    BodiesReport, BodyMotion, BodyNumbers, BoundaryLoads, CoordinateMotion, CoordinateNumbers,
    Film, FinalState, FlowModes, FlowReference, FlowReport, FlowSettings, FlowWork, History,
    LoadNumbers, ProbeSeries, Scene, ThinnedModes, TransferNumbers, View,
};
pub use html::Report;
pub use markup::{escape, literal};
pub use piston::{
    EqualAccuracy, Frame, ModeSet, Outcome, Parameters, PistonReport, RomResults, RomRun,
    Trajectory, TransferError, Variant,
};
pub use pod::{DrawnModes, FieldGrid, PodReport};
pub use provenance::Provenance;
