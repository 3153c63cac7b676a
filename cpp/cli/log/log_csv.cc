#include <spdlog/fmt/fmt.h>

#include <cstdio>
#include <set>

#include "cli/log/log.h"
#include "cli/log/log_source.h"
#include "cli/log/message_table.h"
#include "cli/log/text.h"
#include "config/scenario.h"

namespace skein::cli {
namespace {

void WriteRow(std::ostream& stream, const std::string& first, const std::vector<std::string>& cells) {
  stream << first;
  for (const std::string& cell : cells) stream << ',' << CsvCell(cell);
  stream << '\n';
}

[[noreturn]] void RefuseChannel(const LogCsvOptions& options, const std::set<std::string>& channels,
                                std::int64_t messages) {
  if (messages > 0) {
    throw config::ConfigError(
        fmt::format("{}: none of the {} messages on {} is of a type that Skein knows, so none can be written "
                    "field by field",
                    options.file, messages, Printable(options.channel)));
  }
  std::string names;
  for (const std::string& name : channels) names += (names.empty() ? "" : ", ") + Printable(name);
  throw config::ConfigError(fmt::format("{}: there is nothing on {} in this time; there are {}", options.file,
                                        Printable(options.channel), names.empty() ? "no channels" : names));
}

}  // namespace

void WriteLogCsv(const LogCsvOptions& options, std::ostream& out) {
  LogSource source(options.file);
  Output output(options.output, out, source.parts());
  std::ostream& stream = output.stream();
  std::string_view type;
  std::set<std::string> channels;
  std::int64_t messages = 0;
  std::int64_t skipped = 0;
  source.ForEach([&](const recording::LogEvent& event, double t_s) {
    if (options.window.IsPast(t_s)) return false;
    if (!options.window.Holds(t_s)) return true;
    if (event.channel != options.channel) {
      if (messages == 0 && channels.size() < kMostChannels) channels.emplace(event.channel);
      return true;
    }
    ++messages;
    const auto table = ToTable(event.data);
    if (!table || (!type.empty() && table->type != type)) {
      ++skipped;
      return true;
    }
    if (type.empty()) WriteRow(stream, "t_s", table->columns);
    type = table->type;
    for (const auto& row : table->rows) WriteRow(stream, fmt::format("{:.6f}", t_s), row);
    return stream.good();
  });
  if (type.empty()) RefuseChannel(options, channels, messages);
  output.Finish();
  source.TellProblems();
  if (skipped > 0) {
    fmt::print(stderr, "skein: {}: {} of {} messages on {} are no good {} and were left out\n", options.file,
               skipped, messages, Printable(options.channel), type);
  }
}

}  // namespace skein::cli
