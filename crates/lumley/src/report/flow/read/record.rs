//! The pictures and the basis of a run, as far as a report shows them.

use super::case::CaseView;
use super::numbers::Numbers;
use crate::Error;
use crate::format::npz::NpzReader;
use crate::record::{FrameReader, Record, Support};
use crate::report::flow::modes::SHOWN;
use crate::report::{DrawnModes, FieldGrid, Film, FlowModes, Scene, Track};
use faer::Mat;
use lumley_fem::{PlanarMesh, Point, UniformGrid};
use std::path::Path;

/// The frame of pictures and that of the decomposition, and how many components they have.
const PICTURE: (&str, usize) = ("picture", 4);
const FIXED: (&str, usize) = ("fixed", 2);

/// Before the names of bodies in the series of where they were.
const POSITION: &str = "position-";

/// The pictures, where the bodies were, and the grid of the modes.
#[derive(Debug, Default)]
pub(super) struct Recorded {
    tracks: Vec<Track>,
    film: Option<Film>,
    grid: Option<UniformGrid>,
}

impl Recorded {
    /// What the pictures of the run in `folder` have; nothing where there are none.
    pub(super) fn read(run: &Path, case: &CaseView) -> Result<Self, Error> {
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
        // Names of series are shorter than those of bodies; both have one order.
        let series = record.description().series.iter().map(|series| series.name.as_str());
        let series = series.filter(|name| name.starts_with(POSITION)).zip(case.moving());
        let tracks = series.map(|(series, body)| track(&record, series, body));
        Ok(Self { tracks: tracks.collect::<Result<_, _>>()?, film, grid: fixed })
    }

    /// The scene with the mesh, if there is one.
    pub(super) fn scene(self, mesh: Option<PlanarMesh>) -> Scene {
        Scene { mesh, tracks: self.tracks, film: self.film }
    }
}

/// Where a body was.
fn track(record: &Record, series: &str, (name, pivot): (&str, Point)) -> Result<Track, Error> {
    let series = record.series(series)?;
    let place = |k: usize| [0, 1, 2].map(|d| series.at(k).get(d).copied().unwrap_or(0.0));
    Ok(Track {
        name: name.to_owned(),
        pivot,
        times: record.times().to_vec(),
        positions: (0..record.len()).map(place).collect(),
    })
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
    }))
}
