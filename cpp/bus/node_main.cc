#include "bus/node_main.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <iostream>
#include <optional>
#include <utility>

#include "bus/heartbeat.h"
#include "bus/hub.h"
#include "bus/only_one.h"
#include "bus/refusals.h"

namespace skein::bus {
namespace {

/// False when a file or an option is bad, which is printed then. What is wrong outside of the program is
/// thrown.
bool Succeeds(const std::string& name, const std::function<void()>& start) {
  try {
    start();
    return true;
  } catch (const StartError&) {
    throw;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return false;
  }
}

}  // namespace

void StartLogging(const std::string& node, const std::string& level) {
  spdlog::set_default_logger(spdlog::stderr_logger_mt(node));
  spdlog::set_pattern("%H:%M:%S.%e %n %l: %v");
  spdlog::set_level(spdlog::level::from_str(level));
}

NodeMain::NodeMain(std::string name, const std::string& description)
    : name_(std::move(name)), app_(description, name_) {
  app_.set_version_flag("--version", name_ + " " SKEIN_VERSION);
  app_.add_option("--lcm-url", lcm_url_,
                  "LCM URL (default: LCM_DEFAULT_URL, or " + std::string(kDefaultUrl) + ")");
  app_.add_option("--log-level", log_level_, "How much to log to standard error (default: info)")
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error", "off"}));
}

int NodeMain::Run(int argc, char** argv, const MakeNode& make_node) {
  try {
    app_.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_.exit(error) == 0 ? kExitGood : kExitUsage;
  }
  BlockEndSignals();
  StartLogging(name_, log_level_);
  try {
    return RunLive(make_node);
  } catch (const std::exception& error) {
    std::cerr << name_ << ": " << error.what() << '\n';
    return kExitFailed;
  }
}

int NodeMain::RunLive(const MakeNode& make_node) {
  if (!Succeeds(name_, [&] {
        if (read_) read_();
      }))
    return kExitUsage;
  if (!AwaitHub(lcm_url_)) return kExitGood;
  const Transport transport = MakeTransport(lcm_url_);
  if (only_one_ && !AwaitTurn(transport, name_)) return kExitGood;
  LiveExecutor executor(transport.lcm);
  Bus bus(transport.lcm, name_, executor);
  StartHeartbeat(bus, transport.receive_buffer_bytes);
  TellRefusals(bus);
  std::optional<Turn> turn;
  if (only_one_) turn.emplace(bus, transport.receive_buffer_bytes, [&executor] { executor.Stop(); });
  std::shared_ptr<void> node;
  if (!Succeeds(name_, [&] { node = make_node(bus, executor); })) return kExitUsage;
  spdlog::info("runs on {}", lcm_url_);
  executor.Run();
  if (turn && turn->over()) {
    std::cerr << name_ << ": another " << name_ << " has taken over: this one ends\n";
    return kExitFailed;
  }
  spdlog::info("ends");
  return kExitGood;
}

}  // namespace skein::bus
