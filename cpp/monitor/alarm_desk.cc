#include "monitor/alarm_desk.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <skein/alarm_list_t.hpp>
#include <utility>

#include "bus/channels.h"
#include "bus/chunks.h"

namespace skein::monitor {
namespace {

using Result = AlarmRegister::Result;

// However much happens, no more lists than one each kLookPeriod.
constexpr bus::Utime kLookPeriod = bus::kSecond / 4;
constexpr bus::Utime kRepeatPeriod = bus::kSecond;
constexpr double kShortestShelf_s = 1;
constexpr double kLongestShelf_s = 3600;
// More than people can read; it keeps a set below 100 kB when a thousand UAVs are lost at once.
constexpr std::size_t kMostListed = 300;
// A remark names so many alarms one by one.
constexpr std::size_t kMostNamed = 1;

alarm_t ToMessage(const Alarm& alarm) {
  alarm_t message;
  message.id = alarm.id;
  message.condition = alarm.condition.key;
  message.severity = static_cast<std::int8_t>(alarm.condition.severity);
  message.state = static_cast<std::int8_t>(alarm.state());
  message.vehicle_id = alarm.condition.vehicle_id;
  message.other_vehicle_id = alarm.condition.other_vehicle_id;
  message.formation_id = alarm.condition.formation_id;
  message.text = alarm.condition.text;
  message.raised_utime = alarm.raised_utime;
  message.cleared_utime = alarm.ended_utime.value_or(0);
  if (alarm.acknowledged) {
    message.acknowledged_utime = alarm.acknowledged->utime;
    message.acknowledged_by = alarm.acknowledged->by;
  }
  if (alarm.shelved_until) {
    message.shelved_until_utime = alarm.shelved_until->utime;
    message.shelved_by = alarm.shelved_until->by;
  }
  return message;
}

void SetCounts(alarm_list_t& list, const AlarmRegister::Counts& counts) {
  const auto of = [](const auto& by_severity, AlertLevel severity) {
    return by_severity.at(static_cast<std::size_t>(severity));
  };
  list.num_warnings = of(counts.on, AlertLevel::kWarning);
  list.num_cautions = of(counts.on, AlertLevel::kCaution);
  list.num_advisories = of(counts.on, AlertLevel::kAdvisory);
  list.num_unacknowledged_warnings = of(counts.unacknowledged, AlertLevel::kWarning);
  list.num_unacknowledged_cautions = of(counts.unacknowledged, AlertLevel::kCaution);
  list.num_unacknowledged_advisories = of(counts.unacknowledged, AlertLevel::kAdvisory);
}

const char* Done(std::int8_t action) {
  switch (action) {
    case alarm_command_t::ACTION_SHELVE:
      return "shelved";
    case alarm_command_t::ACTION_UNSHELVE:
      return "unshelved";
    default:
      return "acknowledged";
  }
}

std::string Count(std::size_t alarms) { return fmt::format("{} alarm{}", alarms, alarms == 1 ? "" : "s"); }

}  // namespace

AlarmDesk::AlarmDesk(bus::Bus& bus, bus::Events& events) : bus_(bus), events_(events), inbox_(bus) {
  inbox_.Obey<alarm_command_t>(bus::channel::kCmdAlarm,
                               [this](const alarm_command_t& command) { return Obey(command); });
  bus.executor().Every(kLookPeriod, [this] { Look(); });
}

void AlarmDesk::Raise(const AlarmCondition& condition) { alarms_.Raise(Now(), condition); }
void AlarmDesk::End(const std::string& key) { alarms_.End(Now(), key); }

void AlarmDesk::Look() {
  alarms_.Advance(Now());
  if (alarms_.revision() != sent_revision_ || Now() - sent_ >= kRepeatPeriod) Publish();
}

void AlarmDesk::Publish() {
  alarm_list_t list;
  list.utime = sent_ = Now();
  list.session_id = bus_.session_id();
  list.sequence = sequence_++;
  list.newest_id = alarms_.newest_id();
  SetCounts(list, alarms_.counts());
  const std::vector<Alarm> open = alarms_.open();
  const std::size_t listed = std::min(open.size(), kMostListed);
  list.num_not_listed = static_cast<int>(open.size() - listed);
  for (std::size_t i = 0; i < listed; ++i) list.alarms.push_back(ToMessage(open[i]));
  for (const Alarm& alarm : alarms_.history()) list.alarms.push_back(ToMessage(alarm));
  sent_revision_ = alarms_.revision();
  bus::PublishChunks(bus_, bus::channel::kAlarms, list);
}

bus::Answer AlarmDesk::Obey(const alarm_command_t& command) {
  if (command.alarm_session_id != bus_.session_id()) {
    return bus::Answer::Refused("the alarms have been numbered anew since: look at them again");
  }
  const bool shelves = command.action == alarm_command_t::ACTION_SHELVE;
  if (shelves && (command.duration_s < kShortestShelf_s || command.duration_s > kLongestShelf_s)) {
    return bus::Answer::Refused(fmt::format("an alarm can be shelved for {:.0f} to {:.0f} s, not {:g}",
                                            kShortestShelf_s, kLongestShelf_s, command.duration_s));
  }
  const std::string by = command.operator_name.empty() ? "" : " by " + command.operator_name;
  if (command.all_up_to_id > 0) {
    if (command.action != alarm_command_t::ACTION_ACKNOWLEDGE) {
      return bus::Answer::Refused("alarms are shelved and unshelved one by one");
    }
    return AcknowledgeAll(command, by);
  }
  if (command.alarm_ids.empty()) return bus::Answer::Refused("no alarm is named");
  for (const std::int64_t id : command.alarm_ids) {
    if (!alarms_.Find(id)) return bus::Answer::Refused(fmt::format("there is no alarm {}", id));
  }

  std::string remark;
  std::vector<std::string> done;
  for (const std::int64_t id : command.alarm_ids) {
    const std::string text = alarms_.Find(id)->condition.text;
    const Result result = Apply(command, id, command.operator_name);
    if (result == Result::kDone) done.push_back(text);
    if (result == Result::kOver) remark = fmt::format("alarm {} is over", id);
    if (result == Result::kAlready) remark = fmt::format("alarm {} was {} before", id, Done(command.action));
  }
  if (!done.empty()) {
    const std::string what = done.size() <= kMostNamed ? done.front() : Count(done.size());
    const std::string how_long = shelves ? fmt::format(" for {:g} s", command.duration_s) : "";
    events_.Tell(event_t::INFO, std::string("alarm_") + Done(command.action),
                 fmt::format("{}{}{}: {}", Done(command.action), how_long, by, what));
    Publish();
  }
  return bus::Answer::Accepted(remark);
}

bus::Answer AlarmDesk::AcknowledgeAll(const alarm_command_t& command, const std::string& by) {
  const int count = alarms_.AcknowledgeUpTo(Now(), command.all_up_to_id, command.operator_name);
  if (count == 0) return bus::Answer::Accepted("nothing was left to acknowledge");
  events_.Tell(event_t::INFO, "alarm_acknowledged",
               fmt::format("acknowledged{}: {}", by, Count(static_cast<std::size_t>(count))));
  Publish();
  return bus::Answer::Accepted();
}

AlarmRegister::Result AlarmDesk::Apply(const alarm_command_t& command, std::int64_t id,
                                       const std::string& by) {
  switch (command.action) {
    case alarm_command_t::ACTION_SHELVE:
      return alarms_.Shelve(id, {Now() + bus::ToUtime(command.duration_s), by});
    case alarm_command_t::ACTION_UNSHELVE:
      return alarms_.Unshelve(Now(), id);
    default:
      return alarms_.Acknowledge(Now(), id, by);
  }
}

}  // namespace skein::monitor
