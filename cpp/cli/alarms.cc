#include "cli/alarms.h"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <skein/alarm_command_t.hpp>
#include <string_view>

#include "bus/alarm_json.h"
#include "bus/channels.h"
#include "cli/text_table.h"

namespace skein::cli {
namespace {

constexpr const char* kMonitor = "collision-monitor";
constexpr std::array<std::string_view, 4> kSeverities = {"-", "advisory", "caution", "WARNING"};
constexpr std::array<std::string_view, 5> kStates = {"UNACKNOWLEDGED", "acknowledged",
                                                     "ended, unacknowledged", "shelved", "over"};

const alarm_list_t& List(Station& station) {
  if (!station.WaitUntil([&] { return station.picture().alarms.has_value(); }, kLongestPeriod)) {
    throw Failure(
        fmt::format("no alarms were heard for 2.5 s: is {} running, and on this LCM URL?", kMonitor));
  }
  return *station.picture().alarms;
}

std::string State(const alarm_t& alarm, bus::Utime now) {
  std::string text(kStates.at(static_cast<std::size_t>(alarm.state)));
  if (alarm.state == alarm_t::SHELVED) {
    text += fmt::format(" for {:.0f} s", bus::ToSeconds(alarm.shelved_until_utime - now));
  } else if (alarm.state == alarm_t::ACKNOWLEDGED && !alarm.acknowledged_by.empty()) {
    text += " by " + alarm.acknowledged_by;
  }
  return text;
}

std::string Ago(bus::Utime utime, bus::Utime now) {
  return fmt::format("{:.0f} s ago", bus::ToSeconds(now - utime));
}

alarm_command_t Command(const alarm_list_t& list, std::int8_t action) {
  alarm_command_t command;
  command.action = action;
  command.operator_name = OperatorName();
  command.alarm_session_id = list.session_id;
  return command;
}

void SetIds(alarm_command_t& command, const std::vector<std::string>& ids) {
  for (const std::string& text : ids) {
    std::int64_t id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (error != std::errc() || end != text.data() + text.size() || id < 1) {
      throw Failure("alarms have numbers, as `skein alarms` lists them, not \"" + text + "\"");
    }
    command.alarm_ids.push_back(id);
  }
  command.num_alarm_ids = static_cast<int>(command.alarm_ids.size());
}

void Send(Station& station, const alarm_command_t& command, const std::string& done, std::ostream& out) {
  const std::string remark = station.Ask(bus::channel::kCmdAlarm, command, kMonitor);
  Done(out, done, remark);
}

std::string Names(const std::vector<std::string>& ids) {
  std::string text = ids.size() == 1 ? "alarm" : "alarms";
  for (const std::string& id : ids) text += " " + id;
  return text;
}

}  // namespace

void ShowAlarms(Station& station, const AlarmsOptions& options, std::ostream& out) {
  const alarm_list_t& list = List(station);
  auto json = nlohmann::ordered_json::array();
  Table table = {{"id", "severity", "state", "raised", "alarm"}};
  for (const alarm_t& alarm : list.alarms) {
    if (alarm.state == alarm_t::OVER && !options.history) continue;
    json.push_back(bus::ToJson(alarm));
    table.push_back({std::to_string(alarm.id),
                     std::string(kSeverities.at(static_cast<std::size_t>(alarm.severity))),
                     State(alarm, list.utime), Ago(alarm.raised_utime, list.utime), alarm.text});
  }
  if (options.json) {
    out << json.dump(1) << '\n';
  } else if (table.size() == 1) {
    out << "no alarms\n";
  } else {
    out << Aligned(table, table.front().size());
    if (list.num_not_listed > 0) out << fmt::format("and {} less urgent ones\n", list.num_not_listed);
  }
}

void AcknowledgeAlarms(Station& station, const std::vector<std::string>& ids, std::ostream& out) {
  const alarm_list_t& list = List(station);
  alarm_command_t command = Command(list, alarm_command_t::ACTION_ACKNOWLEDGE);
  if (ids.size() == 1 && ids.front() == "all") {
    if (list.newest_id == 0) {
      out << "there was no alarm yet\n";
      return;
    }
    command.all_up_to_id = list.newest_id;
    Send(station, command, "all alarms acknowledged", out);
  } else {
    SetIds(command, ids);
    Send(station, command, Names(ids) + " acknowledged", out);
  }
}

void ShelveAlarms(Station& station, const std::vector<std::string>& ids, double for_s, std::ostream& out) {
  alarm_command_t command = Command(List(station), alarm_command_t::ACTION_SHELVE);
  SetIds(command, ids);
  command.duration_s = for_s;
  Send(station, command, fmt::format("{} shelved for {:g} s", Names(ids), for_s), out);
}

void UnshelveAlarms(Station& station, const std::vector<std::string>& ids, std::ostream& out) {
  alarm_command_t command = Command(List(station), alarm_command_t::ACTION_UNSHELVE);
  SetIds(command, ids);
  Send(station, command, Names(ids) + " unshelved", out);
}

}  // namespace skein::cli
