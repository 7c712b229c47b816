"""Look at fields that lumley wrote for ParaView through VTK's own reader and cells.

    python check_vtu.py SERIES.pvd [--sample]

Every file of the series must be read, have the time that the series says, cells that are right side out and
values that are finite. With --sample, for the series of `cargo run --example paraview`, fields, areas and
integrals must be those of the formulas there. The exit code is 0 when all is right.
"""

import argparse
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkBiQuadraticQuad, vtkBiQuadraticTriangle, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkProbeFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

TRIANGLE, SQUARE = 34, 28  # biquadratic
CLASSES = {TRIANGLE: vtkBiQuadraticTriangle, SQUARE: vtkBiQuadraticQuad}


class Wrong(Exception):
    """The file is not what it should be."""


def check(condition, message):
    if not condition:
        raise Wrong(message)


def gauss(n=6):
    """Points and weights on the unit interval."""
    x, w = np.polynomial.legendre.leggauss(n)
    return (x + 1) / 2, w / 2


def rule(kind):
    """Quadrature in VTK's parametric coordinates; the triangle is a square with one side shrunk."""
    (x, w), points = gauss(), []
    for s, ws in zip(x, w):
        for t, wt in zip(x, w):
            shrink = 1 - t if kind == TRIANGLE else 1
            points.append((s * shrink, t, ws * wt * shrink))
    return points


def tables(kind):
    """VTK's functions of a cell and their derivatives at all points of a quadrature, and its weights."""
    cell, phi, dphi, weights = CLASSES[kind](), [], [], []
    count = cell.GetNumberOfPoints()
    for r, s, weight in rule(kind):
        values, slopes = [0.0] * count, [0.0] * (2 * count)
        cell.InterpolateFunctions([r, s, 0.0], values)
        cell.InterpolateDerivs([r, s, 0.0], slopes)
        phi.append(values)
        dphi.append(np.reshape(slopes, (2, count)))
        weights.append(weight)
    return np.array(phi), np.array(dphi), np.array(weights)


class Frame:
    """A file as VTK sees it."""

    def __init__(self, path):
        reader, self.errors = vtkXMLUnstructuredGridReader(), []
        for event in ("ErrorEvent", "WarningEvent"):
            reader.AddObserver(event, lambda *_: self.errors.append(path))
        reader.SetFileName(str(path))
        reader.Update()
        check(not self.errors, f"{path}: VTK cannot read it")
        self.path, self.grid = path, reader.GetOutput()
        check(self.grid.GetNumberOfCells() > 0, f"{path}: no cells")
        self.points = vtk_to_numpy(self.grid.GetPoints().GetData())[:, :2]
        kinds = np.array([self.grid.GetCellType(k) for k in range(self.grid.GetNumberOfCells())])
        cells = self.grid.GetCells()
        nodes, ends = (vtk_to_numpy(a) for a in (cells.GetConnectivityArray(), cells.GetOffsetsArray()))
        check(set(kinds) <= set(CLASSES), f"{path}: cells of the types {set(kinds)}")
        self.groups = []  # cells of a kind, their points
        for kind, count in ((TRIANGLE, 7), (SQUARE, 9)):
            (chosen,) = np.nonzero(kinds == kind)
            check((np.diff(ends)[chosen] == count).all(), f"{path}: points of a cell")
            if len(chosen):
                self.groups.append((kind, chosen, nodes[ends[chosen][:, None] + np.arange(count)]))

    def point_field(self, name):
        return vtk_to_numpy(self.grid.GetPointData().GetArray(name))

    def time(self):
        return self.grid.GetFieldData().GetArray("TimeValue").GetValue(0)

    def arrays(self):
        for data in (self.grid.GetPointData(), self.grid.GetCellData()):
            for k in range(data.GetNumberOfArrays()):
                yield data.GetArrayName(k), vtk_to_numpy(data.GetArray(k))

    def integrals(self, nodal):
        """The integral of a field with these values at the points, and the area, of every cell."""
        areas, integrals = np.zeros((2, self.grid.GetNumberOfCells()))
        for kind, cells, nodes in self.groups:
            phi, dphi, weights = tables(kind)
            jacobian = np.einsum("qdk,cki->cqdi", dphi, self.points[nodes])
            determinant = np.linalg.det(jacobian)
            check((determinant > 0).all(), f"{self.path}: a cell is inside out")
            areas[cells] = determinant @ weights
            integrals[cells] = np.einsum("cq,q,qk,ck->c", determinant, weights, phi, nodal[nodes])
        return integrals, areas


