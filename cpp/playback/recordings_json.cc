#include "playback/recordings_json.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <regex>
#include <skein/event_t.hpp>
#include <string>
#include <utility>
#include <vector>

#include "playback/open_recording.h"

namespace skein::playback {
namespace {

using bridge::Json;

constexpr double kMostBins = 600;
constexpr std::size_t kMostMarks = 5'000;

struct Mark {
  double t_s = 0;
  const char* kind = "";
  int severity = 0;
  std::string code;
  std::string text;

  bool marker() const { return kind[0] == 'm'; }
};

class Description {
 public:
  explicit Description(const RecordedFlight& flight) : flight_(flight) {}

  Json Density() const {
    // Whole seconds, so that bins of two recordings can be told apart by the eye.
    const double bin_s = std::max(1.0, std::ceil(flight_.duration_s() / kMostBins));
    const auto bins = static_cast<std::size_t>(flight_.duration_s() / bin_s) + 1;
    std::vector<int> events(bins);
    std::vector<int> warnings(bins);
    for (const Mark& mark : Events()) {
      const auto bin = std::min(bins - 1, static_cast<std::size_t>(mark.t_s / bin_s));
      ++events[bin];
      if (mark.severity >= event_t::CAUTION) ++warnings[bin];
    }
    return {{"bin_s", bin_s}, {"events", events}, {"warnings", warnings}};
  }

  Json Marks() const {
    std::vector<Mark> marks = Events();
    for (const auto& alarm : flight_.Alarms()) {
      marks.push_back({Since(alarm.utime), "alarm", alarm.severity, alarm.condition, alarm.text});
    }
    if (marks.size() > kMostMarks) {
      std::ranges::stable_sort(marks, std::ranges::greater(),
                               [](const Mark& mark) { return std::pair(mark.marker(), mark.severity); });
      marks.resize(kMostMarks);
    }
    std::ranges::stable_sort(marks, {}, &Mark::t_s);
    Json list = Json::array();
    for (const Mark& mark : marks) {
      list.push_back({{"t_s", mark.t_s},
                      {"kind", mark.kind},
                      {"severity", mark.severity},
                      {"code", mark.code},
                      {"text", mark.text}});
    }
    return list;
  }

  Json Flights() const {
    Json list = Json::array();
    std::optional<bus::Utime> last;
    for (const auto& part : flight_.parts()) {
      for (const auto& flight : part.index->flights) {
        if (last == flight.start_utime) continue;  // it goes on in the next part
        last = flight.start_utime;
        list.push_back({{"t_s", Since(flight.utime + part.shift)},
                        {"start_utime", flight.start_utime},
                        {"scenario", flight.scenario}});
      }
    }
    return list;
  }

  Json Channels() const {
    std::map<std::string, recording::ChannelCount> channels;
    for (const auto& part : flight_.parts()) {
      for (const auto& one : part.index->channels) {
        auto& sum = channels[one.name];
        sum.known = one.known;
        sum.count += one.count;
        sum.bytes += one.bytes;
        sum.undecodable += one.undecodable;
      }
    }
    Json list = Json::array();
    for (const auto& [name, count] : channels) {
      list.push_back({{"name", name},
                      {"count", count.count},
                      {"bytes", count.bytes},
                      {"known", count.known},
                      {"undecodable", count.undecodable}});
    }
    return list;
  }

  Json Damages() const {
    Json list = Json::array();
    for (const std::string& problem : flight_.problems()) {
      list.push_back({{"t_s", 0}, {"bytes", 0}, {"reason", problem}});
    }
    for (const auto& part : flight_.parts()) {
      for (const auto& damage : part.index->damage) {
        list.push_back(
            {{"t_s", Since(damage.utime + part.shift)}, {"bytes", damage.bytes}, {"reason", damage.reason}});
        if (list.size() >= kMostMarks) return list;
      }
    }
    return list;
  }

 private:
  double Since(bus::Utime utime) const { return bus::ToSeconds(utime - flight_.start()); }

  std::vector<Mark> Events() const {
    std::vector<Mark> marks;
    for (const auto& part : flight_.parts()) {
      for (const auto& event : part.index->told) {
        marks.push_back({Since(event.utime + part.shift),
                         event.code == recording::kMarkerCode ? "marker" : "event", event.severity,
                         event.code, event.text});
      }
    }
    return marks;
  }

  const RecordedFlight& flight_;
};

/// "hangar" of "hangar-20261125-143000.lcm"; null for a name of another make.
Json ScenarioInName(const std::string& name) {
  static const std::regex pattern(R"((.+)-[0-9]{8}-[0-9]{6}(-[0-9]+)?\.lcm)");
  std::smatch match;
  return std::regex_match(name, match, pattern) ? Json(match[1].str()) : Json();
}

}  // namespace

Json ListJson(const RecordingLibrary& library, const std::vector<RecordingLibrary::Listed>& list,
              bool live_bus) {
  Json recordings = Json::array();
  for (const auto& [files, summary, progress, problem] : list) {
    const auto known = [&summary = summary](auto RecordingSummary::*field) {
      return summary ? Json((*summary).*field) : Json();
    };
    Json scenario = known(&RecordingSummary::scenario);
    if (scenario.is_null() || scenario == "") scenario = ScenarioInName(files.name);
    recordings.push_back({{"name", files.name},
                          {"scenario", scenario},
                          {"start_utime", known(&RecordingSummary::start_utime)},
                          {"duration_s", known(&RecordingSummary::duration_s)},
                          {"bytes", files.bytes},
                          {"parts", files.parts.size()},
                          {"vehicles", known(&RecordingSummary::vehicles)},
                          {"alarms", known(&RecordingSummary::alarms)},
                          {"warnings", known(&RecordingSummary::warnings)},
                          {"markers", known(&RecordingSummary::markers)},
                          {"indexed", summary.has_value()},
                          {"progress", progress},
                          {"recording_now", files.recording_now},
                          {"problem", problem}});
  }
  return {{"folder", library.folder().string()}, {"live_bus", live_bus}, {"recordings", recordings}};
}

Json RecordingJson(const RecordingFiles& files, const RecordedFlight& flight) {
  const RecordingSummary summary = Summarize(flight);
  const Description description(flight);
  Json scenario = summary.scenario.empty() ? ScenarioInName(files.name) : Json(summary.scenario);
  return {{"name", files.name},
          {"scenario", scenario},
          {"start_utime", flight.start()},
          {"duration_s", flight.duration_s()},
          {"bytes", files.bytes},
          {"parts", files.parts.size()},
          {"vehicles", summary.vehicles},
          {"recording_now", files.recording_now},
          {"density", description.Density()},
          {"marks", description.Marks()},
          {"flights", description.Flights()},
          {"channels", description.Channels()},
          {"damage", description.Damages()}};
}

}  // namespace skein::playback
