#!/usr/bin/env python3
"""How much memory flight-experiment takes while it flies a simulated day: simulator, controller and monitor in one process.

usage: memory_over_a_day.py [SCENARIO] [SECONDS]
"""
import pathlib
import subprocess
import sys
import time

BUILD = pathlib.Path(__file__).resolve().parents[2] / "build"


def resident_mb(pid):
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1024
    return None


def watch(child, pause_s):
    """What it takes [MB], looked at again and again until it has ended."""
    samples = []
    while child.poll() is None:
        try:
            if (size := resident_mb(child.pid)) is not None:
                samples.append(size)
        except FileNotFoundError:
            break
        time.sleep(pause_s)
    return samples


def main():
    scenario = sys.argv[1] if len(sys.argv) > 1 else "column"
    seconds = sys.argv[2] if len(sys.argv) > 2 else "86400"
    flight = subprocess.Popen([BUILD / "bin" / "flight-experiment", scenario, "--duration", seconds, "--log-level", "off"],
                              stdout=subprocess.PIPE, text=True)
    samples = watch(flight, 1)
    print("\n".join(flight.stdout.read().splitlines()[-3:]))
    parts = [samples[len(samples) * part // 10] for part in range(10)] + [samples[-1]]
    print("resident, MB, at each tenth of it:", ", ".join(f"{size:.1f}" for size in parts))


if __name__ == "__main__":
    main()
