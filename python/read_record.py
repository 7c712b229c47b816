"""Read a record of lumley with zarr and numpy alone, check it, and print what is in it.

    python read_record.py DIR

The exit code is 0 when everything is as the record says, and 1 otherwise.
"""

import sys

import numpy as np
import zarr


class Wrong(Exception):
    """The record is not what it says."""


def check(condition, message):
    if not condition:
        raise Wrong(message)


def read(record, path, rows, columns):
    """The first `rows` rows of an array; zarr checks the CRC-32C of each chunk on the way.

    A writer that was killed may have left more rows than the record counts, never fewer. Where a chunk
    is missing, zarr puts NaN.
    """
    check(path in record, f"{path}: missing")
    array = record[path]
    shape = (array.shape[0], *columns)
    check(array.shape == shape and shape[0] >= rows, f"{path}: shape {array.shape}, expected {shape}")
    check(array.dtype == np.float64, f"{path}: {array.dtype}, expected float64")
    values = array[:rows]
    check(np.isfinite(values).all(), f"{path}: missing blocks or values that are not finite")
    return values


def nodes(record, name, support):
    """Coordinates of the nodes of a frame, one row each."""
    if "nodes" in support:
        return read(record, f"frames/{name}/nodes", support["nodes"], (2,))
    lower, upper = read(record, f"frames/{name}/bounds", 2, (2,))
    x, y = (np.linspace(a, b, n) for a, b, n in zip(lower, upper, support["grid"]))
    return np.column_stack([axis.ravel() for axis in np.meshgrid(x, y)])


def summarise(path):
    record = zarr.open_group(path, mode="r")
    lumley = record.attrs["lumley"]
    check(lumley["format"] == 1, f"format {lumley['format']}, expected 1")
    count = lumley["snapshots"]
    times = read(record, "time", count, ())
    check((np.diff(times) > 0).all(), "times do not increase")
    span = f", t = {times[0]:g} to {times[-1]:g} s" if count else ""
    print(f"{path}: {count} snapshots{span}")
    for key, value in lumley["provenance"].items():
        print(f"  {key}: {value.splitlines()[0] if value else ''}")
    for series in lumley["series"]:
        values = read(record, f"series/{series['name']}", count, (len(series["entries"]),))
        for entry, column in zip(series["entries"], values.T):
            extent = f"{column.min():.6g} to {column.max():.6g}" if count else "nothing yet"
            print(f"  series {series['name']}: {entry['name']} in {entry['unit']}, {extent}")
    for frame in lumley["frames"]:
        points = nodes(record, frame["name"], frame["support"])
        rows = len(frame["components"]) * len(points)
        values = read(record, f"frames/{frame['name']}/values", count, (rows,))
        for component, field in zip(frame["components"], np.split(values, len(frame["components"]), axis=1)):
            largest = f"largest magnitude {abs(field).max():.6g}" if count else "nothing yet"
            print(f"  frame {frame['name']}: {component['name']} in {component['unit']}"
                  f" at {len(points)} nodes, {largest}")


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 1
    try:
        summarise(sys.argv[1])
    except Exception as error:  # zarr raises errors of many kinds on damaged files
        print(f"{sys.argv[1]}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
