#!/usr/bin/env python3
"""Puts nginx with TLS before a web-bridge, as deploy/nginx/skein.conf does it, and goes through it as a browser would.

usage: tls_proxy.py CONFIGURATION FOLDER BRIDGE_PORT TOKEN

CONFIGURATION is tried as it is, but for ports and paths. Exit code 77: nginx or openssl is not there.
"""
import http.client
import json
import pathlib
import re
import shutil
import socket
import ssl
import subprocess
import sys
import time

HOST = "ground.example.org"


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def check(condition, what):
    if not condition:
        sys.exit(f"not so: {what}")


def main():
    configuration, folder, bridge_port, token = sys.argv[1:]
    nginx = shutil.which("nginx", path="/usr/sbin:/usr/bin")
    if not nginx or not shutil.which("openssl"):
        print("nginx or openssl is not installed")
        sys.exit(77)
    folder = pathlib.Path(folder)
    cert, key = folder / "cert.pem", folder / "key.pem"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1", "-subj", f"/CN={HOST}",
                    "-addext", f"subjectAltName=DNS:{HOST}", "-keyout", key, "-out", cert], check=True, capture_output=True)
    port = free_port()
    server = pathlib.Path(configuration).read_text()
    for pattern, ours in ((r"listen 443 ", f"listen 127.0.0.1:{port} "), (r"127\.0\.0\.1:8080", f"127.0.0.1:{bridge_port}"),
                          (r"/etc/skein/tls/cert\.pem", str(cert)), (r"/etc/skein/tls/key\.pem", str(key))):
        server, count = re.subn(pattern, ours, server)
        check(count == 1 or "8080" in pattern, f"{pattern} is in the configuration")
    whole = folder / "nginx.conf"
    whole.write_text(f"daemon off; pid {folder}/nginx.pid; error_log stderr;\nevents {{}}\nhttp {{ access_log off;\n"
                     f"client_body_temp_path {folder}/body; proxy_temp_path {folder}/proxy;\n{server}\n}}\n")
    proxy = subprocess.Popen([nginx, "-e", "stderr", "-p", folder, "-c", whole])
    try:
        try_it(port, cert, token)
    finally:
        proxy.terminate()
        proxy.wait(10)


def try_it(port, cert, token):
    context = ssl.create_default_context(cafile=str(cert))

    def connect():
        deadline = time.monotonic() + 10
        while True:
            try:
                plain = socket.create_connection(("127.0.0.1", port), timeout=10)
                return context.wrap_socket(plain, server_hostname=HOST)
            except ConnectionRefusedError:
                check(time.monotonic() < deadline, "nginx listens within 10 s")
                time.sleep(0.05)

    def ask(method, path, body=None, **headers):
        connection = http.client.HTTPConnection(HOST)
        connection.sock = connect()
        connection.request(method, path, body, headers={"Host": HOST, **headers})
        return connection.getresponse()

    check(ask("GET", "/").status in (200, 404), "the page is served without a token")
    check(ask("GET", "/api/state").status == 401, "nothing else is")
    signed_in = ask("POST", "/api/session", json.dumps({"token": token}), Origin=f"https://{HOST}")
    cookie = signed_in.getheader("Set-Cookie", "")
    check(signed_in.status == 200 and "; Secure" in cookie and "HttpOnly" in cookie, f"signing in sets a cookie: {cookie}")
    check(signed_in.getheader("Strict-Transport-Security"), "browsers are told to come by TLS alone")
    shown = cookie.split(";")[0]
    check(ask("GET", "/api/state", Cookie=shown).status == 200, "the cookie opens the API")
    check(ask("POST", "/api/command", "{}", Cookie=shown, Origin="https://evil.example").status == 403, "no other page may")

    live = connect()
    live.sendall((f"GET /live HTTP/1.1\r\nHost: {HOST}\r\nOrigin: https://{HOST}\r\nCookie: {shown}\r\n"
                  "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                  "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n").encode())
    answer = b""
    while b'"type":"hello"' not in answer:
        part = live.recv(4096)
        check(part, f"the live link says hello; it said {answer[:300]}")
        answer += part
    check(answer.startswith(b"HTTP/1.1 101"), "the live link is upgraded")
    print("all of it works")


if __name__ == "__main__":
    main()
