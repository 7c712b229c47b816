//! Colour maps made from a formula in the perceptual colour space OKLab.
//!
//! Equal steps of the value are equal steps of lightness. The conversion is that of B. Ottosson,
//! "A perceptual color space for image processing" (2020).

/// A map from values to colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ColourMap {
    /// Blue, white, red over [−1, 1]: for signed quantities, zero is white.
    Diverging,
    /// Dark violet, green, light yellow over [0, 1].
    Sequential,
}

impl ColourMap {
    /// sRGB colour at `s` in [0, 1], from the low end of the map to its high end.
    pub(super) fn colour(self, s: f64) -> [u8; 3] {
        to_bytes(self.linear_rgb(s.clamp(0.0, 1.0)))
    }

    fn linear_rgb(self, s: f64) -> [f64; 3] {
        let [lightness, chroma, hue] = match self {
            Self::Diverging => {
                let t = 2.0 * s - 1.0;
                [0.97 - 0.53 * t.abs(), 0.125 * t.abs(), if t < 0.0 { 250.0 } else { 35.0 }]
            }
            Self::Sequential => [0.25 + 0.67 * s, 0.085 + 0.05 * s * s, 300.0 - 195.0 * s],
        };
        oklch(lightness, chroma, hue)
    }
}

/// OKLCh (hue in degrees) to linear sRGB.
fn oklch(lightness: f64, chroma: f64, hue: f64) -> [f64; 3] {
    let (b, a) = hue.to_radians().sin_cos();
    let (a, b) = (chroma * a, chroma * b);
    let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b).powi(3);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    ]
}

/// Linear sRGB to bytes with the sRGB transfer function.
fn to_bytes(rgb: [f64; 3]) -> [u8; 3] {
    rgb.map(|c| {
        let c = c.clamp(0.0, 1.0);
        let encoded = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in 0..=255")]
        let byte = (255.0 * encoded).round() as u8;
        byte
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLES: u32 = 200;

    /// Relative luminance as WCAG defines it.
    fn luminance(map: ColourMap, s: f64) -> f64 {
        let [r, g, b] = map.linear_rgb(s);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    #[test]
    fn every_colour_can_be_shown() {
        for map in [ColourMap::Diverging, ColourMap::Sequential] {
            for k in 0..=SAMPLES {
                let s = f64::from(k) / f64::from(SAMPLES);
                let rgb = map.linear_rgb(s);
                assert!(rgb.iter().all(|c| (-2e-3..=1.002).contains(c)), "{map:?} {s}: {rgb:?}");
            }
        }
    }

    #[test]
    fn lightness_rises_with_the_value_and_falls_from_zero_both_ways() {
        let grid = |k: u32| f64::from(k) / f64::from(SAMPLES);
        for k in 0..SAMPLES {
            let map = ColourMap::Sequential;
            assert!(luminance(map, grid(k + 1)) > luminance(map, grid(k)));
            let (map, outward) = (ColourMap::Diverging, |k: u32| 0.5 + grid(k) / 2.0);
            assert!(luminance(map, outward(k + 1)) < luminance(map, outward(k)));
            assert!(luminance(map, 1.0 - outward(k + 1)) < luminance(map, 1.0 - outward(k)));
        }
    }

    #[test]
    fn zero_is_nearly_white_and_the_conversion_keeps_white_white() {
        assert_eq!(to_bytes(oklch(1.0, 0.0, 0.0)), [255, 255, 255]);
        let zero = ColourMap::Diverging.colour(0.5);
        assert!(zero.iter().all(|&c| c > 240), "{zero:?}");
    }
}
