#!/usr/bin/env python3
"""Makes a long LCM log of a short one: repeats it, each time with later time stamps.

    long_log.py FROM.lcm TO.lcm --megabytes 2000

The stamp of each event is moved, and utime, which is the first field of every message of Skein. Ticks and sequences begin
anew with each copy, as after a restart.
"""
import argparse
import struct

HEADER = struct.Struct(">IqqII")  # magic, number, utime, length of channel, length of data
MAGIC = 0xEDA1DA01
UTIME_AT = 8  # behind the fingerprint
PAUSE_US = 50_000  # between two copies: one tick


def read_events(data):
    """(utime, channel, message) of each whole event."""
    events, at = [], 0
    while at + HEADER.size <= len(data):
        magic, _, utime, channel_size, data_size = HEADER.unpack_from(data, at)
        body = at + HEADER.size + channel_size
        if magic != MAGIC or body + data_size > len(data):
            break
        events.append((utime, data[at + HEADER.size:body], data[body:body + data_size]))
        at = body + data_size
    return events


def moved(message, shift_us):
    if len(message) < UTIME_AT + 8:
        return message
    utime = int.from_bytes(message[UTIME_AT:UTIME_AT + 8], "big", signed=True)
    return message[:UTIME_AT] + (utime + shift_us).to_bytes(8, "big", signed=True) + message[UTIME_AT + 8:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", metavar="FROM.lcm")
    parser.add_argument("target", metavar="TO.lcm")
    parser.add_argument("--megabytes", type=int, default=2000)
    options = parser.parse_args()
    with open(options.source, "rb") as stream:
        events = read_events(memoryview(stream.read()))
    if not events:
        parser.error(f"{options.source}: no LCM log")
    events = [(utime, bytes(channel), bytes(message)) for utime, channel, message in events]
    period_us = events[-1][0] - events[0][0] + PAUSE_US
    number = written = copies = 0
    with open(options.target, "wb", buffering=1 << 20) as out:
        while written < options.megabytes * 1_000_000:
            shift_us = copies * period_us
            for utime, channel, message in events:
                body = moved(message, shift_us)
                header = HEADER.pack(MAGIC, number, utime + shift_us, len(channel), len(body))
                written += out.write(header) + out.write(channel) + out.write(body)
                number += 1
            copies += 1
    print(f"{copies} copies of {period_us / 1e6:.1f} s, {number} events, {written / 1e6:.0f} MB")


if __name__ == "__main__":
    main()
