//! Pictures of values as PNG data URIs.

use super::colour::ColourMap;

/// Number of colours in a picture; the palette entry after the last is transparent.
const COLOURS: u8 = 255;

/// Encodes `width` × `height` values, top row first, as the data URI of a PNG.
///
/// `values` are positions on the colour map, 0 to 1; what is not finite is transparent. A palette
/// of 255 colours is finer than a reader can tell and a quarter of the size of full colour.
pub(super) fn data_uri(width: u32, height: u32, values: &[f64], map: ColourMap) -> String {
    assert_eq!(values.len(), width as usize * height as usize, "one value per pixel");
    let pixels: Vec<u8> = values.iter().map(|&v| palette_index(v)).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    // The colours are in the order of the values, so that differences from line to line are small: of a
    // smooth field that takes half the bytes, and more effort hardly any less.
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_filter(png::Filter::Up);
    encoder.set_palette(palette(map));
    let mut alpha = [u8::MAX; COLOURS as usize + 1];
    alpha[usize::from(COLOURS)] = 0;
    encoder.set_trns(alpha.to_vec());
    encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&pixels))
        .expect("a palette picture of positive size can be written to memory");
    format!("data:image/png;base64,{}", base64(&file))
}

fn palette_index(value: f64) -> u8 {
    if !value.is_finite() {
        return COLOURS;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in 0..COLOURS")]
    let index = (value.clamp(0.0, 1.0) * f64::from(COLOURS - 1)).round() as u8;
    index
}

fn palette(map: ColourMap) -> Vec<u8> {
    let colour = |k| map.colour(f64::from(k) / f64::from(COLOURS - 1));
    (0..=COLOURS).flat_map(colour).collect()
}

/// RFC 4648 base64.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word = (0..3).fold(0, |w, k| w << 8 | u32::from(*chunk.get(k).unwrap_or(&0)));
        for k in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * k) & 63) as usize];
            out.push(if k <= chunk.len() { char::from(digit) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn base64_of_the_rfc() {
        let vectors = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (bytes, text) in vectors {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    #[test]
    fn values_pick_colours_and_gaps_are_transparent() {
        assert_eq!(palette_index(0.0), 0);
        assert_eq!(palette_index(0.5), 127);
        assert_eq!(palette_index(7.0), COLOURS - 1);
        assert_eq!(palette_index(f64::NAN), COLOURS);
        assert_eq!(palette(ColourMap::Diverging).len(), 3 * 256);
    }
}
