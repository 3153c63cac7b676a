#include "core/fleet_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace skein {
namespace {

constexpr double kStep_s = 0.05;

struct Uav {
  VehicleState state;
  AutopilotInput input;
  VehicleModel model;
};

class RandomFleet {
 public:
  explicit RandomFleet(unsigned seed) : random_(seed) {}

  Uav Next() {
    Uav uav;
    uav.model.gains = {Between(0.005, 0.5), Between(0.05, 1), Between(0.05, 1)};
    uav.model.envelope.max_course_rate_rad_s = Between(0.05, 1);
    uav.state = {Between(-1e5, 1e5), Between(-1e5, 1e5), Between(0, 3000),
                 Between(30, 90),    Between(-20, 20),   Between(-0.35, 0.35)};
    uav.input = Input();
    return uav;
  }
  /// Far beyond the envelope, as laws command it.
  AutopilotInput Input() { return {Between(-50, 200), Between(-30, 30), Between(-1, 1)}; }

 private:
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::mt19937 random_;
};

/// The largest difference of a field, of its own size where that is above 1.
double Difference(const VehicleState& one, const VehicleState& other) {
  const auto of = [](double a, double b) { return std::abs(a - b) / std::max(1.0, std::abs(b)); };
  return std::max({of(one.east_m, other.east_m), of(one.north_m, other.north_m), of(one.up_m, other.up_m),
                   of(one.speed_m_s, other.speed_m_s), of(one.course_rad, other.course_rad),
                   of(one.climb_rad, other.climb_rad)});
}

void ExpectSame(const VehicleState& one, const VehicleState& other) {
  EXPECT_EQ(one.east_m, other.east_m);
  EXPECT_EQ(one.north_m, other.north_m);
  EXPECT_EQ(one.up_m, other.up_m);
  EXPECT_EQ(one.speed_m_s, other.speed_m_s);
  EXPECT_EQ(one.course_rad, other.course_rad);
  EXPECT_EQ(one.climb_rad, other.climb_rad);
}

TEST(FleetMotion, MovesEachAsStepDoesForAThousandSteps) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  RandomFleet random(seed);
  FleetMotion fleet;
  std::vector<Uav> plain;
  for (int i = 0; i < 300; ++i) {
    plain.push_back(random.Next());
    fleet.Add(plain.back().state, plain.back().input, plain.back().model);
  }
  for (int step = 1; step <= 1000; ++step) {
    if (step % 40 == 0) {
      for (std::size_t i = 0; i < plain.size(); ++i) {
        plain[i].input = random.Input();
        fleet.SetInput(i, plain[i].input);
      }
    }
    fleet.Step(kStep_s);
    for (Uav& uav : plain) uav.state = Step(uav.state, uav.input, uav.model, kStep_s);
  }
  double worst = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    worst = std::max(worst, Difference(fleet.State(i), plain[i].state));
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(worst, 0) << "all by Step() itself: nothing was tested";
}

TEST(FleetMotion, LeavesToStepWhoIsOutsideOfTheEnvelope) {
  Uav slow;
  slow.state = {0, 0, 1000, 10, 1, 0.1};
  Uav steep;
  steep.state = {0, 0, 1000, 60, 1, -0.6};
  for (Uav uav : {slow, steep}) {
    uav.input = {70, 2, 0};
    FleetMotion fleet;
    fleet.Add(uav.state, uav.input, uav.model);
    fleet.Step(kStep_s);
    ExpectSame(fleet.State(0), Step(uav.state, uav.input, uav.model, kStep_s));
  }
}

TEST(FleetMotion, LeavesToStepATurnThatIsFar) {
  Uav uav;
  uav.state = {0, 0, 1000, 60, 1, 0};
  uav.input = {60, 9, 0.3};
  FleetMotion fleet;
  fleet.Add(uav.state, uav.input, uav.model);
  fleet.Step(1);
  ExpectSame(fleet.State(0), Step(uav.state, uav.input, uav.model, 1));
}

TEST(FleetMotion, HoldsAnyNumberEachAtItsPlace) {
  for (const int count : {0, 1, 7, 8, 9, 63, 64, 65, 130}) {
    RandomFleet random(5);
    FleetMotion fleet;
    std::vector<Uav> plain;
    for (int i = 0; i < count; ++i) {
      plain.push_back(random.Next());
      fleet.Add(plain.back().state, plain.back().input, plain.back().model);
    }
    ASSERT_EQ(fleet.size(), plain.size());
    fleet.Step(kStep_s);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const Uav& uav = plain[i];
      EXPECT_LT(Difference(fleet.State(i), Step(uav.state, uav.input, uav.model, kStep_s)), 1e-12)
          << "UAV " << i << " of " << count;
    }
  }
}

TEST(FleetMotion, GoesOnFromAStateThatIsSet) {
  RandomFleet random(6);
  FleetMotion fleet;
  Uav uav;
  for (int i = 0; i < 10; ++i) {
    uav = random.Next();
    fleet.Add(uav.state, uav.input, uav.model);
  }
  const VehicleState elsewhere = random.Next().state;
  fleet.SetState(9, elsewhere);
  ExpectSame(fleet.State(9), elsewhere);
  fleet.Step(kStep_s);
  EXPECT_LT(Difference(fleet.State(9), Step(elsewhere, uav.input, uav.model, kStep_s)), 1e-12);
}

TEST(FleetMotion, RefusesAModelThatMakesNoSense) {
  FleetMotion fleet;
  VehicleModel model;
  model.envelope.max_speed_m_s = 0;
  EXPECT_THROW(fleet.Add({}, {}, model), std::invalid_argument);
  EXPECT_EQ(fleet.size(), 0u);
}

}  // namespace
}  // namespace skein
