#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "config/scenario.h"
#include "experiment/experiment.h"

namespace skein::cli {

/// `skein log` on the recording of a flight: three UAVs, the link of UAV3 cut from 20 s to 30 s.
class LogTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::path(testing::TempDir()) / ("skein-log-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    Fly(flight(), [](config::Scenario&) {});
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }

  /// Flies the scenario, changed by `change`, for 40 s.
  template <typename Change>
  static void Fly(const std::string& log, Change change) {
    config::Scenario scenario =
        config::LoadScenario(SKEIN_SOURCE_DIR "/tests/unit/cli/three_with_a_drop.json");
    change(scenario);
    experiment::ExperimentOptions options;
    options.duration_s = 40;
    options.logs = false;
    options.log = log;
    experiment::RunExperiment(scenario, options);
  }

  static std::string flight() { return folder_ / "flight.lcm"; }
  static std::string In(const std::string& name) { return folder_ / name; }

  struct Ran {
    int exit_code;
    std::string output;
  };
  /// Runs `skein log WORDS`; throws what it throws.
  static Ran Run(std::vector<std::string> words) {
    words.insert(words.begin(), "log");
    CommandLine command_line;
    std::reverse(words.begin(), words.end());
    command_line.app().parse(words);
    std::ostringstream out;
    const int exit_code = command_line.offline_command()(out);
    return {exit_code, out.str()};
  }
  static std::string Output(const std::vector<std::string>& words) { return Run(words).output; }
  static nlohmann::json Json(const std::vector<std::string>& words) {
    return nlohmann::json::parse(Output(words));
  }

  /// Why it refuses; "" when it does not.
  static std::string Refusal(const std::vector<std::string>& words) {
    try {
      Run(words);
    } catch (const config::ConfigError& error) {
      return error.what();
    }
    return "";
  }

  static std::string Read(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static std::string Write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  /// The flight with some bytes in its midst overwritten and its end cut off.
  static std::string Damaged() {
    std::string bytes = Read(flight());
    bytes.replace(bytes.size() / 2, 5000, 5000, '\x55');
    bytes.resize(bytes.size() - 10);
    return Write("damaged.lcm", bytes);
  }

  static std::vector<std::string> Lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  static std::size_t Count(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
  }

  static inline std::filesystem::path folder_;
};

}  // namespace skein::cli
