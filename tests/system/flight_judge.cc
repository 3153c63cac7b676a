#include "system/flight_judge.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "config/scenario.h"
#include "core/frames.h"
#include "experiment/experiment.h"

namespace skein::testing {
namespace {

/// What a process is promised to be back within, and so how old what it commands may have become.
constexpr double kBack_s = 2;
constexpr int kTicks_s = 20;

// Around the second in which the undisturbed flight is looked at; its leader is at the same place at the same
// time.
constexpr int kAside_s = 2;

/// In kBack_s with an input that is as old as that a UAV gets away from where it would be by this much of the
/// change of the input, times its gain; the law answers with its own (0.7/s, cpp/core/skein_law.h).
constexpr double kAnswer = 0.7 * kBack_s;
/// And this share of all that the envelope lets be commanded either way, where the flight changes nothing.
constexpr double kMargin = 0.1;

// What a leader's speed may turn and change by [m/s^2]: more than any path that is flown in comfort.
constexpr double kLeader_m_s2 = 4;

constexpr std::array<const char*, 3> kNames{"speed", "course", "climb"};

bool Avoids(const formation_status_t& status) {
  return status.mode == formation_status_t::MODE_AVOIDING ||
         status.mode == formation_status_t::MODE_REJOINING || status.avoidance_up_m != 0;
}

Eigen::Vector3d Place(const formation_status_t& status) {
  return {status.leader_east_m, status.leader_north_m, status.leader_up_m};
}

Eigen::Vector3d LeaderVelocity(const formation_status_t& status) {
  const double level = status.leader_speed_m_s * std::cos(status.leader_climb_rad);
  return {level * std::cos(status.leader_course_rad), level * std::sin(status.leader_course_rad),
          status.leader_speed_m_s * std::sin(status.leader_climb_rad)};
}

}  // namespace

FlightJudge::FlightJudge(const std::string& scenario_file, double duration_s) {
  std::map<int, std::vector<Inputs>> inputs;  // by UAV and tick
  std::vector<bool> avoids;                   // by tick
  experiment::ExperimentOptions options;
  options.duration_s = duration_s;
  options.logs = false;
  options.on_tick = [&](const experiment::Tick& tick) {
    for (const experiment::VehicleTick& vehicle : tick.vehicles) {
      std::vector<Inputs>& of_uav = inputs[vehicle.id];
      // One that is not heard is not commanded.
      of_uav.push_back(vehicle.command ? InputsOf(*vehicle.command) : of_uav.back());
    }
    avoids.push_back(
        std::ranges::any_of(tick.formations, [](const auto& entry) { return Avoids(entry.second); }));
  };
  experiment::RunExperiment(config::LoadScenario(scenario_file), options);
  // Of every 2 s that begin within a second.
  constexpr std::size_t kWindow = (kBack_s + 1) * kTicks_s;
  for (const auto& [id, of_uav] : inputs) {
    for (std::size_t begin = 0; begin + kWindow <= of_uav.size(); begin += kTicks_s) {
      Inputs least = of_uav[begin];
      Inputs most = of_uav[begin];
      bool avoiding = false;
      for (std::size_t tick = begin; tick < begin + kWindow; ++tick) {
        Widen(most, of_uav[tick]);
        for (int i = 0; i < kInputs; ++i) least[i] = std::min(least[i], of_uav[tick][i]);
        avoiding = avoiding || avoids[tick];
      }
      for (int i = 0; i < kInputs; ++i) most[i] -= least[i];
      changes_[id].push_back(most);
      if (avoiding) Widen(avoiding_changes_, most);
    }
  }
}

void FlightJudge::Widen(Inputs& most, const Inputs& other) {
  for (int i = 0; i < kInputs; ++i) most[i] = std::max(most[i], other[i]);
}

FlightJudge::Inputs FlightJudge::InputsOf(const vehicle_command_t& command) {
  return {command.speed_input_m_s, command.course_input_rad, command.climb_input_rad};
}

FlightJudge::Inputs FlightJudge::Explained(int id, double t_s) const {
  const std::vector<Inputs>& changes = changes_.at(id);
  const int last = static_cast<int>(changes.size()) - 1;
  const int begin = other_path_ ? 0 : std::clamp(static_cast<int>(t_s) - kAside_s, 0, last);
  const int end = other_path_ ? last : std::clamp(static_cast<int>(t_s) + kAside_s, 0, last);
  Inputs most{};
  for (int second = begin; second <= end; ++second) Widen(most, changes[static_cast<std::size_t>(second)]);
  if (avoids_) Widen(most, avoiding_changes_);
  return most;
}

bool FlightJudge::InPlace(int id) const {
  constexpr double kNear_m = 50;
  return status_ && std::ranges::any_of(status_->slots, [&](const slot_status_t& slot) {
           return slot.vehicle_id == id && slot.flown &&
                  std::hypot(slot.forward_error_m, slot.left_error_m, slot.up_error_m) < kNear_m;
         });
}

void FlightJudge::Hear(const fleet_roster_t& roster) {
  start_utime_ = roster.start_utime;
  for (const vehicle_info_t& info : roster.vehicles) models_[info.id] = info;
}

void FlightJudge::Hear(const fleet_command_t& commands) {
  if (!start_utime_) return;
  avoids_ = commands.commands.size() < models_.size() || (status_ && Avoids(*status_));
  for (const vehicle_command_t& command : commands.commands) {
    const auto [last, first] = last_.try_emplace(command.id, commands.utime, command);
    const auto& [before_utime, before] = last->second;
    // One on its way to its slot, after its link was lost, is steered anew with a jerk, kills or not. Where
    // it is says the status before: that of a controller which has forgotten where all are comes later than
    // its commands.
    if (!first && models_.contains(command.id) && InPlace(command.id)) {
      JudgeInputs(bus::ToSeconds(commands.utime - *start_utime_), before, command);
      JudgeSetpoint(kBack_s + std::abs(bus::ToSeconds(commands.utime - before_utime)), before, command);
    }
    last->second = {commands.utime, command};
  }
}

void FlightJudge::JudgeInputs(double t_s, const vehicle_command_t& before, const vehicle_command_t& command) {
  const vehicle_info_t& model = models_.at(command.id);
  const Inputs all{2 * model.max_acceleration_m_s2 / model.k_speed_per_s,
                   2 * model.max_course_rate_rad_s / model.k_course_per_s,
                   2 * model.max_climb_rate_rad_s / model.k_climb_per_s};
  const Inputs explained = Explained(command.id, t_s);
  const Inputs was = InputsOf(before);
  const Inputs is = InputsOf(command);
  for (int i = 0; i < kInputs; ++i) {
    const double allowed = (1 + kAnswer) * explained[i] + kMargin * all[i];
    const double step = std::abs(is[i] - was[i]);
    const std::string what = fmt::format("{} input of UAV{} steps by {:.3f} at {:.1f} s, {:.3f} allowed",
                                         kNames[i], command.id, is[i] - was[i], t_s, allowed);
    if (step > allowed) wrong_.push_back(what);
    if (step / allowed > closest_share_) {
      closest_share_ = step / allowed;
      closest_ = what;
    }
  }
}

void FlightJudge::JudgeSetpoint(double time_s, const vehicle_command_t& before,
                                const vehicle_command_t& command) {
  const vehicle_info_t& model = models_.at(command.id);
  const auto within = [&](const char* what, double step, double rate) {
    if (std::abs(step) <= rate * time_s) return;
    wrong_.push_back(fmt::format("{} set-point of UAV{} steps by {:.3f} within {:.2f} s", what, command.id,
                                 step, time_s - kBack_s));
  };
  within("speed", command.setpoint_speed_m_s - before.setpoint_speed_m_s, model.max_acceleration_m_s2);
  within("course", WrapAngle(command.setpoint_course_rad - before.setpoint_course_rad),
         model.max_course_rate_rad_s);
  within("climb", command.setpoint_climb_rad - before.setpoint_climb_rad, model.max_climb_rate_rad_s);
}

void FlightJudge::Hear(const formation_status_t& status) {
  if (status_) {
    const double time_s = bus::ToSeconds(status.utime - status_->utime);
    const double aside_m = (Place(status) - Place(*status_) - time_s * LeaderVelocity(*status_)).norm();
    const double allowed_m = 0.5 + 0.5 * kLeader_m_s2 * time_s * time_s;
    if (aside_m > allowed_m)
      wrong_.push_back(fmt::format(
          "the leader leaps by {:.1f} m within {:.2f} s, avoidance offset {:.1f} m after {:.1f} m", aside_m,
          time_s, status.avoidance_up_m, status_->avoidance_up_m));
  }
  status_ = status;
}

}  // namespace skein::testing
