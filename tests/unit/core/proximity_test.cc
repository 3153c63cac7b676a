#include "core/proximity.h"

#include <gtest/gtest.h>

#include <iostream>
#include <random>
#include <stdexcept>
#include <string>

#include "core/proximity_index.h"
#include "unit/core/fleets.h"

namespace skein {
namespace {

Traffic Uav(int id, const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, int formation_id = 0) {
  Traffic uav;
  uav.id = id;
  uav.position = position;
  uav.velocity = velocity;
  uav.formation_id = formation_id;
  return uav;
}

std::optional<double> TauOf(const Traffic& one, const Traffic& other, double d_mod_m = 500,
                            double min_closing_m_s = 1) {
  return Tau(MotionBetween(one, other), d_mod_m, min_closing_m_s);
}

TEST(Tau, FollowsEquationThreeHeadOn) {
  // (2000 - 500^2 / 2000) / (50 + 50) = 1875 / 100
  EXPECT_DOUBLE_EQ(*TauOf(Uav(1, {0, 0, 0}, {50, 0, 0}), Uav(2, {2000, 0, 0}, {-50, 0, 0})), 18.75);
}

TEST(Tau, TakesTheClosingRateAlongTheLineOfSight) {
  // d = 5000 along (3, 4) / 5; w = (-50, 0): closing 30 m/s. (5000 - 50) / 30
  EXPECT_NEAR(*TauOf(Uav(1, {0, 0, 0}, {0, 0, 0}), Uav(2, {3000, 4000, 0}, {-50, 0, 0})), 165, 1e-9);
}

TEST(Tau, TakesTheLeastSpeedForSlowClosing) {
  // (1000 - 250) / max(0.5, 1)
  EXPECT_DOUBLE_EQ(*TauOf(Uav(1, {0, 0, 0}, {0.5, 0, 0}), Uav(2, {1000, 0, 0}, {0, 0, 0})), 750);
}

TEST(Tau, IsZeroWithinDMod) {
  EXPECT_EQ(TauOf(Uav(1, {0, 0, 0}, {1, 0, 0}), Uav(2, {500, 0, 0}, {0, 0, 0})), 0);
  EXPECT_EQ(TauOf(Uav(1, {0, 0, 0}, {1, 0, 0}), Uav(2, {3, 0, 0}, {0, 0, 0})), 0);
}

TEST(Tau, IsNoneForOpeningPairsAndEqualVelocities) {
  EXPECT_FALSE(TauOf(Uav(1, {0, 0, 0}, {-1, 0, 0}), Uav(2, {300, 0, 0}, {0, 0, 0})));
  EXPECT_FALSE(TauOf(Uav(1, {0, 0, 0}, {50, 7, 1}), Uav(2, {3000, 20, 0}, {50, 7, 1})));
}

TEST(Tau, IsZeroAtOnePointWhateverTheVelocities) {
  EXPECT_EQ(TauOf(Uav(1, {5, 5, 5}, {50, 0, 0}), Uav(2, {5, 5, 5}, {50, 0, 0})), 0);
  EXPECT_EQ(TauOf(Uav(1, {5, 5, 5}, {50, 0, 0}), Uav(2, {5, 5, 5}, {-50, 0, 0})), 0);
}

TEST(ProximityLimits, RefuseWhatMakesNoSense) {
  EXPECT_NO_THROW(Check(ProximityLimits{}));
  EXPECT_NO_THROW(Check(StrangerLimits()));
  const auto refused = [](auto change, const std::string& field) {
    ProximityLimits limits;
    change(limits);
    try {
      Check(limits);
      ADD_FAILURE() << field << " was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, field.size()), field);
    }
  };
  refused([](auto& l) { l.radius_m = 0; }, "radius_m");
  refused([](auto& l) { l.height_m = -1; }, "height_m");
  refused([](auto& l) { l.d_mod_m = 149; }, "d_mod_m");
  refused([](auto& l) { l.caution_tau_s = 0; }, "caution_tau_s");
  refused([](auto& l) { l.advisory_tau_s = 15; }, "advisory_tau_s");
  refused([](auto& l) { l.min_closing_m_s = 0; }, "min_closing_m_s");
  refused([](auto& l) { l.d_mod_m = std::nan(""); }, "d_mod_m");
}

TEST(ProximityRules, TakeAFormationsLimitsForItsOwnMembersOnly) {
  const ProximityRules rules = testing::MixedRules();
  const auto radius = [&](int one, int other) {
    return rules.Between(Uav(1, {0, 0, 0}, {0, 0, 0}, one), Uav(2, {0, 0, 0}, {0, 0, 0}, other)).radius_m;
  };
  EXPECT_EQ(radius(1, 1), 150);
  EXPECT_EQ(radius(2, 2), 300);
  EXPECT_EQ(radius(1, 2), 500);
  EXPECT_EQ(radius(0, 1), 500);
  EXPECT_EQ(radius(0, 0), 500);
  EXPECT_EQ(radius(3, 3), 500);  // unknown formation
}

/// Both ways of searching must pass what is worked out by hand.
class Proximity : public ::testing::TestWithParam<decltype(&FindProximity)> {
 protected:
  std::vector<VehicleProximity> Find(const std::vector<Traffic>& fleet, const ProximityRules& rules = {}) {
    return GetParam()(fleet, rules);
  }
};

TEST_P(Proximity, OfNobodyIsEmpty) { EXPECT_TRUE(Find({}).empty()); }

TEST_P(Proximity, OfOneUavHasNoOther) {
  const auto found = Find({Uav(7, {1, 2, 3}, {50, 0, 0})});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].id, 7);
  EXPECT_FALSE(found[0].nearest);
  EXPECT_FALSE(found[0].least_tau);
}

