#include "system/hosts.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <stdexcept>
#include <utility>

#include "system/process.h"

namespace skein::testing {
namespace {

void Do(const std::vector<std::string>& command) {
  const Finished done = RunToEnd(command);
  if (done.exit_code == 0) return;
  std::string text;
  for (const std::string& word : command) text += word + " ";
  throw std::runtime_error(text + "failed: " + done.output);
}

}  // namespace

Hosts::Stay::Stay(const std::string& space) : home_(open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC)) {
  const int there = open(("/run/netns/" + space).c_str(), O_RDONLY | O_CLOEXEC);
  if (home_ < 0 || there < 0 || setns(there, CLONE_NEWNET) != 0)
    throw std::runtime_error("cannot go to " + space);
  close(there);
}

Hosts::Stay::~Stay() {
  if (setns(home_, CLONE_NEWNET) != 0) std::terminate();
  close(home_);
}

Hosts::Hosts(std::vector<std::string> names) : names_(std::move(names)) {
  const std::string wire = Space("wire");
  Do({"ip", "netns", "add", wire});
  std::string command = "exec ip netns exec " + wire + " " SKEIN_SOURCE_DIR "/tests/system/lossy_wire.py";
  int number = 0;
  for (const std::string& name : names_) {
    const std::string space = Space(name);
    const std::string port = "to-" + name;
    Do({"ip", "netns", "add", space});
    Do({"ip", "-n", wire, "link", "add", port, "type", "veth", "peer", "name", "eth0", "netns", space});
    Do({"ip", "-n", wire, "link", "set", port, "promisc", "on", "up"});
    Do({"ip", "-n", space, "address", "add", "10.78.0." + std::to_string(++number) + "/24", "dev", "eth0"});
    Do({"ip", "-n", space, "link", "set", "lo", "up"});
    Do({"ip", "-n", space, "link", "set", "eth0", "up"});
    Do({"ip", "-n", space, "route", "add", "224.0.0.0/4", "dev", "eth0"});
    // The wire is none that computes checksums.
    Do({"ip", "netns", "exec", space, "ethtool", "-K", "eth0", "tx", "off"});
    command += " " + port;
  }
  wire_ = popen(command.c_str(), "we");
  if (wire_ == nullptr) throw std::runtime_error("no wire");
}

Hosts::~Hosts() {
  if (wire_ != nullptr) pclose(wire_);
  for (const std::string& name : names_) RunToEnd({"ip", "netns", "del", Space(name)});
  RunToEnd({"ip", "netns", "del", Space("wire")});
}

void Hosts::Ip(const std::string& name, std::vector<std::string> words) const {
  words.insert(words.begin(), {"ip", "-n", Space(name)});
  Do(words);
}

void Hosts::SetWire(const std::string& json) const {
  std::fputs((json + "\n").c_str(), wire_);
  std::fflush(wire_);
}

std::string Hosts::Space(const std::string& name) const {
  return "skein-hosts-" + std::to_string(getpid()) + "-" + name;
}

}  // namespace skein::testing
