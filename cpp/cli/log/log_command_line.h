#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <ostream>

#include "cli/log/log.h"

namespace skein::cli {

/// The options of `skein log`. What was asked for needs no bus.
class LogCommandLine {
 public:
  /// Prints what was asked for. Returns the exit code; throws as log/log.h says.
  using Command = std::function<int(std::ostream& out)>;
  using Choose = std::function<void(Command command)>;

  /// @param choose gets the command that was given. Lives as long as this.
  void Add(CLI::App& app, Choose choose);

 private:
  void AddInfo(CLI::App& log);
  void AddEvents(CLI::App& log);
  void AddCsv(CLI::App& log);
  void AddTracks(CLI::App& log);
  void AddPlot(CLI::App& log);
  void AddDiff(CLI::App& log);
  void AddCut(CLI::App& log);
  CLI::App* AddCommand(CLI::App& log, const char* name, const char* description, std::string& file,
                       std::function<void(std::ostream&)> run);

  Choose choose_;
  LogInfoOptions info_;
  LogEventsOptions events_;
  LogCsvOptions csv_;
  LogTracksOptions tracks_;
  LogPlotOptions plot_;
  LogDiffOptions diff_;
  LogCutOptions cut_;
};

}  // namespace skein::cli
