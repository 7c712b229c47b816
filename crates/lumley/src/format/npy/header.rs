use super::dtype::Dtype;
use crate::format::FormatError;
use crate::format::error::excerpt;
use crate::format::region::Region;

const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// Longest header that is read; NumPy itself stops at 10 000 bytes.
const LIMIT: u64 = 1 << 16;

/// Most axes that are read, as many as NumPy has.
const AXES: usize = 64;

/// What stands before the numbers of an NPY file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Header {
    pub dtype: Dtype,
    pub fortran_order: bool,
    pub shape: Vec<usize>,
    /// Where the numbers begin, in bytes.
    pub data: u64,
}

impl Header {
    /// Reads the header and checks that the file holds exactly what it claims.
    pub fn read(file: &Region) -> Result<Self, FormatError> {
        let (start, data) = extent(file)?;
        let mut text = vec![0; usize::try_from(data - start).expect("a short header")];
        file.read(start, &mut text)?;
        let mut parser = Parser { text: &text, at: 0 };
        let fields = parser.dictionary().map_err(|expected| FormatError::Bytes {
            path: file.path().to_owned(),
            offset: start + parser.at as u64,
            found: excerpt(&text[parser.at..]),
            expected,
        })?;
        let dtype = Dtype::parse(&fields.descr).ok_or_else(|| FormatError::Dtype {
            path: file.path().to_owned(),
            found: excerpt(fields.descr.as_bytes()),
        })?;
        let header = Self { dtype, fortran_order: fields.fortran_order, shape: fields.shape, data };
        header.check_size(file)?;
        Ok(header)
    }

    fn check_size(&self, file: &Region) -> Result<(), FormatError> {
        let claimed = self
            .shape
            .iter()
            .try_fold(self.dtype.size(), |product, &axis| product.checked_mul(axis))
            .map(|bytes| bytes as u64);
        let found = file.len() - self.data;
        let (path, shape) = (file.path().to_owned(), self.shape.clone());
        if shape.is_empty() || shape.contains(&0) {
            return Err(FormatError::Shape { path, shape, expected: "one with numbers in it" });
        }
        if claimed != Some(found) {
            return Err(FormatError::Size { path, shape, item: self.dtype.size(), found });
        }
        Ok(())
    }
}

/// Where the header's text begins and ends.
fn extent(file: &Region) -> Result<(u64, u64), FormatError> {
    let mut first = [0; 12];
    let known = usize::try_from(file.len()).map_or(12, |len| len.min(12));
    file.read(0, &mut first[..known])?;
    let wrong = |offset: usize, expected| FormatError::Bytes {
        path: file.path().to_owned(),
        offset: offset as u64,
        found: excerpt(&first[offset..known.max(offset)]),
        expected,
    };
    if known < 12 || &first[..6] != MAGIC {
        return Err(wrong(0, "an NPY file, which begins with \\x93NUMPY"));
    }
    let [.., a, b, c, d] = first;
    let (start, length) = match first[6..8] {
        [1, 0] => (10, u64::from(u16::from_le_bytes([a, b]))),
        [2 | 3, 0] => (12, u64::from(u32::from_le_bytes([a, b, c, d]))),
        _ => return Err(wrong(6, "NPY version 1.0, 2.0 or 3.0")),
    };
    if length > LIMIT || start + length > file.len() {
        return Err(wrong(8, "the length of a header that lies within the file"));
    }
    Ok((start, start + length))
}

struct Fields {
    descr: String,
    fortran_order: bool,
    shape: Vec<usize>,
}

/// Reads the Python dictionary `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }`.
///
/// Each method returns what was expected when it is not there; `at` is then the place.
struct Parser<'a> {
    text: &'a [u8],
    at: usize,
}

impl Parser<'_> {
    fn dictionary(&mut self) -> Result<Fields, &'static str> {
        let (mut descr, mut fortran_order, mut shape) = (None, None, None);
        self.expect(b'{', "a dictionary")?;
        while !self.accept(b'}') {
            let begin = self.at;
            let key = self.string()?;
            self.expect(b':', "a colon")?;
            let fresh = match key.as_str() {
                "descr" => descr.replace(self.string()?).is_none(),
                "fortran_order" => fortran_order.replace(self.boolean()?).is_none(),
                "shape" => shape.replace(self.tuple()?).is_none(),
                _ => false,
            };
            if !fresh {
                self.at = begin;
                return Err("the keys descr, fortran_order and shape, each once");
            }
            if !self.accept(b',') {
                self.expect(b'}', "a comma or the end of the dictionary")?;
                break;
            }
        }
        self.skip_blanks();
        if self.at < self.text.len() {
            return Err("nothing after the dictionary");
        }
        match (descr, fortran_order, shape) {
            (Some(descr), Some(fortran_order), Some(shape)) => {
                Ok(Fields { descr, fortran_order, shape })
            }
            _ => Err("the keys descr, fortran_order and shape"),
        }
    }

    fn string(&mut self) -> Result<String, &'static str> {
        self.skip_blanks();
        let quote = *self.text.get(self.at).filter(|c| b"'\"".contains(c)).ok_or("a string")?;
        let rest = &self.text[self.at + 1..];
        let length = rest.iter().position(|&c| c == quote).ok_or("a string that ends")?;
        self.at += length + 2;
        Ok(String::from_utf8_lossy(&rest[..length]).into_owned())
    }

    fn boolean(&mut self) -> Result<bool, &'static str> {
        self.skip_blanks();
        for (word, value) in [("True", true), ("False", false)] {
            if self.text[self.at..].starts_with(word.as_bytes()) {
                self.at += word.len();
                return Ok(value);
            }
        }
        Err("True or False")
    }

    fn tuple(&mut self) -> Result<Vec<usize>, &'static str> {
        let mut axes = Vec::new();
        self.expect(b'(', "a tuple of sizes")?;
        while !self.accept(b')') {
            if axes.len() == AXES {
                return Err("a tuple of at most 64 sizes");
            }
            axes.push(self.integer()?);
            if !self.accept(b',') {
                self.expect(b')', "a comma or the end of the tuple")?;
                break;
            }
        }
        Ok(axes)
    }

    fn integer(&mut self) -> Result<usize, &'static str> {
        self.skip_blanks();
        let digits = self.text[self.at..].iter().take_while(|c| c.is_ascii_digit()).count();
        let text = str::from_utf8(&self.text[self.at..self.at + digits]).unwrap_or_default();
        let value = text.parse().map_err(|_| "a size that is an integer below 2^64")?;
        self.at += digits;
        Ok(value)
    }

    fn skip_blanks(&mut self) {
        let blanks = self.text[self.at..].iter().take_while(|c| b" \t\r\n".contains(c));
        self.at += blanks.count();
    }

    fn accept(&mut self, c: u8) -> bool {
        self.skip_blanks();
        let found = self.text.get(self.at) == Some(&c);
        self.at += usize::from(found);
        found
    }

    fn expect(&mut self, c: u8, expected: &'static str) -> Result<(), &'static str> {
        if self.accept(c) { Ok(()) } else { Err(expected) }
    }
}
