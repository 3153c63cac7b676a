#include <spdlog/fmt/fmt.h>

#include <array>
#include <nlohmann/json.hpp>
#include <skein/event_t.hpp>

#include "bus/channels.h"
#include "cli/log/log.h"
#include "cli/log/log_source.h"
#include "cli/log/text.h"
#include "recording/log_listener.h"

namespace skein::cli {
namespace {

constexpr std::array<const char*, 4> kSeverityWords = {"info", "advisory", "caution", "WARNING"};

std::string Json(const event_t& event, double t_s) {
  const nlohmann::ordered_json json = {{"t_s", t_s},
                                       {"utime", event.utime},
                                       {"time", IsoTime(event.utime)},
                                       {"severity", event.severity},
                                       {"code", event.code},
                                       {"node", event.event_node},
                                       {"vehicle_id", event.vehicle_id},
                                       {"formation_id", event.formation_id},
                                       {"text", event.text}};
  return json.dump();
}

}  // namespace

void ShowLogEvents(const LogEventsOptions& options, std::ostream& out) {
  LogSource source(options.file);
  double now_s = 0;
  bool is_first = true;
  recording::LogListener listener;
  listener.Hear<event_t>(bus::channel::kEvent, [&](const event_t& event) {
    if (event.severity < options.least_severity || !options.window.Holds(now_s)) return;
    if (options.json) {
      out << (is_first ? "[" : ",") << '\n' << Json(event, now_s);
    } else {
      if (is_first) out << fmt::format("{:>9}  {:<8}  {:<22}  text\n", "t, s", "severity", "code");
      out << fmt::format("{:9.2f}  {:<8}  {:<22}  {}\n", now_s,
                         kSeverityWords.at(static_cast<std::size_t>(event.severity)), event.code, event.text);
    }
    is_first = false;
  });
  source.ForEach([&](const recording::LogEvent& event, double t_s) {
    now_s = t_s;
    if (options.window.IsPast(t_s)) return false;
    listener.Take(event);
    return out.good();
  });
  if (options.json) {
    out << (is_first ? "[]\n" : "\n]\n");
  } else if (is_first) {
    out << "no events\n";
  }
  source.TellProblems();
}

}  // namespace skein::cli
