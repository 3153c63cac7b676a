#include "core/alarm_register.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace skein {

AlarmState Alarm::state() const {
  if (over) return AlarmState::kOver;
  if (shelved_until) return AlarmState::kShelved;
  if (ended_utime) return AlarmState::kEnded;
  return acknowledged ? AlarmState::kAcknowledged : AlarmState::kUnacknowledged;
}

void AlarmRegister::Raise(std::int64_t now, const AlarmCondition& condition) {
  std::optional<Alarm::Act> shelved_until;
  if (const auto known = open_.find(condition.key); known != open_.end()) {
    Alarm& before = known->second;
    const bool worse = condition.severity > before.condition.severity;
    if (!before.ended_utime && !worse) {
      // Better than it was. Who has acknowledged it knows the worst; who has not must see that.
      if (!before.acknowledged || condition.severity == before.condition.severity) return;
      before.condition = condition;
      ++revision_;
      return;
    }
    if (!worse) shelved_until = before.shelved_until;
    Close(known, now);
  }
  Alarm& alarm = open_[condition.key];
  alarm.id = ++newest_id_;
  alarm.condition = condition;
  alarm.raised_utime = now;
  alarm.shelved_until = shelved_until;
  ++revision_;
}

void AlarmRegister::End(std::int64_t now, const std::string& key) {
  const auto entry = open_.find(key);
  if (entry == open_.end() || entry->second.ended_utime) return;
  entry->second.ended_utime = now;
  ++revision_;
  if (entry->second.state() == AlarmState::kShelved) return;
  if (entry->second.acknowledged) {
    Close(entry, now);
  } else {
    LimitEnded(now);
  }
}

void AlarmRegister::Advance(std::int64_t now) {
  for (auto entry = open_.begin(); entry != open_.end();) {
    const auto current = entry++;
    const Alarm& alarm = current->second;
    if (alarm.shelved_until && alarm.shelved_until->utime <= now) BringBack(current, now);
  }
}

AlarmRegister::Result AlarmRegister::Acknowledge(std::int64_t now, std::int64_t id, const std::string& by) {
  const auto entry = FindOpen(id);
  if (entry == open_.end()) return WhyNotOpen(id);
  if (entry->second.acknowledged) return Result::kAlready;
  Acknowledge(entry, now, by);
  return Result::kDone;
}

void AlarmRegister::Acknowledge(Entry entry, std::int64_t now, const std::string& by) {
  Alarm& alarm = entry->second;
  alarm.acknowledged = {now, by};
  ++revision_;
  if (alarm.state() == AlarmState::kEnded) Close(entry, now);
}

int AlarmRegister::AcknowledgeUpTo(std::int64_t now, std::int64_t id, const std::string& by) {
  std::vector<Entry> meant;
  for (auto entry = open_.begin(); entry != open_.end(); ++entry) {
    const Alarm& alarm = entry->second;
    if (alarm.id <= id && !alarm.acknowledged && !alarm.shelved_until) meant.push_back(entry);
  }
  // In the order in which they were raised, for the history.
  std::ranges::sort(meant, {}, [](const Entry& entry) { return entry->second.id; });
  for (const Entry& entry : meant) Acknowledge(entry, now, by);
  return static_cast<int>(meant.size());
}

AlarmRegister::Result AlarmRegister::Shelve(std::int64_t id, const Alarm::Act& until) {
  const auto entry = FindOpen(id);
  if (entry == open_.end()) return WhyNotOpen(id);
  entry->second.shelved_until = until;
  ++revision_;
  return Result::kDone;
}

AlarmRegister::Result AlarmRegister::Unshelve(std::int64_t now, std::int64_t id) {
  const auto entry = FindOpen(id);
  if (entry == open_.end()) return WhyNotOpen(id);
  if (!entry->second.shelved_until) return Result::kAlready;
  BringBack(entry, now);
  return Result::kDone;
}

const Alarm* AlarmRegister::Find(std::int64_t id) const {
  for (const auto& [key, alarm] : open_) {
    if (alarm.id == id) return &alarm;
  }
  const auto past = std::ranges::find(history_, id, &Alarm::id);
  return past == history_.end() ? nullptr : &*past;
}

std::vector<Alarm> AlarmRegister::open() const {
  std::vector<Alarm> alarms;
  for (const auto& [key, alarm] : open_) alarms.push_back(alarm);
  const auto urgency = [](const Alarm& alarm) {
    return std::tuple(alarm.state(), -static_cast<int>(alarm.condition.severity), -alarm.id);
  };
  std::ranges::sort(alarms, {}, urgency);
  return alarms;
}

void AlarmRegister::Restore(const std::vector<Alarm>& open, std::deque<Alarm> history,
                            std::int64_t newest_id) {
  for (const Alarm& alarm : open) open_[alarm.condition.key] = alarm;
  history_ = std::move(history);
  newest_id_ = newest_id;
  ++revision_;
}

AlarmRegister::Counts AlarmRegister::counts() const {
  Counts counts;
  for (const auto& [key, alarm] : open_) {
    if (alarm.shelved_until) continue;
    const auto severity = static_cast<std::size_t>(alarm.condition.severity);
    if (!alarm.ended_utime) ++counts.on.at(severity);
    if (!alarm.acknowledged) ++counts.unacknowledged.at(severity);
  }
  return counts;
}

AlarmRegister::Entry AlarmRegister::FindOpen(std::int64_t id) {
  return std::ranges::find_if(open_, [id](const auto& entry) { return entry.second.id == id; });
}

AlarmRegister::Result AlarmRegister::WhyNotOpen(std::int64_t id) const {
  return Find(id) ? Result::kOver : Result::kUnknown;
}

void AlarmRegister::Close(Entry entry, std::int64_t now) {
  Alarm alarm = std::move(entry->second);
  open_.erase(entry);
  if (!alarm.ended_utime) alarm.ended_utime = now;
  alarm.over = true;
  history_.push_front(std::move(alarm));
  if (history_.size() > kHistory) history_.pop_back();
  ++revision_;
}

void AlarmRegister::BringBack(Entry entry, std::int64_t now) {
  Alarm& alarm = entry->second;
  alarm.shelved_until.reset();
  alarm.acknowledged.reset();
  ++revision_;
  if (alarm.ended_utime) Close(entry, now);
}

void AlarmRegister::LimitEnded(std::int64_t now) {
  std::size_t ended = 0;
  auto oldest = open_.end();
  for (auto entry = open_.begin(); entry != open_.end(); ++entry) {
    if (entry->second.state() != AlarmState::kEnded) continue;
    ++ended;
    if (oldest == open_.end() || entry->second.id < oldest->second.id) oldest = entry;
  }
  if (ended > kMostEnded) Close(oldest, now);
}

}  // namespace skein
