#include "bridge/preview_messages.h"

#include <cmath>

#include "core/path_line.h"

namespace skein::bridge {
namespace {

double Rounded(double value, double steps) { return std::round(value * steps) / steps; }
double Metres(double value) { return Rounded(value, 10); }
double Seconds(double value) { return Rounded(value, 100); }

template <typename Value, typename Convert>
Json OrNull(const std::optional<Value>& value, Convert convert) {
  return value ? Json(convert(*value)) : Json(nullptr);
}

Json Approach(const experiment::CylinderApproach& pair) {
  return {{"horizontal_m", Metres(pair.horizontal_m)},
          {"vertical_m", Metres(pair.vertical_m)},
          {"t_s", Seconds(pair.t_s)},
          {"ids", {pair.first_id, pair.second_id}},
          {"inside_cylinder", pair.inside()}};
}

Json Limit(const experiment::BindingLimit& limit) {
  return {{"vehicle_id", limit.vehicle_id},
          {"limit", limit.limit},
          {"t_s", Seconds(limit.t_s)},
          {"seconds", Seconds(limit.seconds)}};
}

Json TrackPoints(const Track& track) {
  return {{"id", track.vehicle_id}, {"points", Each(track.points, [](const TrackPoint& point) {
                                       return Json{Seconds(point.t_s), Metres(point.position.x()),
                                                   Metres(point.position.y()), Metres(point.position.z())};
                                     })}};
}

Json Leg(const experiment::FlownLeg& leg) {
  return {{"from", OrNull(leg.from, [](std::size_t from) { return from; })},
          {"to", leg.to},
          {"length_m", Metres(leg.length_m)},
          {"time_s", Seconds(leg.time_s)},
          {"course_rad", leg.course_rad}};
}

Json Problem(const PathProblem& problem) {
  return {{"waypoint_index", problem.waypoint}, {"on_leg", problem.on_leg}, {"text", problem.text}};
}

Json Line(const experiment::PathPreview& preview, bool straight_on) {
  Json line = Json::array();
  if (!preview.path) return line;
  const DrawnStretch stretch = StretchToDraw(*preview.path, preview.leader_arc_m, straight_on);
  for (const Eigen::Vector3d& point : SampleLine(*preview.path, stretch.from_arc_m, stretch.to_arc_m)) {
    line.push_back({Rounded(point.x(), 100), Rounded(point.y(), 100), Rounded(point.z(), 100)});
  }
  return line;
}

}  // namespace

Json ToJson(const experiment::Preview& preview) {
  Json json = {{"ok", preview.ok}, {"reason", preview.reason}};
  json["duration_s"] = Seconds(preview.duration_s);
  json["complete"] = preview.complete;
  json["least"] = preview.nearest.empty() ? Json(nullptr) : Approach(preview.nearest.front());
  json["nearest"] = Each(preview.nearest, Approach);
  json["settle_s"] = OrNull(preview.settle_s, Seconds);
  json["limits"] = Each(preview.limits, Limit);
  json["tracks"] = Each(preview.tracks, TrackPoints);
  return json;
}

Json ToJson(const experiment::PathPreview& preview, bool straight_on, bool geometry_only) {
  Json json = ToJson(preview.flight);
  if (geometry_only) json = {{"ok", preview.flight.ok}, {"reason", preview.flight.reason}};
  json["line"] = Line(preview, straight_on);
  json["legs"] = Each(preview.legs, Leg);
  json["problems"] = Each(preview.problems, Problem);
  return json;
}

}  // namespace skein::bridge
