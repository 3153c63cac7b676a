#pragma once

#include <string>
#include <vector>

namespace skein::plot {

/// Samples of one UAV, as the plot draws them.
struct VehicleRecord {
  int id = 0;
  std::string callsign;
  std::vector<double> t_s;
  std::vector<double> east_m;
  std::vector<double> north_m;
  std::vector<double> up_m;
  std::vector<double> speed_m_s;
  std::vector<double> slot_t_s;  ///< of the errors; empty for a UAV in no formation
  std::vector<double> forward_error_m;
  std::vector<double> left_error_m;
  std::vector<double> up_error_m;
};

/// A flight, sampled a few times a second.
struct FlightRecord {
  std::string label;  ///< what tells this run from others
  std::vector<VehicleRecord> vehicles;
  std::vector<double> link_changes_s;  ///< when a data link was cut or restored
};

}  // namespace skein::plot
