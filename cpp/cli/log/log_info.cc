#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <skein/alarm_list_t.hpp>
#include <skein/event_t.hpp>
#include <skein/fleet_roster_t.hpp>

#include "bus/channels.h"
#include "cli/log/log.h"
#include "cli/log/log_source.h"
#include "cli/log/text.h"
#include "cli/text_table.h"
#include "recording/log_listener.h"
#include "recording/message_types.h"

namespace skein::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostListed = 1'000;
constexpr std::size_t kMostShown = 20;
constexpr const char* kMore = "  and more, which --json lists\n";

struct Channel {
  std::string type;  ///< of Skein's, "" while none was seen
  std::int64_t count = 0;
  std::uint64_t bytes = 0;
  std::int64_t good = 0;
  double first_s = 0;
  double last_s = 0;

  bool known() const { return !type.empty(); }
  std::int64_t undecodable() const { return known() ? count - good : 0; }
  /// Messages a second while it was alive; 0: too few to tell.
  double rate_hz() const {
    return last_s > first_s ? static_cast<double>(count - 1) / (last_s - first_s) : 0;
  }
};

struct Flight {
  double t_s = 0;
  std::string scenario;
  bus::Utime start_utime = 0;
  std::map<int, std::string> vehicles;  ///< callsigns by id
};

struct Alarm {
  double t_s = 0;
  int severity = 0;
  std::string text;
};

/// What is found in one pass.
class Survey {
 public:
  explicit Survey(LogSource& source);

  Json ToJson() const;
  std::string ToText() const;

 private:
  void Count(const recording::LogEvent& event);
  void Hear(const fleet_roster_t& roster);
  void Hear(const event_t& event);
  void Hear(const alarm_list_t& list);

  const LogSource& source_;
  std::map<std::string, Channel, std::less<>> channels_;
  double now_s_ = 0;
  bus::Utime first_utime_ = 0;
  std::int64_t messages_ = 0;
  std::vector<Flight> flights_;
  std::array<std::int64_t, 4> events_{};
  std::vector<std::pair<double, std::string>> markers_;
  std::vector<Alarm> alarms_;
  std::int64_t alarm_count_ = 0;
  std::set<std::pair<std::int64_t, std::int64_t>> seen_alarms_;  ///< session and id
};

Survey::Survey(LogSource& source) : source_(source) {
  namespace channel = bus::channel;
  recording::LogListener listener;
  listener.HearWhole<fleet_roster_t>(channel::kFleetRoster, [this](const auto& roster) { Hear(roster); });
  listener.Hear<event_t>(channel::kEvent, [this](const event_t& event) { Hear(event); });
  listener.Hear<alarm_list_t>(channel::kAlarms, [this](const alarm_list_t& list) { Hear(list); });
  source.ForEach([&](const recording::LogEvent& event, double t_s) {
    if (messages_++ == 0) first_utime_ = event.utime;
    now_s_ = t_s;
    Count(event);
    listener.Take(event);
    return true;
  });
}

void Survey::Count(const recording::LogEvent& event) {
  auto found = channels_.find(event.channel);
  if (found == channels_.end()) {
    const bool is_one_too_many = channels_.size() >= kMostChannels;
    found = channels_.emplace(is_one_too_many ? "(more)" : std::string(event.channel), Channel()).first;
    if (found->second.count == 0) found->second.first_s = now_s_;
  }
  Channel& channel = found->second;
  ++channel.count;
  channel.bytes += event.data.size();
  channel.last_s = now_s_;
  const recording::MessageType* type = recording::TypeOf(event.data);
  if (!type || !type->is_good(event.data)) return;
  ++channel.good;
  if (channel.type.empty()) channel.type = type->name;
}

void Survey::Hear(const fleet_roster_t& roster) {
  if (flights_.empty() || flights_.back().start_utime != roster.start_utime) {
    if (flights_.size() >= kMostListed) return;
    flights_.push_back({now_s_, roster.scenario, roster.start_utime, {}});
  }
  for (const vehicle_info_t& vehicle : roster.vehicles) {
    flights_.back().vehicles[vehicle.id] = vehicle.callsign;
  }
}

void Survey::Hear(const event_t& event) {
  ++events_.at(static_cast<std::size_t>(event.severity));
  if (event.code == "marker" && markers_.size() < kMostListed) markers_.emplace_back(now_s_, event.text);
}

void Survey::Hear(const alarm_list_t& list) {
  for (const alarm_t& alarm : list.alarms) {
    if (alarm.state == alarm_t::OVER || seen_alarms_.size() >= 100 * kMostListed) continue;
    if (!seen_alarms_.emplace(list.session_id, alarm.id).second) continue;
    ++alarm_count_;
    if (alarms_.size() < kMostListed) alarms_.push_back({now_s_, alarm.severity, alarm.text});
  }
}

/// Rounded to a thousandth, for people.
double Rounded(double value) { return std::round(value * 1000) / 1000; }

