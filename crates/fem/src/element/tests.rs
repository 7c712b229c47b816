use super::*;

fn tabulated(element: &dyn Element, point: Point) -> (Vec<f64>, Vec<Point>) {
    let n = element.layout().nodes();
    let (mut phi, mut dphi) = (vec![f64::NAN; n], vec![[f64::NAN; 2]; n]);
    element.tabulate(point, &mut phi, &mut dphi);
    (phi, dphi)
}

/// Points inside of a cell, away from its symmetries.
fn samples(cell: Cell) -> &'static [Point] {
    match cell {
        Cell::Interval => &[[0.07, 0.0], [0.37, 0.0], [0.81, 0.0]],
        _ => &[[0.07, 0.11], [0.37, 0.21], [0.81, 0.13], [0.23, 0.61]],
    }
}

/// Directions in which a cell extends.
fn axes(cell: Cell) -> std::ops::Range<usize> {
    match cell {
        Cell::Interval => 0..1,
        _ => 0..2,
    }
}

#[test]
fn functions_are_nodal() {
    for (name, element) in ELEMENTS {
        assert_eq!(element.nodes().len(), element.layout().nodes(), "{name}");
        for (i, &node) in element.nodes().iter().enumerate() {
            for (j, phi) in tabulated(*element, node).0.into_iter().enumerate() {
                let expected = f64::from(u8::from(i == j));
                assert!((phi - expected).abs() < 1e-15, "{name}: phi_{j}(node {i}) = {phi}");
            }
        }
    }
}

#[test]
fn values_alone_are_the_same() {
    for (name, element) in ELEMENTS {
        for &point in samples(element.layout().cell) {
            let expected = tabulated(*element, point).0;
            let mut values = vec![f64::NAN; expected.len()];
            element.values(point, &mut values);
            for (value, phi) in values.iter().zip(expected) {
                assert!((value - phi).abs() < 1e-15, "{name}: {value} {phi}");
            }
        }
    }
}

#[test]
fn functions_sum_to_one_and_gradients_to_zero() {
    for (name, element) in ELEMENTS {
        for &point in samples(element.layout().cell) {
            let (phi, dphi) = tabulated(*element, point);
            assert!((phi.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{name}");
            for d in [0, 1] {
                assert!(dphi.iter().map(|g| g[d]).sum::<f64>().abs() < 1e-14, "{name}");
            }
        }
    }
}

#[test]
fn gradients_are_the_limits_of_differences() {
    let h = 1e-5;
    for (name, element) in ELEMENTS {
        for &point in samples(element.layout().cell) {
            let (_, dphi) = tabulated(*element, point);
            for d in axes(element.layout().cell) {
                let at = |s: f64| {
                    let mut p = point;
                    p[d] += s;
                    tabulated(*element, p).0
                };
                for ((ahead, behind), g) in at(h).iter().zip(at(-h)).zip(&dphi) {
                    let difference = (ahead - behind) / (2.0 * h);
                    assert!((difference - g[d]).abs() < 1e-9, "{name}: {difference} {g:?}");
                }
            }
        }
    }
}

/// Powers of x and y of the monomials of a total degree.
fn monomials(cell: Cell, total: usize) -> Vec<[i32; 2]> {
    let total = i32::try_from(total).expect("small");
    match cell {
        Cell::Interval => vec![[total, 0]],
        _ => (0..=total).map(|a| [a, total - a]).collect(),
    }
}

/// The span holds every monomial up to the degree, and not all of the next.
#[test]
fn degree_is_what_is_reproduced() {
    for (name, element) in ELEMENTS {
        let cell = element.layout().cell;
        let defect = |[a, b]: [i32; 2]| {
            let monomial = |p: Point| p[0].powi(a) * p[1].powi(b);
            let error = |&point: &Point| {
                let (phi, _) = tabulated(*element, point);
                let sum: f64 = phi.iter().zip(element.nodes()).map(|(f, &n)| f * monomial(n)).sum();
                (sum - monomial(point)).abs()
            };
            samples(cell).iter().map(error).fold(0.0, f64::max)
        };
        for total in 0..=element.degree() + 1 {
            let worst = monomials(cell, total).into_iter().map(defect).fold(0.0, f64::max);
            assert_eq!(worst < 1e-14, total <= element.degree(), "{name}, {total}: {worst}");
        }
    }
}

/// Vertices first, then edges, then inside: what dofs of neighbours are shared by.
#[test]
fn nodes_sit_where_the_layout_says() {
    for (name, element) in ELEMENTS {
        let (layout, nodes) = (element.layout(), element.nodes());
        assert!(layout.vertex <= 1 && layout.edge <= 1, "{name}");
        if layout.vertex == 1 {
            assert_eq!(nodes[..layout.cell.vertices()], *layout.cell.corners(), "{name}");
        }
        for edge in 0..layout.cell.edges() {
            for (node, s) in layout.on_edge(edge).zip([0.0, 1.0, 0.5]) {
                assert_eq!(nodes[node], layout.cell.on_edge(edge, s), "{name}, edge {edge}");
            }
        }
    }
}

/// Neighbours agree on their common edge: only its own nodes count there.
#[test]
fn functions_of_other_nodes_vanish_on_an_edge() {
    for (name, element) in ELEMENTS {
        let layout = element.layout();
        for edge in 0..layout.cell.edges() {
            let (phi, _) = tabulated(*element, layout.cell.on_edge(edge, 0.3));
            for node in (0..layout.nodes()).filter(|&n| layout.on_edge(edge).all(|k| k != n)) {
                assert!(phi[node].abs() < 1e-15, "{name}, edge {edge}: phi_{node} = {}", phi[node]);
            }
        }
    }
}
