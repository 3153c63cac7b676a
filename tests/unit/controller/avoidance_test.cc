#include "controller/avoidance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <skein/event_t.hpp>

namespace skein::controller {
namespace {

constexpr double kStep = 0.05;

/// Three UAVs abreast, 500 m apart, northbound at 50 m/s in level flight; who flies is where its offset says.
class AvoidanceTest : public testing::Test {
 protected:
  void Fly(double seconds) {
    for (double time = 0; time < seconds; time += kStep) {
      for (MemberObservation& seen : members_) {
        if (!seen.lost && avoidance_.role(seen.id) != Role::kLost)
          seen.level_m = avoidance_.offset(seen.id).height_m;
        seen.track = {{500.0 * seen.id, 0, 1000 + seen.level_m}, {0, 50, 0}};
      }
      const auto events = avoidance_.Update(members_, strangers_, limits_, kStep);
      for (const FlightEvent& event : events) codes_.push_back(event.code);
    }
  }
  double Height(int id) const { return avoidance_.offset(id).height_m; }
  bool Told(const std::string& code) const { return std::count(codes_.begin(), codes_.end(), code) > 0; }
  MemberObservation& Uav(int id) { return members_[static_cast<std::size_t>(id - 1)]; }

  static MemberObservation InPlace(int id) {
    MemberObservation seen;
    seen.id = id;
    seen.callsign = "UAV" + std::to_string(id);
    return seen;
  }

