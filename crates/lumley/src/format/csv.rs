//! Tables of numbers as text, separated by commas.

use super::FormatError;
use super::atomic::AtomicFile;
use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Read, Write};
use std::path::Path;

/// Longest table that is read, in bytes.
const LIMIT: u64 = 1 << 26;

/// Reads a table of a first column and N others, say t in s, u and v in m/s.
///
/// Empty lines and what follows `#` are skipped; one header line may come first, told by a first column
/// that is not a number. The first column must increase.
///
/// # Errors
/// [`FormatError`], naming the file, the line and its text.
pub fn read_rows<const N: usize>(path: &Path) -> Result<Vec<(f64, [f64; N])>, FormatError> {
    let text = read_text(path)?;
    let wrong = |line: usize, text: &str, expected: String| FormatError::Line {
        path: path.to_owned(),
        line,
        text: text.chars().take(60).collect(),
        expected,
    };
    let mut rows: Vec<(f64, [f64; N])> = Vec::new();
    let mut header_allowed = true;
    for (number, line) in (1..).zip(text.lines()) {
        let content = line.split('#').next().unwrap_or_default().trim();
        let is_header = header_allowed && is_header(content);
        header_allowed &= content.is_empty();
        if content.is_empty() || is_header {
            continue;
        }
        let numbers = || format!("{} finite numbers separated by commas", N + 1);
        let (x, values) = row(content).ok_or_else(|| wrong(number, line, numbers()))?;
        if rows.last().is_some_and(|&(previous, _)| x <= previous) {
            let increasing = "a first column that increases from line to line";
            return Err(wrong(number, line, increasing.into()));
        }
        rows.push((x, values));
    }
    if rows.is_empty() {
        let last = text.lines().count().max(1);
        return Err(wrong(last, "", "at least one line of numbers".into()));
    }
    Ok(rows)
}

/// Reads those columns of a table that are `wanted` by their headers, which stand in the first line; the table
/// may be longer than fits into memory.
///
/// # Errors
/// [`FormatError`], naming the file, the line and its text.
pub fn read_columns(
    path: &Path,
    wanted: impl Fn(&str) -> bool,
) -> Result<Vec<(String, Vec<f64>)>, FormatError> {
    let file = File::open(path).map_err(FormatError::io("open", path))?;
    let mut lines = BufReader::new(file).lines();
    let headers = lines.next().transpose().map_err(FormatError::io("read", path))?;
    let headers = headers.unwrap_or_default();
    let headers: Vec<&str> = headers.split(',').map(str::trim).collect();
    let places: Vec<usize> = (0..headers.len()).filter(|&k| wanted(headers[k])).collect();
    let mut columns: Vec<(String, Vec<f64>)> =
        places.iter().map(|&k| (headers[k].to_owned(), Vec::new())).collect();
    for (number, line) in (2..).zip(lines) {
        let line = line.map_err(FormatError::io("read", path))?;
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        for ((_, column), &k) in columns.iter_mut().zip(&places) {
            let value = cells.get(k).and_then(|cell| cell.parse().ok());
            let whole = value.filter(|_| cells.len() == headers.len());
            column.push(whole.ok_or_else(|| FormatError::Line {
                path: path.to_owned(),
                line: number,
                text: line.chars().take(60).collect(),
                expected: "one number for each header".into(),
            })?);
        }
    }
    Ok(columns)
}

/// Writes columns of equal length under their headers; numbers are read back bit for bit.
///
/// # Errors
/// [`FormatError::Io`]; an older file then stands as it was.
///
/// # Panics
/// If the columns differ in length or a header holds a comma, a quote or a line break.
pub fn write_columns(path: &Path, columns: &[(&str, &[f64])]) -> Result<(), FormatError> {
    let write = || -> io::Result<()> {
        let mut file = BufWriter::new(AtomicFile::create(path)?);
        write_table(&mut file, columns)?;
        file.into_inner().map_err(io::IntoInnerError::into_error)?.commit()
    };
    write().map_err(FormatError::io("write", path))
}

