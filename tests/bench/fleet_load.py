#!/usr/bin/env python3
"""Flies a large fleet live, with all of Skein's processes and lcm-logger, and tells what it costs and what was lost.

    fleet_load.py [--uavs 1000] [--seconds 600] [--buffer-kb 208] [--also COMMAND] [--build DIR]

CPU is that of each process from when all are heard until the end; memory is what it keeps in RAM at the end. Lost is what a
node missed by its own count (HEARTBEAT), and what of FLEET_STATE and CMD_FLEET is not in the recording. --buffer-kb is the
largest receive buffer that the kernel grants meanwhile (net.core.rmem_max; needs root), its own default unless said otherwise.
--also runs a command beside it, with LCM_DEFAULT_URL and SKEIN_PORT set.
"""
import argparse
import json
import mmap
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

from long_log import HEADER

ROOT = pathlib.Path(__file__).resolve().parents[2]
RMEM_MAX = pathlib.Path("/proc/sys/net/core/rmem_max")
LCM_PORT, PAGE_PORT = 7690, 8190
STATE_KEY = struct.Struct(">8x8xqqii")  # session, tick, chunk, chunks
COMMAND_KEY = struct.Struct(">8x8xq8x8xqii")  # session, tick, chunk, chunks
START_TIMEOUT_S = 60
TICK_S = os.sysconf("SC_CLK_TCK")


