"""Check a POD of lumley with numpy alone, block by block: files may be larger than memory.

    python check_pod.py POD.npz X.npy [--weights W.npy]

X.npy has one snapshot a row, of one axis or several; W.npy a weight for each unknown, or for each node of
components that come one after the other. Prints how far each property is from holding:

- orthonormal     max |Phi^T W Phi - I|
- coefficients    max |a - Phi^T W (X - mean)| / sigma_1
- uncorrelated    max |<a_i a_k> - delta_ik lambda_i| / lambda_1
- singular values max |sigma - |Phi^T W (X - mean)|| / sigma_1, row by row: nothing is lost to squares
- Gram            max |sigma^2 - eigenvalue of X^T W X| / sigma_1^2
- residual        mean squared projection error less what the other eigenvalues leave, relative to the energy

The exit code is 0 when all are under the tolerance.
"""

import argparse
import sys
import zipfile

import numpy as np

BLOCK = 1 << 24  # bytes of snapshots at a time


def member(path, name):
    """An array of an NPZ file, mapped where it stands: lumley does not compress."""
    with zipfile.ZipFile(path) as archive:
        entry = archive.getinfo(f"{name}.npy")
        with archive.open(entry) as file:
            version = np.lib.format.read_magic(file)
            read_header = getattr(np.lib.format, f"read_array_header_{version[0]}_{version[1]}")
            shape, fortran, dtype = read_header(file)
            header = file.tell()
    with open(path, "rb") as file:
        file.seek(entry.header_offset + 26)
        lengths = np.frombuffer(file.read(4), "<u2")
    start = entry.header_offset + 30 + int(lengths.sum()) + header
    return np.memmap(path, dtype, "r", start, shape, "F" if fortran else "C")


def has(path, name):
    with zipfile.ZipFile(path) as archive:
        return f"{name}.npy" in archive.namelist()


class Pod:
    """A decomposition beside its snapshots, read by blocks of unknowns."""

    def __init__(self, path, data, weights):
        self.modes, self.a = member(path, "modes"), member(path, "coefficients")
        self.sigma, self.q = member(path, "singular_values"), member(path, "time_weights")
        self.mean = member(path, "mean") if has(path, "mean") else None
        x = np.load(data, mmap_mode="r")
        self.x = x.reshape(len(x), -1)
        self.m, self.n = self.x.shape
        self.w = np.load(weights, mmap_mode="r").ravel() if weights else np.ones(1)
        if self.n % len(self.w):
            sys.exit(f"{weights}: {len(self.w)} weights do not fit {self.n} unknowns")

    def blocks(self):
        """Snapshots (one a row, without their mean), modes and weights of some unknowns."""
        step = max(1, BLOCK // (8 * self.m))
        for first in range(0, self.n, step):
            part = slice(first, min(first + step, self.n))
            node = np.arange(part.start, part.stop) % len(self.w)
            u = np.array(self.x[:, part], float)
            if self.mean is not None:
                u -= self.mean[part]
            yield u, np.array(self.modes[part]), np.array(self.w[node], float)

    def products(self):
        """Phi^T W Phi, Phi^T W X and X^T W X."""
        among = projected = gram = 0.0
        for u, phi, w in self.blocks():
            among = among + (phi.T * w) @ phi
            projected = projected + (phi.T * w) @ u.T
            gram = gram + (u * w) @ u.T
        return among, projected, gram

    def residual(self, projected):
        """<|u - Phi Phi^T W u|^2>: as differences, not as a difference of energies."""
        total = 0.0
        for u, phi, w in self.blocks():
            total += self.q @ ((u - (phi @ projected).T) ** 2 @ w)
        return total


def defects(pod):
    among, projected, gram = pod.products()
    weight = np.sqrt(pod.m * pod.q)  # sigma^2 = M lambda, whatever the time weights
    energies = np.linalg.eigvalsh(gram * np.outer(weight, weight))[::-1]
    first, r = pod.sigma[0], len(pod.sigma)
    weighted = projected * weight
    correlation = weighted @ weighted.T - np.diag(np.square(pod.sigma))
    left = np.maximum(energies[r:], 0).sum() / pod.m
    return {
        "orthonormal": abs(among - np.eye(r)).max(),
        "coefficients": abs(pod.a - projected).max() / first,
        "uncorrelated": abs(correlation).max() / first**2,
        "singular values": abs(np.linalg.norm(weighted, axis=1) - pod.sigma).max() / first,
        "Gram": abs(energies[:r] - np.square(pod.sigma)).max() / first**2,
        "residual": abs(pod.residual(projected) - left) / (energies.sum() / pod.m),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pod", help="pod.npz of a run")
    parser.add_argument("snapshots", help="NPY file, one snapshot a row")
    parser.add_argument("--weights", help="NPY file, one weight for each unknown or each node")
    parser.add_argument("--tolerance", type=float, default=1e-12)
    options = parser.parse_args()
    found = defects(Pod(options.pod, options.snapshots, options.weights))
    for name, defect in found.items():
        print(f"{name:16}{defect:10.1e}{'' if defect <= options.tolerance else '  too large'}")
    return 0 if all(defect <= options.tolerance for defect in found.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
