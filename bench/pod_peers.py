"""Times weighted POD by other tools on snapshots held in memory, as `pod_timing` times lumley.

    python bench/pod_peers.py DATA.npy W.npy TOOL MODES THREADS REPEATS

TOOL is `numpy` (method of snapshots in three lines) or `flowtorch` (its TSQR; needs flowtorch-fluid). Each
repeat prints a line of JSON: times in s, singular values and how far the modes are from orthonormal.
"""

import argparse
import json
import logging
import os
import time


def numpy_gram(xt, w, modes):
    """Returns what does the work and gives modes and singular values."""
    import numpy as np

    def decompose():
        values, vectors = np.linalg.eigh((xt * w) @ xt.T)
        largest = slice(-1, -modes - 1, -1)
        sigma = np.sqrt(values[largest])
        return xt.T @ (vectors[:, largest] / sigma), sigma

    return decompose


def flowtorch_tsqr(xt, w, modes):
    """flowTorch reads blocks of a source; it weighs them by the root of what `read_weight` gives."""
    import torch
    from flowtorch.analysis import SVD
    from flowtorch.analysis.state_vector import FieldSpec, StateVectorLayout, StateVectorSource

    logging.disable(logging.WARNING)
    x, weights = torch.from_numpy(xt).T, torch.from_numpy(w)

    class Source(StateVectorSource):
        n_snapshots = xt.shape[0]
        layout = StateVectorLayout((FieldSpec("u"),), w.shape)

        def read(self, unknowns, snapshots):
            return x[unknowns, snapshots]

        def read_weight(self, unknowns):
            return weights[unknowns]

    def decompose():
        svd = SVD(Source(), rank=modes, spatial_batch_size=BATCH, snapshot_batch_size=xt.shape[0])
        return svd.U.materialize_local().numpy(), svd.s.numpy()

    return decompose


# Unknowns in a block of the TSQR: of 1000 to 100000 the fastest on the larger cases of pod_data.py.
BATCH = 5000

TOOLS = {"numpy": numpy_gram, "flowtorch": flowtorch_tsqr}


def timed(decompose, w):
    import numpy as np

    cpu, wall = time.process_time(), time.perf_counter()
    modes, sigma = decompose()
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    defect = abs((modes.T * w) @ modes - np.eye(modes.shape[1])).max()
    numbers = {"cpu": cpu, "wall": wall, "first": sigma[0], "last": sigma[-1], "defect": defect}
    return {key: float(value) for key, value in numbers.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data")
    parser.add_argument("weights")
    parser.add_argument("tool", choices=TOOLS)
    for number in ("modes", "threads", "repeats"):
        parser.add_argument(number, type=int)
    options = parser.parse_args()
    # These are read when numpy and torch are loaded, hence the late imports.
    for library in ("OMP", "OPENBLAS", "MKL"):
        os.environ[f"{library}_NUM_THREADS"] = str(options.threads)
    import numpy as np

    xt, w = np.load(options.data), np.load(options.weights)
    decompose = TOOLS[options.tool](xt, w, options.modes)
    for _ in range(options.repeats):
        print(json.dumps(timed(decompose, w)), flush=True)


if __name__ == "__main__":
    main()