Json Survey::ToJson() const {
  const recording::Recording& recording = source_.recording();
  Json json = {{"file", source_.file()},         {"bytes", recording.bytes()},
               {"start", IsoTime(first_utime_)}, {"start_utime", first_utime_},
               {"duration_s", Rounded(now_s_)},  {"messages", messages_}};
  json["parts"] = Json::array();
  for (const auto& part : recording.parts()) json["parts"].push_back(part->file().string());
  json["flights"] = Json::array();
  for (const Flight& flight : flights_) {
    Json vehicles = Json::array();
    for (const auto& [id, callsign] : flight.vehicles)
      vehicles.push_back({{"id", id}, {"callsign", callsign}});
    json["flights"].push_back({{"t_s", Rounded(flight.t_s)},
                               {"scenario", flight.scenario},
                               {"start_utime", flight.start_utime},
                               {"vehicles", vehicles}});
  }
  json["channels"] = Json::array();
  for (const auto& [name, channel] : channels_) {
    json["channels"].push_back({{"name", Printable(name)},
                                {"type", channel.known() ? Json(channel.type) : Json()},
                                {"known", channel.known()},
                                {"count", channel.count},
                                {"bytes", channel.bytes},
                                {"rate_hz", Rounded(channel.rate_hz())},
                                {"first_s", Rounded(channel.first_s)},
                                {"last_s", Rounded(channel.last_s)},
                                {"undecodable", channel.undecodable()}});
  }
  for (std::size_t i = 0; i < events_.size(); ++i) json["events"][kSeverities.at(i)] = events_.at(i);
  json["alarm_count"] = alarm_count_;
  json["alarms"] = Json::array();
  for (const Alarm& alarm : alarms_) {
    json["alarms"].push_back(
        {{"t_s", Rounded(alarm.t_s)}, {"severity", alarm.severity}, {"text", alarm.text}});
  }
  json["markers"] = Json::array();
  for (const auto& [t_s, text] : markers_) {
    json["markers"].push_back({{"t_s", Rounded(t_s)}, {"text", text}});
  }
  json["problems"] = recording.problems();
  json["damaged_bytes"] = source_.damaged_bytes();
  json["damage"] = Json::array();
  for (const auto& [file, damage] : source_.damage()) {
    json["damage"].push_back({{"file", file.string()},
                              {"offset", damage.offset},
                              {"bytes", damage.bytes},
                              {"reason", damage.reason}});
  }
  return json;
}

std::string ChannelTable(const std::map<std::string, Channel, std::less<>>& channels) {
  Table table = {{"channel", "type", "messages", "rate, Hz", "size", "undecodable"}};
  for (const bool known : {true, false}) {
    for (const auto& [name, channel] : channels) {
      if (channel.known() != known) continue;
      table.push_back({Printable(name), known ? channel.type : "unknown", std::to_string(channel.count),
                       channel.rate_hz() > 0 ? fmt::format("{:.2f}", channel.rate_hz()) : "-",
                       ByteText(channel.bytes), known ? std::to_string(channel.undecodable()) : "-"});
    }
  }
  return Aligned(table, 2);
}

std::string Survey::ToText() const {
  const recording::Recording& recording = source_.recording();
  std::string text = fmt::format(
      "{}: {}{}, {} messages\nstart     {}\nduration  {}\n", source_.file(), ByteText(recording.bytes()),
      recording.parts().size() > 1 ? fmt::format(" in {} parts", recording.parts().size()) : "", messages_,
      IsoTime(first_utime_), DurationText(now_s_));
  for (const Flight& flight : flights_) {
    std::string callsigns;
    std::size_t listed = 0;
    for (const auto& [id, callsign] : flight.vehicles) {
      if (++listed > 8) break;
      callsigns += (listed > 1 ? ", " : "") + callsign;
    }
    text +=
        fmt::format("scenario  {}, {} UAVs: {}{}", flight.scenario.empty() ? "(no name)" : flight.scenario,
                    flight.vehicles.size(), callsigns, listed > 8 ? ", ..." : "");
    text += flights_.size() > 1 ? fmt::format(" (from {:.1f} s on)\n", flight.t_s) : "\n";
  }
  if (flights_.empty()) text += "scenario  unknown: no FLEET_ROSTER was recorded\n";
  text += "events    ";
  for (std::size_t i = events_.size(); i-- > 0;) {
    text += fmt::format("{} {}{}", events_.at(i), kSeverities.at(i), i > 0 ? ", " : "\n");
  }
  text += fmt::format("alarms    {}\n", alarm_count_);
  for (std::size_t i = 0; i < std::min(alarms_.size(), kMostShown); ++i) {
    text += fmt::format("  {:9.2f} s  {:<8}  {}\n", alarms_[i].t_s,
                        kSeverities.at(static_cast<std::size_t>(alarms_[i].severity)), alarms_[i].text);
  }
  if (alarms_.size() > kMostShown) text += kMore;
  if (!markers_.empty()) text += fmt::format("markers   {}\n", markers_.size());
  for (std::size_t i = 0; i < std::min(markers_.size(), kMostShown); ++i) {
    text += fmt::format("  {:9.2f} s  {}\n", markers_[i].first, markers_[i].second);
  }
  if (markers_.size() > kMostShown) text += kMore;
  for (const std::string& problem : recording.problems()) text += "problem   " + problem + '\n';
  const auto damage = source_.damage();
  if (damage.empty()) {
    text += "damage    none\n";
  } else {
    text += fmt::format("damage    {} could not be read\n", ByteText(source_.damaged_bytes()));
  }
  for (std::size_t i = 0; i < std::min(damage.size(), kMostShown); ++i) {
    text += fmt::format("  {}: {} from byte {} on: {}\n", damage[i].file.filename().string(),
                        ByteText(damage[i].damage.bytes), damage[i].damage.offset, damage[i].damage.reason);
  }
  if (damage.size() > kMostShown) text += kMore;
  return text + '\n' + ChannelTable(channels_);
}

}  // namespace

void ShowLogInfo(const LogInfoOptions& options, std::ostream& out) {
  LogSource source(options.file);
  const Survey survey(source);
  out << (options.json ? survey.ToJson().dump(1, ' ', false, Json::error_handler_t::replace) + '\n'
                       : survey.ToText());
}

}  // namespace skein::cli
