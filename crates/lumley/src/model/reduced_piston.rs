use super::{Frame, Model, StepError, StepReport};
use lumley_body::BodyState;
use lumley_rom::ReducedPiston;
use std::io::{self, Read, Write};
use std::slice;

/// A reduced piston is a model like any other.
impl Model for ReducedPiston {
    fn time(&self) -> f64 {
        ReducedPiston::time(self)
    }

    fn step(&mut self, dt: f64) -> Result<StepReport, StepError> {
        ReducedPiston::step(self, dt)?;
        Ok(StepReport::default())
    }

    fn sample(&self, frame: &Frame, v: &mut [f64]) -> Result<(), StepError> {
        match frame {
            Frame::Fixed { grid, .. } => {
                ReducedPiston::sample(self, grid, v)?;
                Ok(())
            }
            Frame::Reference | Frame::Picture { .. } => {
                Err(StepError::UnknownFrame { frame: frame.name() })
            }
        }
    }

    fn bodies(&self) -> &[BodyState] {
        slice::from_ref(self.body())
    }

    fn save(&self, to: &mut dyn Write) -> io::Result<()> {
        ReducedPiston::save(self, to)
    }

    fn restore(&mut self, from: &mut dyn Read) -> io::Result<()> {
        ReducedPiston::restore(self, from)
    }
}
