#!/usr/bin/env python3
"""Flies for hours of simulated time with all of Skein's nodes in one process, and tells what became of its memory and its log.

    simulated_soak.py [--hours 8] [--scenario triangle] [--build DIR]

Ends with 1 when the flight failed; when memory grew by more than 10% and 2 MB from the second tenth of the time to the last; or when the
log, replayed with lcm-logplayer, does not end where the UAVs were at the end of the flight.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests/bench"), str(ROOT / "tests/system")]

from live_soak import replayed  # noqa: E402
from memory_over_a_day import watch  # noqa: E402

REPLAY_SPEED = 200
NEAR_M = 0.1  # the CSV has millimetres, the page single precision


def fly(options, folder):
    """@return (exit code, MB resident, a few times a second)."""
    flight = subprocess.Popen([str(options.build / "bin/flight-experiment"), options.scenario, "--duration", str(3600 * options.hours),
                               "--csv", str(folder / "flight.csv"), "--log", str(folder / "flight.lcm"), "--log-level", "off"],
                              stdout=open(folder / "summary.txt", "wb"))
    samples = watch(flight, 0.05)
    return flight.wait(), samples


def last_places(file):
    """{id: where it is} in the last rows of a CSV of flight-experiment."""
    with open(file, "rb") as whole:
        names = whole.readline().decode().strip().split(",")
        whole.seek(-min(1 << 20, file.stat().st_size), 2)
        lines = whole.read().decode().splitlines()[1:]
    rows = list(csv.DictReader(lines, fieldnames=names))
    return {int(row["vehicle_id"]): [float(row[axis]) for axis in ("east_m", "north_m", "up_m")]
            for row in rows if row["t_s"] == rows[-1]["t_s"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hours", type=float, default=8)
    parser.add_argument("--scenario", default="triangle")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the programs were built")
    options = parser.parse_args()
    problems = []
    with tempfile.TemporaryDirectory(prefix="skein-simulated-soak-") as name:
        folder = pathlib.Path(name)
        exit_code, samples = fly(options, folder)
        print((folder / "summary.txt").read_text())
        if exit_code != 0:
            problems.append(f"flight-experiment ended with {exit_code}")
        tenths = [samples[min(len(samples) - 1, i * len(samples) // 10)] for i in range(1, 10)] + [samples[-1]]
        print(f"memory at each tenth, MB: {' '.join(f'{mb:.1f}' for mb in tenths)}")
        if tenths[-1] > max(1.1 * tenths[1], tenths[1] + 2):
            problems.append(f"memory grew from {tenths[1]:.1f} to {tenths[-1]:.1f} MB")
        log = folder / "flight.lcm"
        print(f"log: {log.stat().st_size / 1e6:.0f} MB; replayed at {REPLAY_SPEED} times its speed ...", flush=True)
        end, again = last_places(folder / "flight.csv"), replayed(options, [log], REPLAY_SPEED)
        apart = [vehicle for vehicle in end if math.dist(end[vehicle], again.get(vehicle, [math.inf] * 3)) > NEAR_M]
        print(f"replayed to its end: {len(apart)} of {len(end)} UAVs elsewhere than they were")
        if apart or not end:
            problems.append("the log does not end as the flight did")
    for problem in problems:
        print("FAILED:", problem)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
