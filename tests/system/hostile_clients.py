#!/usr/bin/env python3
"""Treats a web-bridge as slow and hostile clients do, all at once, and asks it meanwhile what a browser asks.

usage: hostile_clients.py PORT PID SECONDS

1,000 connections that say nothing; headers that come a byte at a time; readers that never read, of HTTP and of WebSockets that ask and
ask; bodies of 100 MB; WebSocket messages without an end; JSON a hundred thousand levels deep. Prints one line of JSON: what was served
to the others and how fast (vehicles, and a command of an operator now and then), and the memory (RSS) of the process PID before, at most
since it was started, and after.
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


COMMAND = b'{"channel":"CMD_LINK","body":{"vehicle_id":1,"mode":"restored"}}'  # changes nothing


def memory_mb(kind="VmRSS"):
    for line in pathlib.Path(f"/proc/{PID}/status").read_text().splitlines():
        if line.startswith(kind + ":"):
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


def connect_live():
    connection = connect()
    connection.send(b"GET /live HTTP/1.1\r\n" + HOST + f"Origin: http://127.0.0.1:{PORT}\r\n".encode() +
                    b"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                    b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n")
    connection.recv(4096)
    return connection


def frame(first, text):
    return bytes([first, 0x80 | 126]) + len(text).to_bytes(2, "big") + bytes(4) + text


def endless_message():
    with connect_live() as connection:
        first = 0x01
        while time.monotonic() < END:
            connection.send(frame(first, b"x" * 60_000))
            first = 0x00  # goes on, and never ends


def deaf_asker(id_text):
    """Answers have the id of what is asked, and none is ever dropped."""
    with connect_live() as connection:
        while time.monotonic() < END:
            connection.send(frame(0x81, b'{"type":"command","id":"' + id_text + b'"}'))


def deaf_asker_of_much():
    deaf_asker(os.urandom(30_000).hex().encode())


def deaf_asker_of_what_packs_well():
    deaf_asker(b"x" * 60_000)


def deep_json():
    body = b'{"channel":"CMD_LINK","body":' + b"[" * 100_000 + b"]" * 100_000 + b"}"
    with connect() as connection:
        connection.send(command_request(body))
        connection.recv(4096)


def command_request(body):
    return (b"POST /api/command HTTP/1.1\r\nConnection: close\r\n" + HOST + b"Content-Type: application/json\r\nContent-Length: " +
            str(len(body)).encode() + b"\r\n\r\n" + body)


def serve_time(request):
    """For how long a well-behaved browser waits for its answer [s]."""
    began = time.monotonic()
    with connect() as connection:
        connection.send(request)
        answer = b""
        while part := connection.recv(65_536):
            answer += part
    if b" 200 " not in answer[:20]:
        raise OSError(answer[:200])
    return time.monotonic() - began


def main():
    limit = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(limit, 8192), limit))
    before = memory_mb()
    attacks = [idle, slow_header, slow_header, slow_reader, slow_reader, large_body, large_body, large_body, large_body,
               endless_message, endless_message, deaf_asker_of_much, deaf_asker_of_what_packs_well, deep_json]
    for attack in attacks:
        threading.Thread(target=again_and_again, args=[attack], daemon=True).start()
    times, command_times, refused = [], [], 0
    while time.monotonic() < END:
        try:
            times.append(serve_time(b"GET /api/vehicles HTTP/1.1\r\nConnection: close\r\n" + HOST + b"\r\n"))
            if len(times) % 10 == 0:
                command_times.append(serve_time(command_request(COMMAND)))
        except OSError as error:
            print(error, file=sys.stderr)
            refused += 1
        time.sleep(0.1)
    print(json.dumps({"answers": len(times), "refused": refused, "median_ms": round(1000 * statistics.median(times or [0]), 1),
                      "slowest_ms": round(1000 * max(times, default=0), 1), "commands": len(command_times),
                      "slowest_command_ms": round(1000 * max(command_times, default=0), 1), "memory_before_mb": before,
                      "memory_at_most_mb": memory_mb("VmHWM"), "memory_after_mb": memory_mb()}), flush=True)
    os._exit(0)  # the attackers may hang in a send


if __name__ == "__main__":
    main()
