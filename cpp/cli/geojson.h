#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/scenario.h"
#include "core/path.h"

/// Paths as GeoJSON (RFC 7946): longitude and latitude in WGS-84; altitude, the third coordinate, in metres
/// above the level of the fleet's origin plus the origin's own altitude, so that points of one altitude are
/// flown level.
namespace skein::cli {

/// Waypoints and whether the path is closed.
struct PathFile {
  bool closed = false;
  std::vector<Waypoint> waypoints;
};

/// Reads a LineString, or Points in their order: bare, in a Feature or in a FeatureCollection. A Polygon's
/// outer ring is a closed path, so is a LineString that ends where it starts. Altitude comes from the third
/// coordinate or else altitude_m, speed from speed_m_s, radius from turn_radius_m among the properties of the
/// feature. A point without altitude or speed has that of the point before. Throws config::ConfigError with
/// file, place and reason.
PathFile ReadPathFile(const std::filesystem::path& file, const config::Origin& origin);

/// A FeatureCollection of the line as it is flown (if any) and a Point for each waypoint; ReadPathFile takes
/// it back.
/// @param line of (east, north, up) [m]
std::string WritePath(const PathFile& path, const std::vector<Eigen::Vector3d>& line,
                      const config::Origin& origin);

}  // namespace skein::cli