fn write_table(out: &mut impl Write, columns: &[(&str, &[f64])]) -> io::Result<()> {
    let rows = columns.first().map_or(0, |(_, values)| values.len());
    for (header, values) in columns {
        assert_eq!(values.len(), rows, "columns of equal length");
        assert!(!header.contains([',', '"', '\n', '\r']), "a header without separators");
    }
    let headers: Vec<&str> = columns.iter().map(|(header, _)| *header).collect();
    writeln!(out, "{}", headers.join(","))?;
    for row in 0..rows {
        let cells: Vec<String> =
            columns.iter().map(|(_, values)| values[row].to_string()).collect();
        writeln!(out, "{}", cells.join(","))?;
    }
    Ok(())
}

fn read_text(path: &Path) -> Result<String, FormatError> {
    let mut text = String::new();
    let file = File::open(path).map_err(FormatError::io("open", path))?;
    let read = file.take(LIMIT + 1).read_to_string(&mut text);
    if read.map_err(FormatError::io("read", path))? as u64 > LIMIT {
        return Err(FormatError::LongTable { path: path.to_owned(), limit: LIMIT });
    }
    Ok(text)
}

/// "x, u" is a header; "nan, 1" and "1 2" are mistakes.
fn is_header(line: &str) -> bool {
    let first = line.split(',').next().unwrap_or_default().trim();
    first.starts_with(|c: char| c.is_alphabetic() || c == '"') && first.parse::<f64>().is_err()
}

/// The numbers of a line, if they are as many as there should be and all finite.
fn row<const N: usize>(line: &str) -> Option<(f64, [f64; N])> {
    let mut cells = line.split(',');
    let mut next = || cells.next()?.trim().parse().ok().filter(|value: &f64| value.is_finite());
    let first = next()?;
    let mut values = [0.0; N];
    for value in &mut values {
        *value = next()?;
    }
    cells.next().is_none().then_some((first, values))
}

#[cfg(test)]
mod tests {
    use super::{read_rows, write_columns};
    use crate::format::FormatError;

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    #[test]
    fn comments_header_and_blanks_are_skipped() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("u.csv");
        std::fs::write(&path, "# flow\n\nx [m], u\r\n 0, -1.5e-3 # wall\n0.5 ,2\n")?;
        assert_eq!(read_rows(&path)?, [(0.0, [-1.5e-3]), (0.5, [2.0])]);
        Ok(())
    }

    #[test]
    fn wrong_lines_are_named() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("u.csv");
        for (text, wrong) in [
            ("0,1\n1 2\n", 2),
            ("x,u\n0,1\nx,u\n", 3),
            ("0,1\n1,nan\n", 2),
            ("nan,1\n", 1),
            ("0,1,2\n", 1),
            ("0,1\n0,2\n", 2),
            ("1,1e999\n", 1),
            ("# nothing\n", 1),
            ("", 1),
        ] {
            std::fs::write(&path, text)?;
            let error = read_rows::<1>(&path).expect_err(text);
            assert!(matches!(error, FormatError::Line { line, .. } if line == wrong), "{error}");
        }
        std::fs::write(&path, b"0,\xFF\n")?;
        assert!(matches!(read_rows::<1>(&path), Err(FormatError::Io { .. })));
        Ok(())
    }

    #[test]
    fn columns_are_read_back_bit_for_bit() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("x.csv");
        let (x, u) = ([0.1, 0.1 + 0.2], [-0.0, f64::MIN_POSITIVE]);
        write_columns(&path, &[("x", &x), ("u", &u)])?;
        let read = read_rows(&path)?;
        let bits = |(x, [u]): (f64, [f64; 1])| [x.to_bits(), u.to_bits()];
        let written = x.into_iter().zip(u.map(|u| [u])).map(bits).collect::<Vec<_>>();
        assert_eq!(read.into_iter().map(bits).collect::<Vec<_>>(), written);
        Ok(())
    }
}
