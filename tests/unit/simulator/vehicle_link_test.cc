#include "simulator/vehicle_link.h"

#include <gtest/gtest.h>

#include <vector>

namespace skein::simulator {
namespace {

using bus::kSecond;

std::vector<int> Received(VehicleLink<int>& link, bus::Utime now) {
  std::vector<int> messages;
  link.Receive(now, [&](bus::Utime, int message) { messages.push_back(message); });
  return messages;
}

TEST(VehicleLink, BringsAMessageAtOnceWhenPerfect) {
  VehicleLink<int> link({}, 1);
  link.Send(0, 7);
  EXPECT_EQ(Received(link, 0), std::vector{7});
  EXPECT_EQ(Received(link, kSecond), std::vector<int>{});
}

TEST(VehicleLink, DelaysByTheDelayAndNoMore) {
  VehicleLink<int> link({LinkMode::kUp, {.delay_s = 0.2}}, 1);
  link.Send(1000, 7);
  EXPECT_TRUE(Received(link, 200'999).empty());
  bus::Utime arrived = 0;
  link.Receive(kSecond, [&](bus::Utime arrival, int) { arrived = arrival; });
  EXPECT_EQ(arrived, 201'000);
}

TEST(VehicleLink, JitterSpreadsArrivalsAndMayChangeTheOrder) {
  VehicleLink<int> link({LinkMode::kUp, {.delay_s = 0.1, .jitter_s = 0.4}}, 1);
  for (int i = 0; i < 1000; ++i) link.Send(i * 50'000, i);
  std::vector<int> messages;
  bus::Utime last = 0;
  double sum_s = 0;
  link.Receive(1000 * kSecond, [&](bus::Utime arrival, int message) {
    const double delay_s = bus::ToSeconds(arrival - message * 50'000);
    EXPECT_GE(delay_s, 0.1);
    EXPECT_LT(delay_s, 0.5);
    EXPECT_GE(arrival, last);
    last = arrival;
    sum_s += delay_s;
    messages.push_back(message);
  });
  EXPECT_EQ(messages.size(), 1000u);
  EXPECT_FALSE(std::is_sorted(messages.begin(), messages.end()));
  EXPECT_NEAR(sum_s / 1000, 0.3, 0.02);
}

TEST(VehicleLink, LosesTheGivenShare) {
  for (const double loss : {0.0, 0.1, 0.9, 1.0}) {
    VehicleLink<int> link({LinkMode::kUp, {.loss = loss}}, 3);
    for (int i = 0; i < 10'000; ++i) link.Send(0, i);
    EXPECT_NEAR(static_cast<double>(Received(link, 0).size()), 10'000 * (1 - loss),
                loss == 0 || loss == 1 ? 0 : 150);
  }
}

TEST(VehicleLink, LosesTheSameMessagesWithTheSameSeedOnly) {
  const auto fates = [](std::uint64_t seed) {
    VehicleLink<int> link({LinkMode::kUp, {.loss = 0.5}}, seed);
    for (int i = 0; i < 100; ++i) link.Send(0, i);
    return Received(link, 0);
  };
  EXPECT_EQ(fates(5), fates(5));
  EXPECT_NE(fates(5), fates(6));
}

TEST(VehicleLink, BringsNothingWhileCutNorWhatWasUnderWay) {
  for (const LinkMode mode : {LinkMode::kSilent, LinkMode::kFrozen}) {
    const config::LinkQuality quality{.delay_s = 0.2};
    VehicleLink<int> link({LinkMode::kUp, quality}, 1);
    link.Send(0, 1);
    link.Set({mode, quality});
    link.Send(100'000, 2);
    EXPECT_TRUE(Received(link, kSecond).empty());
    link.Set({LinkMode::kUp, quality});
    link.Send(kSecond, 3);
    EXPECT_EQ(Received(link, 2 * kSecond), std::vector{3});
  }
}

}  // namespace
}  // namespace skein::simulator
