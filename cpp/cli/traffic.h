#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bus/executor.h"

namespace skein::cli {

/// Follows the messages of one type: which of them are good, and how many never came.
class TypeWatch {
 public:
  virtual ~TypeWatch() = default;
  /// Whether the bytes are a good message.
  virtual bool Hear(const void* data, std::size_t size) = 0;
  /// Messages missed by now; none when the type has no numbers that would tell.
  virtual std::optional<std::int64_t> gaps() const = 0;
};

/// What has been heard on one channel.
struct ChannelTraffic {
  std::string type;  ///< of the last message; "": not one of Skein's
  std::int64_t fingerprint = 0;
  std::int64_t count = 0;
  std::int64_t undecodable = 0;
  std::size_t least_bytes = 0;
  std::size_t most_bytes = 0;
  std::int64_t bytes = 0;
  /// Of the last kRateWindow.
  struct Arrival {
    bus::Utime utime = 0;
    std::size_t bytes = 0;
    bool new_set = true;  ///< false: comes right behind another message of the same burst
  };
  std::deque<Arrival> arrivals;
  std::map<std::int64_t, std::unique_ptr<TypeWatch>> watches;  ///< by fingerprint

  /// None when no type on the channel has numbers that would tell.
  std::optional<std::int64_t> gaps() const;
  /// Standard deviation of the intervals between bursts [s]; none before there are two intervals.
  std::optional<double> jitter_s() const;
};

/// What goes on on a bus, channel by channel.
class Traffic {
 public:
  /// Rates and jitter are those of so long.
  static constexpr bus::Utime kRateWindow = 10 * bus::kSecond;
  /// Messages of one channel that come closer than this are one burst: chunks, or one message for each of
  /// several.
  static constexpr bus::Utime kBurst = 5'000;

  /// Whoever reaches the bus can invent names: messages of further channels are only counted.
  static constexpr std::size_t kMostChannels = 1'000;

  explicit Traffic(bus::Utime start) : start_(start) {}

  void Hear(bus::Utime now, const std::string& channel, const void* data, std::size_t size);

  struct Rate {
    double messages_s = 0;
    double bytes_s = 0;
  };
  /// Over the last kRateWindow, or since the start when that is shorter; none in the first half second, in
  /// which it would tell of nothing.
  std::optional<Rate> RateOf(const ChannelTraffic& channel, bus::Utime now) const;

  const std::map<std::string, ChannelTraffic>& channels() const { return channels_; }
  /// Messages on channels beyond kMostChannels.
  std::int64_t beyond() const { return beyond_; }
  bus::Utime start() const { return start_; }

 private:
  bus::Utime start_;
  std::int64_t beyond_ = 0;
  std::map<std::string, ChannelTraffic> channels_;
};

/// For people. @param width of the terminal [characters], 0: as wide as it needs to be. Columns that do not
/// fit are left out, the last ones first.
std::string TrafficTable(const Traffic& traffic, bus::Utime now, std::size_t width);
nlohmann::ordered_json TrafficJson(const Traffic& traffic, bus::Utime now);

}  // namespace skein::cli
