"""What a decomposition takes on many machines: the model of docs/scaling.md, from rates measured on one.

    python bench/pod_scaling.py [--terabytes 100] [--snapshots 1000] [--modes 50] [--disk GB/s of all ranks]
"""

import argparse
import math

RATE = 50e9  # flops a core in the sum over rows, measured (docs/benchmarks.md)
READ = 3.4e9  # bytes/s a core decodes from the page cache, measured
MESSAGE = 2.3e9  # bytes/s between two ranks, measured in shared memory; 1.4e9 by TCP
LATENCY = 20e-6  # s a message; 1e-6 in shared memory
MERGE = 2e9  # bytes/s at which two sums are added
DENSE = 25.0  # M^3 flops of the eigenproblem, on rank 0 alone
DENSE_RATE = 15e9


def seconds(ranks, n, m, modes, disk, exact):
    """Time of each part; the slowest leaf of a rank decides."""
    leaf = 8192
    leaves = math.ceil(n / leaf)
    rows = min(n, math.ceil(leaves / ranks) * leaf)
    passes = 3 if exact else 2
    # M x M products over the rows, and numbers in the sums of the passes; svd with a sketch, or without.
    products, sums = 1, [m * m]
    if exact:
        sketched = 2 * m + 64 <= 4096
        products, sums = 2 if sketched else 3, [(2 * m + 64) * m if sketched else m * m, m * m]
    flops = rows * (m * m * products + 4 * m * modes)
    read = passes * max(8 * rows * m / READ, 8 * n * m / disk)
    levels = math.ceil(math.log2(ranks)) if ranks > 1 else 0
    tree = sum(levels * (2 * (LATENCY + 8 * s / MESSAGE) + 8 * s / MERGE) for s in sums)
    dense = DENSE * m**3 / DENSE_RATE
    return flops / RATE, read, tree, dense


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terabytes", type=float, default=100)
    parser.add_argument("--snapshots", type=int, default=1000)
    parser.add_argument("--modes", type=int, default=50)
    parser.add_argument("--disk", type=float, default=500, help="GB/s that the file system gives all ranks")
    options = parser.parse_args()
    n = int(options.terabytes * 1e12 / 8 / options.snapshots)
    print(f"{options.terabytes:g} TB: {n:.3g} unknowns x {options.snapshots} snapshots, file system {options.disk:g} GB/s")
    print(f"{'ranks':>7} {'route':>6} {'products':>10} {'reading':>10} {'tree':>8} {'dense':>8} {'total, s':>10} {'efficiency':>10}")
    for exact in (False, True):
        one = None
        for ranks in (1, 10, 100, 1000, 10_000):
            parts = seconds(ranks, n, options.snapshots, options.modes, options.disk * 1e9, exact)
            total = sum(parts)
            one = one or total
            row = " ".join(f"{part:>{width}.1f}" for part, width in zip(parts, (10, 10, 8, 8)))
            print(f"{ranks:>7} {'svd' if exact else 'auto':>6} {row} {total:>10.1f} {one / ranks / total:>10.2f}")


if __name__ == "__main__":
    main()
