//! The pictures and the basis of a run, as far as a report shows them.

use super::numbers::Numbers;
use crate::Error;
use crate::format::npz::NpzReader;
use crate::record::{FrameReader, Record, Support};
use crate::report::flow::modes::SHOWN;
use crate::report::{DrawnModes, FieldGrid, Film, FlowModes, Scene};
use faer::Mat;
use lumley_fem::{PlanarMesh, UniformGrid};
use std::path::Path;

/// The frame of pictures and that of the decomposition, and how many components they have.
const PICTURE: (&str, usize) = ("picture", 4);
const FIXED: (&str, usize) = ("fixed", 2);

/// The pictures and the grid of the modes.
#[derive(Debug, Default)]
pub(super) struct Recorded {
    film: Option<Film>,
    grid: Option<UniformGrid>,
}

impl Recorded {
    /// What the pictures of the run in `folder` have; nothing where there are none.
    pub(super) fn read(run: &Path) -> Result<Self, Error> {
        let folder = run.join("pictures");
        if !folder.exists() {
            return Ok(Self::default());
        }
        let fixed = run.join("record");
        let fixed = if fixed.exists() { grid(&Record::open(fixed)?, FIXED) } else { None };
        let record = Record::open(folder)?;
        let film = match grid(&record, PICTURE) {
            Some(grid) => Some(film(&record, &grid)?),
            None => None,
        };
        Ok(Self { film, grid: fixed })
    }

    /// The scene with the mesh, if there is one.
    pub(super) fn scene(self, mesh: Option<PlanarMesh>) -> Scene {
        Scene { mesh, film: self.film }
    }
}

/// The grid of a frame, if there is such a frame on a grid of the plane.
fn grid(record: &Record, (name, components): (&str, usize)) -> Option<UniformGrid> {
    let frame = record.description().frames.iter().find(|frame| frame.name == name)?;
    match &frame.support {
        Support::Grid(grid) if grid.dimension() == 2 => {
            (frame.components.len() == components).then(|| grid.clone())
        }
        _ => None,
    }
}

fn film(record: &Record, grid: &UniformGrid) -> Result<Film, Error> {
    let frame: FrameReader = record.frame(PICTURE.0)?;
    Film::sample(grid, record.times(), |rows, times| {
        let mut line = Mat::zeros(rows.len(), times);
        frame.read_block(rows, 0..times, line.as_mut())?;
        Ok(line)
    })
}

/// The decomposition, if there is one.
pub(super) fn modes(
    folder: &Path,
    recorded: &Recorded,
    numbers: &Numbers,
) -> Result<Option<FlowModes>, Error> {
    let path = folder.join("basis").join("fixed.npz");
    let Some(grid) = recorded.grid.clone().filter(|_| path.exists()) else { return Ok(None) };
    let npz = NpzReader::open(&path)?;
    let coefficients = npz.read("coefficients")?;
    let of_modes = FieldGrid { nodes: [grid.nodes()[0], grid.nodes()[1], 1], components: FIXED.1 };
    let all = npz.unchecked("modes")?;
    let shown = SHOWN.min(all.cols());
    let drawn = (all.rows() == of_modes.len()).then(|| {
        DrawnModes::sample(of_modes, shown, |rows| {
            let mut block = Mat::zeros(rows.len(), shown);
            all.read_block(rows, 0..shown, block.as_mut()).map(|()| block)
        })
    });
    Ok(Some(FlowModes {
        grid,
        eigenvalues: npz.vector("spectrum")?,
        total_energy: npz.vector("total_energy")?.iter().sum(),
        centred: npz.names().any(|name| name == "mean"),
        residuals: numbers.projection.res_percent.clone(),
        modes: drawn.transpose()?,
        times: npz.vector("times")?,
        coefficients: coefficients.row_iter().map(|row| row.iter().copied().collect()).collect(),
        thinned: numbers.pod_every.clone(),
        divergence: numbers.pod.divergence.clone(),
        snapshot_divergence: numbers.pod.snapshot_divergence,
    }))
}
