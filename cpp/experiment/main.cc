#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "bus/node_main.h"
#include "experiment/csv_writer.h"
#include "experiment/experiment.h"
#include "experiment/flight_recorder.h"
#include "plot/plot.h"

namespace skein::experiment {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> scenarios;
  std::vector<std::string> controls;
  fs::path csv;
  fs::path log;
  fs::path plot;
  std::optional<double> duration_s;
  std::uint64_t seed = 1;
  std::string log_level = "error";
};

// Set by SIGINT and SIGTERM: the flight ends, its files are finished.
volatile std::sig_atomic_t interrupted = 0;

struct Run {
  config::Scenario scenario;
  std::string label;  ///< what tells it from the other runs, "" when it is the only one
};

std::vector<Run> Runs(const Arguments& arguments) {
  std::vector<Run> runs;
  for (const std::string& name : arguments.scenarios) {
    const fs::path file = config::FindScenario(name);
    const config::Scenario scenario = config::LoadScenario(file);
    const std::string stem = arguments.scenarios.size() > 1 ? file.stem().string() : "";
    if (arguments.controls.empty()) runs.push_back({scenario, stem});
    for (const std::string& control : arguments.controls) {
      std::string label = stem;
      if (arguments.controls.size() > 1) label += (stem.empty() ? "" : " ") + control;
      runs.push_back({UnderControl(scenario, control), label});
    }
  }
  for (Run& run : runs) {
    const std::string label = run.label;
    const auto is_taken = [&](const Run& earlier) { return &earlier < &run && earlier.label == run.label; };
    for (int number = 2; std::any_of(runs.begin(), runs.end(), is_taken); ++number) {
      run.label = label + " " + std::to_string(number);
    }
  }
  return runs;
}

/// flight.csv -> flight-turn-paper.csv, when there are several runs.
fs::path FileOf(const Run& run, const fs::path& file) {
  if (run.label.empty() || file.empty()) return file;
  std::string label = run.label;
  std::replace(label.begin(), label.end(), ' ', '-');
  return file.parent_path() / (file.stem().string() + "-" + label + file.extension().string());
}

/// Better told before the flight than after it. Leaves an empty file where there was none.
void CheckWritable(const fs::path& file) {
  if (file.empty()) return;
  errno = 0;
  if (!std::ofstream(file, std::ios::app)) {
    throw config::ConfigError(file.string() + ": cannot be written: " + std::strerror(errno));
  }
}

/// On a terminal, for runs that take a while.
class Progress {
 public:
  explicit Progress(double duration_s) : duration_s_(duration_s), shown_(isatty(STDERR_FILENO) == 1) {}
  ~Progress() {
    if (wrote_) fmt::print(stderr, "\r\033[K");
  }

  void Show(double t_s) {
    const auto now = Clock::now();
    if (!shown_ || now - last_ < std::chrono::milliseconds(200)) return;
    last_ = now;
    wrote_ = true;
    fmt::print(stderr, "\r{:.0f} of {:.0f} s ({:.0f}%)", t_s, duration_s_, 100 * t_s / duration_s_);
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;
  double duration_s_;
  bool shown_;
  bool wrote_ = false;
  Clock::time_point last_ = Clock::now();
};

/// Flies one run, writes its files, prints its summary.
plot::FlightRecord Fly(const Run& run, const Arguments& arguments) {
  std::optional<CsvWriter> csv;
  if (!arguments.csv.empty()) csv.emplace(FileOf(run, arguments.csv));
  FlightRecorder recorder(run.scenario, run.label);
  const double duration_s = arguments.duration_s.value_or(run.scenario.duration_s);
  Progress progress(duration_s);

  ExperimentOptions options;
  options.duration_s = duration_s;
  options.seed = arguments.seed;
  options.log = FileOf(run, arguments.log);
  options.on_tick = [&](const Tick& tick) {
    if (csv) csv->Add(tick);
    if (!arguments.plot.empty()) recorder.Add(tick);
    progress.Show(tick.t_s);
  };
  options.stop = [] { return interrupted != 0; };
  const auto start = std::chrono::steady_clock::now();
  const Summary summary = RunExperiment(run.scenario, options);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  if (csv) csv->Finish();
  fmt::print("{}  Real time: {:.2f} s, {:.0f} times as fast as the flight\n", ToText(summary), took.count(),
             summary.duration_s / took.count());
  std::fflush(stdout);
  return recorder.record();
}

void WritePlot(const fs::path& file, const std::string& title,
               const std::vector<plot::FlightRecord>& records) {
  std::ofstream stream(file, std::ios::binary);
  stream << plot::PlotSvg(title, records);
  stream.flush();
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

void Describe(CLI::App& app, Arguments& arguments) {
  app.add_option("scenario", arguments.scenarios, "Scenarios: files, or names of those that ship")
      ->required()
      ->type_name("SCENARIO");
  app.add_option("--control", arguments.controls,
                 "Flies all formations under this control; several, with commas between, one after the other")
      ->delimiter(',')
      ->check(CLI::IsMember({"skein", "paper"}));
  app.add_option("--csv", arguments.csv, "A row per UAV and control step");
  app.add_option("--log", arguments.log, "LCM log of the whole bus, for lcm-logplayer");
  app.add_option("--plot", arguments.plot,
                 "SVG figure of errors, speed, altitude and track; all runs in one");
  app.add_option("--duration", arguments.duration_s, "Seconds to fly, instead of the scenario's own")
      ->check(CLI::Range(0.05, 1e6))
      ->type_name("S");
  app.add_option("--seed", arguments.seed, "Of lossy and jittered links")
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--log-level", arguments.log_level, "What the nodes say on standard error")
      ->capture_default_str()
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "critical", "off"}));
  app.set_version_flag("--version", "flight-experiment " SKEIN_VERSION);
  app.footer(
      "With several runs, --csv and --log write a file each: flight.csv becomes flight-turn-paper.csv.\n"
      "Everything is the same on every run but the line \"Real time\".");
}

int Main(int argc, char** argv) {
  CLI::App app("Flies scenarios in simulated time, as fast as it can, with all nodes in one process.",
               "flight-experiment");
  Arguments arguments;
  Describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? bus::kExitGood : bus::kExitUsage;
  }
  bus::StartLogging("flight-experiment", arguments.log_level);
  std::vector<Run> runs;
  try {
    runs = Runs(arguments);
    CheckWritable(arguments.plot);
    for (const Run& run : runs) {
      CheckWritable(FileOf(run, arguments.csv));
      CheckWritable(FileOf(run, arguments.log));
    }
  } catch (const config::ConfigError& error) {
    fmt::print(stderr, "flight-experiment: {}\n", error.what());
    return bus::kExitUsage;
  }
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
  try {
    std::vector<plot::FlightRecord> records;
    for (const Run& run : runs) {
      records.push_back(Fly(run, arguments));
      if (interrupted != 0) break;
    }
    const std::string title =
        arguments.scenarios.size() == 1 ? runs.front().scenario.name : "Flights compared";
    if (!arguments.plot.empty()) WritePlot(arguments.plot, title, records);
  } catch (const std::exception& error) {
    fmt::print(stderr, "flight-experiment: {}\n", error.what());
    return bus::kExitFailed;
  }
  if (interrupted == 0) return bus::kExitGood;
  fmt::print(stderr, "flight-experiment: interrupted; what was written ends there\n");
  return bus::kExitFailed;
}

}  // namespace
}  // namespace skein::experiment

int main(int argc, char** argv) { return skein::experiment::Main(argc, argv); }
