#include "simulator/link_schedule.h"

#include <spdlog/fmt/fmt.h>

#include <utility>

namespace skein::simulator {
namespace {

LinkSetting Changed(const LinkSetting& before, const LinkSetting& at_start,
                    const LinkChange::Direction& change) {
  if (change.as_at_start) return at_start;
  return {change.mode.value_or(before.mode), change.quality.value_or(before.quality)};
}

std::string Words(const LinkSetting& setting) {
  switch (setting.mode) {
    case LinkMode::kSilent:
      return "cut";
    case LinkMode::kFrozen:
      return "frozen";
    case LinkMode::kUp:
      break;
  }
  const config::LinkQuality& quality = setting.quality;
  if (quality.delay_s == 0 && quality.jitter_s == 0 && quality.loss == 0) return "up";
  return fmt::format("up with {:g} s delay, {:g} s jitter, {:g}% loss", quality.delay_s, quality.jitter_s,
                     100 * quality.loss);
}

/// Code and words of a change that was made.
struct Account {
  std::string code;
  std::string text;
};

Account Describe(const SimulatedVehicle& vehicle, const LinkSetting& uplink_before,
                 const LinkSetting& downlink_before) {
  const LinkSetting& uplink = vehicle.uplink();
  const LinkSetting& downlink = vehicle.downlink();
  const auto was_cut = [](const LinkSetting& before, const LinkSetting& after) {
    return before.mode == LinkMode::kUp && after.mode != LinkMode::kUp;
  };
  const auto was_restored = [](const LinkSetting& before, const LinkSetting& after) {
    return before.mode != LinkMode::kUp && after.mode == LinkMode::kUp;
  };
  Account account;
  if (was_cut(uplink_before, uplink) || was_cut(downlink_before, downlink)) {
    account.code = "link_cut";
  } else if (was_restored(uplink_before, uplink) || was_restored(downlink_before, downlink)) {
    account.code = "link_cut_ended";
  } else {
    account.code = "link_set";
  }
  const std::string up = Words(uplink);
  const std::string down = Words(downlink);
  account.text = up == down
                     ? fmt::format("data link of {} is {}", vehicle.callsign(), up)
                     : fmt::format("data link of {}: uplink {}, downlink {}", vehicle.callsign(), up, down);
  return account;
}

}  // namespace

LinkChange ToLinkChange(const config::TimelineEntry& entry) {
  using Direction = LinkChange::Direction;
  LinkChange change;
  if (const auto* cut = std::get_if<config::CutLink>(&entry.action)) {
    const Direction direction{cut->frozen ? LinkMode::kFrozen : LinkMode::kSilent, std::nullopt};
    change.vehicle_id = cut->vehicle_id;
    if (cut->uplink) change.uplink = direction;
    if (cut->downlink) change.downlink = direction;
    change.duration_s = cut->for_s.value_or(0);
  } else if (const auto* restore = std::get_if<config::RestoreLink>(&entry.action)) {
    change.vehicle_id = restore->vehicle_id;
    change.uplink = change.downlink = Direction{std::nullopt, std::nullopt, true};
  } else {
    const auto& set = std::get<config::SetLink>(entry.action);
    change.vehicle_id = set.vehicle_id;
    if (set.uplink) change.uplink = Direction{std::nullopt, set.uplink};
    if (set.downlink) change.downlink = Direction{std::nullopt, set.downlink};
  }
  return change;
}

LinkSchedule::LinkSchedule(std::vector<SimulatedVehicle>& fleet, Tell tell)
    : fleet_(fleet), tell_(std::move(tell)), last_changes_(fleet.size()) {
  for (std::size_t i = 0; i < fleet.size(); ++i) {
    index_[fleet[i].id()] = i;
    at_start_.push_back({fleet[i].uplink(), fleet[i].downlink()});
  }
}

bool LinkSchedule::Add(const LinkChange& change, bus::Utime now, bus::Utime when) {
  const auto found = index_.find(change.vehicle_id);
  if (found == index_.end()) return false;
  if (when <= now) {
    Make(found->second, change, now);
  } else {
    due_.emplace(when, [this, index = found->second, change](bus::Utime due) { Make(index, change, due); });
  }
  return true;
}

void LinkSchedule::AddTimeline(const std::vector<config::TimelineEntry>& timeline, bus::Utime start,
                               double repeat_s) {
  for (const config::TimelineEntry& entry : timeline) {
    Repeat(ToLinkChange(entry), start + bus::ToUtime(entry.at_s), bus::ToUtime(repeat_s));
  }
}

void LinkSchedule::Repeat(const LinkChange& change, bus::Utime when, bus::Utime period) {
  const std::size_t index = index_.at(change.vehicle_id);
  due_.emplace(when, [this, index, change, period](bus::Utime due) {
    Make(index, change, due);
    if (period > 0) Repeat(change, due + period, period);
  });
}

void LinkSchedule::RunUntil(bus::Utime now) {
  while (!due_.empty() && due_.begin()->first <= now) {
    const auto first = due_.extract(due_.begin());
    first.mapped()(first.key());
  }
}

void LinkSchedule::Make(std::size_t index, const LinkChange& change, bus::Utime now) {
  const SimulatedVehicle& vehicle = fleet_[index];
  const Settings before{vehicle.uplink(), vehicle.downlink()};
  Settings after;
  if (change.uplink) after.uplink = Changed(*before.uplink, at_start_[index].uplink, *change.uplink);
  if (change.downlink)
    after.downlink = Changed(*before.downlink, at_start_[index].downlink, *change.downlink);
  Set(index, after);
  if (change.duration_s > 0) {
    // A direction that this change left alone, or that another one changes meanwhile, is not set back.
    due_.emplace(now + bus::ToUtime(change.duration_s),
                 [this, index, after, before, number = changes_](bus::Utime) {
                   Settings back;
                   if (after.uplink && last_changes_[index].uplink == number) back.uplink = before.uplink;
                   if (after.downlink && last_changes_[index].downlink == number)
                     back.downlink = before.downlink;
                   Set(index, back);
                 });
  }
}

void LinkSchedule::Set(std::size_t index, const Settings& settings) {
  SimulatedVehicle& vehicle = fleet_[index];
  const LinkSetting uplink_before = vehicle.uplink();
  const LinkSetting downlink_before = vehicle.downlink();
  ++changes_;
  if (settings.uplink) {
    vehicle.SetUplink(*settings.uplink);
    last_changes_[index].uplink = changes_;
  }
  if (settings.downlink) {
    vehicle.SetDownlink(*settings.downlink);
    last_changes_[index].downlink = changes_;
  }
  if (vehicle.uplink() == uplink_before && vehicle.downlink() == downlink_before) return;
  const Account account = Describe(vehicle, uplink_before, downlink_before);
  tell_(vehicle, account.code, account.text);
}

}  // namespace skein::simulator
