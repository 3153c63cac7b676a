#include "bridge/guess_limit.h"

#include <algorithm>

namespace skein::bridge {

std::chrono::seconds GuessLimit::Wait(const std::string& address, Time now) const {
  const auto found = guesses_.find(address);
  if (found == guesses_.end() || found->second.size() < kGuesses) return {};
  const auto left = found->second.front() + kPeriod - now;
  return std::max(std::chrono::seconds(0), std::chrono::ceil<std::chrono::seconds>(left));
}

bool GuessLimit::Count(const std::string& address, Time now) {
  if (!guesses_.contains(address) && guesses_.size() >= kMostAddresses) {
    guesses_.erase(
        std::ranges::min_element(guesses_, {}, [](const auto& entry) { return entry.second.back(); }));
  }
  std::deque<Time>& times = guesses_[address];
  times.push_back(now);
  if (times.size() > kGuesses) times.pop_front();
  return Wait(address, now) > std::chrono::seconds(0);
}

}  // namespace skein::bridge
