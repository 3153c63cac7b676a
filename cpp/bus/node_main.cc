#include "bus/node_main.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <iostream>
#include <utility>

#include "bus/heartbeat.h"

namespace skein::bus {

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
  const Transport transport = MakeTransport(lcm_url_);
  LiveExecutor executor(transport.lcm);
  Bus bus(transport.lcm, name_, executor);
  StartHeartbeat(bus, transport.receive_buffer_bytes);
  std::shared_ptr<void> node;
  try {
    node = make_node(bus, executor);
  } catch (const StartError&) {
    throw;
  } catch (const std::exception& error) {
    std::cerr << name_ << ": " << error.what() << '\n';
    return kExitUsage;
  }
  spdlog::info("runs on {}", lcm_url_);
  executor.Run();
  spdlog::info("ends");
  return kExitGood;
}

}  // namespace skein::bus
