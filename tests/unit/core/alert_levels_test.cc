#include "core/alert_levels.h"

#include <gtest/gtest.h>

#include <iostream>
#include <random>
#include <string>

#include "unit/core/fleets.h"
#include "unit/core/time_steps.h"

namespace skein {
namespace {

Traffic Uav(int id, const Eigen::Vector3d& position, const Eigen::Vector3d& velocity = {0, 0, 0}) {
  Traffic uav;
  uav.id = id;
  uav.position = position;
  uav.velocity = velocity;
  return uav;
}

std::vector<AlertChange> Sweep(AlertLevels& levels, std::int64_t utime, const std::vector<Traffic>& fleet) {
  const ProximityRules rules;
  ProximityIndex index;
  index.Load(fleet, rules);
  return levels.Sweep(utime, index);
}

/// R = D_mod = 500 m, H 100 m, Tau 55 / 25 s, V_min 1 m/s.
AlertLevel AssessStrangers(const Traffic& one, const Traffic& other) {
  return Assess(one, other, StrangerLimits());
}

TEST(EntersCylinder, FindsAPathThatOnlyGrazesTheEdge) {
  // Passing 499 m abeam enters, 501 m does not.
  EXPECT_TRUE(EntersCylinder({5000, 499, 0}, {-50, 0, 0}, 500, 100));
  EXPECT_FALSE(EntersCylinder({5000, 501, 0}, {-50, 0, 0}, 500, 100));
  EXPECT_FALSE(EntersCylinder({5000, 0, 101}, {-50, 0, 0}, 500, 100));
}

TEST(EntersCylinder, NeedsBothDistancesAtOneTime) {
  // Horizontally inside from 90 s to 110 s; sinking from 1000 m at 10 m/s it is inside vertically from 90 s
  // to 110 s.
  EXPECT_TRUE(EntersCylinder({5000, 0, 1000}, {-50, 0, -10}, 500, 100));
  // At 20 m/s it is so from 45 s to 55 s only: it dives through before it is there.
  EXPECT_FALSE(EntersCylinder({5000, 0, 1000}, {-50, 0, -20}, 500, 100));
}

TEST(EntersCylinder, LooksForwardOnly) { EXPECT_FALSE(EntersCylinder({5000, 0, 0}, {50, 0, 0}, 500, 100)); }

TEST(EntersCylinder, WithoutRelativeMotionIsWhereItIs) {
  EXPECT_TRUE(EntersCylinder({100, 0, 0}, {0, 0, 0}, 500, 100));
  EXPECT_TRUE(EntersCylinder({0, 0, 0}, {0, 0, 0}, 500, 100));
  EXPECT_FALSE(EntersCylinder({600, 0, 0}, {0, 0, 0}, 500, 100));
  EXPECT_TRUE(EntersCylinder({100, 0, 500}, {0, 0, -1}, 500, 100));
}

TEST(EntersCylinder, AgreesWithSmallSteps) {
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-2000, 2000);
  std::uniform_real_distribution<double> speed(-60, 60);
  int entered = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Vector3d position(place(random), place(random), 0.15 * place(random));
    const Eigen::Vector3d velocity(speed(random), speed(random), 0.1 * speed(random));
    if (velocity.head<2>().norm() < 10) continue;  // would not have passed after 400 s
    const auto within = [&](double radius_m, double height_m) {
      for (double t = 0; t < 400; t += 0.02) {
        const Eigen::Vector3d there = position + t * velocity;
        if (there.head<2>().norm() < radius_m && std::abs(there.z()) < height_m) return true;
      }
      return false;
    };
    // A step can miss less than 2 m of way.
    if (within(500, 100)) {
      ++entered;
      EXPECT_TRUE(EntersCylinder(position, velocity, 500, 100)) << "seed " << seed << " trial " << trial;
    } else if (!within(502, 102)) {
      EXPECT_FALSE(EntersCylinder(position, velocity, 500, 100)) << "seed " << seed << " trial " << trial;
    }
  }
  EXPECT_GT(entered, 10);
}

TEST(Assess, WarnsInsideTheCylinderWhateverTheVelocities) {
  for (const double speed : {-50.0, 0.0, 50.0}) {
    EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), Uav(2, {499, 0, 99}, {speed, 0, 0})), AlertLevel::kWarning);
  }
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), Uav(2, {0, 0, 0})), AlertLevel::kWarning);
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), Uav(2, {500, 0, 0})), AlertLevel::kClear);
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), Uav(2, {0, 0, 100})), AlertLevel::kClear);
}

TEST(Assess, GivesAdvisoryAndCautionByTau) {
  // Head-on at 100 m/s: Tau = (d - 250000 / d) / 100. 5600 m: 55.55 s, 5500 m: 54.5 s, 2600 m: 25.04 s, 2590
  // m: 24.9 s.
  const auto at = [](double d) {
    return AssessStrangers(Uav(1, {0, 0, 0}, {50, 0, 0}), Uav(2, {d, 0, 0}, {-50, 0, 0}));
  };
  EXPECT_EQ(at(5600), AlertLevel::kClear);
  EXPECT_EQ(at(5500), AlertLevel::kAdvisory);
  EXPECT_EQ(at(2600), AlertLevel::kAdvisory);
  EXPECT_EQ(at(2590), AlertLevel::kCaution);
  EXPECT_EQ(at(501), AlertLevel::kCaution);
}

