#!/usr/bin/env python3
"""The multicast route that LCM needs on a host without a network: for its own group only, while somebody needs it.

    multicast_route.py LCM_URL

Holds it for a shell script: adds it if it is missing, says "ready" on standard output, and releases it when its
standard input ends, also when whoever started it was killed. What it does it tells on standard error.
"""

import contextlib
import fcntl
import os
import pathlib
import re
import secrets
import signal
import socket
import subprocess
import sys

GROUP = "239.255.76.67"
ROUTE = [f"{GROUP}/32", "dev", "lo"]
# Marks the route as one that Skein added, whichever flight it was: the kernel keeps the number for us.
PROTOCOL = ["proto", "76"]
# Whoever needs the route binds such a name. The kernel keeps these for each network by itself, as it does routes, and
# forgets them with their process.
HOLDER = "skein-multicast-route-"


class RouteFailed(Exception):
    pass


class Route:
    def __init__(self, lcm_url, say):
        # With ttl > 0 the traffic is meant for the network: a route through the loopback would keep it from there.
        stays_here = re.search(r"[?&]ttl=0\b", lcm_url) is not None
        self.wanted = lcm_url.startswith(f"udpm://{GROUP}:") and stays_here
        self.say = say
        self.holder = socket.socket(socket.AF_UNIX)

    def hold(self):
        """Adds the route if it is missing. Raises RouteFailed."""
        if not self.wanted:
            return
        with _alone():
            self._hold()

    def _hold(self):
        self.holder.bind(f"\0{HOLDER}{secrets.token_hex(8)}")
        if _ip("route", "get", GROUP).returncode == 0:
            return
        if subprocess.run(_as_root("ip", "route", "add", *ROUTE, *PROTOCOL), capture_output=True).returncode != 0:
            raise RouteFailed(f"this machine has no route for multicast, and adding one is not permitted; "
                              f"do it by hand:\n"
                              f"    sudo ip route add {' '.join(ROUTE)}\n"
                              f"and when you are done:\n"
                              f"    sudo ip route del {' '.join(ROUTE)}")
        self.say(f"No route for multicast: added {GROUP}/32 on lo, taken back at the end")

    def release(self):
        """Takes back a route that Skein has added, unless another flight needs it."""
        with _alone():
            self._release()

    def _release(self):
        self.holder.close()
        if not self.wanted or not _ip("route", "show", *ROUTE, *PROTOCOL).stdout:
            return
        # Names of others may be any bytes.
        if f"@{HOLDER}".encode() in pathlib.Path("/proc/net/unix").read_bytes():
            self.say(f"Route {GROUP}/32 on lo stays: another flight needs it")
        elif subprocess.run(_as_root("ip", "route", "del", *ROUTE, *PROTOCOL), capture_output=True).returncode == 0:
            self.say(f"Route {GROUP}/32 on lo taken back")


@contextlib.contextmanager
def _alone():
    """One flight after the other: between looking and doing nobody else adds the route or takes it back."""
    with open(__file__, "rb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _ip(*arguments):
    return subprocess.run(["ip", *arguments], capture_output=True)


def _as_root(*command):
    return list(command) if os.geteuid() == 0 else ["sudo", "-n", *command]


def main():
    # Ctrl-C goes to all of a terminal's processes, and the flight still needs the route while it ends.
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    route = Route(sys.argv[1], lambda text: print(text, file=sys.stderr, flush=True))
    try:
        route.hold()
    except RouteFailed as failure:
        sys.exit(str(failure))
    print("ready", flush=True)
    sys.stdin.read()
    route.release()


if __name__ == "__main__":
    main()
