//! What is written is parsed again: markup, places and bytes. VTK's own view is in `python/check_vtu.py`.

use super::{Collection, Frame, Values, VtuWriter};
use crate::format::{FormatError, atomic};
use crate::report::wellformed::{Element, elements};
use lumley_fem::space::NodalSpace;
use lumley_fem::{MeshDescription, PlanarMesh, Point};
use std::fs;
use std::path::Path;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A mesh of both kinds of cells, with what a frame needs.
struct Ground {
    space: NodalSpace,
    points: Vec<Point>,
    heat: Vec<f64>,
    areas: Vec<f64>,
}

impl Ground {
    fn new(cells: usize) -> Self {
        let bend = |[x, y]: Point| [x + 0.2 * y * y, y - 0.1 * x * x];
        let description =
            MeshDescription::structured([cells, cells], |[i, j]| (i + j) % 2 == 0, bend);
        let mesh = PlanarMesh::new(description).expect("valid");
        let space = NodalSpace::velocity(mesh.topology());
        let points = space.points(&mesh);
        let heat = points.iter().map(|[x, y]| x - y / 3.0).collect();
        let areas = mesh.cell_qualities().iter().map(|cell| cell.area).collect();
        Self { space, points, heat, areas }
    }

    fn write(&self, path: &Path) -> Result<(), FormatError> {
        let fields =
            [("velocity", Values::Vectors(&self.points)), ("heat", Values::Scalars(&self.heat))];
        let cells = [("area", Values::Scalars(&self.areas))];
        let frame =
            Frame { time: 0.1, points: &self.points, point_fields: &fields, cell_fields: &cells };
        VtuWriter::new(&self.space).write(path, &frame)
    }
}

/// The elements of a file and its appended data.
struct Parsed {
    elements: Vec<Element>,
    data: Vec<u8>,
}

impl Parsed {
    fn of(bytes: &[u8]) -> Self {
        const TAIL: &[u8] = b"\n</AppendedData>\n</VTKFile>\n";
        let start = bytes.windows(2).position(|two| two == b"\n_").expect("appended data") + 2;
        let data = bytes[start..].strip_suffix(TAIL).expect("the end").to_vec();
        let markup = [&bytes[..start], TAIL].concat();
        let markup = String::from_utf8(markup).expect("text");
        Self { elements: elements(&markup).expect("well-formed"), data }
    }

    fn attribute<'a>(element: &'a Element, key: &str) -> Option<&'a str> {
        element.attributes.iter().find(|(k, _)| k == key).map(|(_, value)| value.as_str())
    }

    /// Type and bytes of an array.
    fn array(&self, name: &str) -> (&str, &[u8]) {
        let named = |e: &&Element| Self::attribute(e, "Name") == Some(name);
        let element = self.elements.iter().find(named).expect(name);
        let offset: usize =
            Self::attribute(element, "offset").expect("a place").parse().expect("a number");
        let (length, rest) = self.data[offset..].split_at(8);
        let length = u64::from_le_bytes(length.try_into().expect("eight bytes"));
        let length = usize::try_from(length).expect("short");
        (Self::attribute(element, "type").expect("a type"), &rest[..length])
    }

    fn numbers(&self, name: &str) -> Vec<f64> {
        let (kind, bytes) = self.array(name);
        assert_eq!(kind, "Float64");
        bytes.as_chunks().0.iter().map(|number| f64::from_le_bytes(*number)).collect()
    }

    fn integers(&self, name: &str) -> Vec<usize> {
        let (kind, bytes) = self.array(name);
        assert_eq!(kind, "Int64");
        let number =
            |bytes: &[u8; 8]| usize::try_from(i64::from_le_bytes(*bytes)).expect("positive");
        bytes.as_chunks().0.iter().map(number).collect()
    }
}

fn in_space(vectors: &[Point]) -> Vec<f64> {
    vectors.iter().flat_map(|[x, y]| [*x, *y, 0.0]).collect()
}

#[test]
fn what_is_parsed_is_what_was_written() -> Outcome {
    let (folder, ground) = (tempfile::tempdir()?, Ground::new(3));
    let path = folder.path().join("flow.vtu");
    ground.write(&path)?;
    let parsed = Parsed::of(&fs::read(&path)?);
    assert_eq!(parsed.numbers("points"), in_space(&ground.points));
    assert_eq!(parsed.numbers("velocity"), in_space(&ground.points));
    assert_eq!(parsed.numbers("heat"), ground.heat);
    assert_eq!(parsed.numbers("area"), ground.areas);
    let (dofs, cells) = (ground.space.dofs(), ground.areas.len());
    let (nodes, ends) = (parsed.integers("connectivity"), parsed.integers("offsets"));
    let (kind, types) = parsed.array("types");
    assert_eq!((kind, types.len(), ends.len()), ("UInt8", cells, cells));
    for cell in 0..cells {
        let start = if cell == 0 { 0 } else { ends[cell - 1] };
        assert_eq!(nodes[start..ends[cell]], *dofs.cell(cell), "cell {cell}");
        assert_eq!(types[cell], if dofs.cell(cell).len() == 7 { 34 } else { 28 });
    }
    let piece = parsed.elements.iter().find(|e| e.tag == "Piece").expect("a piece");
    assert_eq!(Parsed::attribute(piece, "NumberOfPoints"), Some(&*dofs.len().to_string()));
    assert_eq!(Parsed::attribute(piece, "NumberOfCells"), Some(&*cells.to_string()));
    Ok(())
}

