#!/usr/bin/env python3
"""Treats a web-bridge as slow and hostile clients do, all at once, and asks it meanwhile what a browser asks.

usage: hostile_clients.py PORT PID SECONDS

1,000 connections that say nothing; headers that come a byte at a time; readers that never read; bodies of 100 MB; WebSocket messages
without an end; JSON a hundred thousand levels deep. Prints one line of JSON: what was served to the others and how fast, and the memory
(RSS) of the process PID before, at most and after.
"""
import json
import os
import pathlib
import resource
import socket
import statistics
import sys
import threading
import time

PORT, PID, SECONDS = (int(word) for word in sys.argv[1:4])
END = time.monotonic() + SECONDS
IDLE = 1000
HOST = f"Host: 127.0.0.1:{PORT}\r\n".encode()


def memory_mb():
    for line in pathlib.Path(f"/proc/{PID}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1000
    return 0.0


def connect(timeout=5):
    return socket.create_connection(("127.0.0.1", PORT), timeout)


def again_and_again(attack):
    """Until the end, whatever the bridge does about it."""
    while time.monotonic() < END:
        try:
            attack()
        except OSError:
            time.sleep(0.01)


def idle():
    held = []
    while len(held) < IDLE and time.monotonic() < END:
        held.append(connect())
    while time.monotonic() < END:
        time.sleep(0.1)


def slow_header():
    with connect() as connection:
        for byte in b"GET / HTTP/1.1\r\n" + HOST + b"X-Slow: " + b"x" * 10_000:
            if time.monotonic() > END:
                return
            connection.send(bytes([byte]))
            time.sleep(0.2)


def slow_reader():
    with connect() as connection:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        for _ in range(1000):
            connection.send(b"GET /api/state HTTP/1.1\r\n" + HOST + b"\r\n")
        time.sleep(max(0, END - time.monotonic()))


def large_body():
    with connect() as connection:
        connection.send(b"POST /api/command HTTP/1.1\r\n" + HOST + b"Content-Type: application/json\r\nContent-Length: 100000000\r\n\r\n")
        for _ in range(1526):
            connection.send(b" " * 65_536)


def endless_message():
    with connect() as connection:
        connection.send(b"GET /live HTTP/1.1\r\n" + HOST + f"Origin: http://127.0.0.1:{PORT}\r\n".encode() +
                        b"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                        b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n")
        connection.recv(4096)
        first = 0x01
        while time.monotonic() < END:
            connection.send(bytes([first, 0x80 | 126]) + (60_000).to_bytes(2, "big") + bytes(4) + b"x" * 60_000)
            first = 0x00  # goes on, and never ends


def deep_json():
    body = b'{"channel":"CMD_LINK","body":' + b"[" * 100_000 + b"]" * 100_000 + b"}"
    with connect() as connection:
        connection.send(b"POST /api/command HTTP/1.1\r\n" + HOST + b"Content-Type: application/json\r\nContent-Length: " +
                        str(len(body)).encode() + b"\r\n\r\n" + body)
        connection.recv(4096)


def main():
    limit = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(limit, 8192), limit))
    before = most = memory_mb()
    attacks = [idle, slow_header, slow_header, slow_reader, slow_reader, large_body, large_body, endless_message, endless_message,
               deep_json]
    for attack in attacks:
        threading.Thread(target=again_and_again, args=[attack], daemon=True).start()
    times, refused = [], 0
    while time.monotonic() < END:
        began = time.monotonic()
        try:
            with connect() as connection:
                connection.send(b"GET /api/vehicles HTTP/1.1\r\nConnection: close\r\n" + HOST + b"\r\n")
                answer = b""
                while part := connection.recv(65_536):
                    answer += part
            if b" 200 " not in answer[:20]:
                raise OSError
            times.append(time.monotonic() - began)
        except OSError:
            refused += 1
        most = max(most, memory_mb())
        time.sleep(0.1)
    print(json.dumps({"answers": len(times), "refused": refused, "median_ms": round(1000 * statistics.median(times or [0]), 1),
                      "slowest_ms": round(1000 * max(times, default=0), 1), "memory_before_mb": before, "memory_at_most_mb": most,
                      "memory_after_mb": memory_mb()}), flush=True)
    os._exit(0)  # the attackers may hang in a send


if __name__ == "__main__":
    main()
