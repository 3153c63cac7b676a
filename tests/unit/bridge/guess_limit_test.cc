#include "bridge/guess_limit.h"

#include <gtest/gtest.h>

namespace skein::bridge {
namespace {

using std::chrono::seconds;

TEST(GuessLimit, LetsSoManyBeTriedWithinAMinuteAndThenWaits) {
  GuessLimit limit;
  const GuessLimit::Time start{};
  for (std::size_t i = 0; i + 1 < GuessLimit::kGuesses; ++i) {
    EXPECT_FALSE(limit.Count("10.0.0.5", start + seconds(i)));
    EXPECT_EQ(limit.Wait("10.0.0.5", start + seconds(i)), seconds(0));
  }
  EXPECT_TRUE(limit.Count("10.0.0.5", start + seconds(20)));
  EXPECT_EQ(limit.Wait("10.0.0.5", start + seconds(20)), seconds(40));
  EXPECT_EQ(limit.Wait("10.0.0.6", start + seconds(20)), seconds(0));
  // The first of them is a minute old: one more may be tried.
  EXPECT_EQ(limit.Wait("10.0.0.5", start + seconds(60)), seconds(0));
  EXPECT_TRUE(limit.Count("10.0.0.5", start + seconds(60)));
  EXPECT_EQ(limit.Wait("10.0.0.5", start + seconds(60)), seconds(1));
}

TEST(GuessLimit, ForgetsTheOneThatGuessedLongestAgo) {
  GuessLimit limit;
  const GuessLimit::Time start{};
  const auto block = [&](const std::string& address, seconds at) {
    for (std::size_t i = 0; i < GuessLimit::kGuesses; ++i) limit.Count(address, start + at);
  };
  block("oldest", seconds(0));
  block("next", seconds(1));
  for (std::size_t i = 0; i + 1 < GuessLimit::kMostAddresses; ++i)
    limit.Count("address " + std::to_string(i), start + seconds(2));
  EXPECT_EQ(limit.Wait("oldest", start + seconds(2)), seconds(0));
  EXPECT_GT(limit.Wait("next", start + seconds(2)), seconds(0));
}

}  // namespace
}  // namespace skein::bridge
