#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <string>

namespace skein::bridge {

/// How many wrong tokens an address may show: kGuesses within kPeriod, then none, right or wrong, until the
/// first of them is that old.
class GuessLimit {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr std::size_t kGuesses = 10;
  static constexpr std::chrono::seconds kPeriod{60};
  /// More are not remembered, lest somebody with many addresses fills the memory: the one that guessed
  /// longest ago is forgotten.
  static constexpr std::size_t kMostAddresses = 1000;

  /// How long this address must wait still, 0 when it may try.
  std::chrono::seconds Wait(const std::string& address, Time now) const;
  /// It has shown a wrong one. @return whether it must wait from now on.
  bool Count(const std::string& address, Time now);

 private:
  std::map<std::string, std::deque<Time>> guesses_;  ///< the last kGuesses of each, oldest first
};

}  // namespace skein::bridge