TEST_P(Proximity, OfTwoIsMutual) {
  const auto found = Find({Uav(4, {0, 0, 1000}, {50, 0, 0}), Uav(2, {3000, 4000, 900}, {50, 0, 0})});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].nearest->id, 2);
  EXPECT_EQ(found[1].nearest->id, 4);
  for (const auto& one : found) {
    EXPECT_DOUBLE_EQ(one.nearest->separation.horizontal_m, 5000);
    EXPECT_DOUBLE_EQ(one.nearest->separation.vertical_m, 100);
    EXPECT_FALSE(one.least_tau);
  }
}

TEST_P(Proximity, NearestIsByDistanceInSpace) {
  // 3 is nearer on the map (100 m) but 1000 m above; 2 is 800 m away at the same height.
  const auto found =
      Find({Uav(1, {0, 0, 0}, {0, 0, 0}), Uav(2, {800, 0, 0}, {0, 0, 0}), Uav(3, {100, 0, 1000}, {0, 0, 0})});
  EXPECT_EQ(found[0].nearest->id, 2);
}

TEST_P(Proximity, LeastTauNeedNotBeOfTheNearest) {
  // 2: (1000 - 250) / 5 = 150 s. 3: (3000 - 250/3) / 100 = 29.1667 s.
  const auto found = Find(
      {Uav(1, {0, 0, 0}, {0, 0, 0}), Uav(2, {1000, 0, 0}, {-5, 0, 0}), Uav(3, {0, 3000, 0}, {0, -100, 0})});
  EXPECT_EQ(found[0].nearest->id, 2);
  EXPECT_EQ(found[0].least_tau->id, 3);
  EXPECT_NEAR(found[0].least_tau->tau_s, 29.166667, 1e-6);
}

TEST_P(Proximity, TakesTheSmallerIdOfEquals) {
  const auto found = Find({Uav(9, {0, 0, 0}, {0, 0, 0}), Uav(8, {1000, 0, 0}, {-50, 0, 0}),
                           Uav(3, {-1000, 0, 0}, {50, 0, 0}), Uav(5, {0, 1000, 0}, {0, -50, 0})});
  EXPECT_EQ(found[0].nearest->id, 3);
  EXPECT_EQ(found[0].least_tau->id, 3);
}

