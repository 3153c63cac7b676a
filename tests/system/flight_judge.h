#pragma once

#include <map>
#include <optional>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/formation_status_t.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bus/executor.h"

namespace skein::testing {

/// Judges what a controller says in a live flight in which things go wrong: no step in any command is larger
/// than what 2 s of flight explain, and the leader never leaps. What 2 s of flight explain is what the same
/// scenario shows when it flies with nothing going wrong (flight-experiment).
class FlightJudge {
 public:
  /// @param duration_s how much of the flight there is to compare with.
  FlightJudge(const std::string& scenario_file, double duration_s);

  void Hear(const fleet_roster_t& roster);
  void Hear(const fleet_command_t& commands);
  void Hear(const formation_status_t& status);
  /// From now on the leader flies something else than the scenario says: any stretch of it is compared with.
  void ExpectOtherPath() { other_path_ = true; }

  const std::vector<std::string>& wrong() const { return wrong_; }
  /// The largest step of an input, in what was allowed for it, and what it was.
  const std::string& closest() const { return closest_; }

 private:
  /// The inputs of eq. (1), which simulated UAVs obey.
  static constexpr int kInputs = 3;
  using Inputs = std::array<double, kInputs>;
  static Inputs InputsOf(const vehicle_command_t& command);
  static void Widen(Inputs& most, const Inputs& other);
  /// What a UAV's inputs change by within 2 s, at most, of that flight around that time.
  Inputs Explained(int id, double t_s) const;
  bool InPlace(int id) const;
  void JudgeInputs(double t_s, const vehicle_command_t& before, const vehicle_command_t& command);
  void JudgeSetpoint(double time_s, const vehicle_command_t& before, const vehicle_command_t& command);

  std::map<int, std::vector<Inputs>> changes_;  ///< of the undisturbed flight, by UAV and second: within 2 s
  Inputs avoiding_changes_{};                   ///< the same while it avoids somebody, of any UAV
  bool other_path_ = false;
  std::optional<bus::Utime> start_utime_;
  std::map<int, vehicle_info_t> models_;
  std::map<int, std::pair<bus::Utime, vehicle_command_t>> last_;
  std::optional<formation_status_t> status_;
  bool avoids_ = false;
  std::vector<std::string> wrong_;
  double closest_share_ = 0;
  std::string closest_;
};

}  // namespace skein::testing
