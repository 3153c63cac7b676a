#include "core/error_mixer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace skein {
namespace {

using std::numbers::pi;

const VehicleState kLeader{.north_m = 5000, .up_m = 1000, .speed_m_s = 50, .course_rad = pi / 2};

TEST(ErrorMixer, ErrorOfThePapersTestIsAheadLeftAndUp) {
  // The wing is 2000 m behind and 1000 m right of a leader that flies north; its slot is 1000 m behind.
  const VehicleState wing{
      .east_m = 1000, .north_m = 3000, .up_m = 800, .speed_m_s = 60, .course_rad = pi / 2};
  const StateError error = ErrorInLeaderFrame(kLeader, {-1000, 0, 0}, wing);
  EXPECT_NEAR(error.forward_m, 1000, 1e-9);
  EXPECT_NEAR(error.left_m, 1000, 1e-9);
  EXPECT_NEAR(error.up_m, 200, 1e-9);
  EXPECT_NEAR(error.speed_m_s, -10, 1e-9);
  EXPECT_NEAR(error.course_rad, 0, 1e-12);
  EXPECT_NEAR(error.climb_rad, 0, 1e-12);
}

TEST(ErrorMixer, ErrorIsZeroInTheSlot) {
  const VehicleState wing{
      .east_m = 300, .north_m = 4000, .up_m = 1020, .speed_m_s = 50, .course_rad = pi / 2 + 2 * pi};
  const StateError error = ErrorInLeaderFrame(kLeader, {-1000, -300, 20}, wing);
  EXPECT_NEAR(error.forward_m, 0, 1e-9);
  EXPECT_NEAR(error.left_m, 0, 1e-9);
  EXPECT_NEAR(error.up_m, 0, 1e-9);
  EXPECT_NEAR(error.course_rad, 0, 1e-12);
}

TEST(ErrorMixer, CourseErrorTakesTheShortWayAcrossPi) {
  const VehicleState leader{.course_rad = pi - 0.1};
  EXPECT_NEAR(ErrorInLeaderFrame(leader, {}, {.course_rad = -pi + 0.1}).course_rad, -0.2, 1e-12);
  EXPECT_NEAR(ErrorInLeaderFrame(leader, {}, {.course_rad = 5 * pi + 0.1}).course_rad, -0.2, 1e-12);
}

TEST(ErrorMixer, SaturatesPositionsAndNothingElse) {
  const MixedError mixed = Mix({1000, -1000, 200, -10, 0.5, -0.2}, {});
  EXPECT_NEAR(mixed.speed, 1.5 * 50 + 10 * -10, 1e-12);
  EXPECT_NEAR(mixed.course, 0.1 * -50 + 10 * 0.5, 1e-12);
  EXPECT_NEAR(mixed.climb, 0.04 * 50 + 5 * -0.2, 1e-12);
}

TEST(ErrorMixer, PassesSmallPositionsThrough) {
  const MixedError mixed = Mix({-20, 30, 10, 0, 0, 0}, {});
  EXPECT_NEAR(mixed.speed, -30, 1e-12);
  EXPECT_NEAR(mixed.course, 3, 1e-12);
  EXPECT_NEAR(mixed.climb, 0.4, 1e-12);
}

TEST(ErrorMixer, ChecksItsGains) {
  EXPECT_NO_THROW(Check(MixerGains{}));
  EXPECT_NO_THROW(Check(MixerGains{.k_ev = 0}));
  EXPECT_THROW(Check(MixerGains{.k_ex = -1}), std::invalid_argument);
  EXPECT_THROW(Check(MixerGains{.saturation_up_m = 0}), std::invalid_argument);
  EXPECT_THROW(Check(MixerGains{.k_emu = std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace skein
