#!/usr/bin/env python3
"""Stands for many browsers that look at a flight, and tells what each is sent.

    browsers.py [--count 100] [--slow 0] [--seconds 20] [--port 8080]

Each is a WebSocket to web-bridge that reads whatever comes. --slow of them read next to nothing: 2 kB a second.
"""
import argparse
import base64
import os
import selectors
import socket
import time

SLOW_READ, SLOW_PAUSE_S = 200, 0.1


class Browser:
    def __init__(self, port, slow):
        self.slow, self.bytes, self.frames, self.rest, self.skip, self.read_at = slow, 0, 0, b"", 0, 0.0
        self.socket = socket.socket()
        if slow:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.socket.connect(("127.0.0.1", port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /live HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        head = b""
        while b"\r\n\r\n" not in head:
            head += self.socket.recv(1)
        if b" 101 " not in head.split(b"\r\n")[0]:
            raise SystemExit(head.decode())
        self.socket.setblocking(False)

    def read(self):
        data = self.socket.recv(SLOW_READ if self.slow else 1 << 20)
        if not data:
            raise SystemExit("web-bridge has closed a connection")
        self.bytes += len(data)
        self.count_frames(data)

    def count_frames(self, data):
        """Steps from header to header; what is in between is passed over."""
        if self.skip >= len(data):
            self.skip -= len(data)
            return
        data = self.rest + data[self.skip:]
        at = 0
        while at + 10 <= len(data):
            size, head = data[at + 1] & 127, 2
            if size == 126:
                size, head = int.from_bytes(data[at + 2:at + 4], "big"), 4
            elif size == 127:
                size, head = int.from_bytes(data[at + 2:at + 10], "big"), 10
            at += head + size
            self.frames += 1
        self.rest, self.skip = data[at:], max(0, at - len(data))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--slow", type=int, default=0)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--port", type=int, default=int(os.environ.get("SKEIN_PORT", 8080)))
    options = parser.parse_args()
    browsers = [Browser(options.port, slow=i < options.slow) for i in range(options.count)]
    selector = selectors.DefaultSelector()
    for browser in browsers:
        selector.register(browser.socket, selectors.EVENT_READ, browser)

    def listen(seconds):
        end = time.monotonic() + seconds
        while (left_s := end - time.monotonic()) > 0:
            now = time.monotonic()
            for key, _ in selector.select(min(left_s, SLOW_PAUSE_S)):
                browser = key.data
                if browser.slow and now < browser.read_at:
                    continue
                browser.read_at = now + SLOW_PAUSE_S
                browser.read()

    listen(2)  # the whole picture that each is sent first
    for browser in browsers:
        browser.bytes = browser.frames = 0
    began = time.monotonic()
    listen(options.seconds)
    passed_s = time.monotonic() - began
    for kind, some in (("", [one for one in browsers if not one.slow]), ("slow ", [one for one in browsers if one.slow])):
        if some:
            rates = sorted(one.bytes / passed_s / 1000 for one in some)
            frames = sorted(one.frames / passed_s for one in some)
            print(f"{len(some)} {kind}browsers: {rates[0]:.1f} to {rates[-1]:.1f} kB/s each, "
                  f"{frames[0]:.1f} to {frames[-1]:.1f} messages/s")


if __name__ == "__main__":
    main()
