#!/usr/bin/env python3
"""Runs clang-tidy on those sources that have changed since it last found nothing in them.

usage: tidy.py BUILD_FOLDER SOURCE...

A source has changed when it, anything that it includes, its compile command, .clang-tidy or clang-tidy has. What a source
includes is known from the build, so build first. Each source is read by itself, without the headers that are precompiled for
all: what one forgets to include is found here. Exit code 1 when anything is found.
"""
import hashlib
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path


@cache
def content(path):
    try:
        return hashlib.sha256(Path(path).read_bytes()).digest()
    except OSError:
        return b"missing"


def includes(build):
    """{source: files that it was compiled from}, both as the compiler named them."""
    found = {}
    listed = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    for target in listed.split("\n\n"):
        files = [line.strip() for line in target.splitlines()[1:] if line.startswith("    ")]
        source = next((file for file in files if file.endswith(".cc")), None)
        if source:
            found[source] = files
    return found


def without_precompiled_headers(build, folder):
    """Writes a compile_commands.json for clang, which cannot read GCC's; returns {source: command}."""
    commands = json.loads((build / "compile_commands.json").read_text())
    for one in commands:
        one["command"] = re.sub(r" -Winvalid-pch -include \S+cmake_pch\.hxx", "", one["command"])
    (folder / "compile_commands.json").write_text(json.dumps(commands))
    return {one["file"]: one["command"] for one in commands}


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    build = Path(sys.argv[1])
    sources = [str(Path(source).resolve()) for source in sys.argv[2:]]
    root = Path(__file__).resolve().parents[2]
    folder = build / "tidy"
    folder.mkdir(exist_ok=True)
    commands = without_precompiled_headers(build, folder)
    known = includes(build)
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    common = version + (root / ".clang-tidy").read_bytes()

    def stamp_of(source):
        return folder / (str(Path(source).relative_to(root)).replace("/", "-") + ".clean")

    def digest(source):
        if source not in known:
            return None
        all_of_it = hashlib.sha256(common + commands.get(source, "").encode())
        for file in sorted(set(known[source])):
            all_of_it.update(file.encode() + content(file))
        return all_of_it.hexdigest()

    def is_clean(source):
        stamp = stamp_of(source)
        return stamp.exists() and stamp.read_text() == digest(source)

    def check(source):
        tidy = ["clang-tidy", "-p", str(folder), "--quiet", "--warnings-as-errors=*", source]
        run = subprocess.run(tidy, capture_output=True, text=True)
        if run.returncode != 0:
            print(run.stdout + run.stderr, flush=True)
        elif digest(source):
            stamp_of(source).write_text(digest(source))
        return run.returncode == 0

    changed = [source for source in sources if not is_clean(source)]
    print(f"{len(sources) - len(changed)} of {len(sources)} sources were clean and have not changed", flush=True)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        clean = list(pool.map(check, changed))
    sys.exit(0 if all(clean) else 1)


if __name__ == "__main__":
    main()
