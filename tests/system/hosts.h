#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace skein::testing {

/// Hosts on one network, each a network namespace: 10.78.0.1, 10.78.0.2, ... in their order, with a route for
/// multicast. Their wire is lossy_wire.py. For root alone.
class Hosts {
 public:
  /// Throws std::runtime_error when the kernel has no such namespaces.
  explicit Hosts(std::vector<std::string> names);
  ~Hosts();
  Hosts(const Hosts&) = delete;
  Hosts& operator=(const Hosts&) = delete;

  /// While it lives, this thread and the processes that it starts are on that host.
  class Stay {
   public:
    explicit Stay(const std::string& space);
    ~Stay();
    Stay(const Stay&) = delete;
    Stay& operator=(const Stay&) = delete;

   private:
    int home_;
  };
  Stay On(const std::string& name) const { return Stay(Space(name)); }

  /// Runs `ip` for a host with these words after "-n NAMESPACE".
  void Ip(const std::string& name, std::vector<std::string> words) const;

  /// What the wire does from now on, as lossy_wire.py takes it; apart are "to-NAME".
  void SetWire(const std::string& json) const;

 private:
  /// The network namespace of a host, or of the wire.
  std::string Space(const std::string& name) const;

  std::vector<std::string> names_;
  FILE* wire_ = nullptr;
};

}  // namespace skein::testing
