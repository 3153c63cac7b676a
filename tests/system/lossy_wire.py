#!/usr/bin/env python3
"""A hub of network interfaces that loses, delays, reorders and doubles frames: what tc netem does, on any kernel.

usage: lossy_wire.py INTERFACE INTERFACE...

Each line of standard input is a JSON object of what holds from then on, and of nothing else: {"loss": 0.1, "delay_s": 0.2,
"jitter_s": 0.05, "duplicate": 0.02, "apart": ["to-sim"]}. A frame is delayed by delay_s give or take jitter_s, so they overtake one
another; who is apart hears nobody and is not heard. Ends with standard input. Prints the seed.
"""
import heapq
import json
import random
import select
import socket
import sys
import time

ETH_P_ALL = 3
LARGEST_FRAME = 65536


def open_interface(name):
    interface = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ETH_P_ALL))
    interface.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
    interface.bind((name, ETH_P_ALL))
    interface.setblocking(False)
    return interface


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    seed = random.randrange(1 << 32)
    print("seed", seed, flush=True)
    chance = random.Random(seed)
    interfaces = {open_interface(name): name for name in sys.argv[1:]}
    wire = {}
    waiting = []  # (when, number, interface, frame)
    number = 0

    def send(interface, frame):
        try:
            interface.send(frame)
        except OSError:
            pass  # an interface that is down

    def pass_on(source, frame):
        nonlocal number
        for target, name in interfaces.items():
            if target is source or {name, interfaces[source]} & set(wire.get("apart", [])):
                continue
            for _ in range(2 if chance.random() < wire.get("duplicate", 0) else 1):
                if chance.random() < wire.get("loss", 0):
                    continue
                delay_s = wire.get("delay_s", 0) + chance.uniform(-1, 1) * wire.get("jitter_s", 0)
                if delay_s <= 0:
                    send(target, frame)
                else:
                    number += 1
                    heapq.heappush(waiting, (time.monotonic() + delay_s, number, target, frame))

    while True:
        patience = max(0, waiting[0][0] - time.monotonic()) if waiting else None
        readable, _, _ = select.select([sys.stdin, *interfaces], [], [], patience)
        while waiting and waiting[0][0] <= time.monotonic():
            _, _, target, frame = heapq.heappop(waiting)
            send(target, frame)
        for source in readable:
            if source is sys.stdin:
                line = sys.stdin.readline()
                if not line:
                    return
                wire = json.loads(line)
                continue
            try:
                frame, (_, _, packet_type, *_) = source.recvfrom(LARGEST_FRAME)
            except OSError:
                continue
            if packet_type != socket.PACKET_OUTGOING:
                pass_on(source, frame)


if __name__ == "__main__":
    main()
