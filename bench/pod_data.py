"""Snapshots to measure POD on: thirty travelling waves and a little noise.

    u(x_i, t_j) = sum_k 0.8^k cos(2 pi k (x_i - c_k t_j) + phi_k) + 1e-6 noise,   k = 1..30

with x_i = i/n, t_j = j/m, c_k = 0.3 + 0.7 frac(k g), phi_k = 2 pi frac(k p), g the golden and p the plastic
number's fraction. Needs numpy. Writes FOLDER/NAME.npy, one snapshot a row, and the weights FOLDER/NAME_w.npy.

    python bench/pod_data.py FOLDER NAME UNKNOWNS SNAPSHOTS
"""

import argparse
from pathlib import Path

import numpy as np

# Unknowns, snapshots and key of the noise.
CASES = {"a": (20_000, 200, 1000), "b": (200_000, 500, 1001), "c": (1_000_000, 200, 1002)}

K = np.arange(1, 31)
AMPLITUDE = 0.8**K
SPEED = 0.3 + 0.7 * (K * 0.6180339887498949 % 1)
PHASE = 2 * np.pi * (K * 0.7548776662466927 % 1)


def snapshot(n, t, noise):
    """The field at the time t. Each wave is one Fourier coefficient: a row costs one transform."""
    spectrum = np.zeros(n // 2 + 1, complex)
    spectrum[K] = n / 2 * AMPLITUDE * np.exp(1j * (PHASE - 2 * np.pi * K * SPEED * t))
    return np.fft.irfft(spectrum, n) + 1e-6 * noise.standard_normal(n)


def paths(folder, name):
    return Path(folder) / f"{name}.npy", Path(folder) / f"{name}_w.npy"


def write(folder, name, n, m, key=1):
    """Writes the files unless they are there; returns their paths."""
    data, weights = paths(folder, name)
    if not (data.exists() and weights.exists()):
        data.parent.mkdir(parents=True, exist_ok=True)
        noise = np.random.Generator(np.random.Philox(key=key))
        with open(data, "wb") as file:
            header = {"descr": "<f8", "fortran_order": False, "shape": (m, n)}
            np.lib.format.write_array_header_1_0(file, header)
            for j in range(m):
                snapshot(n, j / m, noise).tofile(file)
        np.save(weights, (1 + 0.5 * np.sin(2 * np.pi * 7 * np.arange(n) / n)) / n)
    return data, weights


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("name")
    parser.add_argument("unknowns", type=int)
    parser.add_argument("snapshots", type=int)
    options = parser.parse_args()
    write(options.folder, options.name, options.unknowns, options.snapshots)


if __name__ == "__main__":
    main()