def scenario_of(uavs):
    """Vees of ten, 12 km apart, each on its own closed path."""
    def at(east_m, north_m, **more):
        return {"east_m": east_m, "north_m": north_m, "up_m": 800, "speed_m_s": 50, **more}

    turning = {"turn_radius_m": 3000}
    return {
        "name": f"{uavs} UAVs", "duration_s": 86400, "control": "skein",
        "origin": {"latitude_deg": 40.08, "longitude_deg": 116.58, "altitude_m": 0},
        "fleet": {"count": uavs, "formations": max(1, uavs // 10), "shape": "vee", "spacing_m": 250, "lead_m": 1000,
                  "columns": 20, "east_step_m": 12000, "north_step_m": 20000, "scatter_m": 40, "scatter_up_m": 10,
                  "leader": at(0, 0, course_deg=0),
                  "path": {"closed": True, "waypoints": [at(0, 0), at(0, 4000, **turning), at(7000, 4000, **turning),
                                                         at(7000, -7000, **turning), at(0, -7000, **turning)]}}}


class Process:
    def __init__(self, name, pid):
        self.name, self.pid = name, pid
        self.began_s = self.cpu_s()

    def cpu_s(self):
        """User and system time so far [s]."""
        fields = pathlib.Path(f"/proc/{self.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / TICK_S

    def memory_mb(self):
        for line in pathlib.Path(f"/proc/{self.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) / 1000
        return 0.0


def heard():
    """Names of the programs that web-bridge has heard."""
    try:
        with urllib.request.urlopen(f"http://127.0.0.1:{PAGE_PORT}/api/state", timeout=5) as answer:
            return {beat["heartbeat_node"] for beat in json.load(answer)["heartbeats"]}
    except (urllib.error.URLError, OSError, ValueError):
        return set()


def children_of(pid):
    return [int(child) for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def events_of(path):
    """(channel, message) of each event of a log."""
    with open(path, "rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data:
        at = 0
        while at + HEADER.size <= len(data):
            _, _, _, channel_size, data_size = HEADER.unpack_from(data, at)
            body = at + HEADER.size + channel_size
            yield data[at + HEADER.size:body], data[body:body + data_size]
            at = body + data_size


def text_at(message, at):
    size = struct.unpack_from(">i", message, at)[0]
    return message[at + 4:at + 3 + size].decode(), at + 4 + size


def heartbeat(message):
    """(node, gaps, receive buffer)."""
    node, at = text_at(message, 16)
    _, at = text_at(message, at)
    gaps = struct.unpack_from(">q", message, at + 32)[0]
    return node, gaps, struct.unpack_from(">q", message, at + 64)[0]


class Recorded:
    """What a recording holds of a channel that comes in chunks, and what is missing between its first and its last chunk."""

    def __init__(self, key):
        self.key, self.first, self.last, self.count = key, None, None, 0

    def take(self, message):
        _, tick, chunk, chunks = self.key.unpack_from(message)
        self.last = tick * chunks + chunk
        self.first = self.last if self.first is None else self.first
        self.count += 1

    def text(self):
        return f"{self.last - self.first + 1 - self.count} of {self.count}" if self.count else "nothing recorded"


def start_all(started, programs, folder, uavs, url, page_port):
    """Starts all processes of a fleet, with their recording in `folder`, and puts them into `started` by name as it goes."""
    scenario = folder / "scenario.json"
    scenario.write_text(json.dumps(scenario_of(uavs)))
    with_scenario = ["--scenario", str(scenario)]
    commands = {
        "flight-recorder": ["--folder", str(folder), "--split-mb", "1000000", "--quota-gb", "1000", *with_scenario],
        "web-bridge": ["--port", str(page_port), "--web", str(ROOT / "web/dist")],
        "collision-monitor": with_scenario,
        "formation-controller": with_scenario,
        "fleet-simulator": with_scenario,
    }
    for name, arguments in commands.items():
        with open(folder / f"{name}.txt", "wb") as output:
            started[name] = subprocess.Popen([str(programs / name), "--lcm-url", url, *arguments], stdout=output, stderr=output)


def end_all(started):
    """Each hears the end of those before it: the recorder last."""
    for name in reversed(list(started)):
        started[name].terminate()
        started[name].wait(30)


def fly(options, folder):
    url = f"udpm://239.255.76.67:{LCM_PORT}?ttl=0"
    started = {}
    try:
        start_all(started, options.build / "bin", folder, options.uavs, url, PAGE_PORT)
        deadline = time.monotonic() + START_TIMEOUT_S
        while missing := set(started) - heard():
            if time.monotonic() > deadline:
                raise SystemExit(f"not heard within {START_TIMEOUT_S} s: {', '.join(missing)}; see {folder}")
            time.sleep(0.2)
        time.sleep(5)  # the fleet has assembled its picture everywhere
        processes = [Process(name, child.pid) for name, child in started.items()]
        processes += [Process("lcm-logger", pid) for pid in children_of(started["flight-recorder"].pid)]
        also = subprocess.Popen(options.also, shell=True, env={
            **os.environ, "LCM_DEFAULT_URL": url, "SKEIN_PORT": str(PAGE_PORT)}) if options.also else None
        began = time.monotonic()
        while (left_s := began + options.seconds - time.monotonic()) > 0:
            if sys.stderr.isatty():
                print(f"\r{options.uavs} UAVs: {left_s:4.0f} s left ", end="", file=sys.stderr, flush=True)
            time.sleep(min(1, left_s))
        passed_s = time.monotonic() - began
        if also:
            also.wait()
        rows = [(one.name, 100 * (one.cpu_s() - one.began_s) / passed_s, one.memory_mb()) for one in processes]
    finally:
        end_all(started)
    return rows


def report(options, rows, folder):
    lost, buffers = {}, {}
    state, command = Recorded(STATE_KEY), Recorded(COMMAND_KEY)
    for log in sorted(folder.glob("*.lcm*")):
        if log.suffix == ".json":
            continue
        for channel, message in events_of(log):
            if channel == b"FLEET_STATE":
                state.take(message)
            elif channel == b"CMD_FLEET":
                command.take(message)
            elif channel == b"HEARTBEAT":
                node, gaps, buffer = heartbeat(message)
                lost[node], buffers[node] = gaps, buffer
    print(f"{options.uavs} UAVs, {options.seconds} s, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}\n")
    print("| process | CPU, % of one core | memory, MB | buffer, kB | lost |\n|---|---|---|---|---|")
    for name, cpu, memory_mb in rows:
        is_logger = name == "lcm-logger"
        missing = f"{state.text()}; {command.text()}" if is_logger else lost.get(name, "?")
        buffer = "" if is_logger else f"{buffers.get(name, 0) / 1000:.0f}"
        print(f"| {name} | {cpu:.1f} | {memory_mb:.1f} | {buffer} | {missing} |")
    print(f"| all | {sum(cpu for _, cpu, _ in rows):.1f} | {sum(memory for _, _, memory in rows):.1f} | | |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--uavs", type=int, default=1000)
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--buffer-kb", type=float, default=208)
    parser.add_argument("--also", metavar="COMMAND")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the programs were built")
    options = parser.parse_args()
    before = RMEM_MAX.read_text()
    with tempfile.TemporaryDirectory(prefix="skein-fleet-load-") as folder:
        try:
            RMEM_MAX.write_text(str(int(options.buffer_kb * 1024)))
            rows = fly(options, pathlib.Path(folder))
        finally:
            RMEM_MAX.write_text(before)
        report(options, rows, pathlib.Path(folder))


if __name__ == "__main__":
    main()
