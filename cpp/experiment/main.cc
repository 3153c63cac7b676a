#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bus/node_main.h"
#include "bus/number_checks.h"
#include "config/variation.h"
#include "experiment/campaign_command.h"
#include "experiment/csv_writer.h"
#include "experiment/experiment.h"
#include "experiment/flight_sampler.h"
#include "experiment/output.h"
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
  bool vary = false;
  std::uint64_t runs = 0;  ///< 0: no campaign
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  std::vector<fs::path> merged;
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
    config::Scenario scenario = config::LoadScenario(file);
    if (arguments.vary && !scenario.vary) {
      throw config::ConfigError(file.string() + ": has no \"vary\" block to draw from");
    }
    if (arguments.vary) scenario = config::Varied(scenario, arguments.seed);
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

/// Flies one run, writes its files, prints its summary.
plot::FlightRecord Fly(const Run& run, const Arguments& arguments) {
  std::optional<CsvWriter> csv;
  if (!arguments.csv.empty()) csv.emplace(FileOf(run, arguments.csv));
  FlightSampler sampler(run.scenario, run.label);
  const double duration_s = arguments.duration_s.value_or(run.scenario.duration_s);
  Progress progress(duration_s, "s");

  ExperimentOptions options;
  options.duration_s = duration_s;
  options.seed = arguments.seed;
  options.log = FileOf(run, arguments.log);
  options.on_tick = [&](const Tick& tick) {
    if (csv) csv->Add(tick);
    if (!arguments.plot.empty()) sampler.Add(tick);
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
  return sampler.record();
}

void Describe(CLI::App& app, Arguments& arguments) {
  auto* scenarios =
      app.add_option("scenario", arguments.scenarios, "Scenarios: files, or names of those that ship")
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
      ->check(bus::Between(0.05, 1e6))
      ->type_name("S");
  app.add_option("--seed", arguments.seed, "Of lossy and jittered links, and of --vary and --runs")
      ->check(bus::NumberCheck(0, 0x1p64, "0 or more"))
      ->capture_default_str()
      ->type_name("N");
  auto* vary = app.add_flag("--vary", arguments.vary,
                            "Flies the variation that --runs draws from this seed, to look at one run");
  auto* runs =
      app.add_option("--runs", arguments.runs,
                     "A campaign: so many runs of one scenario, run i with the variation of seed + i; "
                     "--csv gets a row a run, --plot the spread")
          ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
          ->type_name("N")
          ->excludes(vary);
  app.add_option("--jobs", arguments.jobs, "Runs of a campaign at once")
      ->check(bus::Between(1, 1024))
      ->capture_default_str()
      ->type_name("N")
      ->needs(runs);
  app.add_option("--merge", arguments.merged,
                 "Flies nothing: the CSVs of parts of a campaign as one, sorted into --csv, with its summary")
      ->type_name("CSV")
      ->expected(1, -1)
      ->excludes(scenarios)
      ->excludes(runs)
      ->excludes(vary);
  app.add_option("--log-level", arguments.log_level, "What the nodes say on standard error")
      ->capture_default_str()
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "critical", "off"}));
  app.set_version_flag("--version", "flight-experiment " SKEIN_VERSION);
  app.footer(
      "With several scenarios or controls, --csv and --log write a file each: flight.csv becomes "
      "flight-turn-paper.csv.\n"
      "A campaign on several machines: parallel flight-experiment turn --runs 50 --seed {} --csv "
      "part-{}.csv\n"
      "::: 1 51 101, then flight-experiment --merge part-*.csv --csv campaign.csv --plot campaign.svg\n"
      "Everything is the same on every run but the line \"Real time\".");
}

/// What is wrong with options that are right each by itself; "" when nothing is.
std::string Conflict(const Arguments& arguments) {
  if (arguments.merged.empty() && arguments.scenarios.empty()) return "name a scenario, or CSVs to --merge";
  if (arguments.runs == 0) return "";
  if (arguments.scenarios.size() > 1 || arguments.controls.size() > 1) {
    return "--runs flies one scenario, under one control";
  }
  if (!arguments.log.empty())
    return "--log goes with single flights only: see --vary for a run of a campaign";
  const std::uint64_t last = arguments.seed + arguments.runs - 1;
  return last < arguments.seed ? "--seed and --runs go beyond the greatest seed" : "";
}

int RunCampaign(const Arguments& arguments) {
  Campaign campaign;
  campaign.csv = arguments.csv;
  campaign.plot = arguments.plot;
  campaign.options.runs = arguments.runs;
  campaign.options.first_seed = arguments.seed;
  campaign.options.jobs = arguments.jobs;
  campaign.options.duration_s = arguments.duration_s;
  campaign.options.stop = [] { return interrupted != 0; };
  return Fly(Runs(arguments).front().scenario, campaign);
}

int RunFlights(const Arguments& arguments) {
  const std::vector<Run> runs = Runs(arguments);
  CheckWritable(arguments.plot);
  for (const Run& run : runs) {
    CheckWritable(FileOf(run, arguments.csv));
    CheckWritable(FileOf(run, arguments.log));
  }
  std::vector<plot::FlightRecord> records;
  for (const Run& run : runs) {
    records.push_back(Fly(run, arguments));
    if (interrupted != 0) break;
  }
  const std::string title = arguments.scenarios.size() == 1 ? runs.front().scenario.name : "Flights compared";
  if (!arguments.plot.empty()) WriteFile(arguments.plot, plot::PlotSvg(title, records));
  return bus::kExitGood;
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
  if (const std::string conflict = Conflict(arguments); !conflict.empty()) {
    fmt::print(stderr, "flight-experiment: {}\n", conflict);
    return bus::kExitUsage;
  }
  bus::StartLogging("flight-experiment", arguments.log_level);
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
  int exit_code = bus::kExitGood;
  try {
    exit_code = !arguments.merged.empty() ? Merge(arguments.merged, arguments.csv, arguments.plot)
                : arguments.runs > 0      ? RunCampaign(arguments)
                                          : RunFlights(arguments);
  } catch (const config::ConfigError& error) {
    fmt::print(stderr, "flight-experiment: {}\n", error.what());
    return bus::kExitUsage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "flight-experiment: {}\n", error.what());
    return bus::kExitFailed;
  }
  if (interrupted == 0) return exit_code;
  fmt::print(stderr, "flight-experiment: interrupted; what was written ends there\n");
  return bus::kExitFailed;
}

}  // namespace
}  // namespace skein::experiment

int main(int argc, char** argv) { return skein::experiment::Main(argc, argv); }
