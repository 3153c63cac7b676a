#!/usr/bin/env bash
# Three hosts on one network: the station with the rule, one that it names, one that it does not. Needs root.
#
#   nft_rule.sh deploy/nftables/skein.nft build/bin/skein
set -euo pipefail
rule=$1
skein=$2
name=skein-nft-$$

((EUID == 0)) || { echo "needs root" && exit 77; }
ip netns add "$name-probe" 2>/dev/null || { echo "no network namespaces here" && exit 77; }
ip netns del "$name-probe"

cleanup() {
  local host
  for host in station named stranger switch; do ip netns del "$name-$host" 2>/dev/null || true; done
}
trap cleanup EXIT

ip netns add "$name-switch"
ip -n "$name-switch" link add hub type bridge
ip -n "$name-switch" link set hub up
number=0
for host in station named stranger; do
  number=$((number + 1))
  ip netns add "$name-$host"
  ip -n "$name-$host" link add eth0 type veth peer name "port$number" netns "$name-switch"
  ip -n "$name-switch" link set "port$number" master hub up
  ip -n "$name-$host" link set lo up
  ip -n "$name-$host" link set eth0 up
done
ip -n "$name-station" addr add 192.0.2.11/24 dev eth0
ip -n "$name-named" addr add 192.0.2.10/24 dev eth0
ip -n "$name-stranger" addr add 192.0.2.99/24 dev eth0
ip netns exec "$name-station" nft -f "$rule"

# Hears datagrams until the last of the senders has had his turn.
coproc listener {
  ip netns exec "$name-station" python3 -c '
import socket
bus = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
bus.bind(("", 7667))
bus.settimeout(20)
print("listens", flush=True)
while True:
    text = bus.recv(100).decode()
    print(text, flush=True)
    if text == "named 2":
        break'
}
exec {hear}<&"${listener[0]}"  # bash forgets the listener as soon as it ends
read -r line <&"$hear"
[[ $line == listens ]]
send() {
  ip netns exec "$name-$1" python3 -c '
import socket, sys
socket.socket(socket.AF_INET, socket.SOCK_DGRAM).sendto(sys.argv[1].encode(), ("192.0.2.11", 7667))' "$1 $2"
}
send named 1
send stranger 1
send stranger 2
send named 2
heard=$(cat <&"$hear")
dropped=$(ip netns exec "$name-station" nft list chain inet skein input | grep -oE 'packets [0-9]+' | head -n 1)
printf 'heard:\n%s\ndropped: %s\n' "$heard" "$dropped"
[[ $heard == $'named 1\nnamed 2' && $dropped == "packets 2" ]]

# What the doctor says of the port that the rule names, and of another one.
ip -n "$name-station" route add 224.0.0.0/4 dev eth0
exposure() {
  ip netns exec "$name-station" "$skein" --lcm-url "udpm://239.255.76.67:$1?ttl=1" doctor --json |
    python3 -c 'import json, sys; print(*(f["health"] for f in json.load(sys.stdin) if f["about"] == "exposure"))'
}
[[ $(exposure 7667) == good ]] || { echo "the doctor does not see the rule" && exit 1; }
[[ $(exposure 7668) != good ]] || { echo "the doctor takes the rule for that of another port" && exit 1; }
