use crate::format::FormatError;
use crate::format::error::excerpt;
use std::path::Path;

/// A place in a file that is read from its beginning to its end; numbers are text or binary.
pub(super) struct Cursor<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    at: usize,
    /// How numbers in the body of a section are stored.
    pub encoding: Encoding,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Binary { big_endian: bool },
}

impl<'a> Cursor<'a> {
    pub fn new(path: &'a Path, bytes: &'a [u8]) -> Self {
        Self { path, bytes, at: 0, encoding: Encoding::Text }
    }

    /// Bytes from here to the end.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The error that something else stands at `place`.
    fn wrong_at(&self, place: usize, expected: &'static str) -> FormatError {
        let path = self.path.to_owned();
        let rest = &self.bytes[place.min(self.bytes.len())..];
        if self.encoding == Encoding::Text {
            let line = self.bytes[..place].split(|&byte| byte == b'\n').count();
            let end = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
            let text = String::from_utf8_lossy(&rest[..end.min(60)]).into_owned();
            FormatError::Line { path, line, text, expected: expected.to_owned() }
        } else {
            FormatError::Bytes { path, offset: place as u64, found: excerpt(rest), expected }
        }
    }

    /// The error that something else stands here.
    pub fn wrong(&self, expected: &'static str) -> FormatError {
        self.wrong_at(self.at, expected)
    }

    fn skip_blanks(&mut self) {
        let blanks = self.bytes[self.at..].iter().take_while(|byte| byte.is_ascii_whitespace());
        self.at += blanks.count();
    }

    fn is_at_end(&mut self) -> bool {
        self.skip_blanks();
        self.left() == 0
    }

    /// The name of the section that begins here, without its `$`; none at the end of the file.
    pub fn section(&mut self) -> Result<Option<&'a str>, FormatError> {
        if self.is_at_end() {
            return Ok(None);
        }
        let begin = self.at;
        let word = self.word();
        let name = word.strip_prefix(b"$").and_then(|name| str::from_utf8(name).ok());
        let name = name.filter(|name| !name.is_empty() && !name.starts_with("End"));
        self.skip_line_end();
        name.map(Some).ok_or_else(|| self.wrong_at(begin, "a section, for example $Nodes"))
    }

    /// Passes the line `$EndNAME`.
    pub fn end(&mut self, name: &str) -> Result<(), FormatError> {
        self.skip_blanks();
        let begin = self.at;
        let word = self.word();
        if word.strip_prefix(b"$End") == Some(name.as_bytes()) {
            return Ok(());
        }
        Err(self.wrong_at(begin, "the end of the section"))
    }

    /// Passes all that stands before the line `$EndNAME`, and that line.
    pub fn skip(&mut self, name: &str) -> Result<(), FormatError> {
        let begin = self.at;
        let end = format!("$End{name}").into_bytes();
        let rest = &self.bytes[begin..];
        let mut dollars = (0..rest.len()).filter(|&k| rest[k] == b'$');
        let place = dollars.find(|&k| rest[k..].starts_with(&end));
        let place = place.ok_or_else(|| self.wrong_at(begin, "a section that ends"))?;
        self.at = begin + place;
        self.end(name)
    }

    /// What stands before the next blank.
    fn word(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// Passes the end of the line: binary numbers begin right behind it.
    pub fn skip_line_end(&mut self) {
        let rest = &self.bytes[self.at..];
        let blanks = rest.iter().take_while(|byte| b" \t\r".contains(byte)).count();
        self.at += if rest.get(blanks) == Some(&b'\n') { blanks + 1 } else { 0 };
    }

    /// A name in quotes, on one line.
    pub fn quoted(&mut self) -> Result<String, FormatError> {
        self.skip_blanks();
        let wrong = |cursor: &Self| cursor.wrong("a name in quotes");
        let rest = self.bytes[self.at..].strip_prefix(b"\"").ok_or_else(|| wrong(self))?;
        let length = rest.iter().position(|byte| b"\"\n".contains(byte));
        let length = length.filter(|&end| rest[end] == b'"').ok_or_else(|| wrong(self))?;
        let name = str::from_utf8(&rest[..length]).map_err(|_| wrong(self))?;
        self.at += length + 2;
        Ok(name.to_owned())
    }

    /// A number that is text in every file.
    pub fn text<T: std::str::FromStr>(&mut self, expected: &'static str) -> Result<T, FormatError> {
        self.skip_blanks();
        let begin = self.at;
        let word = str::from_utf8(self.word()).unwrap_or_default();
        word.parse().map_err(|_| self.wrong_at(begin, expected))
    }

    /// The next bytes of a binary file, the lowest first.
    fn binary<const N: usize>(
        &mut self,
        big_endian: bool,
        expected: &'static str,
    ) -> Result<[u8; N], FormatError> {
        let rest = &self.bytes[self.at..];
        let mut bytes = *rest.first_chunk::<N>().ok_or_else(|| self.wrong(expected))?;
        if big_endian {
            bytes.reverse();
        }
        self.at += N;
        Ok(bytes)
    }

    /// An integer of 32 bits.
    pub fn integer(&mut self, expected: &'static str) -> Result<i32, FormatError> {
        match self.encoding {
            Encoding::Text => self.text(expected),
            Encoding::Binary { big_endian } => {
                Ok(i32::from_le_bytes(self.binary(big_endian, expected)?))
            }
        }
    }

    /// An integer of 64 bits that is not negative.
    pub fn size(&mut self, expected: &'static str) -> Result<u64, FormatError> {
        match self.encoding {
            Encoding::Text => self.text(expected),
            Encoding::Binary { big_endian } => {
                Ok(u64::from_le_bytes(self.binary(big_endian, expected)?))
            }
        }
    }

    /// A finite number.
    pub fn float(&mut self, expected: &'static str) -> Result<f64, FormatError> {
        let begin = self.at;
        let value = match self.encoding {
            Encoding::Text => self.text(expected)?,
            Encoding::Binary { big_endian } => {
                f64::from_le_bytes(self.binary(big_endian, expected)?)
            }
        };
        if value.is_finite() { Ok(value) } else { Err(self.wrong_at(begin, expected)) }
    }

    /// Whether `count` things of at least so many bytes, in text and in binary files, can still stand here.
    pub fn check_room(&self, count: u64, text: u64, binary: u64) -> Result<usize, FormatError> {
        let each = if self.encoding == Encoding::Text { text } else { binary };
        // The last number of a text needs no blank behind it.
        let room = count.checked_mul(each).is_some_and(|bytes| bytes <= self.left() as u64 + 1);
        let count = usize::try_from(count).ok().filter(|_| room);
        count.ok_or_else(|| {
            self.wrong_at(self.at, "as much as the number before this place promises")
        })
    }
}