TEST(Assess, IsClearWhenTheyWillMiss) {
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), Uav(2, {2000, 510, 0}, {-100, 0, 0})), AlertLevel::kClear);
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), Uav(2, {2000, 0, 110}, {-100, 0, 0})), AlertLevel::kClear);
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), Uav(2, {2000, 490, 90}, {-100, 0, 0})), AlertLevel::kCaution);
}

TEST(Assess, IsClearWhenTheyHardlyClose) {
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), Uav(2, {501, 0, 0}, {-1, 0, 0})), AlertLevel::kClear);
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), Uav(2, {501, 0, 0}, {-1.1, 0, 0})), AlertLevel::kCaution);
}

TEST(Assess, ByUncertaintyAloneCautionsAndNeverWarns) {
  Traffic lost = Uav(2, {700, 0, 0});
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), lost), AlertLevel::kClear);
  lost.horizontal_uncertainty_m = 199;
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), lost), AlertLevel::kClear);
  lost.horizontal_uncertainty_m = 300;
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), lost), AlertLevel::kCaution);
  lost.position = {0, 0, 149};
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), lost), AlertLevel::kClear);
  lost.vertical_uncertainty_m = 50;
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), lost), AlertLevel::kCaution);
  lost.position = {0, 0, 99};
  EXPECT_EQ(AssessStrangers(Uav(1, {0, 0, 0}), lost), AlertLevel::kWarning);
}

TEST(Assess, IsTheSameWhicheverIsNamedFirst) {
  std::mt19937 random(7);
  const auto fleet = testing::ClusteredFleet(60, random);
  for (const auto& one : fleet) {
    for (const auto& other : fleet) {
      if (&one != &other) {
        ASSERT_EQ(AssessStrangers(one, other), AssessStrangers(other, one));
      }
    }
  }
}

TEST(FindConflicts, EqualsBruteForce) {
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  const ProximityRules rules = testing::MixedRules();
  std::size_t found = 0;
  ProximityIndex index;
  for (const int count : {0, 1, 2, 9, 60, 150, 150, 400}) {
    for (const auto make : {&testing::SpreadFleet, &testing::ClusteredFleet, &testing::TiedFleet}) {
      const auto fleet = make(count, random);
      const auto expected = FindConflictsByBruteForce(fleet, rules);
      index.Load(fleet, rules);
      ASSERT_EQ(FindConflicts(index), expected) << "seed " << seed << " count " << count;
      found += expected.size();
    }
  }
  EXPECT_GT(found, 100u);
}

/// Two strangers on the x axis, swept at a given rate.
class AlertLevelsTest : public ::testing::TestWithParam<int> {
 protected:
  /// One sweep with the second UAV at x, flying at vx.
  AlertLevel Sweep(double x, double vx = 0) {
    utime_ += kSecond / GetParam();
    changes_ = skein::Sweep(levels_, utime_, {Uav(1, {0, 0, 0}), Uav(2, {x, 0, 0}, {vx, 0, 0})});
    const auto active = levels_.active();
    return active.empty() ? AlertLevel::kClear : active[0].level;
  }
  /// Sweeps on at x until the level falls, and says after how many seconds since the first of these sweeps
  /// that was.
  double SecondsUntilItFalls(double x, double vx = 0) {
    const AlertLevel before = levels_.active().at(0).level;
    const std::int64_t first = utime_ + kSecond / GetParam();
    while (Sweep(x, vx) == before && utime_ - first < 20 * kSecond) {
    }
    return static_cast<double>(utime_ - first) * 1e-6;
  }

  AlertLevels levels_;
  std::int64_t utime_ = 1'577'836'800 * kSecond;
  std::vector<AlertChange> changes_;
};

constexpr double kCautionAt = 1500;   // closing at 100 m/s: Tau 13 s
constexpr double kAdvisoryAt = 4000;  // 39 s
constexpr double kClosing = -100;

TEST_P(AlertLevelsTest, WarnsAtOnce) {
  EXPECT_EQ(Sweep(499), AlertLevel::kWarning);
  ASSERT_EQ(changes_.size(), 1u);
  EXPECT_EQ(changes_[0].before, AlertLevel::kClear);
  EXPECT_EQ(changes_[0].pair.first_id, 1);
  EXPECT_EQ(changes_[0].pair.second_id, 2);
}

TEST_P(AlertLevelsTest, CautionsInTheSecondOfFourSweeps) {
  EXPECT_EQ(Sweep(kCautionAt, kClosing), AlertLevel::kClear);
  EXPECT_EQ(Sweep(9000), AlertLevel::kClear);
  EXPECT_EQ(Sweep(9000), AlertLevel::kClear);
  EXPECT_EQ(Sweep(kCautionAt, kClosing), AlertLevel::kCaution);
}

