//! The integrals of the weak form over [`WIDTH`](super::lanes::WIDTH) cells at once.

use super::lanes::Lanes;
use lumley_fem::element::{Cell, Element};
use lumley_fem::geometry::Tabulated;
use lumley_fem::quadrature::rule;

/// Exact for the centroid and the area of a quadratic cell, and for its mass matrix but for the square of the bubble.
pub const DEGREE: usize = 5;
/// Points of that rule on a square; a triangle has fewer.
const MOST_POINTS: usize = 9;

/// A point of the quadrature: the N functions of the velocity and the G functions of the geometry.
#[derive(Debug, Clone, Copy)]
pub struct ReferencePoint<const N: usize, const G: usize> {
    velocity: Tabulated<N>,
    geometry: Tabulated<G>,
}

/// The quadrature on a kind of cell.
pub fn reference_points<const N: usize, const G: usize>(
    cell: Cell,
    velocity: &dyn Element,
    geometry: &dyn Element,
) -> Vec<ReferencePoint<N, G>> {
    let rule = rule(cell, DEGREE);
    assert!(rule.len() <= MOST_POINTS, "room for the points of the quadrature");
    let pairs = Tabulated::on(velocity, &rule).into_iter().zip(Tabulated::on(geometry, &rule));
    pairs.map(|(velocity, geometry)| ReferencePoint { velocity, geometry }).collect()
}

/// What the equations are, at one instant and one iteration.
#[derive(Debug, Clone, Copy)]
pub struct Terms {
    /// Density, in kg/m³.
    pub density: f64,
    /// Dynamic viscosity, in Pa s.
    pub viscosity: f64,
    /// The new velocity's weight in its rate, per s; zero for steady flow.
    pub rate: f64,
    /// Whether the viscous term is that of the stress.
    pub stress: bool,
    /// Whether the convective term is linearised by Newton.
    pub newton: bool,
    /// The divergence that the velocity shall have, per s: what boundary values without an outlet enforce.
    pub divergence: f64,
}

/// What the integrals take of the fields: values at the nodes of the cells.
pub struct Fields<const N: usize, const G: usize> {
    /// Geometry nodes, in m.
    pub nodes: [[Lanes; 2]; G],
    /// Convecting velocity relative to the mesh, in m/s.
    pub wind: [[Lanes; 2]; N],
    /// Body force less the known part of the rate, in m/s².
    pub source: [[Lanes; 2]; N],
    /// The velocity about which Newton's method linearises, in m/s.
    pub base: [[Lanes; 2]; N],
}

/// The integrals: entry `[i][j]` belongs to test function i and function j.
pub struct Integrals<const N: usize, const C: usize> {
    /// What acts on each component alone, the same on both.
    pub common: [[Lanes; N]; N],
    /// `[c][d]`: what component d does to component c beyond that; C is N where something does, else 0.
    pub coupled: [[[[Lanes; N]; C]; 2]; 2],
    /// `−∫ p_k ∂_c φ_j`.
    pub divergence: [[[Lanes; N]; 2]; 3],
    /// Right-hand side of the momentum.
    pub momentum: [[Lanes; N]; 2],
    /// Area of the cells, in m².
    pub area: Lanes,
}

/// The map of the cells at a point of the quadrature.
#[derive(Clone, Copy, Default)]
struct Map {
    inverse: [[Lanes; 2]; 2],
    point: [Lanes; 2],
    weight: Lanes,
}

#[inline(always)]
fn map<const N: usize, const G: usize>(at: &ReferencePoint<N, G>, nodes: &[[Lanes; 2]; G]) -> Map {
    let (mut point, mut jacobian) = ([Lanes::default(); 2], [[Lanes::default(); 2]; 2]);
    for (g, node) in nodes.iter().enumerate() {
        for c in 0..2 {
            point[c] += node[c] * at.geometry.phi[g];
            for d in 0..2 {
                jacobian[c][d] += node[c] * at.geometry.dphi[g][d];
            }
        }
    }
    let [[a, b], [c, d]] = jacobian;
    let determinant = a * d - b * c;
    let r = determinant.recip();
    let minus = Lanes::default() - r;
    Map {
        inverse: [[d * r, b * minus], [c * minus, a * r]],
        point,
        weight: determinant * at.geometry.weight,
    }
}

