"""Starts the processes of a flight, waits until they answer, keeps them running, ends them. Called by scripts/run."""

import argparse
import json
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request

import multicast_route

START_TIMEOUT_S = 20
STOP_TIMEOUT_S = 5
# A process that dies this often within this time is not started again.
DEATHS, DEATHS_WITHIN_S = 5, 30

asked_to_end = threading.Event()  # set by Ctrl-C and the like; asking again changes nothing


class StartFailed(Exception):
    pass


class Interrupted(Exception):
    pass


def say(text):
    print(text, flush=True)


def pause():
    if asked_to_end.wait(0.1):
        raise Interrupted


class Process:
    """One program of the flight. `command` is a function, as a recorder needs a new file each time."""

    def __init__(self, name, command, output):
        self.name, self.command, self.output = name, command, output
        self.child = None
        self.deaths = []

    def start(self):
        # In a session of its own, Ctrl-C reaches it through us alone, so that the recorder can end last; and should
        # we be killed outright, the kernel ends it.
        with open(self.output, "ab") as output:
            self.child = subprocess.Popen(["setpriv", "--pdeathsig", "TERM", "--", *self.command()],
                                          stdin=subprocess.DEVNULL, stdout=output, stderr=output,
                                          start_new_session=True)

    def runs(self):
        return self.child is not None and self.child.poll() is None

    def stop(self):
        """Asks it to end."""
        if self.runs():
            self.child.terminate()

    def await_end(self, deadline):
        try:
            self.child.wait(max(0.1, deadline - time.monotonic()))
        except subprocess.TimeoutExpired:
            say(f"{self.name} does not end; killed")
            self.child.kill()
            self.child.wait()

    def how_it_ended(self):
        code = self.child.returncode
        return f"exit code {code}" if code >= 0 else f"signal {-code}"

    def last_lines(self):
        lines = self.output.read_text(errors="replace").splitlines()[-15:]
        return "\n".join("    " + line for line in lines) or "    (it printed nothing)"

    def revive(self):
        """Starts it again after its death, or gives it up and returns False."""
        now = time.monotonic()
        self.deaths = [at for at in self.deaths if now - at < DEATHS_WITHIN_S] + [now]
        if len(self.deaths) >= DEATHS:
            say(f"{self.name} died {DEATHS} times within {DEATHS_WITHIN_S} s ({self.how_it_ended()}) "
                f"and is not started again; the others go on. Its last lines ({self.output}):\n{self.last_lines()}")
            return False
        say(f"{self.name} died ({self.how_it_ended()}): started again")
        self.start()
        return True


class Flight:
    def __init__(self, options):
        self.options = options
        name = f"{options.scenario.stem}-{time.strftime('%Y%m%d-%H%M%S')}"
        self.log = options.root / "logs" / f"{name}.lcm"
        self.folder = options.root / "logs" / name
        self.folder.mkdir(parents=True)
        self.recordings = []
        self.route = multicast_route.Route(options.lcm_url, say)
        binaries = options.root / "build" / "bin"
        scenario = ["--scenario", str(options.scenario)]
        tiles = ["--tiles", str(options.tiles)] if options.tiles else []

        def node(program, *arguments):
            command = [str(binaries / program), "--lcm-url", options.lcm_url, *arguments]
            return Process(program, lambda: command, self.folder / f"{program}.txt")

        self.recorder = Process("lcm-logger", self.record_command, self.folder / "lcm-logger.txt")
        self.nodes = [
            node("web-bridge", "--port", str(options.port), "--web", str(options.root / "web" / "dist"), *tiles),
            node("collision-monitor", *scenario),
            node("formation-controller", *scenario, "--state-file", str(self.folder / "formation-controller.state")),
            node("fleet-simulator", *scenario),
        ]
        # The recorder first and the simulator last: so the log holds the flight from its first tick.
        self.processes = [self.recorder, *self.nodes]

    def record_command(self):
        again = len(self.recordings)
        self.recordings.append(self.log.with_stem(f"{self.log.stem}-{again + 1}") if again else self.log)
        return ["lcm-logger", "--quiet", f"--lcm-url={self.options.lcm_url}", str(self.recordings[-1])]

    def start(self):
        self.route.add_if_missing()
        for process in self.processes:
            process.start()
        deadline = time.monotonic() + START_TIMEOUT_S
        tell_at = time.monotonic() + 1
        while silent := self.silent():
            for process in self.processes:
                if not process.runs():
                    raise StartFailed(f"{process.name} ended at its start ({process.how_it_ended()}). "
                                      f"Its last lines:\n{process.last_lines()}")
            if time.monotonic() > deadline:
                raise StartFailed(f"no answer from {', '.join(silent)} within {START_TIMEOUT_S} s; "
                                  f"what they print is in {self.folder}")
            if tell_at and time.monotonic() > tell_at:
                say("Waiting for the programs to answer ...")
                tell_at = None
            pause()

    def silent(self):
        """Names of the programs that have not been heard yet."""
        heard = set()
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.options.port}/api/state", timeout=2) as answer:
                heard = {beat["heartbeat_node"] for beat in json.load(answer)["heartbeats"]}
        except (urllib.error.URLError, OSError, ValueError):
            pass
        if self.log.exists() and self.log.stat().st_size > 0:
            heard.add(self.recorder.name)
        return [process.name for process in self.processes if process.name not in heard]

    def keep_running(self):
        kept = list(self.processes)
        while kept:
            kept = [process for process in kept if process.runs() or process.revive()]
            pause()
        raise StartFailed("nothing is left running")

    def stop(self):
        """Ends all; the recorder last, so that the log holds everything."""
        for group in (self.nodes, [self.recorder]):
            for process in group:
                process.stop()
            deadline = time.monotonic() + STOP_TIMEOUT_S
            for process in group:
                if process.child:
                    process.await_end(deadline)
        self.route.remove()
        for recording in self.recordings:
            if recording.exists():
                size_mb = recording.stat().st_size / 1e6
                say(f"The log is {os.path.relpath(recording)} ({size_mb:.1f} MB); scripts/replay plays it")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--scenario", type=pathlib.Path, required=True)
    parser.add_argument("--port", type=int, required=True)
    parser.add_argument("--lcm-url", required=True)
    parser.add_argument("--tiles", type=pathlib.Path)
    options = parser.parse_args()

    flight = Flight(options)
    status = 0
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: asked_to_end.set())
    try:
        flight.start()
        say(f"Skein flies {options.scenario.stem}: http://127.0.0.1:{options.port}   (Ctrl-C ends it)")
        flight.keep_running()
    except (StartFailed, multicast_route.RouteFailed) as failure:
        print(f"run: {failure}", file=sys.stderr, flush=True)
        status = 1
    except Interrupted:
        say("\nEnding ...")
    finally:
        flight.stop()
    return status


if __name__ == "__main__":
    sys.exit(main())
