#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "bus/executor.h"
#include "config/scenario.h"

namespace skein::simulator {

enum class LinkMode {
  kUp,
  kSilent,  ///< nothing gets through
  kFrozen,  ///< nothing gets through, and the receiver sees the last message again and again
};

/// How one direction of a data link behaves.
struct LinkSetting {
  LinkMode mode = LinkMode::kUp;
  config::LinkQuality quality;

  bool operator==(const LinkSetting& other) const;
};

/// Random numbers of one link: the same on every machine, and no link's depend on what another one carries
/// (splitmix64).
class LinkRandom {
 public:
  explicit LinkRandom(std::uint64_t seed) : state_(seed) {}
  /// Uniform, 0 <= number < 1.
  double Next();

 private:
  std::uint64_t state_;
};

/// One direction of a data link: loses messages and brings the others later, perhaps in another order.
template <typename Message>
class VehicleLink {
 public:
  VehicleLink(const LinkSetting& setting, std::uint64_t seed) : setting_(setting), random_(seed) {}

  const LinkSetting& setting() const { return setting_; }

  /// From now on. A cut loses what is under way, too.
  void Set(const LinkSetting& setting) {
    setting_ = setting;
    if (setting.mode != LinkMode::kUp) under_way_.clear();
  }

  void Send(bus::Utime now, Message message) {
    if (setting_.mode != LinkMode::kUp) return;
    const config::LinkQuality& quality = setting_.quality;
    if (quality.loss > 0 && random_.Next() < quality.loss) return;
    double delay_s = quality.delay_s;
    if (quality.jitter_s > 0) delay_s += quality.jitter_s * random_.Next();
    const bus::Utime arrival = now + bus::ToUtime(delay_s);
    const auto later = std::upper_bound(under_way_.begin(), under_way_.end(), arrival,
                                        [](bus::Utime time, const auto& sent) { return time < sent.first; });
    under_way_.emplace(later, arrival, std::move(message));
  }

  /// Calls `handle(arrival, message)` for all that have arrived up to `now`, that moment included, in order
  /// of arrival.
  template <typename Handle>
  void Receive(bus::Utime now, Handle&& handle) {
    auto sent = under_way_.begin();
    for (; sent != under_way_.end() && sent->first <= now; ++sent) handle(sent->first, sent->second);
    under_way_.erase(under_way_.begin(), sent);
  }

 private:
  LinkSetting setting_;
  LinkRandom random_;
  std::vector<std::pair<bus::Utime, Message>> under_way_;  ///< by arrival
};

}  // namespace skein::simulator
