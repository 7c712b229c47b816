use super::{Frame, Model, StepError, StepReport};
use lumley_body::BodyState;
use lumley_fom::Piston;
use std::io::{self, Read, Write};
use std::slice;

/// The full-order piston, paper eqs. (33) and (34).
impl Model for Piston {
    fn time(&self) -> f64 {
        Piston::time(self)
    }

    fn step(&mut self, dt: f64) -> Result<StepReport, StepError> {
        let step = Piston::step(self, dt)?;
        let (iterations, residual) = (step.iterations, step.residual);
        Ok(StepReport { iterations, residual, renewals: 0 })
    }

    fn sample(&self, frame: &Frame, v: &mut [f64]) -> Result<(), StepError> {
        match frame {
            Frame::Fixed { grid, transfer } => Ok(transfer.transfer(self, grid, v)?),
            Frame::Reference => {
                for (v, u) in v.iter_mut().zip(self.velocities()) {
                    *v = u;
                }
                Ok(())
            }
            Frame::Picture { .. } => Err(StepError::UnknownFrame { frame: frame.name() }),
        }
    }

    fn bodies(&self) -> &[BodyState] {
        slice::from_ref(self.body())
    }

    fn save(&self, to: &mut dyn Write) -> io::Result<()> {
        Piston::save(self, to)
    }

    fn restore(&mut self, from: &mut dyn Read) -> io::Result<()> {
        Piston::restore(self, from).map_err(io::Error::other)
    }
}
