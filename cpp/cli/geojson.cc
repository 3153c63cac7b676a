#include "cli/geojson.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/geo_point.h"
#include "config/json_reader.h"

namespace skein::cli {
namespace {

using Json = nlohmann::ordered_json;

// Collections within collections are read by recursion.
constexpr int kDeepest = 64;

/// Collects the waypoints of one file.
class Reader {
 public:
  Reader(std::string file, const config::Origin& origin) : file_(std::move(file)), origin_(origin) {}

  void ReadObject(const Json& object, const Json& properties, const std::string& place) {
    const std::string type = TextMember(object, "type", place);
    if (type == "FeatureCollection") {
      const Json& features = Member(object, "features", place);
      if (!features.is_array()) Refuse(place + "/features", "must be an array");
      for (std::size_t i = 0; i < features.size(); ++i) {
        ReadObject(features[i], Json::object(), place + "/features/" + std::to_string(i));
      }
    } else if (type == "Feature") {
      const Json own = object.value("properties", Json::object());
      ReadObject(Member(object, "geometry", place), own.is_object() ? own : Json::object(),
                 place + "/geometry");
    } else if (type == "Point") {
      AddPoint(Member(object, "coordinates", place), properties, place + "/coordinates");
      ++points_;
    } else if (type == "LineString") {
      // What `path show` draws beside its waypoints is not a second path.
      if (properties.value("flown", Json(false)) == true) return;
      AddLine(Member(object, "coordinates", place), properties, place + "/coordinates");
    } else if (type == "Polygon") {
      const Json& rings = Member(object, "coordinates", place);
      if (!rings.is_array() || rings.size() != 1) Refuse(place, "a polygon must have one ring");
      AddLine(rings[0], properties, place + "/coordinates/0");
      path_.closed = true;
    } else {
      Refuse(place + "/type", "\"" + type + "\" is no path; give a LineString, a Polygon or Points");
    }
    if (properties.value("closed", Json(false)) == true) path_.closed = true;
  }

  PathFile Take() {
    if (lines_ > 1 || (lines_ == 1 && points_ > 0)) Refuse("", "holds more than one path");
    auto& waypoints = path_.waypoints;
    if (lines_ == 1 && waypoints.size() > 2) {
      const Waypoint& first = waypoints.front();
      const Waypoint& last = waypoints.back();
      if (std::hypot(first.east_m - last.east_m, first.north_m - last.north_m) < kSamePointM) {
        waypoints.pop_back();
        path_.closed = true;
      }
    }
    if (waypoints.size() < 2) Refuse("", "a path needs at least two points");
    return path_;
  }

 private:
  static constexpr double kSamePointM = 0.1;

  [[noreturn]] void Refuse(const std::string& place, const std::string& reason) const {
    throw config::ConfigError(file_ + ": " + (place.empty() ? "" : place + ": ") + reason);
  }

  const Json& Member(const Json& object, const char* key, const std::string& place) const {
    if (!object.is_object()) Refuse(place, "must be an object");
    const auto found = object.find(key);
    if (found == object.end()) Refuse(place, std::string("has no \"") + key + "\": this is no GeoJSON");
    return *found;
  }

  std::string TextMember(const Json& object, const char* key, const std::string& place) const {
    const Json& member = Member(object, key, place);
    if (!member.is_string()) Refuse(place + "/" + key, "must be a text");
    return member.get<std::string>();
  }

  double Number(const Json& value, double least, double most, const std::string& place) const {
    if (!value.is_number()) Refuse(place, "must be a number");
    const double number = value.get<double>();
    if (!(number >= least && number <= most)) {
      Refuse(place, "must be " + Json(least).dump() + " .. " + Json(most).dump() + ", not " + value.dump());
    }
    return number;
  }

  std::optional<double> Property(const Json& properties, const char* key, double least, double most,
                                 const std::string& place) const {
    const auto found = properties.find(key);
    if (found == properties.end() || found->is_null()) return std::nullopt;
    return Number(*found, least, most, place + " (property " + key + ")");
  }

