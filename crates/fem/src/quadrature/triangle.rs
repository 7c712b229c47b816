use super::gauss_legendre;
use crate::Point;

/// Points that the symmetries of the triangle carry into each other; weights are parts of the area.
enum Orbit {
    /// The centroid.
    Centre(f64),
    /// Three points with the barycentric coordinates (a, a, 1 − 2 a).
    Three(f64, f64),
    /// Six points with the barycentric coordinates (a, b, 1 − a − b).
    Six(f64, f64, f64),
}
use Orbit::{Centre, Six, Three};

/// Fully symmetric rules: degree and orbits.
///
/// Degree 5 is Radon's (1948); 4 and 6 are Strang and Fix's (1973) and Cowper's (1973); 8 is
/// Dunavant's (1985, Int. J. Numer. Methods Eng. 21, 1129-1148). Their digits were completed by Newton's
/// method on the moment equations with 40 digits.
const RULES: &[(usize, &[Orbit])] = &[
    (1, &[Centre(1.0)]),
    (2, &[Three(1.0 / 6.0, 1.0 / 3.0)]),
    (
        4,
        &[
            Three(0.445_948_490_915_964_9, 0.223_381_589_678_011_47),
            Three(0.091_576_213_509_770_74, 0.109_951_743_655_321_87),
        ],
    ),
    (
        5,
        &[
            Centre(0.225),
            Three(0.470_142_064_105_115_1, 0.132_394_152_788_506_2),
            Three(0.101_286_507_323_456_34, 0.125_939_180_544_827_14),
        ],
    ),
    (
        6,
        &[
            Three(0.249_286_745_170_910_43, 0.116_786_275_726_379_37),
            Three(0.063_089_014_491_502_23, 0.050_844_906_370_206_82),
            Six(0.310_352_451_033_784_4, 0.053_145_049_844_816_945, 0.082_851_075_618_373_57),
        ],
    ),
    (
        8,
        &[
            Centre(0.144_315_607_677_787_17),
            Three(0.459_292_588_292_723_2, 0.095_091_634_267_284_62),
            Three(0.170_569_307_751_760_2, 0.103_217_370_534_718_24),
            Three(0.050_547_228_317_030_98, 0.032_458_497_623_198_08),
            Six(0.263_112_829_634_638_1, 0.008_394_777_409_957_605, 0.027_230_314_174_434_993),
        ],
    ),
];

/// The symmetric rule of least points that reaches the degree, above 8 the collapsed one.
pub(super) fn rule(degree: usize) -> Vec<(Point, f64)> {
    match RULES.iter().find(|(reached, _)| degree <= *reached) {
        Some((_, orbits)) => orbits.iter().flat_map(points).collect(),
        None => collapsed(degree),
    }
}

fn points(orbit: &Orbit) -> Vec<(Point, f64)> {
    let (weight, points) = match *orbit {
        Centre(w) => (w, vec![[1.0 / 3.0; 2]]),
        Three(a, w) => (w, around([a, a, 1.0 - 2.0 * a]).to_vec()),
        Six(a, b, w) => {
            let c = 1.0 - a - b;
            (w, [around([a, b, c]), around([b, a, c])].concat())
        }
    };
    points.into_iter().map(|point| (point, 0.5 * weight)).collect()
}

/// The barycentric coordinates turned round the triangle.
fn around([a, b, c]: [f64; 3]) -> [Point; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Gauss-Legendre rules on the square whose side `t = 1` shrinks to a corner: `x = s (1 − t)`, `y = t`.
/// The factor `1 − t` of the area costs a degree in t.
fn collapsed(degree: usize) -> Vec<(Point, f64)> {
    let (along, across) = (gauss_legendre(degree / 2 + 1), gauss_legendre(degree.div_ceil(2) + 1));
    let row = |(t, v): (f64, f64)| {
        along.iter().map(move |&(s, w)| ([s * (1.0 - t), t], w * v * (1.0 - t)))
    };
    across.into_iter().flat_map(row).collect()
}
