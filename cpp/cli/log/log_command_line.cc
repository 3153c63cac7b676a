#include "cli/log/log_command_line.h"

#include <map>
#include <utility>

#include "bus/number_checks.h"
#include "config/scenario.h"

namespace skein::cli {
namespace {

constexpr const char* kFileHelp = "The recording; further parts of it (FILE.01, ...) are found";

void AddWindow(CLI::App* command, LogWindow& window) {
  command->add_option("--from", window.from_s, "From so many seconds after the recording's start on")
      ->check(bus::NotNegative())
      ->type_name("S");
  command->add_option("--to", window.to_s, "Up to so many seconds after its start")
      ->check(bus::NotNegative())
      ->type_name("S");
}

void CheckWindow(const LogWindow& window) {
  if (window.to_s && *window.to_s <= window.from_s) {
    throw config::ConfigError("--to must be later than --from");
  }
}

void AddOutput(CLI::App* command, OutputOptions& output, bool is_required = false) {
  command
      ->add_option("--out", output.file,
                   is_required ? "Write into this file" : "Write into this file (default: standard output)")
      ->required(is_required)
      ->type_name("FILE");
  command->add_flag("--force", output.force, "Replace the file if it exists");
}

void AddFlight(CLI::App* command, int& flight) {
  command->add_option("--flight", flight, "Which one, when the scenario was started anew meanwhile")
      ->check(bus::Positive())
      ->capture_default_str()
      ->type_name("N");
}

}  // namespace

CLI::App* LogCommandLine::AddCommand(CLI::App& log, const char* name, const char* description,
                                     std::string& file, std::function<void(std::ostream&)> run) {
  CLI::App* command = log.add_subcommand(name, description);
  command->add_option("file", file, kFileHelp)->required()->type_name("FILE");
  command->callback([this, run = std::move(run)] {
    choose_([run](std::ostream& out) {
      run(out);
      return 0;
    });
  });
  return command;
}

void LogCommandLine::Add(CLI::App& app, Choose choose) {
  choose_ = std::move(choose);
  CLI::App* log = app.add_subcommand("log", "Recordings: what is in them, and exports");
  log->require_subcommand(1);
  log->footer(
      "Exit codes: 0 done, 1 not done (diff: the flights part), 2 wrong usage or a file that cannot be "
      "used.");
  AddInfo(*log);
  AddEvents(*log);
  AddCsv(*log);
  AddTracks(*log);
  AddPlot(*log);
  AddDiff(*log);
  AddCut(*log);
}

void LogCommandLine::AddInfo(CLI::App& log) {
  CLI::App* command =
      AddCommand(log, "info", "What is in it: scenario, times, UAVs, channels, alarms, markers, damage",
                 info_.file, [this](std::ostream& out) { ShowLogInfo(info_, out); });
  command->add_flag("--json", info_.json, "As JSON");
}

void LogCommandLine::AddEvents(CLI::App& log) {
  CLI::App* command = AddCommand(log, "events", "What happened: a line for each EVENT, markers among them",
                                 events_.file, [this](std::ostream& out) {
                                   CheckWindow(events_.window);
                                   ShowLogEvents(events_, out);
                                 });
  const std::map<std::string, int> severities = {
      {"info", 0}, {"advisory", 1}, {"caution", 2}, {"warning", 3}};
  command->add_option("--least", events_.least_severity, "Only from this severity on")
      ->transform(CLI::Transformer(severities, CLI::ignore_case))
      ->check([](const std::string& text) {
        return text.size() == 1 && text[0] >= '0' && text[0] <= '3'
                   ? ""
                   : "must be info, advisory, caution or warning, is " + text;
      })
      ->type_name("info|advisory|caution|warning");
  AddWindow(command, events_.window);
  command->add_flag("--json", events_.json, "As JSON");
}

void LogCommandLine::AddCsv(CLI::App& log) {
  CLI::App* command = AddCommand(log, "csv", "The messages of a channel, a column for each field", csv_.file,
                                 [this](std::ostream& out) {
                                   CheckWindow(csv_.window);
                                   WriteLogCsv(csv_, out);
                                 });
  command->add_option("--channel", csv_.channel, "As `skein log info` lists it")
      ->required()
      ->type_name("CHANNEL");
  AddWindow(command, csv_.window);
  AddOutput(command, csv_.output);
}

void LogCommandLine::AddTracks(CLI::App& log) {
  const auto add = [&](const char* name, const char* description, auto write) {
    CLI::App* command = AddCommand(log, name, description, tracks_.file, [this, write](std::ostream& out) {
      CheckWindow(tracks_.window);
      write(tracks_, out);
    });
    command
        ->add_option("--tolerance-m", tracks_.tolerance_m,
                     "Leave out positions that an even flight between the others passes so closely; 0: none")
        ->check(bus::Between(0.0, 1e6))
        ->capture_default_str()
        ->type_name("M");
    AddWindow(command, tracks_.window);
    AddOutput(command, tracks_.output);
    return command;
  };
  CLI::App* geojson =
      add("geojson", "Tracks of all UAVs, paths and events for QGIS and other GIS", WriteLogGeoJson);
  geojson->add_flag("--points", tracks_.points, "Tracks as points, each with its time, instead of lines");
  add("kml", "The same for Google Earth, with its time slider", WriteLogKml);
}

void LogCommandLine::AddPlot(CLI::App& log) {
  CLI::App* command = AddCommand(log, "plot", "A figure of the paper from this flight, as SVG", plot_.file,
                                 [this](std::ostream& out) { WriteLogPlot(plot_, out); });
  command
      ->add_option("--figure", plot_.figure,
                   "6: errors and speed (an assembly); 8: altitude, track and link drops as well")
      ->check(CLI::IsMember({6, 8}))
      ->capture_default_str()
      ->type_name("6|8");
  AddFlight(command, plot_.flight);
  AddOutput(command, plot_.output);
}

void LogCommandLine::AddDiff(CLI::App& log) {
  CLI::App* command =
      log.add_subcommand("diff", "Where two flights of a scenario part; exit code 1 when they do");
  command->add_option("first", diff_.first, kFileHelp)->required()->type_name("FILE");
  command->add_option("second", diff_.second, "What it is compared with, at the same times of the scenario")
      ->required()
      ->type_name("FILE");
  command->add_option("--tolerance-m", diff_.tolerance_m, "How far apart a UAV may be")
      ->check(bus::Between(0.0, 1e9))
      ->capture_default_str()
      ->type_name("M");
  AddFlight(command, diff_.flight);
  command->add_flag("--json", diff_.json, "As JSON");
  command->callback(
      [this] { choose_([this](std::ostream& out) { return CompareLogs(diff_, out) ? 0 : 1; }); });
}

void LogCommandLine::AddCut(CLI::App& log) {
  CLI::App* command =
      AddCommand(log, "cut", "A part of it as a recording of its own", cut_.file, [this](std::ostream& out) {
        CheckWindow(cut_.window);
        CutLog(cut_, out);
      });
  AddWindow(command, cut_.window);
  AddOutput(command, cut_.output, true);
  command->footer(
      "The state of the moment (roster, formations, paths, links, alarms: all that is repeated at 1 Hz) is\n"
      "put at the start of the part, so that a page that plays it shows all at once.");
}

}  // namespace skein::cli
