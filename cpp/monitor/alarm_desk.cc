#include "monitor/alarm_desk.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdlib>
#include <skein/alarm_list_t.hpp>
#include <utility>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/saved_bytes.h"
#include "bus/text.h"

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
  message.text = bus::Shortened(alarm.condition.text);
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

Alarm ToAlarm(const alarm_t& message) {
  Alarm alarm;
  alarm.id = message.id;
  alarm.condition = {message.condition,
                     static_cast<AlertLevel>(message.severity),
                     message.text,
                     message.vehicle_id,
                     message.other_vehicle_id,
                     message.formation_id};
  alarm.raised_utime = message.raised_utime;
  if (message.cleared_utime != 0) alarm.ended_utime = message.cleared_utime;
  if (message.acknowledged_utime != 0)
    alarm.acknowledged = {message.acknowledged_utime, message.acknowledged_by};
  if (message.shelved_until_utime != 0)
    alarm.shelved_until = {message.shelved_until_utime, message.shelved_by};
  alarm.over = message.state == alarm_t::OVER;
  return alarm;
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

AlarmDesk::AlarmDesk(bus::Bus& bus, bus::Events& events, const std::filesystem::path& state_file)
    : bus_(bus), events_(events), state_file_(state_file, "collision-monitor 1", events), inbox_(bus) {
  Restore();
  inbox_.Obey<alarm_command_t>(bus::channel::kCmdAlarm,
                               [this](const alarm_command_t& command) { return Obey(command); });
  bus.executor().Every(kLookPeriod, [this] { Look(); });
}

void AlarmDesk::Raise(const AlarmCondition& condition) {
  unconfirmed_.erase(condition.key);
  alarms_.Raise(Now(), condition);
}

void AlarmDesk::End(const std::string& key) {
  unconfirmed_.erase(key);
  alarms_.End(Now(), key);
}

void AlarmDesk::Look() {
  alarms_.Advance(Now());
  if (!unconfirmed_.empty() && Now() >= confirm_by_) {
    for (const std::string& key : std::exchange(unconfirmed_, {})) alarms_.End(Now(), key);
  }
  const bool changed = alarms_.revision() != sent_revision_;
  if (changed || Now() - sent_ >= kRepeatPeriod) Publish();
  // Also when nothing has changed: the time in it says that it is not of another flight.
  if (state_file_.kept()) state_file_.Save(Encoded());
}

std::string AlarmDesk::Encoded() const {
  bus::SavedBytes bytes;
  bytes.Add(Now());
  bytes.Add(alarms_.newest_id());
  alarm_list_t list{};
  for (const Alarm& alarm : alarms_.open()) list.alarms.push_back(ToMessage(alarm));
  for (const Alarm& alarm : alarms_.history()) list.alarms.push_back(ToMessage(alarm));
  const std::vector<alarm_list_t> chunks = bus::Split(list);
  bytes.Add(static_cast<std::int64_t>(chunks.size()));
  for (const alarm_list_t& chunk : chunks) bytes.Add(chunk);
  bytes.Add(encode_more_ ? encode_more_() : "");
  return bytes.Take();
}

void AlarmDesk::Restore() {
  const auto state = state_file_.Read();
  if (!state) return;
  bus::SavedReader reader(*state);
  const auto saved = reader.Number();
  const auto newest_id = reader.Number();
  const auto chunks = reader.Number();
  if (!chunks) return state_file_.SetAside("it holds no alarms");
  std::vector<Alarm> open;
  std::deque<Alarm> history;
  for (std::int64_t i = 0; i < *chunks; ++i) {
    const auto chunk = reader.Take<alarm_list_t>();
    if (!chunk) return state_file_.SetAside("it holds no alarms");
    for (const alarm_t& message : chunk->alarms) {
      const Alarm alarm = ToAlarm(message);
      if (alarm.over)
        history.push_back(alarm);
      else
        open.push_back(alarm);
    }
  }
  if (std::abs(Now() - *saved) > kOldestState) return;
  also_kept_ = reader.Text().value_or("");
  for (const Alarm& alarm : open) {
    if (!alarm.ended_utime) unconfirmed_.insert(alarm.condition.key);
  }
  confirm_by_ = Now() + kConfirm;
  alarms_.Restore(open, std::move(history), *newest_id);
  events_.Tell(event_t::ADVISORY, "monitor_restarted",
               fmt::format("the monitor is back, with {}", Count(open.size())));
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
    SaveNow();
  }
  return bus::Answer::Accepted(remark);
}

bus::Answer AlarmDesk::AcknowledgeAll(const alarm_command_t& command, const std::string& by) {
  const int count = alarms_.AcknowledgeUpTo(Now(), command.all_up_to_id, command.operator_name);
  if (count == 0) return bus::Answer::Accepted("nothing was left to acknowledge");
  events_.Tell(event_t::INFO, "alarm_acknowledged",
               fmt::format("acknowledged{}: {}", by, Count(static_cast<std::size_t>(count))));
  Publish();
  SaveNow();
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
