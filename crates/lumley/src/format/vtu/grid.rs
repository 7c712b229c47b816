use super::Values;
use super::array::Array;
use crate::format::FormatError;
use crate::format::atomic::AtomicFile;
use lumley_fem::Point;
use lumley_fem::space::NodalSpace;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// VTK's numbers of the cells.
const BIQUADRATIC_TRIANGLE: u8 = 34;
const BIQUADRATIC_QUAD: u8 = 28;

/// Bytes that are handed to the system at a time.
const BUFFER: usize = 1 << 16;

/// What the flow is at an instant.
///
/// ```
/// use lumley::format::vtu::{Frame, Values};
/// let points = [[0.0, 0.0], [1.0, 0.0]];
/// let heat = [293.0, 294.0];
/// let fields = [("temperature", Values::Scalars(&heat))];
/// let frame = Frame { time: 0.5, points: &points, point_fields: &fields, cell_fields: &[] };
/// assert_eq!(frame.points.len(), frame.point_fields[0].1.len());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame<'a> {
    /// Time, in s.
    pub time: f64,
    /// Where the dofs of the velocity are, in m.
    pub points: &'a [Point],
    /// Fields by their names, with a value for each point.
    pub point_fields: &'a [(&'a str, Values<'a>)],
    /// Fields by their names, with a value for each cell.
    pub cell_fields: &'a [(&'a str, Values<'a>)],
}

/// Writes frames on a mesh whose nodes may move: which points a cell has is prepared once.
///
/// Numbers are stored as they are: raw, little-endian, 64 bits. For a series in time see
/// [`Collection`](super::Collection).
///
/// ```
/// use lumley::format::vtu::{Frame, Values, VtuWriter};
/// use lumley_fem::{MeshDescription, PlanarMesh, space::NodalSpace};
/// let mesh = PlanarMesh::new(MeshDescription::structured([2, 1], |[i, _]| i == 1, |p| p))?;
/// let space = NodalSpace::velocity(mesh.topology());
/// let points = space.points(&mesh);
/// let fields = [("velocity", Values::Vectors(&points))];
/// let frame = Frame { time: 0.0, points: &points, point_fields: &fields, cell_fields: &[] };
/// let folder = tempfile::tempdir()?;
/// VtuWriter::new(&space).write(&folder.path().join("flow.vtu"), &frame)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct VtuWriter {
    points: usize,
    cells: usize,
    connectivity: Vec<u8>,
    ends: Vec<u8>,
    types: Vec<u8>,
}

impl VtuWriter {
    /// For fields on a space made by [`NodalSpace::velocity`].
    ///
    /// # Panics
    /// If the space has not seven dofs on a triangle and nine on a quadrilateral.
    pub fn new(space: &NodalSpace) -> Self {
        let dofs = space.dofs();
        let (triangles, quadrilaterals) = (dofs.triangles::<7>(), dofs.quadrilaterals::<9>());
        let cells = triangles.len() + quadrilaterals.len();
        let lengths = (0..cells).map(|cell| if cell < triangles.len() { 7 } else { 9 });
        let ends = lengths.scan(0, |end, length| {
            *end += length;
            Some(*end)
        });
        let nodes = triangles.as_flattened().iter().chain(quadrilaterals.as_flattened());
        let mut types = vec![BIQUADRATIC_TRIANGLE; triangles.len()];
        types.resize(cells, BIQUADRATIC_QUAD);
        Self {
            points: dofs.len(),
            cells,
            connectivity: integers(nodes.copied()),
            ends: integers(ends),
            types,
        }
    }

    /// Writes a frame as the whole content of `path`.
    ///
    /// # Errors
    /// [`FormatError::NotFinite`], and then nothing is written; [`FormatError::Io`], for example on a full
    /// disk. In both cases an older file stands as it was.
    ///
    /// # Panics
    /// If there is not one value for each point or cell, or a name is not made of letters, digits and `_`.
    pub fn write(&self, path: &Path, frame: &Frame<'_>) -> Result<(), FormatError> {
        let sections = self.sections(frame);
        self.check(path, frame)?;
        let write = || -> io::Result<()> {
            let mut file = BufWriter::with_capacity(BUFFER, AtomicFile::create(path)?);
            self.write_to(&mut file, frame.time, &sections)?;
            file.into_inner().map_err(io::IntoInnerError::into_error)?.commit()
        };
        write().map_err(FormatError::io("write", path))
    }

    /// The arrays of the file in their order, under the names that VTK has for their groups.
    fn sections<'a>(&'a self, frame: &Frame<'a>) -> [(&'static str, Vec<Array<'a>>); 4] {
        let fields = |fields: &'a [(&'a str, Values<'a>)]| {
            fields.iter().map(|&(name, values)| Array::Numbers(name, values)).collect()
        };
        [
            ("PointData", fields(frame.point_fields)),
            ("CellData", fields(frame.cell_fields)),
            ("Points", vec![Array::Numbers("points", Values::Vectors(frame.points))]),
            (
                "Cells",
                vec![
                    Array::Constant("connectivity", "Int64", &self.connectivity),
                    Array::Constant("offsets", "Int64", &self.ends),
                    Array::Constant("types", "UInt8", &self.types),
                ],
            ),
        ]
    }

    /// Everything has its number of values, and all are finite.
    fn check(&self, path: &Path, frame: &Frame<'_>) -> Result<(), FormatError> {
        let time = [frame.time];
        let (time, points) = (("time", Values::Scalars(&time)), Values::Vectors(frame.points));
        check_values(path, time, 1)?;
        check_values(path, ("points", points), self.points)?;
        for (fields, count) in [(frame.point_fields, self.points), (frame.cell_fields, self.cells)]
        {
            fields.iter().try_for_each(|&field| check_values(path, field, count))?;
        }
        Ok(())
    }

    fn write_to(
        &self,
        out: &mut impl Write,
        time: f64,
        sections: &[(&str, Vec<Array<'_>>)],
    ) -> io::Result<()> {
        let Self { points, cells, .. } = self;
        write!(
            out,
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\">\n\
             <UnstructuredGrid>\n\
             <FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
             format=\"ascii\">{time:?}</DataArray>\n</FieldData>\n\
             <Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n"
        )?;
        let mut offset = 0;
        for (section, arrays) in sections {
            writeln!(out, "<{section}>")?;
            for array in arrays {
                array.declare(offset, out)?;
                offset += array.size();
            }
            writeln!(out, "</{section}>")?;
        }
        write!(out, "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")?;
        let mut arrays = sections.iter().flat_map(|(_, arrays)| arrays);
        arrays.try_for_each(|array| array.append(out))?;
        writeln!(out, "\n</AppendedData>\n</VTKFile>")
    }
}

fn check_values(
    path: &Path,
    (name, values): (&str, Values<'_>),
    count: usize,
) -> Result<(), FormatError> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    assert!(name.chars().all(plain), "{name:?}: a name of letters, digits and _");
    assert_eq!(values.len(), count, "values of {name}");
    values.not_finite().map_or(Ok(()), |(place, value)| {
        Err(FormatError::NotFinite { path: path.to_owned(), field: name.to_owned(), place, value })
    })
}

/// As VTK's Int64.
fn integers(values: impl Iterator<Item = usize>) -> Vec<u8> {
    values.flat_map(|value| (value as u64).to_le_bytes()).collect()
}
