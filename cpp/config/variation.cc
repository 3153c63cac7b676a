#include "config/variation.h"

#include <algorithm>
#include <map>
#include <random>

namespace skein::config {
namespace {

/// Draws the same numbers on every library, which the distributions of <random> do not.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  /// Uniform, within both ends.
  double From(const Span& span) { return span.least + (span.most - span.least) * Share(); }
  /// Uniform, -by .. by.
  double By(double by) { return From({-by, by}); }

 private:
  double Share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  std::mt19937_64 random_;
};

void VaryStart(const StartVariation& vary, Draw& draw, VehicleState& start) {
  start.east_m += draw.By(vary.east_m);
  start.north_m += draw.By(vary.north_m);
  start.up_m += draw.By(vary.up_m);
  start.speed_m_s += draw.By(vary.speed_m_s);
  start.course_rad += draw.By(vary.course_rad);
}

void VaryLink(const LinkVariation& vary, Draw& draw, LinkQuality& link) {
  if (vary.delay_s) link.delay_s = draw.From(*vary.delay_s);
  if (vary.jitter_s) link.jitter_s = draw.From(*vary.jitter_s);
  if (vary.loss) link.loss = draw.From(*vary.loss);
}

void Scale(double factor, VehicleConfig& vehicle) {
  AutopilotGains gains = vehicle.actual.value_or(vehicle.model.gains);
  gains.speed_per_s *= factor;
  gains.course_per_s *= factor;
  gains.climb_per_s *= factor;
  vehicle.actual = gains;
}

int VehicleOf(const TimelineEntry& entry) {
  return std::visit([](const auto& action) { return action.vehicle_id; }, entry.action);
}

/// What happens to one UAV moves together, so that a link is not restored before it is cut.
void VaryTimeline(const TimelineVariation& vary, Draw& draw, std::vector<TimelineEntry>& timeline) {
  std::map<int, double> shifts_s;
  for (TimelineEntry& entry : timeline) {
    const auto [shift, is_new] = shifts_s.try_emplace(VehicleOf(entry));
    if (is_new) shift->second = draw.By(vary.at_s);
    entry.at_s += shift->second;
    auto* cut = std::get_if<CutLink>(&entry.action);
    if (cut && cut->for_s) *cut->for_s += draw.By(vary.for_s);
  }
  std::stable_sort(timeline.begin(), timeline.end(),
                   [](const TimelineEntry& a, const TimelineEntry& b) { return a.at_s < b.at_s; });
}

}  // namespace

Scenario Varied(Scenario scenario, std::uint64_t seed) {
  if (!scenario.vary) return scenario;
  const Variation& vary = *scenario.vary;
  Draw draw(seed);
  for (VehicleConfig& vehicle : scenario.vehicles) {
    const auto& ids = vary.start.vehicles;
    if (ids.empty() || std::find(ids.begin(), ids.end(), vehicle.id) != ids.end()) {
      VaryStart(vary.start, draw, vehicle.start);
    }
    VaryLink(vary.uplink, draw, vehicle.uplink);
    VaryLink(vary.downlink, draw, vehicle.downlink);
    if (vary.autopilot_scale) Scale(draw.From(*vary.autopilot_scale), vehicle);
  }
  VaryTimeline(vary.timeline, draw, scenario.timeline);
  return scenario;
}

}  // namespace skein::config