TEST_P(Proximity, OfMembersUsesTheirOwnDMod) {
  // Strangers: (1000 - 250) / 10 = 75 s; members: (1000 - 22.5) / 10 = 97.75 s.
  const ProximityRules rules = testing::MixedRules();
  const Eigen::Vector3d away{1000, 0, 0};
  EXPECT_DOUBLE_EQ(
      Find({Uav(1, {0, 0, 0}, {10, 0, 0}, 1), Uav(2, away, {0, 0, 0}, 0)}, rules)[0].least_tau->tau_s, 75);
  EXPECT_DOUBLE_EQ(
      Find({Uav(1, {0, 0, 0}, {10, 0, 0}, 1), Uav(2, away, {0, 0, 0}, 1)}, rules)[0].least_tau->tau_s, 97.75);
}

TEST_P(Proximity, OfManyAtOnePointNamesTheSmallestOther) {
  std::vector<Traffic> fleet;
  for (int id = 100; id >= 1; --id) fleet.push_back(Uav(id, {10, 20, 30}, {50, 0, 0}));
  for (const auto& one : Find(fleet)) {
    EXPECT_EQ(one.nearest->id, one.id == 1 ? 2 : 1);
    EXPECT_EQ(one.nearest->separation.horizontal_m, 0);
    EXPECT_EQ(*one.least_tau, (LeastTau{one.id == 1 ? 2 : 1, 0}));
  }
}

constexpr const char* kSearchNames[] = {"Index", "BruteForce"};
INSTANTIATE_TEST_SUITE_P(Searches, Proximity, ::testing::Values(&FindProximity, &FindProximityByBruteForce),
                         [](const auto& info) { return std::string(kSearchNames[info.index]); });

using MakeFleet = std::vector<Traffic> (*)(int, std::mt19937&);

class ProximityIndexSearch : public ::testing::TestWithParam<MakeFleet> {};

TEST_P(ProximityIndexSearch, EqualsBruteForceToTheLastBit) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  const ProximityRules rules = testing::MixedRules();
  ProximityIndex index;  // takes a larger fleet after a smaller one, and the other way round
  for (const int count : {0, 1, 2, 3, 7, 8, 9, 17, 600, 60, 64, 65, 150, 0, 150, 150, 513, 400}) {
    const std::vector<Traffic> fleet = GetParam()(count, random);
    const auto expected = FindProximityByBruteForce(fleet, rules);
    index.Load(fleet, rules);
    const auto& found = index.FindProximity();
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i], expected[i]) << "UAV " << expected[i].id << " of " << count;
    }
  }
}

constexpr const char* kFleetNames[] = {"Spread", "Clustered", "Tied"};
INSTANTIATE_TEST_SUITE_P(Fleets, ProximityIndexSearch,
                         ::testing::Values(&testing::SpreadFleet, &testing::ClusteredFleet,
                                           &testing::TiedFleet),
                         [](const auto& info) { return std::string(kFleetNames[info.index]); });

TEST(ProximityIndex, OnSeveralProcessorsEqualsBruteForce) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const std::vector<Traffic> fleet = testing::ClusteredFleet(5000, random);
  const ProximityRules rules = testing::MixedRules();
  EXPECT_EQ(FindProximity(fleet, rules), FindProximityByBruteForce(fleet, rules));
}

TEST(ProximityIndex, AsksForFewPairsOfALargeFleet) {
  std::mt19937 random(1);
  const std::vector<Traffic> fleet = testing::SpreadFleet(2000, random);
  ProximityRules rules;
  rules.strangers.advisory_tau_s = 20;
  ProximityIndex index;
  index.Load(fleet, rules);
  int asked = 0;
  index.FindPairs([&](int, int) { return ++asked, false; });
  EXPECT_GT(asked, 0);
  EXPECT_LT(asked, 2000 * 1999 / 2 / 20);
}

}  // namespace
}  // namespace skein
