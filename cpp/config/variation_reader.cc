#include <algorithm>
#include <cmath>

#include "config/readers.h"

namespace skein::config {
namespace {

Span ReadSpan(const Value& value, Range range) {
  const auto ends = value.Items();
  if (ends.size() != 2) value.Refuse("must be two numbers, the least and the greatest");
  const Span span{ends[0].Number(range), ends[1].Number(range)};
  if (span.least > span.most) value.Refuse("the first number must not be greater than the second");
  return span;
}

std::optional<Span> FindSpan(const Object& object, std::string_view key, Range range) {
  const auto value = object.Find(key);
  return value ? std::optional(ReadSpan(*value, range)) : std::nullopt;
}

StartVariation ReadStart(const Value& value) {
  const Object object(value, {"vehicles", "east_m", "north_m", "up_m", "speed_m_s", "course_deg"});
  StartVariation start;
  for (const Value& id : object.Items("vehicles")) start.vehicles.push_back(id.Integer(kIds));
  start.east_m = object.Number("east_m", {0, 20e3}, 0);
  start.north_m = object.Number("north_m", {0, 20e3}, 0);
  start.up_m = object.Number("up_m", {0, 5e3}, 0);
  start.speed_m_s = object.Number("speed_m_s", {0, 200}, 0);
  start.course_rad = object.Number("course_deg", {0, 180}, 0) * M_PI / 180;
  return start;
}

LinkVariation ReadLink(const Value& value) {
  const Object object(value, {"delay_s", "jitter_s", "loss"});
  return {.delay_s = FindSpan(object, "delay_s", {0, 60}),
          .jitter_s = FindSpan(object, "jitter_s", {0, 60}),
          .loss = FindSpan(object, "loss", {0, 1})};
}

/// Every start that can be drawn must be one that the file could give.
void CheckStarts(const Object& start, const StartVariation& vary, const Scenario& scenario) {
  const auto ids = start.Items("vehicles");
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto is_it = [&](const VehicleConfig& vehicle) { return vehicle.id == vary.vehicles[i]; };
    if (std::none_of(scenario.vehicles.begin(), scenario.vehicles.end(), is_it)) {
      ids[i].Refuse("there is no UAV " + std::to_string(vary.vehicles[i]) + " in this scenario");
    }
    if (std::count(vary.vehicles.begin(), vary.vehicles.end(), vary.vehicles[i]) > 1) {
      ids[i].Refuse("is there more than once");
    }
  }
  const auto check = [&](const VehicleConfig& vehicle, std::string_view key, double value, double by,
                         Range range) {
    if (by == 0 || (value - by >= range.least && value + by <= range.most)) return;
    start.At(key).Refuse(vehicle.callsign + " could start outside of " + Shown(range.least) + " .. " +
                         Shown(range.most));
  };
  for (const VehicleConfig& vehicle : scenario.vehicles) {
    if (!vary.vehicles.empty() &&
        std::find(vary.vehicles.begin(), vary.vehicles.end(), vehicle.id) == vary.vehicles.end()) {
      continue;
    }
    const Envelope& envelope = vehicle.model.envelope;
    check(vehicle, "east_m", vehicle.start.east_m, vary.east_m, kHorizontalM);
    check(vehicle, "north_m", vehicle.start.north_m, vary.north_m, kHorizontalM);
    check(vehicle, "up_m", vehicle.start.up_m, vary.up_m, kUpM);
    check(vehicle, "speed_m_s", vehicle.start.speed_m_s, vary.speed_m_s,
          {envelope.min_speed_m_s, envelope.max_speed_m_s});
  }
}

TimelineVariation ReadTimeline(const Value& value, const Scenario& scenario) {
  const Object object(value, {"at_s", "for_s"});
  const TimelineVariation vary{.at_s = object.Number("at_s", kSeconds, 0),
                               .for_s = object.Number("for_s", kSeconds, 0)};
  if (scenario.timeline.empty()) value.Refuse("there is no timeline to vary");
  double latest_s = 0;
  for (const TimelineEntry& entry : scenario.timeline) {
    const auto* cut = std::get_if<CutLink>(&entry.action);
    const double for_s = cut ? cut->for_s.value_or(0) : 0;
    if (entry.at_s < vary.at_s) {
      object.At("at_s").Refuse(Shown(entry.at_s) + " s after the start is sooner than that in the timeline");
    }
    if (for_s > 0 && for_s - vary.for_s < 0.05) {
      object.At("for_s").Refuse("a link is cut for " + Shown(for_s) + " s only in the timeline");
    }
    latest_s = std::max(latest_s, entry.at_s + vary.at_s + (for_s > 0 ? for_s + vary.for_s : 0));
  }
  if (scenario.timeline_repeat_s > 0 && latest_s >= scenario.timeline_repeat_s) {
    value.Refuse("the timeline could end after " + Shown(latest_s) + " s, later than timeline_repeat_s");
  }
  return vary;
}

}  // namespace

Variation ReadVariation(const Value& value, const Scenario& scenario) {
  const Object object(value, {"start", "timeline", "link", "autopilot_scale"});
  Variation vary;
  if (const auto start = object.Find("start")) {
    vary.start = ReadStart(*start);
    CheckStarts(Object(*start), vary.start, scenario);
  }
  if (const auto timeline = object.Find("timeline")) vary.timeline = ReadTimeline(*timeline, scenario);
  if (const auto link = object.Find("link")) {
    const Object directions(*link, {"up", "down"});
    if (const auto up = directions.Find("up")) vary.uplink = ReadLink(*up);
    if (const auto down = directions.Find("down")) vary.downlink = ReadLink(*down);
  }
  vary.autopilot_scale = FindSpan(object, "autopilot_scale", {0.1, 10});
  return vary;
}

}  // namespace skein::config
