use super::*;
use crate::manufactured::{grid_modes, nodes};
use crate::piston::Motion;
use lumley_fem::UniformGrid;
use lumley_fem::quadrature::gauss_legendre;

const LENGTH: f64 = 1.1;
const NODES: usize = 41;
const MODES: usize = 5;

struct Setting {
    modes: faer::Mat<f64>,
    tables: PrefixTables,
    a: Vec<f64>,
}

fn setting() -> Setting {
    let grid = UniformGrid::line(0.0, LENGTH, NODES);
    let modes = grid_modes(&nodes(LENGTH, NODES), MODES);
    let basis = Basis::on_grid(&grid, modes.as_ref(), None).expect("orthonormal modes");
    let tables = PrefixTables::new(&basis).expect("small");
    Setting { modes, tables, a: vec![0.31, -0.22, 0.17, 0.05, -0.4] }
}

fn interfacial(tables: &PrefixTables) -> Interfacial {
    let [mode, solid] = [(); 2].map(|()| vec![0.0; MODES]);
    let whole = tables.whole_integral().to_vec();
    Interfacial { mode, solid, whole, velocity: 0.0, shear: 0.0, body: Motion::default() }
}

/// Positions between nodes, at nodes, and near both ends.
fn positions() -> Vec<f64> {
    let irrational = (1..40).map(|k| LENGTH * (f64::from(k) * 0.618_033_988_749_895).fract());
    let at_nodes = nodes(LENGTH, NODES).into_iter().skip(1);
    irrational.chain(at_nodes).chain([1e-9, 1e-3, LENGTH - 1e-3, LENGTH - 1e-12]).collect()
}

impl Setting {
    /// Integrates `f(value and slope of each mode)` from 0 to `end`, cell by cell.
    fn quadrature(&self, end: f64, f: impl Fn(&[(f64, f64)]) -> f64) -> f64 {
        let h = LENGTH / (NODES - 1) as f64;
        let mut sum = 0.0;
        for cell in 0..NODES - 1 {
            let wet = ((end - cell as f64 * h) / h).clamp(0.0, 1.0);
            for (s, weight) in gauss_legendre(4) {
                let at = |n| {
                    let (l, r) = (self.modes[(cell, n)], self.modes[(cell + 1, n)]);
                    (l + s * wet * (r - l), (r - l) / h)
                };
                let modes: Vec<(f64, f64)> = (0..MODES).map(at).collect();
                sum += weight * wet * h * f(&modes);
            }
        }
        sum
    }

    fn velocity(&self, modes: &[(f64, f64)]) -> (f64, f64) {
        let sum =
            |part: fn(&(f64, f64)) -> f64| self.a.iter().zip(modes).map(|(a, m)| a * part(m)).sum();
        (sum(|m| m.0), sum(|m| m.1))
    }

    /// Compares with `∫_0^x f_n` for every n; the scale is the integral of `|f_n|` over the domain.
    fn compare(&self, what: &str, x: f64, found: &[f64], f: impl Fn(usize, &[(f64, f64)]) -> f64) {
        for (n, found) in found.iter().enumerate() {
            let expected = self.quadrature(x, |modes| f(n, modes));
            let scale = self.quadrature(LENGTH, |modes| f(n, modes).abs());
            let gap = (found - expected).abs() / scale;
            assert!(gap < 1e-13, "{what} {n} at X = {x}: {found} and {expected}, {gap:e}");
        }
    }
}

#[test]
fn tables_equal_direct_quadrature() {
    let setting = setting();
    let (tables, a) = (&setting.tables, &setting.a);
    let mut at = interfacial(tables);
    for x in positions() {
        let cut = tables.cut(x, a, &mut at);

        let wet: Vec<f64> = at.whole.iter().zip(&at.solid).map(|(w, s)| w - s).collect();
        setting.compare("integral", x, &wet, |n, modes| modes[n].0);

        let mut found = vec![0.0; MODES];
        tables.subtract_convection(&cut, a, &mut found);
        setting.compare("convection", x, &found, |n, modes| {
            let (v, slope) = setting.velocity(modes);
            -modes[n].0 * v * slope
        });

        tables.fluid_dissipation(&cut, a, &mut found);
        let dissipation = |n: usize, modes: &[(f64, f64)]| modes[n].1 * setting.velocity(modes).1;
        setting.compare("dissipation in the fluid", x, &found, dissipation);

        tables.whole_dissipation(a, &mut found);
        setting.compare("dissipation in all", LENGTH, &found, dissipation);
    }
}

/// At a node the slope is that of the fluid's side, X-.
#[test]
fn a_node_belongs_to_the_cell_at_its_left() {
    let setting = setting();
    let mut at = interfacial(&setting.tables);
    let h = LENGTH / (NODES - 1) as f64;
    let node = 17;
    setting.tables.cut(node as f64 * h, &setting.a, &mut at);
    let value = |k| (0..MODES).map(|n| setting.a[n] * setting.modes[(k, n)]).sum::<f64>();
    assert!((at.velocity - value(node)).abs() < 1e-14);
    let slope = (value(node) - value(node - 1)) / h;
    assert!((at.shear - slope).abs() < 1e-12, "{} and {slope}", at.shear);
}

/// Round-off puts many a node a little beyond its number of spacings.
#[test]
fn every_node_of_any_grid_belongs_to_the_cell_at_its_left() {
    for (length, nodes) in [(1.1, 401), (1.1, 41), (0.7, 1001), (3.3e-3, 127), (977.0, 3)] {
        let grid = UniformGrid::line(0.0, length, nodes);
        let constant = faer::Mat::from_fn(nodes, 1, |_, _| length.sqrt().recip());
        let basis = Basis::on_grid(&grid, constant.as_ref(), None).expect("a constant");
        let tables = PrefixTables::new(&basis).expect("small");
        for node in 1..nodes {
            for x in [grid.point(node)[0], node as f64 * grid.spacing()[0]] {
                assert_eq!(
                    tables.locate(x),
                    (node - 1, 1.0),
                    "node {node} of {nodes}, L = {length}"
                );
            }
            let (cell, fraction) = tables.locate((node as f64 - 0.5) * grid.spacing()[0]);
            assert!(cell == node - 1 && (fraction - 0.5).abs() < 1e-9, "{cell} {fraction}");
        }
        let beyond = grid.point(1)[0] * (1.0 + 1e-14);
        assert_eq!(tables.locate(beyond).0, 1, "a true position beyond a node is left alone");
    }
}

#[test]
fn tables_beyond_memory_are_refused() {
    let grid = UniformGrid::line(0.0, LENGTH, 2001);
    // Hats that do not touch are orthogonal; the square of one has the integral 2 h/3.
    let height = (1.5 / grid.spacing()[0]).sqrt();
    let hat = |k, n| if k == 3 * n + 1 { height } else { 0.0 };
    let modes = faer::Mat::from_fn(2001, 52, hat);
    let basis = Basis::on_grid(&grid, modes.as_ref(), None).expect("orthonormal modes");
    let refused = PrefixTables::new(&basis).expect_err("1.1 GiB");
    assert!(matches!(refused, ReducedError::TooLarge { modes: 52, nodes: 2001, .. }), "{refused}");
}
