use super::Element;
use crate::Point;

/// Most nodes of an element of a line whose products are taken.
const LINE_NODES: usize = 3;

/// Products of the functions of an element of a line: function `i` is number `pairs[i][0]` along x times
/// number `pairs[i][1]` along y.
pub(super) fn tabulate(
    line: &dyn Element,
    pairs: &[[usize; 2]],
    [x, y]: Point,
    phi: &mut [f64],
    dphi: &mut [Point],
) {
    let nodes = line.layout().nodes();
    let along = |s: f64| {
        let (mut f, mut df) = ([0.0; LINE_NODES], [[0.0; 2]; LINE_NODES]);
        line.tabulate([s, 0.0], &mut f[..nodes], &mut df[..nodes]);
        (f, df)
    };
    let ((fx, dfx), (fy, dfy)) = (along(x), along(y));
    for ((phi, dphi), &[i, j]) in phi.iter_mut().zip(dphi).zip(pairs) {
        *phi = fx[i] * fy[j];
        *dphi = [dfx[i][0] * fy[j], fx[i] * dfy[j][0]];
    }
}
