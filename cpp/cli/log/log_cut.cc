#include <spdlog/fmt/fmt.h>

#include <deque>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "cli/log/log.h"
#include "cli/log/log_source.h"
#include "cli/log/text.h"
#include "config/scenario.h"
#include "recording/log_output.h"
#include "recording/message_types.h"

namespace skein::cli {
namespace {

// What is repeated at 1 Hz has come within this.
constexpr double kBefore_s = 1.5;

/// Whether it is a state of ours that is repeated, rather than something that happens once.
bool IsState(const recording::LogEvent& event) {
  if (event.channel == bus::channel::kEvent || event.channel == bus::channel::kAck) return false;
  return !event.channel.starts_with("CMD_") && recording::TypeOf(event.data);
}

struct Kept {
  double t_s;
  std::string channel;
  std::vector<std::byte> data;
};

}  // namespace

void CutLog(const LogCutOptions& options, std::ostream& out) {
  LogSource source(options.file);
  Output output(options.output, out, source.parts());
  recording::LogOutput log(output.stream());
  std::deque<Kept> before;
  std::int64_t messages = 0;
  double end_s = 0;
  source.ForEach([&](const recording::LogEvent& event, double t_s) {
    end_s = t_s;
    if (options.window.IsPast(t_s)) return false;
    if (t_s < options.window.from_s) {
      while (!before.empty() && before.front().t_s < t_s - kBefore_s) before.pop_front();
      if (t_s >= options.window.from_s - kBefore_s && IsState(event)) {
        before.push_back({t_s, std::string(event.channel), {event.data.begin(), event.data.end()}});
      }
      return true;
    }
    // All at once, at the time of the first message of the part: so the part begins where it was asked to.
    if (messages++ == 0) {
      for (const Kept& kept : before) log.Write(event.utime, kept.channel, kept.data);
    }
    log.Write(event.utime, event.channel, event.data);
    return output.stream().good();
  });
  if (messages == 0) {
    const double from_s = options.window.from_s;
    // The last message that was read may lie beyond the window.
    throw config::ConfigError(
        options.window.IsPast(end_s)
            ? fmt::format(
                  "{}: nothing was recorded from {:g} s to {:g} s; before and after there is something",
                  options.file, from_s, *options.window.to_s)
            : fmt::format("{}: there is nothing from {:g} s on; the recording is {:.1f} s long", options.file,
                          from_s, end_s));
  }
  output.Finish();
  source.TellProblems();
}

}  // namespace skein::cli
