//! Stokes and Oseen systems of Q2 velocities with discontinuous linear pressures, cell by cell.

use lumley_fom::linear::{CellUnknowns, DelayedUnknowns};

/// Local unknowns of a cell: both components of nine velocities, then the constant pressure and its
/// two gradients.
const LOCAL: usize = 21;
/// Those that are met in this cell alone, eliminated last to first: the gradients of the pressure and
/// the velocity in the centre.
const INTERIOR: [usize; 4] = [8, 17, 19, 20];
/// Points and weights of Gauss's rule with three points on (0, 1).
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// What an Oseen system is made of: `u/dt + (w·∇)u − ν ∇²u + ∇p = f`, `∇·u = 0`.
#[derive(Clone, Copy)]
pub struct Oseen {
    pub viscosity: f64,
    /// 1/dt, zero for steady flow.
    pub rate: f64,
    /// The wind at a point.
    pub wind: fn([f64; 2]) -> [f64; 2],
    /// Interior unknowns are eliminated in the cell.
    pub condensed: bool,
}

/// A mapped grid of cells with velocities given on its rim, but for an outlet on the right.
pub struct Grid {
    pub cells: [usize; 2],
    pub map: fn([f64; 2]) -> [f64; 2],
    /// The last column of cells meets the first one.
    pub periodic: bool,
    /// Traction-free on the right.
    pub outlet: bool,
}

/// A system of cells as the solver takes it.
pub struct System {
    pub unknowns: CellUnknowns,
    pub matrices: Vec<f64>,
    /// What the velocity on the rim leaves on the right.
    pub rhs: Vec<f64>,
    pub centroids: Vec<[f64; 2]>,
    pub pressures: Vec<[usize; 2]>,
    pub neighbours: Vec<[usize; 2]>,
    /// Number of unknowns before anything is eliminated in the cells.
    pub whole: usize,
}

impl System {
    pub fn delay(&self) -> DelayedUnknowns<'_> {
        DelayedUnknowns { unknowns: &self.pressures, neighbours: &self.neighbours }
    }
}

impl Grid {
    /// The Oseen system on this grid. Without an outlet the last pressure is pinned if asked for.
    pub fn assemble(&self, oseen: &Oseen, pin: bool) -> System {
        let [nx, ny] = self.cells;
        let mut numbers = self.numbers();
        let mut count = numbers.iter().flatten().count();
        let mut whole = 2 * count;
        let mut system = System {
            unknowns: CellUnknowns::new(0, &[[0; 0]; 0]).expect("no unknowns"),
            matrices: Vec::new(),
            rhs: Vec::new(),
            centroids: Vec::new(),
            pressures: Vec::new(),
            neighbours: self.neighbours(),
            whole: 0,
        };
        if oseen.condensed {
            // Centres have no number of their own.
            count = 0;
            for (node, number) in numbers.iter_mut().enumerate() {
                let [i, j] = [node % (2 * nx + 1), node / (2 * nx + 1)];
                if self.twin(i, j) != node || (i % 2 == 1 && j % 2 == 1) {
                    *number = None;
                } else if number.is_some() {
                    *number = Some(count);
                    count += 1;
                }
            }
        }
        let velocities = 2 * count;
        let mut next = velocities;
        let mut lists = Vec::new();
        for cell in 0..nx * ny {
            let [i, j] = [cell % nx, cell / nx];
            let nodes = self.nodes(i, j);
            let matrix = local_matrix(oseen, nodes.map(|node| self.point(node)));
            let mut list = [None; LOCAL];
            for (k, node) in nodes.into_iter().enumerate() {
                let [a, b] = [node % (2 * nx + 1), node / (2 * nx + 1)];
                let number = numbers[self.twin(a, b)];
                list[k] = number.map(|n| 2 * n);
                list[9 + k] = number.map(|n| 2 * n + 1);
            }
            for (k, local) in list.iter_mut().enumerate().skip(18) {
                let pinned = pin && k == 18 && cell + 1 == nx * ny;
                if !(pinned || oseen.condensed && k > 18) {
                    *local = Some(next);
                    next += 1;
                }
            }
            whole += 3;
            if let Some(pressure) = list[18] {
                system.pressures.push([pressure, cell]);
            }
            let kept: Vec<usize> = (0..LOCAL).filter(|&k| list[k].is_some()).collect();
            system.rhs.resize(next, 0.0);
            for column in (0..18).filter(|&k| list[k].is_none()) {
                let rim = (oseen.wind)(self.point(nodes[column % 9]))[column / 9];
                for &row in &kept {
                    system.rhs[list[row].expect("kept")] -= matrix[column][row] * rim;
                }
            }
            for &column in &kept {
                system.matrices.extend(kept.iter().map(|&row| matrix[column][row]));
            }
            lists.push(kept.iter().filter_map(|&k| list[k]).collect::<Vec<_>>());
            system.centroids.push(self.point(nodes[8]));
        }
        system.unknowns = CellUnknowns::new(next, &lists).expect("a sound numbering");
        system.whole = whole;
        system
    }

    /// Node of the grid that stands for this one.
    fn twin(&self, i: usize, j: usize) -> usize {
        let across = 2 * self.cells[0] + 1;
        let i = if self.periodic && i + 1 == across { 0 } else { i };
        i + j * across
    }

    /// Numbers of the nodes whose velocity is unknown.
    fn numbers(&self) -> Vec<Option<usize>> {
        let [across, up] = self.cells.map(|n| 2 * n + 1);
        let mut count = 0;
        let mut number = |node: usize| {
            let [i, j] = [node % across, node / across];
            let side = !self.periodic && (i == 0 || (i + 1 == across && !self.outlet));
            let held = j == 0 || j + 1 == up || side;
            (!held && self.twin(i, j) == node).then(|| {
                count += 1;
                count - 1
            })
        };
        (0..across * up).map(&mut number).collect()
    }

