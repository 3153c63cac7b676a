#include <iostream>
#include <stdexcept>

#include "bus/live_executor.h"
#include "bus/node_main.h"
#include "bus/transport.h"
#include "cli/command_line.h"
#include "cli/log/log_source.h"
#include "cli/run_for.h"
#include "config/scenario.h"

namespace {

using namespace skein;  // NOLINT: the main file of a program

void Run(const cli::CommandLine& command_line) {
  const auto transport =
      bus::MakeTransport(command_line.lcm_url().empty() ? bus::DefaultUrl() : command_line.lcm_url());
  bus::LiveExecutor executor(transport.lcm);
  bus::Bus bus(transport.lcm, "skein", executor);
  cli::Station station(bus, [&](bus::Utime duration) { return cli::RunFor(executor, duration); });
  command_line.command()(station, std::cout);
}

/// On a full disk what was asked for is not there.
void Flush() {
  if (!std::cout.flush()) throw std::runtime_error("standard output: could not be written wholly");
}

}  // namespace

int main(int argc, char** argv) {
  cli::CommandLine command_line;
  try {
    command_line.app().parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return command_line.app().exit(error) == 0 ? bus::kExitGood : bus::kExitUsage;
  }
  bus::StartLogging("skein", "warning");
  try {
    if (command_line.offline_command()) {
      cli::CatchInterrupts();
      const int exit_code = command_line.offline_command()(std::cout);
      Flush();
      return exit_code;
    }
    bus::BlockEndSignals();
    Run(command_line);
    Flush();
    return bus::kExitGood;
  } catch (const config::ConfigError& error) {
    std::cerr << "skein: " << error.what() << '\n';
    return bus::kExitUsage;
  } catch (const std::exception& error) {
    std::cerr << "skein: " << error.what() << '\n';
    return bus::kExitFailed;
  }
}