/// The arrays follow each other without gaps, up to the end.
#[test]
fn arrays_fill_the_appended_data() -> Outcome {
    let (folder, ground) = (tempfile::tempdir()?, Ground::new(3));
    let path = folder.path().join("flow.vtu");
    ground.write(&path)?;
    let parsed = Parsed::of(&fs::read(&path)?);
    let mut end = 0;
    for element in parsed.elements.iter().filter(|e| e.tag == "DataArray") {
        let Some(offset) = Parsed::attribute(element, "offset") else { continue };
        assert_eq!(offset, end.to_string());
        end += 8 + parsed.array(Parsed::attribute(element, "Name").expect("a name")).1.len();
    }
    assert_eq!(end, parsed.data.len());
    Ok(())
}

#[test]
fn what_is_not_finite_is_refused_and_the_older_file_stands() -> Outcome {
    let (folder, mut ground) = (tempfile::tempdir()?, Ground::new(2));
    let path = folder.path().join("flow.vtu");
    ground.write(&path)?;
    let before = fs::read(&path)?;
    ground.heat[5] = f64::NAN;
    let error = ground.write(&path).expect_err("refused");
    assert!(
        matches!(&error, FormatError::NotFinite { field, place: 5, .. } if field == "heat"),
        "{error}"
    );
    ground.points[3][1] = f64::INFINITY;
    let error = ground.write(&path).expect_err("refused").to_string();
    assert!(error.contains("value 3 of points is inf") && error.contains("help: "), "{error}");
    assert_eq!(fs::read(&path)?, before);
    assert_eq!(fs::read_dir(folder.path())?.count(), 1);
    Ok(())
}

#[test]
fn a_series_is_well_formed_and_resumes_bit_for_bit() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("flow.pvd");
    let mut series = Collection::resume(&path, f64::INFINITY)?;
    assert!(series.entries().is_empty(), "there is no file yet");
    let times = [0.1, 0.1 + 0.2, 1e-9 + 7.0, 1e20];
    for (k, time) in times.into_iter().enumerate() {
        series.push(time, &format!("frames/flow-{k}.vtu"))?;
    }
    let text = fs::read_to_string(&path)?;
    let found = elements(&text)?;
    assert_eq!(found.iter().filter(|e| e.tag == "DataSet").count(), times.len());
    assert_eq!(Collection::resume(&path, f64::INFINITY)?, series);
    let mut resumed = Collection::resume(&path, times[2])?;
    assert_eq!(resumed.entries(), &series.entries()[..3]);
    resumed.push(times[3], "frames/flow-3.vtu")?;
    assert_eq!(fs::read_to_string(&path)?, text, "the same file as without the interruption");
    let error = resumed.push(times[3], "again.vtu").expect_err("not later");
    assert!(matches!(error, FormatError::TimeOrder { snapshot: 4, .. }), "{error}");
    assert!(resumed.push(f64::NAN, "nan.vtu").is_err());
    Ok(())
}

#[test]
fn a_damaged_series_is_refused_with_its_line() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("flow.pvd");
    let mut series = Collection::new(&path);
    series.push(0.5, "a.vtu")?;
    series.push(1.5, "b.vtu")?;
    let text = fs::read_to_string(&path)?;
    for (from, to, wrong) in [
        ("Collection\"", "Collation\"", 1),
        ("timestep=\"0.5\"", "timestep=\"0,5\"", 3),
        ("timestep=\"0.5\"", "timestep=\"NaN\"", 3),
        ("timestep=\"1.5\"", "timestep=\"0.25\"", 4),
        ("b.vtu", "b<vtu", 4),
        ("</VTKFile>\n", "", 5),
    ] {
        fs::write(&path, text.replace(from, to))?;
        let error = Collection::resume(&path, 9.0).expect_err(to);
        assert!(matches!(error, FormatError::Line { line, .. } if line == wrong), "{error}");
    }
    Ok(())
}

/// Tells the test that a process runs under a limit what to do where.
const FOLDER: &str = "LUMLEY_TEST_FOLDER";

/// Not a test of its own: what the next one starts.
#[test]
fn under_a_limit() {
    if let Some(folder) = std::env::var_os(FOLDER) {
        let path = Path::new(&folder).join("flow.vtu");
        let error = Ground::new(20).write(&path).expect_err("a full disk");
        eprintln!("error: {error}");
    }
}

/// A limit on the size of files stands for a full disk: every write beyond it fails.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said_and_leaves_nothing_half() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("flow.vtu");
    atomic::write(&path, b"the frame before")?;
    let run = "exec \"$0\" --exact format::vtu::tests::under_a_limit --nocapture";
    let limited = format!("trap '' XFSZ; ulimit -f 64; {run}");
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", &limited]).arg(std::env::current_exe()?).env(FOLDER, folder.path());
    let output = shell.output()?;
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("cannot write") && said.contains("flow.vtu"), "{said}");
    assert_eq!(fs::read(&path)?, b"the frame before");
    assert_eq!(fs::read_dir(folder.path())?.count(), 1);
    Ok(())
}
