use faer::Mat;
use lumley::record::{
    Description, FrameDescription, Quantity, RecordError, RecordWriter, SeriesDescription,
    Snapshot, Support,
};
use lumley_fem::UniformGrid;
use std::path::{Path, PathBuf};

pub type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Knuth's linear congruential generator: the same numbers in each run of the tests.
pub struct Lcg(pub u64);

impl Lcg {
    pub fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).expect("31 bits") % bound
    }
}

/// Two frames, one of them wider than a chunk when `nodes` is large, and two series.
pub fn description(nodes: [usize; 2]) -> Description {
    let u = Quantity::new("u", "m/s");
    let grid = UniformGrid::rectangle([-0.1, 0.0], [1.1, 1.0 / 3.0], nodes);
    let fixed = FrameDescription {
        name: "fixed".into(),
        support: Support::Grid(grid),
        length_unit: "m".into(),
        components: vec![u.clone(), Quantity::new("v", "m/s")],
    };
    let reference = FrameDescription {
        name: "reference".into(),
        support: Support::Nodes(vec![[0.0, 0.0], [0.1 + 0.2, 0.0], [1.0, 0.0]]),
        length_unit: "1".into(),
        components: vec![u],
    };
    let angles = vec![Quantity::new("theta", "rad"), Quantity::new("phi", "rad")];
    let position = SeriesDescription { name: "position".into(), entries: angles };
    let load = SeriesDescription { name: "load".into(), entries: vec![Quantity::new("F", "N")] };
    Description {
        frames: vec![fixed, reference],
        series: vec![position, load],
        provenance: [("program".into(), "lumley 0.1.0".into()), ("case".into(), "a = 1\n".into())]
            .into(),
        gathered: None,
    }
}

pub fn time(k: usize) -> f64 {
    0.01 * k as f64
}

/// Entry `i` of vector `which` of snapshot `k`.
pub fn value(which: usize, i: usize, k: usize) -> f64 {
    (which as f64 + 1.3 * i as f64 + 0.7 * k as f64).sin()
}

/// The snapshots 0..count of vector `which`, in columns.
pub fn matrix(which: usize, rows: usize, count: usize) -> Mat<f64> {
    Mat::from_fn(rows, count, |i, k| value(which, i, k))
}

pub fn append(
    writer: &mut RecordWriter,
    description: &Description,
    range: std::ops::Range<usize>,
) -> Result<(), RecordError> {
    let series = description.series.iter().map(|series| series.entries.len());
    let lengths: Vec<usize> =
        series.chain(description.frames.iter().map(FrameDescription::rows)).collect();
    for k in range {
        let vectors: Vec<Vec<f64>> = lengths
            .iter()
            .enumerate()
            .map(|(which, &length)| (0..length).map(|i| value(which, i, k)).collect())
            .collect();
        let parts: Vec<&[f64]> = vectors.iter().map(Vec::as_slice).collect();
        let (series, fields) = parts.split_at(description.series.len());
        writer.append(&Snapshot { time: time(k), series, fields })?;
    }
    Ok(())
}

/// A record of `count` snapshots at `path`.
pub fn record(path: &Path, nodes: [usize; 2], count: usize) -> Result<Description, RecordError> {
    let description = description(nodes);
    let mut writer = RecordWriter::create(path, &description)?;
    append(&mut writer, &description, 0..count)?;
    writer.finish()?;
    Ok(description)
}

/// All files under `folder`, in order.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let entries = std::fs::read_dir(folder).expect("a folder of the test");
    for path in entries.map(|entry| entry.expect("a readable entry").path()) {
        if path.is_dir() { found.extend(files(&path)) } else { found.push(path) }
    }
    found.sort();
    found
}

/// A new file in the place of the old one: to cut and refill the old one makes some systems wait for the disk.
pub fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    if path.exists() {
        std::fs::remove_file(path)?;
    }
    std::fs::write(path, bytes)
}
