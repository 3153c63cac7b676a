#!/usr/bin/env python3
"""Sends random and mutated datagrams to an LCM bus: noise, headers that lie, and what is really said there with some bytes changed.

usage: hostile_datagrams.py GROUP PORT COUNT RATE SEED

Two fragments that crash LCM 1.3.1 itself (upstream pull request 628) come about by themselves now and then.
"""
import random
import select
import socket
import struct
import sys
import time

SHORT, FRAGMENT = 0x4C433032, 0x4C433033
CHANNELS = [b"FLEET_STATE", b"CMD_FLEET", b"FLEET_ROSTER", b"HEARTBEAT", b"CMD_LINK", b"FORMATION", b"x" * 70, b"", b"\xff\x00"]


def mutated(datagram, rng):
    data = bytearray(datagram)
    for _ in range(rng.choice((1, 1, 2, 8))):
        if not data:
            break
        # Not the channel's name: what nobody has subscribed to is heard by nobody.
        at = rng.randrange(min(24, len(data) - 1), len(data))
        kind = rng.randrange(4)
        if kind == 0:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            data[at] = rng.randrange(256)
        elif kind == 2:
            data[at:at + 8] = rng.choice((b"\x7f\xf0" + bytes(6), b"\xff" * 8, b"\x7f" + b"\xff" * 7, bytes(8)))
        else:
            del data[at:]
            break
    return bytes(data)


def made_up(rng):
    kind = rng.randrange(4)
    noise = rng.randbytes(rng.choice((0, 1, 7, 8, 9, 20, 100, 1400)))
    if kind == 0:
        return noise
    if kind == 1:
        return struct.pack(">II", SHORT, rng.getrandbits(32)) + rng.choice(CHANNELS) + rng.choice((b"\0", b"")) + noise
    size, offset = rng.choice((0, 1, 100, 1 << 16, 1 << 31, (1 << 32) - 1)), rng.getrandbits(32)
    number, count = rng.choice((0, 1, 65535)), rng.choice((0, 1, 2, 65535))
    header = struct.pack(">IIIIHH", FRAGMENT, rng.getrandbits(4), size, offset if kind == 2 else 0, number, count)
    return header + (rng.choice(CHANNELS) + b"\0" if number == 0 else b"") + noise


def main():
    group, port, count, rate, seed = sys.argv[1], *(int(text) for text in sys.argv[2:])
    rng = random.Random(seed)
    bus = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    bus.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    bus.bind(("", port))
    bus.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, struct.pack("4sl", socket.inet_aton(group), socket.INADDR_ANY))
    bus.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
    heard = []
    start = time.monotonic()
    for sent in range(count):
        due = start + sent / rate
        while (left := due - time.monotonic()) > 0:
            if select.select([bus], [], [], left)[0] and len(heard) < 2000:
                heard.append(bus.recv(65536))
            elif len(heard) >= 2000:
                time.sleep(min(left, 0.01))
        datagram = mutated(rng.choice(heard), rng) if len(heard) > 50 and rng.random() < 0.7 else made_up(rng)
        bus.sendto(datagram, (group, port))
    print(f"{count} datagrams in {time.monotonic() - start:.1f} s")


if __name__ == "__main__":
    main()
