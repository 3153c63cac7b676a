"""The multicast route that LCM needs on a host without a network: for its own group only, while a flight lasts."""

import os
import re
import subprocess

GROUP = "239.255.76.67"


class RouteFailed(Exception):
    pass


class Route:
    def __init__(self, lcm_url, say):
        # With ttl > 0 the traffic is meant for the network: a route through the loopback would keep it from there.
        stays_here = re.search(r"[?&]ttl=0\b", lcm_url) is not None
        self.wanted = lcm_url.startswith(f"udpm://{GROUP}:") and stays_here
        self.say = say
        self.added = False

    def add_if_missing(self):
        if not self.wanted or _ip("route", "get", GROUP).returncode == 0:
            return
        command = _as_root("ip", "route", "add", f"{GROUP}/32", "dev", "lo")
        if subprocess.run(command, capture_output=True).returncode != 0:
            raise RouteFailed(f"this machine has no route for multicast, and adding one is not permitted; "
                              f"do it by hand:\n"
                              f"    sudo ip route add {GROUP}/32 dev lo\n"
                              f"and when you are done:\n"
                              f"    sudo ip route del {GROUP}/32 dev lo")
        self.added = True
        self.say(f"No route for multicast: added {GROUP}/32 on lo, taken back at the end")

    def remove(self):
        if self.added:
            subprocess.run(_as_root("ip", "route", "del", f"{GROUP}/32", "dev", "lo"), capture_output=True)
            self.say(f"Route {GROUP}/32 on lo taken back")


def _ip(*arguments):
    return subprocess.run(["ip", *arguments], capture_output=True)


def _as_root(*command):
    return list(command) if os.geteuid() == 0 else ["sudo", "-n", *command]
