#include "cli/geo_point.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

namespace skein::cli {
namespace {

GeographicLib::LocalCartesian Frame(const config::Origin& origin) {
  return {origin.latitude_deg, origin.longitude_deg, origin.altitude_m};
}

}  // namespace

/// Altitude is along the up axis of the local frame (WGS-84 heights sink away from it: 8 m in 10 km), so the
/// height that belongs to it is found step by step; the steps shrink a thousandfold each.
Eigen::Vector3d ToLocal(const GeoPoint& point, const config::Origin& origin) {
  const double up_m = point.altitude_m - origin.altitude_m;
  double height_m = point.altitude_m;
  Eigen::Vector3d local{0, 0, 0};
  for (int i = 0; i < 4; ++i) {
    Frame(origin).Forward(point.latitude_deg, point.longitude_deg, height_m, local.x(), local.y(), local.z());
    height_m += up_m - local.z();
  }
  local.z() = up_m;
  return local;
}

GeoPoint ToGeo(const Eigen::Vector3d& local, const config::Origin& origin) {
  GeoPoint point{};
  double height_m = 0;
  Frame(origin).Reverse(local.x(), local.y(), local.z(), point.latitude_deg, point.longitude_deg, height_m);
  point.altitude_m = origin.altitude_m + local.z();
  return point;
}

std::array<double, 3> GeoPosition(const Eigen::Vector3d& local, const config::Origin& origin) {
  const auto rounded = [](double value, double steps) { return std::round(value * steps) / steps; };
  const GeoPoint point = ToGeo(local, origin);
  return {rounded(point.longitude_deg, 1e10), rounded(point.latitude_deg, 1e10),
          rounded(point.altitude_m, 1e4)};
}

}  // namespace skein::cli