TEST_P(AlertLevelsTest, PassesOverASingleBadSample) {
  for (int round = 0; round < 5; ++round) {
    EXPECT_EQ(Sweep(kCautionAt, kClosing), AlertLevel::kClear);
    for (int sweep = 0; sweep < 3; ++sweep) EXPECT_EQ(Sweep(9000), AlertLevel::kClear);
  }
}

TEST_P(AlertLevelsTest, CountsACautionAsAnAdvisoryToo) {
  EXPECT_EQ(Sweep(kAdvisoryAt, kClosing), AlertLevel::kClear);
  EXPECT_EQ(Sweep(kCautionAt, kClosing), AlertLevel::kAdvisory);
  EXPECT_EQ(Sweep(kCautionAt, kClosing), AlertLevel::kCaution);
}

TEST_P(AlertLevelsTest, EndsAfterFourBetterSeconds) {
  Sweep(499);
  EXPECT_DOUBLE_EQ(SecondsUntilItFalls(700), 4);
  EXPECT_TRUE(levels_.active().empty());
  ASSERT_EQ(changes_.size(), 1u);
  EXPECT_EQ(changes_[0].pair.level, AlertLevel::kClear);
  EXPECT_EQ(changes_[0].pair.worst, AlertLevel::kWarning);
}

TEST_P(AlertLevelsTest, StaysWhileItIsNotAQuarterBetter) {
  Sweep(499);
  for (int sweep = 0; sweep < 20 * GetParam(); ++sweep) EXPECT_EQ(Sweep(620), AlertLevel::kWarning);
  EXPECT_DOUBLE_EQ(SecondsUntilItFalls(626), 4);
}

TEST_P(AlertLevelsTest, StartsTheFourSecondsAnewWhenItGetsWorse) {
  Sweep(499);
  for (int sweep = 0; sweep < 3 * GetParam(); ++sweep) Sweep(700);
  EXPECT_EQ(Sweep(620), AlertLevel::kWarning);
  EXPECT_DOUBLE_EQ(SecondsUntilItFalls(700), 4);
}

TEST_P(AlertLevelsTest, FallsFromAWarningToTheCautionThatStillHolds) {
  Sweep(499, kClosing);
  Sweep(499, kClosing);
  EXPECT_DOUBLE_EQ(SecondsUntilItFalls(700, kClosing), 4);
  EXPECT_EQ(levels_.active().at(0).level, AlertLevel::kCaution);
  EXPECT_EQ(levels_.active().at(0).worst, AlertLevel::kWarning);
}

TEST_P(AlertLevelsTest, TellsAChangeOnceNotPerSweep) {
  int changes = 0;
  for (int sweep = 0; sweep < 50; ++sweep) {
    Sweep(499);
    changes += static_cast<int>(changes_.size());
  }
  EXPECT_EQ(changes, 1);
}

TEST_P(AlertLevelsTest, ForgetsAPairWhoseUavIsGone) {
  Sweep(499);
  changes_ = skein::Sweep(levels_, utime_ + kSecond, {Uav(1, {0, 0, 0})});
  ASSERT_EQ(changes_.size(), 1u);
  EXPECT_EQ(changes_[0].pair.level, AlertLevel::kClear);
  EXPECT_EQ(changes_[0].before, AlertLevel::kWarning);
  EXPECT_TRUE(levels_.active().empty());
}

INSTANTIATE_TEST_SUITE_P(Rates, AlertLevelsTest, ::testing::Values(1, 2, 10),
                         [](const auto& info) { return std::to_string(info.param) + "Hz"; });

TEST(AlertLevels, AreKeptPerPairOfIds) {
  AlertLevels levels;
  const std::vector<Traffic> fleet{Uav(30, {0, 0, 0}), Uav(2, {100, 0, 0}), Uav(10, {200, 0, 0}),
                                   Uav(4, {9000, 0, 0})};
  EXPECT_EQ(Sweep(levels, kSecond, fleet).size(), 3u);
  const auto active = levels.active();
  ASSERT_EQ(active.size(), 3u);
  EXPECT_EQ(std::pair(active[0].first_id, active[0].second_id), std::pair(2, 10));
  EXPECT_EQ(std::pair(active[1].first_id, active[1].second_id), std::pair(2, 30));
  EXPECT_EQ(std::pair(active[2].first_id, active[2].second_id), std::pair(10, 30));
}

TEST(AlertLevels, OfNobodyAreNone) {
  AlertLevels levels;
  EXPECT_TRUE(Sweep(levels, kSecond, {}).empty());
  EXPECT_TRUE(Sweep(levels, 2 * kSecond, {Uav(1, {0, 0, 0})}).empty());
  EXPECT_TRUE(levels.active().empty());
}

}  // namespace
}  // namespace skein