class Sample:
    """The formulas of the example, in the coordinates of the unit square."""

    def __init__(self, time):
        self.time = time

    def place(self, x, y):
        return np.stack([2 * x + 0.3 * (1 + self.time) * y * y, y - 0.2 * x * x + 0.1 * x * y], -1)

    def determinant(self, x, y):
        return 2 * (1 + 0.1 * x) - 0.6 * (1 + self.time) * y * (0.1 * y - 0.4 * x)

    @staticmethod
    def velocity(x, y):
        return np.stack([1 + x - 2 * x * y + y * y, x * x - 3 * y + x * y, 0 * x], -1)

    @staticmethod
    def pressure(x, y):
        return x * x + 2 * x * y - y

    def integral(self, f):
        """Over the whole domain; exact, for f is a polynomial."""
        x, w = gauss()
        x, y = np.meshgrid(x, x)
        return np.sum(f(x, y) * self.determinant(x, y) * np.outer(w, w))


def probe(frame, places):
    """The fields that vtkProbeFilter finds at these places, and which of the places it finds."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for x, y in places:
        points.InsertNextPoint(x, y, 0)
    targets = vtkPolyData()
    targets.SetPoints(points)
    probe = vtkProbeFilter()
    probe.SetInputData(targets)
    probe.SetSourceData(frame.grid)
    # VTK looks for points in straight parts of the curved cells and takes most for outside without this.
    probe.ComputeToleranceOff()
    probe.SetTolerance(1e-6)
    probe.Update()
    found = probe.GetOutput().GetPointData()
    mask = vtk_to_numpy(found.GetArray(probe.GetValidPointMaskArrayName()))
    return (lambda name: vtk_to_numpy(found.GetArray(name))), mask == 1


def compare_probe(frame, sample):
    """VTK's place in a curved cell is a little off; the fields must fit together there to round-off."""
    x, y = np.random.default_rng(1).random((2, 500)) * 0.98 + 0.01
    field, inside = probe(frame, sample.place(x, y))
    check(inside.mean() > 0.99, f"{frame.path}: the probe finds {inside.sum()} of {len(x)} points")
    (r, s), velocity = field("reference")[inside, :2].T, field("velocity")[inside]
    return {
        "probed place": (max(abs(r - x[inside]).max(), abs(s - y[inside]).max()), 2e-3),
        "probed velocity": (abs(velocity - sample.velocity(r, s)).max(), 1e-12),
    }


def compare_sample(frame):
    """Errors against the formulas, with what is allowed."""
    sample = Sample(frame.time())
    pressures, areas = frame.integrals(frame.point_field("pressure"))
    speeds, _ = frame.integrals(frame.point_field("velocity")[:, 1])
    integrals = {
        "area": (areas, lambda x, y: np.ones_like(x)),
        "integral of pressure": (pressures, sample.pressure),
        "integral of v": (speeds, lambda x, y: sample.velocity(x, y)[..., 1]),
    }
    errors = {what: (abs(found.sum() - sample.integral(f)), 1e-13) for what, (found, f) in integrals.items()}
    errors["area of cells"] = (abs(areas - dict(frame.arrays())["area"]).max(), 1e-14)
    return errors | compare_probe(frame, sample)


def look(series, is_sample):
    entries = ElementTree.parse(series).getroot().findall("./Collection/DataSet")
    check(entries, f"{series}: no files")
    times = [float(entry.get("timestep")) for entry in entries]
    check((np.diff(times) > 0).all(), f"{series}: times do not increase")
    for time, entry in zip(times, entries):
        frame = Frame(series.parent / entry.get("file"))
        check(frame.time() == time, f"{frame.path}: time {frame.time()}, the series says {time}")
        for name, values in frame.arrays():
            check(np.isfinite(values).all(), f"{frame.path}: {name} is not finite")
        _, areas = frame.integrals(np.ones(len(frame.points)))
        print(f"{frame.path}: t = {time:g} s, {len(areas)} cells, area {areas.sum():.6g} m2, fields "
              + ", ".join(name for name, _ in frame.arrays()))
        for what, (error, allowed) in compare_sample(frame).items() if is_sample else ():
            print(f"  {what:24}{error:10.1e}")
            check(error <= allowed, f"{frame.path}: {what}: error {error:.1e}, expected at most {allowed:.0e}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("series", type=Path, help="a .pvd file")
    parser.add_argument("--sample", action="store_true", help="it is the series of the example")
    options = parser.parse_args()
    try:
        look(options.series, options.sample)
    except (Wrong, OSError, ElementTree.ParseError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
