#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "bus/bus.h"
#include "bus/live_executor.h"
#include "bus/transport.h"

namespace skein::bus {

/// Exit codes of every executable.
enum ExitCode { kExitGood = 0, kExitFailed = 1, kExitUsage = 2 };

/// spdlog to standard error, with the node's name. @param level "trace" .. "critical", "off".
void StartLogging(const std::string& node, const std::string& level = "info");

/// What the main() of every node has in common: --help, --version, --lcm-url, --log-level, logging,
/// HEARTBEAT, a clean end on SIGINT and SIGTERM, exit codes.
///
///   int main(int argc, char** argv) {
///     skein::bus::NodeMain node("collision-monitor", "Warns of collisions and watches data links.");
///     std::string scenario;
///     node.app().add_option("--scenario", scenario, "Scenario file with the thresholds");
///     return node.Run(argc, argv, [&](auto& bus, auto&) {
///       return std::make_shared<skein::monitor::MonitorNode>(bus, ReadOptions(scenario));
///     });
///   }
class NodeMain {
 public:
  NodeMain(std::string name, const std::string& description);

  /// For the options of this executable.
  CLI::App& app() { return app_; }
  const std::string& lcm_url() const { return lcm_url_; }
  /// For an option that replaces --lcm-url.
  void SetLcmUrl(std::string url) { lcm_url_ = std::move(url); }

  /// Of this node there is to be one alone on a bus: another one that is started waits until the first is
  /// gone (bus/only_one.h). @param read called before: reads the files of its options, lest what is wrong
  /// with them is found only when it takes over. What it throws is taken as that of `make_node` is.
  void OnlyOne(std::function<void()> read) {
    only_one_ = true;
    read_ = std::move(read);
  }

  /// Makes the node, runs until SIGINT or SIGTERM, destroys it. An exception of `make_node` is printed; it
  /// means a bad file or option (exit code 2), a StartError something outside of the program (1).
  using MakeNode = std::function<std::shared_ptr<void>(Bus& bus, LiveExecutor& executor)>;
  int Run(int argc, char** argv, const MakeNode& make_node);

 private:
  int RunLive(const MakeNode& make_node);

  std::string name_;
  CLI::App app_;
  std::string lcm_url_ = DefaultUrl();
  std::string log_level_ = "info";
  bool only_one_ = false;
  std::function<void()> read_;
};

}  // namespace skein::bus