  void AddLine(const Json& coordinates, const Json& properties, const std::string& place) {
    if (!coordinates.is_array()) Refuse(place, "must be an array of positions");
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      AddPoint(coordinates[i], properties, place + "/" + std::to_string(i));
    }
    ++lines_;
  }

  void AddPoint(const Json& position, const Json& properties, const std::string& place) {
    if (!position.is_array() || position.size() < 2 || position.size() > 3) {
      Refuse(place, "must be [longitude, latitude] or [longitude, latitude, altitude]");
    }
    const double longitude_deg = Number(position[0], -180, 180, place + "/0");
    const double latitude_deg = Number(position[1], -90, 90, place + "/1");
    auto altitude_m = Property(properties, "altitude_m", -1000, 20'000, place);
    if (position.size() == 3) altitude_m = Number(position[2], -1000, 20'000, place + "/2");
    auto speed_m_s = Property(properties, "speed_m_s", 0.1, 400, place);
    const auto& before = path_.waypoints;
    if (!altitude_m && before.empty()) {
      Refuse(place, "has no altitude: give a third coordinate, or the property altitude_m");
    }
    if (!speed_m_s && before.empty()) Refuse(place, "has no speed: give the property speed_m_s");
    const double up_m = altitude_m ? *altitude_m - origin_.altitude_m : before.back().up_m;
    const Eigen::Vector3d local = ToLocal({longitude_deg, latitude_deg, up_m + origin_.altitude_m}, origin_);
    constexpr double kFarthestM = 200e3;
    if (local.head<2>().norm() > kFarthestM) {
      Refuse(place, "lies " + std::to_string(std::lround(local.head<2>().norm() / 1000)) +
                        " km from the fleet's origin (are longitude and latitude in this order?)");
    }
    path_.waypoints.push_back(
        {.east_m = local.x(),
         .north_m = local.y(),
         .up_m = up_m,
         .speed_m_s = speed_m_s ? *speed_m_s : before.back().speed_m_s,
         .turn_radius_m = Property(properties, "turn_radius_m", 0, 1e6, place).value_or(0)});
  }

  std::string file_;
  config::Origin origin_;
  PathFile path_;
  int lines_ = 0;
  int points_ = 0;
};

Json Feature(Json geometry, Json properties) {
  return {{"type", "Feature"}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}};
}

}  // namespace

PathFile ReadPathFile(const std::filesystem::path& file, const config::Origin& origin) {
  const std::string text = config::ReadTextFile(file, "a path file");
  const auto keep = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest) throw config::ConfigError(file.string() + ": nests too deeply for GeoJSON");
    return true;
  };
  Json json;
  try {
    json = Json::parse(text, keep);
  } catch (const Json::exception& error) {  // beside parse_error: numbers that are too large
    throw config::ConfigError(file.string() + ": is no JSON: " + error.what());
  }
  Reader reader(file.string(), origin);
  reader.ReadObject(json, Json::object(), "");
  return reader.Take();
}

std::string WritePath(const PathFile& path, const std::vector<Eigen::Vector3d>& line,
                      const config::Origin& origin) {
  Json features = Json::array();
  if (!line.empty()) {
    Json coordinates = Json::array();
    for (const auto& point : line) coordinates.push_back(GeoPosition(point, origin));
    features.push_back(Feature({{"type", "LineString"}, {"coordinates", coordinates}}, {{"flown", true}}));
  }
  for (const Waypoint& waypoint : path.waypoints) {
    features.push_back(
        Feature({{"type", "Point"},
                 {"coordinates", GeoPosition({waypoint.east_m, waypoint.north_m, waypoint.up_m}, origin)}},
                {{"speed_m_s", waypoint.speed_m_s},
                 {"turn_radius_m", waypoint.turn_radius_m},
                 {"closed", path.closed}}));
  }
  return Json{{"type", "FeatureCollection"}, {"features", std::move(features)}}.dump(1);
}

}  // namespace skein::cli
