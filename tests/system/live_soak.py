#!/usr/bin/env python3
"""Flies a hundred UAVs live for a while, with links that drop at random, and tells what became of memory, ticks and recording.

    live_soak.py [--minutes 30] [--uavs 100] [--drops-a-minute 6] [--seed N] [--build DIR]

Ends with 1 when a process ended or grew by more than 10% and 2 MB from the second tenth of the time to the last, beside the history of
the flight that web-bridge keeps; when more than 0.1% of the commands came later than the next tick, or not at all; when a lost link was
found too late; or when the recording, replayed with lcm-logplayer, does not end in the state in which the flight ended.
"""
import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import time
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/bench"))

from fleet_load import COMMAND_KEY, STATE_KEY, Process, children_of, end_all, start_all  # noqa: E402
from long_log import HEADER  # noqa: E402

LCM_PORT, REPLAY_LCM_PORT, PAGE_PORT, REPLAY_PAGE_PORT = 7692, 7693, 8192, 8193
TICK_US = 50_000
REPLAY_SPEED = 60
# web-bridge keeps the flight since its start for the charts: so much a UAV and second (cpp/recording/history.h), up to two hours.
HISTORY_BYTES = 44


def url_of(port):
    return f"udpm://239.255.76.67:{port}?ttl=0"


def places(port):
    """{id: where it is} as the page is told."""
    with urllib.request.urlopen(f"http://127.0.0.1:{port}/api/vehicles", timeout=5) as answer:
        return {one["id"]: [one[axis] for axis in ("east_m", "north_m", "up_m")] for one in json.load(answer)["vehicles"]}


def await_places(port, count, timeout_s):
    end = time.monotonic() + timeout_s
    while time.monotonic() < end:
        try:
            if len(found := places(port)) == count:
                return found
        except OSError:
            pass
        time.sleep(0.2)
    raise SystemExit(f"the page on port {port} has no {count} UAVs")


def late_commands(logs):
    """(ticks with commands that came later than a tick or never, ticks)."""
    stated, commanded = {}, {}
    for log in logs:
        data, at = log.read_bytes(), 0
        while at + HEADER.size <= len(data):
            _, _, utime, channel_size, data_size = HEADER.unpack_from(data, at)
            body = at + HEADER.size + channel_size
            channel = data[at + HEADER.size:body]
            if channel == b"FLEET_STATE":
                session, tick, _, _ = STATE_KEY.unpack_from(data, body)
                stated.setdefault((session, tick), utime)
            elif channel == b"CMD_FLEET":
                session, tick, _, _ = COMMAND_KEY.unpack_from(data, body)
                commanded.setdefault(tick, utime)
            at = body + data_size
    ticks = sorted(stated)[20:-2]  # once the controller has its picture
    late = sum(1 for key in ticks if commanded.get(key[1], float("inf")) - stated[key] > TICK_US)
    return late, len(ticks)


def fly(options, folder):
    programs = options.build / "bin"
    started, problems, samples = {}, [], {}
    try:
        start_all(started, programs, folder, options.uavs, url_of(LCM_PORT), PAGE_PORT)
        await_places(PAGE_PORT, options.uavs, 60)
        processes = [Process(name, child.pid) for name, child in started.items()]
        processes += [Process("lcm-logger", pid) for pid in children_of(started["flight-recorder"].pid)]
        # The last ones are over before the flight is.
        drops = max(1, int((options.minutes - 1) * options.drops_a_minute))
        report = open(folder / "drops.json", "wb")
        dropper = subprocess.Popen([str(programs / "skein"), "--lcm-url", url_of(LCM_PORT), "drops", "--random", "--count", str(drops),
                                    "--rate", str(options.drops_a_minute), "--seed", str(options.seed), "--shortest", "6",
                                    "--longest", "40", "--json"], stdout=report, stderr=subprocess.DEVNULL)
        began = time.monotonic()
        while (left_s := began + 60 * options.minutes - time.monotonic()) > 0:
            if sys.stderr.isatty():
                print(f"\r{left_s / 60:5.1f} min left ", end="", file=sys.stderr, flush=True)
            time.sleep(min(6 * options.minutes / 10, left_s))
            for one in processes:
                samples.setdefault(one.name, []).append(one.memory_mb())
        problems += [f"{name} has ended" for name, child in started.items() if child.poll() is not None]
        if dropper.wait(180) != 0:
            problems.append("a lost link was missed, or found late")
        started["fleet-simulator"].terminate()
        started["fleet-simulator"].wait(10)
        time.sleep(1)
        end = places(PAGE_PORT)
    finally:
        end_all(started)
    return samples, end, problems


def replayed(options, logs, speed=REPLAY_SPEED):
    """{id: where it is} on the page after lcm-logplayer has played the logs."""
    bridge = subprocess.Popen([str(options.build / "bin/web-bridge"), "--lcm-url", url_of(REPLAY_LCM_PORT), "--port",
                               str(REPLAY_PAGE_PORT), "--replay", logs[0].name, "--replay-speed", str(speed)],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        time.sleep(1)
        for log in logs:
            subprocess.run(["lcm-logplayer", f"--speed={speed}", f"--lcm-url={url_of(REPLAY_LCM_PORT)}",
                            "--regexp=(?!CMD_).*", str(log)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(1)
        return places(REPLAY_PAGE_PORT)
    finally:
        bridge.terminate()
        bridge.wait(10)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--uavs", type=int, default=100)
    parser.add_argument("--drops-a-minute", type=float, default=6)
    parser.add_argument("--seed", type=int, default=random.randrange(1 << 31))
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the programs were built")
    options = parser.parse_args()
    print(f"{options.uavs} UAVs, {options.minutes:g} min, {options.drops_a_minute:g} drops a minute, seed {options.seed}", flush=True)
    with tempfile.TemporaryDirectory(prefix="skein-live-soak-") as name:
        folder = pathlib.Path(name)
        samples, end, problems = fly(options, folder)
        print("\n| process | memory at each tenth, MB |\n|---|---|")
        for process, memory in samples.items():
            tenths = [memory[min(len(memory) - 1, i * len(memory) // 10)] for i in range(1, 10)] + [memory[-1]]
            print(f"| {process} | {' '.join(f'{mb:.1f}' for mb in tenths)} |")
            history_mb = HISTORY_BYTES * options.uavs * 0.9 * 60 * options.minutes / 1e6 if process == "web-bridge" else 0
            if tenths[-1] - history_mb > 1.1 * tenths[1] and tenths[-1] - history_mb > tenths[1] + 2:
                problems.append(f"{process} grew from {tenths[1]:.1f} to {tenths[-1]:.1f} MB")
        summary = json.loads((folder / "drops.json").read_text() or "{}").get("summary")
        print(f"\ndrops: {json.dumps(summary)}")
        logs = sorted(log for log in folder.glob("*.lcm*") if log.suffix != ".json")
        late, ticks = late_commands(logs)
        print(f"late or missing commands: {late} of {ticks} ticks ({100 * late / max(1, ticks):.3f}%)")
        if late > 0.001 * ticks:
            problems.append("more than 0.1% of the commands came late")
        apart = sum(1 for key, place in replayed(options, logs).items() if end.get(key) != place)
        print(f"replayed to its end: {apart} of {len(end)} UAVs elsewhere than they were")
        if apart:
            problems.append("the recording does not end as the flight did")
    for problem in problems:
        print("FAILED:", problem)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
