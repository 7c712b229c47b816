"""Memory, time and reading rate of `lumley pod` on a file larger than the memory it is allowed.

    python bench/pod_memory.py --data FOLDER --gigabytes 12 -o FOLDER/pod -- --memory 200MB --threads 2

What follows `--` goes to lumley. Case c of pod_data.py is 1.6 GB; the data are made unless they are there
(200 snapshots; needs numpy). The file is dropped from the system's cache first. `python/check_pod.py` checks
the result.
"""

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
SNAPSHOTS = 200


def make(folder, gigabytes):
    """In a process of its own: the peak memory of a process counts for those that it starts."""
    unknowns = round(gigabytes * 1e9 / 8 / SNAPSHOTS)
    name = f"waves_{unknowns}"
    numbers = (str(unknowns), str(SNAPSHOTS))
    subprocess.run([sys.executable, HERE / "pod_data.py", folder, name, *numbers], check=True)
    return folder / f"{name}.npy", folder / f"{name}_w.npy"


def drop_from_cache(path):
    with open(path, "rb") as file:
        os.fsync(file.fileno())  # only what is on disk can be dropped
        os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)


def run(arguments):
    """Exit code, wall clock in s and resources of a process."""
    start = time.perf_counter()
    process = subprocess.Popen(arguments)
    _, status, used = os.wait4(process.pid, 0)
    return os.waitstatus_to_exitcode(status), time.perf_counter() - start, used


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", type=Path, required=True, help="folder of the snapshots")
    parser.add_argument("--gigabytes", type=float, default=1.6, help="size of the snapshots")
    parser.add_argument("--lumley", type=Path, default=HERE.parent / "target/release/lumley")
    parser.add_argument("--modes", default="20")
    parser.add_argument("-o", "--output", required=True, help="of lumley; a run there is replaced")
    parser.add_argument("more", nargs="*", help="further arguments of lumley, after --")
    options = parser.parse_args()

    data, weights = make(options.data, options.gigabytes)
    drop_from_cache(data)
    files = [data, "--weights", weights, "--force", "-o", options.output]
    code, wall, used = run([options.lumley.resolve(), "pod", *files, "--modes", options.modes, *options.more])
    if code != 0:
        sys.exit(code)
    cpu, size = used.ru_utime + used.ru_stime, data.stat().st_size
    print(f"snapshots          {size / 1e6:10.1f} MB")
    print(f"peak resident      {used.ru_maxrss * 1024 / 1e6:10.1f} MB")
    print(f"wall clock         {wall:10.2f} s")
    print(f"CPU                {cpu:10.2f} s")
    print(f"rate               {size / 1e6 / wall:10.1f} MB/s of snapshots, all passes and output included")


if __name__ == "__main__":
    main()
