#pragma once

#include <Eigen/Core>
#include <array>

#include "config/scenario.h"

namespace skein::cli {

/// Longitude and latitude in WGS-84; altitude in metres above the level of the fleet's origin plus the
/// origin's own altitude, so that points of one altitude are flown level.
struct GeoPoint {
  double longitude_deg = 0;
  double latitude_deg = 0;
  double altitude_m = 0;
};

/// From the local frame (east, north, up) [m] and back.
GeoPoint ToGeo(const Eigen::Vector3d& local, const config::Origin& origin);
Eigen::Vector3d ToLocal(const GeoPoint& point, const config::Origin& origin);

/// ToGeo() as a position of GeoJSON: longitude, latitude, altitude; without digits that mean nothing (to a
/// hundredth of a millimetre or so).
std::array<double, 3> GeoPosition(const Eigen::Vector3d& local, const config::Origin& origin);

}  // namespace skein::cli
