#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/log/flight_picker.h"
#include "cli/log/log_source.h"
#include "recording/log_listener.h"

namespace skein::cli {

/// Where a UAV was at a time of its scenario.
struct Sample {
  double t_s = 0;
  Eigen::Vector3d place{0, 0, 0};  ///< ENU [m]
};

/// The states of one flight, read bit by bit.
class FlightStates {
 public:
  FlightStates(const std::string& file, int flight);
  FlightStates(const FlightStates&) = delete;
  FlightStates& operator=(const FlightStates&) = delete;

  /// Reads on by so much as there is, to the next state at least; `use` gets each of them. False at the
  /// end. Throws Interrupted.
  bool ReadOn(const std::function<void(int id, const Sample& sample)>& use);

  /// The time of the latest state that was read.
  double now_s() const { return now_s_; }
  double share_read() const {
    return static_cast<double>(reader_.bytes_read()) / static_cast<double>(source_.recording().bytes());
  }
  LogSource& source() { return source_; }
  const LogSource& source() const { return source_; }
  const FlightPicker& picker() const { return picker_; }
  const std::map<int, std::string>& callsigns() const { return callsigns_; }

 private:
  LogSource source_;
  FlightPicker picker_;
  recording::RecordingReader reader_;
  recording::LogListener listener_;
  std::map<int, std::string> callsigns_;
  std::vector<std::pair<int, Sample>> read_;
  double now_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace skein::cli
