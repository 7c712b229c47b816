/// How a number is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Dtype {
    kind: Kind,
    big_endian: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    F4,
    F8,
    I1,
    I2,
    I4,
    I8,
    U1,
    U2,
    U4,
    U8,
}

impl Dtype {
    /// The type that NumPy calls `descr`, for example `<f8`, if it is one that is read.
    pub fn parse(descr: &str) -> Option<Self> {
        let (order, name) = descr.split_at_checked(1)?;
        let kind = match name {
            "f4" => Kind::F4,
            "f8" => Kind::F8,
            "i1" => Kind::I1,
            "i2" => Kind::I2,
            "i4" => Kind::I4,
            "i8" => Kind::I8,
            "u1" => Kind::U1,
            "u2" => Kind::U2,
            "u4" => Kind::U4,
            "u8" => Kind::U8,
            _ => return None,
        };
        match order {
            "<" | ">" => Some(Self { kind, big_endian: order == ">" }),
            "|" if matches!(kind, Kind::I1 | Kind::U1) => Some(Self { kind, big_endian: false }),
            _ => None,
        }
    }

    /// Bytes a number.
    pub fn size(self) -> usize {
        match self.kind {
            Kind::I1 | Kind::U1 => 1,
            Kind::I2 | Kind::U2 => 2,
            Kind::F4 | Kind::I4 | Kind::U4 => 4,
            Kind::F8 | Kind::I8 | Kind::U8 => 8,
        }
    }

    /// NumPy's name, without the byte order.
    pub fn name(self) -> &'static str {
        match self.kind {
            Kind::F4 => "f4",
            Kind::F8 => "f8",
            Kind::I1 => "i1",
            Kind::I2 => "i2",
            Kind::I4 => "i4",
            Kind::I8 => "i8",
            Kind::U1 => "u1",
            Kind::U2 => "u2",
            Kind::U4 => "u4",
            Kind::U8 => "u8",
        }
    }

    /// Every `step`-th of the numbers in `bytes` as f64, as many as there are places: integers beyond
    /// 2⁵³ are rounded.
    pub fn decode<'o>(self, bytes: &[u8], step: usize, out: impl Iterator<Item = &'o mut f64>) {
        let big = self.big_endian;
        match self.kind {
            Kind::F4 => each(bytes, step, big, out, |b| f32::from_le_bytes(b).into()),
            Kind::F8 => each(bytes, step, big, out, f64::from_le_bytes),
            Kind::I1 => each(bytes, step, big, out, |b| i8::from_le_bytes(b).into()),
            Kind::I2 => each(bytes, step, big, out, |b| i16::from_le_bytes(b).into()),
            Kind::I4 => each(bytes, step, big, out, |b| i32::from_le_bytes(b).into()),
            Kind::I8 => each(bytes, step, big, out, |b| i64::from_le_bytes(b) as f64),
            Kind::U1 => each(bytes, step, big, out, |b| u8::from_le_bytes(b).into()),
            Kind::U2 => each(bytes, step, big, out, |b| u16::from_le_bytes(b).into()),
            Kind::U4 => each(bytes, step, big, out, |b| u32::from_le_bytes(b).into()),
            Kind::U8 => each(bytes, step, big, out, |b| u64::from_le_bytes(b) as f64),
        }
    }
}

fn each<'o, const N: usize>(
    bytes: &[u8],
    step: usize,
    big: bool,
    out: impl Iterator<Item = &'o mut f64>,
    number: impl Fn([u8; N]) -> f64,
) {
    let numbers = bytes.as_chunks::<N>().0;
    let put = |(value, &little): (&mut f64, &[u8; N])| {
        let mut bytes = little;
        if big {
            bytes.reverse();
        }
        *value = number(bytes);
    };
    if step == 1 {
        out.zip(numbers).for_each(put); // a loop that the compiler vectorises
    } else {
        out.zip(numbers.iter().step_by(step)).for_each(put);
    }
}
