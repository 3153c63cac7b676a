"""Starts the processes of a flight, waits until they answer, keeps them running, ends them. Called by scripts/run."""

import argparse
import json
import os
import pathlib
import select
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request

import multicast_route

START_TIMEOUT_S = 20
STOP_TIMEOUT_S = 5
# Without a recording, for want of room say, the flight begins all the same: the page tells.
RECORDING_TIMEOUT_S = 2
# A process that dies this often in a row, each time so soon after its start, is started again only every RETRY_S: something is
# wrong with it, or somebody on the network ends it again and again.
SHORT_LIVES, SHORT_LIFE_S, RETRY_S = 5, 5, 5

# Holds something to read once Ctrl-C or the like has asked to end; asking again changes nothing. The interpreter writes
# it: a threading.Event that a signal sets is locked for ever when the signal comes while it is looked at or set.
asked_to_end, asks_to_end = os.pipe()  # neither of which children inherit


class StartFailed(Exception):
    pass


class Interrupted(Exception):
    pass


def say(text):
    print(text, flush=True)


def page_address(options):
    """Where this machine's own browser finds the page."""
    host = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(options.listen, options.listen)
    return f"http://[{host}]:{options.port}" if ":" in host else f"http://{host}:{options.port}"


def pause(seconds=0.1):
    if select.select([asked_to_end], [], [], seconds)[0]:
        raise Interrupted


class Process:
    """One program of the flight."""

    def __init__(self, name, command, output):
        self.name, self.command, self.output = name, command, output
        self.child = None
        self.started = 0.0
        self.died = None  # since when it is to be started again
        self.short_lives = 0

    def start(self):
        # In a session of its own, Ctrl-C reaches it through us alone, so that the recorder can end last; and should
        # we be killed outright, the kernel ends it.
        self.started = time.monotonic()
        with open(self.output, "ab") as output:
            self.child = subprocess.Popen(["setpriv", "--pdeathsig", "TERM", "--", *self.command],
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

    def tend(self):
        """Starts it again after its death: at once, or now and then when it never lives for long."""
        if self.runs():
            return
        now = time.monotonic()
        if self.died is None:
            self.died = now
            self.short_lives = self.short_lives + 1 if now - self.started < SHORT_LIFE_S else 0
            if self.short_lives < SHORT_LIVES:
                say(f"{self.name} died ({self.how_it_ended()}): started again")
            elif self.short_lives == SHORT_LIVES:
                say(f"{self.name} died {SHORT_LIVES} times in a row within {SHORT_LIFE_S} s of its start ({self.how_it_ended()}) "
                    f"and is started again every {RETRY_S} s now; the others go on. Its last lines ({self.output}):\n"
                    f"{self.last_lines()}")
        if self.short_lives < SHORT_LIVES or now >= self.died + RETRY_S:
            self.died = None
            self.start()


class Flight:
    def __init__(self, options):
        self.options = options
        self.start_utime = time.time() * 1e6
        self.logs = options.root / "logs"
        self.folder = self.logs / f"{options.scenario.stem}-{time.strftime('%Y%m%d-%H%M%S')}"
        self.folder.mkdir(parents=True)
        self.route = multicast_route.Route(options.lcm_url, say)
        binaries = options.root / "build" / "bin"
        scenario = ["--scenario", str(options.scenario)]
        tiles = ["--tiles", str(options.tiles)] if options.tiles else []
        names = [argument for name in options.allow_host for argument in ("--allow-host", name)]
        access = ["--listen", options.listen, *names, *(["--tokens"] if options.tokens else [])]

        def state(program):
            return ["--state-file", str(self.folder / f"{program}.state")]

        def node(program, *arguments):
            command = [str(binaries / program), "--lcm-url", options.lcm_url, *arguments]
            return Process(program, command, self.folder / f"{program}.txt")

        self.recorder = node("flight-recorder", "--folder", str(self.logs), *scenario)
        self.simulator = node("fleet-simulator", *scenario, *state("fleet-simulator"))
        self.nodes = [
            node("web-bridge", "--port", str(options.port), "--web", str(options.root / "web" / "dist"),
                 "--logs", str(self.logs), *tiles, *access, *state("web-bridge")),
            node("collision-monitor", *scenario, *state("collision-monitor")),
            node("formation-controller", *scenario, *state("formation-controller")),
            self.simulator,
        ]
        self.processes = [self.recorder, *self.nodes]

    def recordings(self):
        """What flight-recorder has recorded on this bus since the start: (file, number of files, bytes), by its cards."""
        found = []
        for card in sorted(self.logs.glob("*.lcm.json")):
            try:
                content = json.loads(card.read_text())
                files = [self.logs / part["file"] for part in content["parts"]]
                sizes = [file.stat().st_size for file in files if file.exists()]
                if content["lcm_url"] == self.options.lcm_url and content["start_utime"] > self.start_utime and sizes:
                    found.append((card.with_suffix(""), len(sizes), sum(sizes)))
            except (OSError, ValueError, KeyError, TypeError):
                pass  # just being written, or somebody else's
        return found

    def start(self):
        self.route.hold()
        for process in self.processes:
            if process is not self.simulator:
                process.start()
        # Something is recorded before the simulator starts: so the log holds the flight from its first tick.
        recording_by = time.monotonic() + RECORDING_TIMEOUT_S
        while not self.recordings() and self.recorder.runs() and time.monotonic() < recording_by:
            pause(0.01)
        self.simulator.start()
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
            with urllib.request.urlopen(f"{page_address(self.options)}/api/health", timeout=2) as answer:
                heard = set(json.load(answer)["nodes"])
        except (urllib.error.URLError, OSError, ValueError):
            pass
        return [process.name for process in self.processes if process.name not in heard]

    def keep_running(self):
        while True:
            for process in self.processes:
                process.tend()
            pause()

    def stop(self):
        """Ends all; the recorder last, so that the log holds everything."""
        for group in (self.nodes, [self.recorder]):
            for process in group:
                process.stop()
            deadline = time.monotonic() + STOP_TIMEOUT_S
            for process in group:
                if process.child:
                    process.await_end(deadline)
        self.route.release()
        for file, count, size in self.recordings():
            files = "" if count == 1 else f" in {count} files"
            say(f"The log is {os.path.relpath(file)} ({size / 1e6:.1f} MB{files}); scripts/replay plays it")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--scenario", type=pathlib.Path, required=True)
    parser.add_argument("--port", type=int, required=True)
    parser.add_argument("--lcm-url", required=True)
    parser.add_argument("--tiles", type=pathlib.Path)
    parser.add_argument("--listen", default="127.0.0.1")
    parser.add_argument("--tokens", action="store_true")
    parser.add_argument("--allow-host", action="append", default=[])
    options = parser.parse_args()

    flight = Flight(options)
    status = 0
    os.set_blocking(asks_to_end, False)
    signal.set_wakeup_fd(asks_to_end, warn_on_full_buffer=False)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: None)
    try:
        flight.start()
        say(f"Skein flies {options.scenario.stem}: {page_address(options)}   (Ctrl-C ends it)")
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