  std::vector<MemberObservation> members_ = {InPlace(1), InPlace(2), InPlace(3)};
  std::vector<Traffic> strangers_;
  AirspaceLimits limits_;
  Avoidance avoidance_;
  std::vector<std::string> codes_;
};

TEST_F(AvoidanceTest, LeadsTheOthersUpTwoHundredMetresAndBackDown) {
  Fly(10);
  EXPECT_FALSE(avoidance_.active());
  Uav(3).lost = true;
  Fly(26);
  EXPECT_EQ(avoidance_.role(3), Role::kLost);
  EXPECT_DOUBLE_EQ(Height(1), 200);
  EXPECT_DOUBLE_EQ(Height(2), 200);
  EXPECT_TRUE(Told("avoidance_started"));

  Uav(3).lost = false;
  Fly(60);
  EXPECT_EQ(avoidance_.role(3), Role::kRejoining);
  EXPECT_DOUBLE_EQ(Height(3), 0) << "it comes back below";
  EXPECT_DOUBLE_EQ(Height(1), 200) << "the others stay up until it is in place";
  EXPECT_FALSE(Told("avoidance_ended"));

  Uav(3).ready_to_merge = true;
  Fly(26);
  for (int id : {1, 2, 3}) EXPECT_DOUBLE_EQ(Height(id), 0);
  EXPECT_FALSE(avoidance_.active());
  EXPECT_TRUE(Told("avoidance_ended"));
}

TEST_F(AvoidanceTest, ClimbsAlsoWhenTheLostUavIsALittleAboveTheOthers) {
  for (const double level : {-20.0, 0.3, 20.0}) {
    avoidance_ = Avoidance();
    Uav(3).lost = true;
    Uav(3).level_m = level;
    Fly(30);
    EXPECT_DOUBLE_EQ(Height(1), level + 200);
  }
}

TEST_F(AvoidanceTest, NobodyClimbsWhenAllAreLost) {
  for (MemberObservation& seen : members_) seen.lost = true;
  Fly(30);
  EXPECT_EQ(avoidance_.body().target_m(), 0);
}

TEST_F(AvoidanceTest, NobodyChangesLevelWhenAllAreHeardAgainInPlace) {
  for (MemberObservation& seen : members_) seen.lost = seen.in_place = true;
  Fly(5);
  for (MemberObservation& seen : members_) seen.lost = false;
  for (int i = 0; i < 10; ++i) {
    Fly(1);
    for (const int id : {1, 2, 3}) EXPECT_EQ(Height(id), 0) << "UAV" << id;
  }
  EXPECT_FALSE(avoidance_.active());
}

TEST_F(AvoidanceTest, OneThatIsHeardAgainInPlaceButAtAnotherLevelStaysThereAtFirst) {
  Uav(3).lost = Uav(3).in_place = true;
  Fly(26);
  Uav(3).lost = false;
  Fly(10);
  EXPECT_EQ(avoidance_.role(3), Role::kRejoining);
  EXPECT_EQ(Height(3), 0);
  EXPECT_EQ(Height(1), 200);
}

TEST_F(AvoidanceTest, ClimbsByLessUnderACeilingAndDescendsWhenUpIsClosed) {
  limits_.highest_m = 170;
  Uav(2).lost = true;
  Fly(30);
  EXPECT_DOUBLE_EQ(Height(1), 160);

  Avoidance fresh;
  limits_.highest_m = 50;
  avoidance_ = fresh;
  Fly(30);
  EXPECT_DOUBLE_EQ(Height(1), -200);
}

TEST_F(AvoidanceTest, SaysSoWhenNoAltitudeIsFree) {
  limits_.highest_m = 50;
  limits_.lowest_m = -50;
  Uav(2).lost = true;
  Fly(30);
  EXPECT_TRUE(avoidance_.blocked());
  EXPECT_EQ(std::count(codes_.begin(), codes_.end(), "avoidance_blocked"), 1);
  EXPECT_DOUBLE_EQ(Height(1), 0);
}

TEST_F(AvoidanceTest, GoesDownWhenOtherTrafficIsAbove) {
  limits_.strangers = StrangerLimits();
  strangers_.push_back({{700, 300, 1200}, {0, 50, 0}});
  Uav(3).lost = true;
  Fly(30);
  EXPECT_LT(Height(1), -100);
}

TEST_F(AvoidanceTest, KeepsClearOfASecondLostUavAtTheAvoidanceLevel) {
  Uav(3).lost = true;
  Fly(30);
  Uav(2).lost = true;  // up there with the others
  Fly(60);
  EXPECT_GE(std::abs(Height(1) - 200), limits_.clearance_m);
  EXPECT_GE(std::abs(Height(1) - 0), limits_.clearance_m);

  Uav(2).lost = false;
  Uav(3).lost = false;
  Fly(60);
  EXPECT_GE(std::abs(Height(2) - Height(3)), 0.8 * limits_.clearance_m)
      << "they rejoin at levels of their own";
  Uav(2).ready_to_merge = Uav(3).ready_to_merge = true;
  Fly(60);
  for (int id : {1, 2, 3}) EXPECT_DOUBLE_EQ(Height(id), 0);
}

TEST_F(AvoidanceTest, TakesUpWhatAnEarlierRunHadBegun) {
  avoidance_.Restore({200, 0, 0}, 200);
  Uav(1).level_m = Uav(2).level_m = 200;
  Uav(3).level_m = 0;
  for (MemberObservation& seen : members_) seen.track = {{500.0 * seen.id, 0, 1000}, {0, 50, 0}};
  avoidance_.Update(members_, {}, limits_, kStep);
  EXPECT_EQ(avoidance_.role(1), Role::kFlying);
  EXPECT_DOUBLE_EQ(Height(1), 200);
  EXPECT_EQ(avoidance_.role(3), Role::kRejoining);
}

TEST_F(AvoidanceTest, StaysUpAfterARestartUntilEverybodyIsHeard) {
  avoidance_.Restore({200, 0, 0}, 200);
  Uav(1).level_m = Uav(2).level_m = 200;
  Uav(3).heard = false;  // it is silent: FLEET_STATE does not name it
  Fly(60);
  EXPECT_DOUBLE_EQ(Height(1), 200);
  Uav(3).heard = true;
  Uav(3).lost = true;
  Uav(3).level_m = 0;
  Fly(10);
  EXPECT_DOUBLE_EQ(Height(1), 200);
  EXPECT_FALSE(Told("avoidance_ended"));
}

TEST_F(AvoidanceTest, StaysWhereItIsWhenTheLostUavIsFarBelowAnyway) {
  Uav(3).lost = true;
  Uav(3).level_m = -700;
  Fly(30);
  EXPECT_DOUBLE_EQ(Height(1), 0);
  EXPECT_FALSE(Told("avoidance_started"));
}

TEST_F(AvoidanceTest, DoesNotComeDownThroughOtherTraffic) {
  limits_.strangers = StrangerLimits();
  Uav(3).lost = true;
  Fly(30);
  Uav(3).lost = false;
  Uav(3).ready_to_merge = true;
  strangers_.push_back({{700, 300, 1050}, {0, 50, 0}});
  Fly(30);
  EXPECT_DOUBLE_EQ(Height(1), 200);
  EXPECT_TRUE(avoidance_.blocked());
  EXPECT_EQ(std::count(codes_.begin(), codes_.end(), "avoidance_blocked"), 1);
  strangers_.clear();
  Fly(30);
  EXPECT_DOUBLE_EQ(Height(1), 0);
}

TEST_F(AvoidanceTest, DoesNotPassTheLevelOfOneLostUavToAvoidAnother) {
  limits_.highest_m = 350;  // no room for another 200 m up
  Uav(3).lost = true;
  Fly(30);
  Uav(2).lost = true;  // at +200
  double lowest = 1e9;
  for (int i = 0; i < 60; ++i) {
    Fly(1);
    lowest = std::min(lowest, Height(1));
  }
  EXPECT_GT(lowest, 100) << "UAV3 is at 0";
  EXPECT_GE(Height(1), 320) << "less than 200 m up, but up";
}

TEST_F(AvoidanceTest, WaitsInPlaceWhileAnotherLostUavIsBetweenItAndTheBody) {
  Uav(2).lost = Uav(3).lost = true;
  Fly(30);
  Uav(2).lost = false;
  Uav(2).ready_to_merge = true;
  Fly(60);
  EXPECT_EQ(avoidance_.role(2), Role::kRejoining) << "UAV3, lost at 0, is between -120 and +200";
  EXPECT_LT(Height(2), -90);
  Uav(3).lost = false;
  Uav(3).ready_to_merge = true;
  Fly(60);
  for (int id : {1, 2, 3}) EXPECT_DOUBLE_EQ(Height(id), 0);
}

TEST_F(AvoidanceTest, KeepsARejoinLevelBelowTheCeilingWhenThePathComesDown) {
  Uav(3).lost = true;
  Fly(30);
  Uav(3).lost = false;
  Fly(5);
  limits_.lowest_m = 50;  // the planned altitude is 50 m below the ground's margin by now
  Fly(30);
  EXPECT_GE(Height(3), 50);
}

TEST_F(AvoidanceTest, DoesNothingForNobody) {
  members_.clear();
  Fly(5);
  EXPECT_FALSE(avoidance_.active());
}

}  // namespace
}  // namespace skein::controller
