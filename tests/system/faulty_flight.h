#pragma once

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <skein/alarm_list_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "system/bus_ear.h"
#include "system/process.h"

namespace skein::testing {

inline const std::vector<std::string> kNodes{"fleet-simulator", "formation-controller", "collision-monitor"};

/// The nodes of a flight, started and killed one by one, each with a state file.
class FaultsTest : public ::testing::Test {
 protected:
  ~FaultsTest() override {
    nodes_.clear();
    std::filesystem::remove_all(folder_);
  }

  std::unique_ptr<Process> Start(const std::string& node) const {
    return std::make_unique<Process>(
        std::vector<std::string>{Program(node), "--lcm-url", url_, "--scenario", scenario_, "--state-file",
                                 folder_ + "/" + node},
        environment_);
  }
  void StartAll() {
    for (const std::string& node : kNodes) nodes_[node] = Start(node);
    for (const std::string& node : kNodes) ASSERT_TRUE(HearsHeartbeat(url_, node)) << node;
    ASSERT_TRUE(Hears<formation_status_t>(
        url_, bus::channel::kFormationStatus, [](const auto&) { return true; }, Seconds(10)));
  }
  /// Killed outright, and started again with the same state file.
  void Restart(const std::string& node) {
    nodes_[node]->Signal(SIGKILL);
    ASSERT_TRUE(nodes_[node]->WaitForEnd(Seconds(5)));
    nodes_[node] = Start(node);
  }
  void Skein(std::vector<std::string> words) const {
    words.insert(words.begin(), {Program("skein"), "--lcm-url", url_});
    Process skein(words, environment_);
    ASSERT_EQ(skein.WaitForEnd(Seconds(20)), 0) << skein.output();
  }
  /// The next complete FLEET_STATE of this small fleet.
  fleet_state_t NextState() const {
    fleet_state_t next{};
    EXPECT_TRUE(Hears<fleet_state_t>(
        url_, bus::channel::kFleetState,
        [&](const fleet_state_t& state) {
          next = state;
          return true;
        },
        Seconds(5)));
    return next;
  }
  bool HearsAlarm(const std::string& condition, const std::function<bool(const alarm_t&)>& is_it,
                  Seconds timeout) const {
    return Hears<alarm_list_t>(
        url_, bus::channel::kAlarms,
        [&](const alarm_list_t& list) {
          return std::any_of(list.alarms.begin(), list.alarms.end(), [&](const alarm_t& alarm) {
            return alarm.condition == condition && is_it(alarm);
          });
        },
        timeout);
  }
  /// Whether all slots of the formation are held within so much, at some moment within `timeout`.
  bool HoldsSlots(double within_m, Seconds timeout) const {
    return Hears<formation_status_t>(
        url_, bus::channel::kFormationStatus,
        [&](const formation_status_t& status) {
          return !status.slots.empty() &&
                 std::all_of(status.slots.begin(), status.slots.end(), [&](const slot_status_t& slot) {
                   return std::hypot(slot.forward_error_m, slot.left_error_m, slot.up_error_m) <= within_m;
                 });
        },
        timeout);
  }

  std::string url_ = FreshLcmUrl();
  std::string scenario_ = "triangle";
  std::string folder_ = FreshFolder("skein-faults");
  std::map<std::string, std::string> environment_;  ///< added to that of the programs
  std::map<std::string, std::unique_ptr<Process>> nodes_;
};

}  // namespace skein::testing