/// All integrals; the coupling blocks only where they are needed.
#[inline(always)]
pub fn integrate<const N: usize, const G: usize, const C: usize>(
    points: &[ReferencePoint<N, G>],
    terms: &Terms,
    fields: &Fields<N, G>,
) -> Integrals<N, C> {
    let mut maps = [Map::default(); MOST_POINTS];
    let (mut area, mut moment) = (Lanes::default(), [Lanes::default(); 2]);
    for (map_at, at) in maps.iter_mut().zip(points) {
        *map_at = map(at, &fields.nodes);
        area += map_at.weight;
        for c in 0..2 {
            moment[c] += map_at.weight * map_at.point[c];
        }
    }
    let (per_area, per_length) = (area.recip(), area.sqrt().recip());
    let centre = moment.map(|m| m * per_area);

    let zero = Lanes::default();
    let mut sums = Integrals {
        common: [[zero; N]; N],
        coupled: [[[[zero; N]; C]; 2]; 2],
        divergence: [[[zero; N]; 2]; 3],
        momentum: [[zero; N]; 2],
        area,
    };
    for (map, at) in maps.iter().zip(points) {
        let pressure = [
            Lanes::splat(1.0),
            (map.point[0] - centre[0]) * per_length,
            (map.point[1] - centre[1]) * per_length,
        ];
        add_point::<N, G, C>(&mut sums, at, map, &pressure, terms, fields);
    }
    sums
}

#[inline(always)]
fn add_point<const N: usize, const G: usize, const C: usize>(
    sums: &mut Integrals<N, C>,
    at: &ReferencePoint<N, G>,
    map: &Map,
    pressure: &[Lanes; 3],
    terms: &Terms,
    fields: &Fields<N, G>,
) {
    let ReferencePoint { velocity: Tabulated { phi, dphi, .. }, .. } = at;
    let zero = Lanes::default();
    let weight = map.weight;
    let mut slopes = [[zero; 2]; N];
    let (mut wind, mut source) = ([zero; 2], [zero; 2]);
    for j in 0..N {
        for d in 0..2 {
            slopes[j][d] = map.inverse[0][d] * dphi[j][0] + map.inverse[1][d] * dphi[j][1];
            wind[d] += fields.wind[j][d] * phi[j];
            source[d] += fields.source[j][d] * phi[j];
        }
    }
    let inertia = weight * terms.density;
    let friction = weight * terms.viscosity;
    let carried = [wind[0] * inertia, wind[1] * inertia];
    let (mut transport, mut shear) = ([zero; N], [[zero; 2]; N]);
    for j in 0..N {
        transport[j] =
            inertia * (terms.rate * phi[j]) + carried[0] * slopes[j][0] + carried[1] * slopes[j][1];
        shear[j] = [friction * slopes[j][0], friction * slopes[j][1]];
    }
    for i in 0..N {
        for j in 0..N {
            sums.common[i][j] +=
                transport[j] * phi[i] + shear[j][0] * slopes[i][0] + shear[j][1] * slopes[i][1];
        }
    }
    for (k, p) in pressure.iter().enumerate() {
        let p = *p * weight;
        for c in 0..2 {
            for j in 0..N {
                sums.divergence[k][c][j] -= p * slopes[j][c];
            }
        }
    }
    if C > 0 && terms.stress {
        add_transpose(sums, &shear, &slopes);
    }
    if C > 0 && terms.newton {
        let push = add_newton(sums, phi, &slopes, inertia, &fields.base);
        source = [0, 1].map(|c| source[c] + push[c]);
    }
    for c in 0..2 {
        let push = source[c] * inertia;
        for i in 0..N {
            sums.momentum[c][i] += push * phi[i];
        }
    }
}

/// `∫ μ ∇uᵀ : ∇v`
#[inline(always)]
fn add_transpose<const N: usize, const C: usize>(
    sums: &mut Integrals<N, C>,
    shear: &[[Lanes; 2]; N],
    slopes: &[[Lanes; 2]; N],
) {
    for c in 0..2 {
        for d in 0..2 {
            for i in 0..C {
                for j in 0..N {
                    sums.coupled[c][d][i][j] += shear[j][c] * slopes[i][d];
                }
            }
        }
    }
}

/// `∫ ρ (u·∇) b · v` for the base b; returns what stands on the right-hand side for it, `(b·∇) b`.
#[inline(always)]
fn add_newton<const N: usize, const C: usize>(
    sums: &mut Integrals<N, C>,
    phi: &[f64; N],
    slopes: &[[Lanes; 2]; N],
    inertia: Lanes,
    base: &[[Lanes; 2]; N],
) -> [Lanes; 2] {
    let zero = Lanes::default();
    let (mut value, mut gradient) = ([zero; 2], [[zero; 2]; 2]);
    for j in 0..N {
        for c in 0..2 {
            value[c] += base[j][c] * phi[j];
            for d in 0..2 {
                gradient[c][d] += base[j][c] * slopes[j][d];
            }
        }
    }
    for c in 0..2 {
        for d in 0..2 {
            let change = gradient[c][d] * inertia;
            for i in 0..C {
                let change = change * phi[i];
                for j in 0..N {
                    sums.coupled[c][d][i][j] += change * phi[j];
                }
            }
        }
    }
    [0, 1].map(|c| value[0] * gradient[c][0] + value[1] * gradient[c][1])
}
