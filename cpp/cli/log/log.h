#pragma once

#include <optional>
#include <ostream>
#include <string>

#include "cli/log/output.h"

/// What `skein log` can do with a recording, each a function of its options. They print to `out` and throw
/// config::ConfigError for what was asked wrongly (no log, no such channel), Failure or another
/// std::exception when it cannot be had.
///
/// Times are seconds since the recording's first event.
namespace skein::cli {

struct LogWindow {
  double from_s = 0;
  std::optional<double> to_s;  ///< none: to the end
  bool Holds(double t_s) const { return t_s >= from_s && !IsPast(t_s); }
  bool IsPast(double t_s) const { return to_s && t_s > *to_s; }
};

struct LogInfoOptions {
  std::string file;
  bool json = false;
};
/// What is in it, and what is damaged.
void ShowLogInfo(const LogInfoOptions& options, std::ostream& out);

struct LogEventsOptions {
  std::string file;
  LogWindow window;
  int least_severity = 0;
  bool json = false;
};
/// What was told on EVENT, markers among it.
void ShowLogEvents(const LogEventsOptions& options, std::ostream& out);

struct LogCsvOptions {
  std::string file;
  std::string channel;
  LogWindow window;
  OutputOptions output;
};
/// The messages of a channel, field by field.
void WriteLogCsv(const LogCsvOptions& options, std::ostream& out);

struct LogTracksOptions {
  std::string file;
  LogWindow window;
  double tolerance_m = 0.5;  ///< how far thinned tracks may stray; 0: every state
  bool points = false;       ///< GeoJSON: a point for each state, with its time, instead of lines
  OutputOptions output;
};
void WriteLogGeoJson(const LogTracksOptions& options, std::ostream& out);
void WriteLogKml(const LogTracksOptions& options, std::ostream& out);

struct LogPlotOptions {
  std::string file;
  int figure = 8;  ///< of the paper: 6 or 8
  int flight = 1;  ///< which one, when the scenario was started anew meanwhile
  OutputOptions output;
};
void WriteLogPlot(const LogPlotOptions& options, std::ostream& out);

struct LogDiffOptions {
  std::string first;
  std::string second;
  double tolerance_m = 1;
  int flight = 1;
  bool json = false;
};
/// Whether the flights agree: every UAV was heard in both, and was never farther apart than the tolerance at
/// a time of the scenario at which it was.
bool CompareLogs(const LogDiffOptions& options, std::ostream& out);

struct LogCutOptions {
  std::string file;
  LogWindow window;
  OutputOptions output;
};
/// A part of a recording as a log of its own, which begins with the state of that moment.
void CutLog(const LogCutOptions& options, std::ostream& out);

}  // namespace skein::cli
