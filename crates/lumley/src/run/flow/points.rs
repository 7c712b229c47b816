use super::instruments::column;
use crate::Error;
use crate::case::FlowCase;
use crate::model::FlowModel;
use lumley_fem::{Location, PlanarMesh, Point, PointLocator};

/// Column of the pressure at the first of two points less that at the second.
pub(super) const DIFFERENCE: &str = "pressure_difference";

/// The points at which velocity and pressure are measured, those of the pressure difference last.
#[derive(Debug, Clone)]
pub(super) struct Points {
    names: Vec<String>,
    places: Vec<Point>,
    /// Where they are in the mesh; nowhere while a body covers them.
    found: Vec<Option<Location>>,
    locator: PointLocator,
}

impl Points {
    /// The points of `case` in the mesh where it is at the start.
    ///
    /// # Errors
    /// A point that is in no cell then.
    pub fn new(case: &FlowCase, mesh: &PlanarMesh) -> Result<Self, Error> {
        let names = case.probes.iter().map(|probe| probe.name.clone()).collect();
        let probes = case.probes.iter().map(|probe| ("flow.probes", probe.at));
        let two = case.pressure_difference.into_iter().flatten();
        let two = two.map(|point| ("flow.pressure_difference", point));
        let locator = PointLocator::new(mesh);
        let (mut places, mut found) = (Vec::new(), Vec::new());
        for (argument, point) in probes.chain(two) {
            let at = locator.locate(mesh, point).ok_or_else(|| Error::Argument {
                argument,
                value: format!("{point:?}"),
                expected: "a point in the fluid, in m: no cell of the mesh contains this one"
                    .into(),
            })?;
            places.push(point);
            found.push(Some(at));
        }
        Ok(Self { names, places, found, locator })
    }

    /// The columns of the table, time first.
    pub fn headers(&self) -> Vec<String> {
        let of = |name: &String| ["u", "v", "p"].map(|quantity| column(name, quantity));
        let mut headers: Vec<String> = vec!["time".into()];
        headers.extend(self.names.iter().flat_map(of));
        if self.places.len() > self.names.len() {
            headers.push(DIFFERENCE.into());
        }
        headers
    }

    /// Appends velocity and pressure at each probe, and the pressure difference.
    pub fn measure(&mut self, model: &FlowModel, row: &mut Vec<f64>) {
        self.follow(model);
        let probes = self.names.len();
        for k in 0..probes {
            let velocity = |at: &Location| model.flow().space().vector(model.flow().velocity(), at);
            row.extend(self.found[k].as_ref().map_or([f64::NAN; 2], velocity));
            row.push(self.pressure(model, k));
        }
        if self.places.len() > probes {
            row.push(self.pressure(model, probes) - self.pressure(model, probes + 1));
        }
    }

    /// Finds the points again in a mesh that moves.
    fn follow(&mut self, model: &FlowModel) {
        if model.flow().moves() {
            let mesh = model.flow().mesh();
            self.locator.update(mesh);
            for (found, point) in self.found.iter_mut().zip(&self.places) {
                *found = self.locator.locate(mesh, *point);
            }
        }
    }

    fn pressure(&self, model: &FlowModel, k: usize) -> f64 {
        let flow = model.flow();
        self.found[k].map_or(f64::NAN, |Location { cell, .. }| {
            let functions = flow.pressure_functions(cell);
            functions.pressure(&flow.pressure()[cell], self.places[k])
        })
    }
}