    fn point(&self, node: usize) -> [f64; 2] {
        let across = 2 * self.cells[0] + 1;
        let [x, y] = [node % across, node / across].map(|i| i as f64 / 2.0);
        (self.map)([x / self.cells[0] as f64, y / self.cells[1] as f64])
    }

    /// Corners, middles of the edges, centre.
    fn nodes(&self, i: usize, j: usize) -> [usize; 9] {
        const PLACES: [[usize; 2]; 9] =
            [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1], [1, 1]];
        PLACES.map(|[a, b]| 2 * i + a + (2 * j + b) * (2 * self.cells[0] + 1))
    }

    fn neighbours(&self) -> Vec<[usize; 2]> {
        let [nx, ny] = self.cells;
        let mut pairs = Vec::new();
        for cell in 0..nx * ny {
            if cell % nx + 1 < nx {
                pairs.push([cell, cell + 1]);
            } else if self.periodic {
                pairs.push([cell + 1 - nx, cell]);
            }
            if cell / nx + 1 < ny {
                pairs.push([cell, cell + nx]);
            }
        }
        pairs
    }
}

/// The quadratic through 0, 1/2 and 1 that is one at the node `k` of `[0, 1, 1/2]`, and its slope.
fn quadratic(k: usize, x: f64) -> [f64; 2] {
    match k {
        0 => [(1.0 - x) * (1.0 - 2.0 * x), 4.0 * x - 3.0],
        1 => [x * (2.0 * x - 1.0), 4.0 * x - 1.0],
        _ => [4.0 * x * (1.0 - x), 4.0 - 8.0 * x],
    }
}

/// Values and slopes of the nine functions of the reference square.
fn biquadratic([x, y]: [f64; 2]) -> [[f64; 3]; 9] {
    const FACTORS: [[usize; 2]; 9] =
        [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0], [1, 2], [2, 1], [0, 2], [2, 2]];
    FACTORS.map(|[a, b]| {
        let ([f, df], [g, dg]) = (quadratic(a, x), quadratic(b, y));
        [f * g, df * g, f * dg]
    })
}

/// The matrix of one cell by columns, `matrix[column][row]`.
fn local_matrix(oseen: &Oseen, nodes: [[f64; 2]; 9]) -> [[f64; LOCAL]; LOCAL] {
    let mut a = [[0.0; LOCAL]; LOCAL];
    for (x, wx) in GAUSS {
        for (y, wy) in GAUSS {
            add_point(&mut a, oseen, &nodes, &biquadratic([x, y]), wx * wy);
        }
    }
    if oseen.condensed {
        condense(&mut a);
    }
    a
}

fn add_point(
    a: &mut [[f64; LOCAL]; LOCAL],
    oseen: &Oseen,
    nodes: &[[f64; 2]; 9],
    shape: &[[f64; 3]; 9],
    weight: f64,
) {
    let sum = |c: usize, d: usize| -> f64 {
        nodes.iter().zip(shape).map(|(node, phi)| node[c] * phi[d]).sum()
    };
    let [xx, xy, yx, yy] = [sum(0, 1), sum(0, 2), sum(1, 1), sum(1, 2)];
    let det = xx * yy - xy * yx;
    let at = [sum(0, 0), sum(1, 0)];
    let gradients = shape.map(|[_, r, s]| [(yy * r - yx * s) / det, (xx * s - xy * r) / det]);
    let weight = weight * det;
    let wind = (oseen.wind)(at);
    let pressure = [1.0, at[0] - nodes[8][0], at[1] - nodes[8][1]];
    for j in 0..9 {
        let [gx, gy] = gradients[j];
        let carried = oseen.rate * shape[j][0] + wind[0] * gx + wind[1] * gy;
        for i in 0..9 {
            let [hx, hy] = gradients[i];
            let entry = weight * (oseen.viscosity * (gx * hx + gy * hy) + shape[i][0] * carried);
            a[j][i] += entry;
            a[9 + j][9 + i] += entry;
        }
        for (k, p) in pressure.into_iter().enumerate() {
            for (c, slope) in [gx, gy].into_iter().enumerate() {
                a[9 * c + j][18 + k] -= weight * slope * p;
                a[18 + k][9 * c + j] -= weight * slope * p;
            }
        }
    }
}

/// Eliminates the interior unknowns: the velocities first, their pivots are not zero.
fn condense(a: &mut [[f64; LOCAL]; LOCAL]) {
    for pivot in INTERIOR {
        let column = a[pivot];
        for (j, other) in a.iter_mut().enumerate() {
            if j != pivot {
                let factor = other[pivot] / column[pivot];
                for (i, x) in other.iter_mut().enumerate() {
                    if i != pivot {
                        *x -= column[i] * factor;
                    }
                }
                other[pivot] = 0.0;
            }
        }
        a[pivot] = [0.0; LOCAL];
    }
}

/// Numbers between −1/2 and 1/2 without any pattern (splitmix64).
pub fn noise(len: usize) -> Vec<f64> {
    let number = |k: u64| {
        let mut z = (k + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (0..len as u64).map(number).collect()
}

/// `|b − A x| / |b|`
pub fn relative_residual(system: &System, x: &[f64], b: &[f64]) -> f64 {
    let mut product = vec![0.0; b.len()];
    system.unknowns.multiply(&system.matrices, x, &mut product);
    let norm = |v: &mut dyn Iterator<Item = f64>| v.map(|x| x * x).sum::<f64>().sqrt();
    norm(&mut product.iter().zip(b).map(|(p, b)| b - p)) / norm(&mut b.iter().copied())
}
