# Shared by the scripts; sourced, not run. Defines `root`, the repository's folder.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck disable=SC2034  # for those who source this
default_lcm_url='udpm://239.255.76.67:7667?ttl=0'

say() { printf '%s\n' "$*"; }

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# step TITLE COMMAND...: runs the command with its output kept back. A line tells of it once it has taken a second;
# its output is shown only if it fails, and then this ends with its exit code.
step() {
  local title=$1 output status=0 began=$SECONDS ticker
  shift
  output=$(mktemp)
  { sleep 1 >/dev/null 2>&1 && say "$title ..."; } &
  ticker=$!
  "$@" >"$output" 2>&1 || status=$?
  kill "$ticker" 2>/dev/null || true
  wait "$ticker" 2>/dev/null || true
  if ((status != 0)); then
    tail -n 60 "$output" >&2
    rm -f "$output"
    printf '%s: failed (exit code %d): %s\n' "$title" "$status" "$*" >&2
    return "$status"
  fi
  rm -f "$output"
  ((SECONDS - began < 2)) || say "$title: done in $((SECONDS - began)) s"
}

# Whether nobody listens on a TCP port of this host.
port_is_free() { ! (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }

# Vite and Playwright need Node ^20.19 or >= 22.12; Debian 12's own is 18.
node_is_new_enough() {
  command -v node >/dev/null && command -v npm >/dev/null && node -e '
    const [major, minor] = process.versions.node.split(".").map(Number);
    process.exit((major === 20 && minor >= 19) || (major === 22 && minor >= 12) || major > 22 ? 0 : 1)'
}

# Puts the Node that scripts/setup installed first on PATH, if it had to.
use_node() {
  local modules=$root/scripts/node/node_modules folder
  node_is_new_enough && return
  # npm 9 does not link the programs of optional packages, so Node's own folder, too.
  for folder in "$modules/.bin" "$modules"/node-linux-*/bin; do
    PATH=$folder:$PATH
  done
}

# digest FILE...: one checksum of the files' names and contents.
digest() { printf '%s\0' "$@" | sort -z | xargs -0 sha256sum | sha256sum | cut -d ' ' -f 1; }

# Builds the page into web/dist, if its sources have changed since the last time.
build_page() {
  local stamp=$root/web/node_modules/.skein-built state sources
  mapfile -t sources < <(find "$root/web" \( -name node_modules -o -name dist \) -prune -o -type f -print)
  state=$(digest "${sources[@]}")
  [[ -f $root/web/dist/index.html && -f $stamp && $(<"$stamp") == "$state" ]] && return 0
  step "Building the page" npm run --prefix "$root/web" build
  echo "$state" >"$stamp"
}
