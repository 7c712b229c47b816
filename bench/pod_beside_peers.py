"""POD of lumley beside other tools on the same data: CPU time of weighted POD, one process each, in turns.

    cargo build --release --manifest-path bench/Cargo.toml --bin pod_timing
    python bench/pod_beside_peers.py --data FOLDER --cases a,b,c --rounds 5

Needs numpy, and flowtorch-fluid for its row. A process loads the data, then decomposes them several times:
its fastest run counts, as the first one pays for fresh memory. What is compared was measured in the same
round. Missing data are made (pod_data.py); all three cases take 2.5 GB on disk, and c 5 GB of memory.
"""

import argparse
import importlib.util
import json
import statistics
import subprocess
import sys
from pathlib import Path

import pod_data

HERE = Path(__file__).resolve().parent
LUMLEY = ("auto", "svd")
BASES = ("numpy", "flowtorch")


def command(name, options, case, threads):
    """The same arguments for lumley's timing and for that of the others."""
    data, weights = pod_data.paths(options.data, case)
    peers = [sys.executable, HERE / "pod_peers.py"]
    program = [options.pod_timing.resolve()] if name in LUMLEY else peers
    numbers = [options.modes, threads, options.repeats]
    return [str(part) for part in (*program, data, weights, name, *numbers)]


def best(name, options, case, threads):
    """The fastest run of one process, and the worst of its modes."""
    arguments = command(name, options, case, threads)
    output = subprocess.run(arguments, check=True, stdout=subprocess.PIPE, text=True).stdout
    runs = [json.loads(line) for line in output.splitlines()]
    return {
        "cpu": min(run["cpu"] for run in runs),
        "wall": min(run["wall"] for run in runs),
        "defect": max(run["defect"] for run in runs),
    }


def measure(options, case):
    """For each round, the results under (name, threads)."""
    bases = [name for name in BASES if name == "numpy" or importlib.util.find_spec(name)]
    contestants = [(name, options.threads) for name in (*bases, *LUMLEY)]
    contestants += [(name, 2 * options.threads) for name in LUMLEY]
    rounds = []
    for k in range(options.rounds):
        rounds.append({c: best(c[0], options, case, c[1]) for c in contestants})
        print(f"case {case}: round {k + 1} of {options.rounds}", file=sys.stderr)
    return bases, rounds


def summary(values):
    return f"{statistics.median(values):8.2f} {min(values):6.2f}"


def table(options, case, bases, rounds):
    """Median and least of the ratios, and of the speed-up by twice the threads."""
    one, two = options.threads, 2 * options.threads
    n, m, _ = pod_data.CASES[case]
    print(f"\n{case}: {n} unknowns x {m} snapshots, {options.modes} modes, {one} thread(s)")
    against = "".join(f"{'to ' + base:>16}" for base in bases)
    print(f"{'':10}{'CPU s':>16}{against}{'speed-up':>16}{'defect':>10}   (median, least)")
    for name in (*bases, *LUMLEY):
        own = [results[name, one] for results in rounds]
        columns = [summary([result["cpu"] for result in own])]
        for base in bases:
            columns.append(summary([r[name, one]["cpu"] / r[base, one]["cpu"] for r in rounds]))
        speedup = [r[name, one]["wall"] / r[name, two]["wall"] for r in rounds if (name, two) in r]
        columns.append(summary(speedup) if speedup else "")
        defect = max(result["defect"] for result in own)
        print(f"{name:10}" + "".join(f"{c:>16}" for c in columns) + f"{defect:10.1e}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", type=Path, required=True, help="folder of the data sets")
    parser.add_argument("--cases", default="a,b,c", help="of pod_data.py, separated by commas")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--repeats", type=int, default=3, help="runs in a process")
    parser.add_argument("--threads", type=int, default=1, help="the speed-up is that of twice as many")
    parser.add_argument("--modes", type=int, default=20)
    parser.add_argument("--pod-timing", type=Path, default=HERE / "target/release/pod_timing")
    options = parser.parse_args()
    for case in options.cases.split(","):
        pod_data.write(options.data, case, *pod_data.CASES[case])
        table(options, case, *measure(options, case))


if __name__ == "__main__":
    main()
