#include "cli/traffic.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <skein/fields.hpp>
#include <type_traits>
#include <vector>

#include "bus/chunks.h"
#include "bus/decode.h"
#include "bus/validate.h"
#include "cli/any_message.h"
#include "cli/log/text.h"
#include "cli/text_table.h"

namespace skein::cli {
namespace {

template <typename Message>
constexpr bool kInChunks = requires(const Message& message) {
  bus::ChunkTraits<Message>::Set(message);
};

template <typename Message>
bool Good(const Message& message) {
  // Parts of messages have no rules of their own.
  if constexpr (requires { bus::Valid(message); }) return bus::Valid(message);
  return true;
}

template <typename Message>
class PlainWatch : public TypeWatch {
 public:
  bool Hear(const void* data, std::size_t size) override {
    const auto message = bus::Decode<Message>(data, size);
    return message && Good(*message);
  }
  std::optional<std::int64_t> gaps() const override { return std::nullopt; }
};

template <typename Message>
class ChunkWatch : public TypeWatch {
 public:
  bool Hear(const void* data, std::size_t size) override {
    const auto message = bus::Decode<Message>(data, size);
    if (!message || !Good(*message)) return false;
    gaps_ += assembler_.Add(*message).gaps;
    return true;
  }
  std::optional<std::int64_t> gaps() const override { return gaps_; }

 private:
  bus::ChunkAssembler<Message> assembler_{[](const Message&, int) {}};
  std::int64_t gaps_ = 0;
};

/// Every node numbers its own.
class EventWatch : public TypeWatch {
  static constexpr std::size_t kMostNodes = 1'000;  ///< names can be invented

 public:
  bool Hear(const void* data, std::size_t size) override {
    const auto event = bus::Decode<event_t>(data, size);
    if (!event || !Good(*event)) return false;
    if (last_.size() >= kMostNodes && !last_.contains(event->event_node)) return true;
    const auto [last, is_new] = last_.try_emplace(event->event_node, event->event_sequence);
    // A smaller one is that of a node which was started anew.
    if (!is_new) gaps_ += std::max<std::int64_t>(0, event->event_sequence - last->second - 1);
    last->second = event->event_sequence;
    return true;
  }
  std::optional<std::int64_t> gaps() const override { return gaps_; }

 private:
  std::map<std::string, std::int64_t> last_;
  std::int64_t gaps_ = 0;
};

template <typename Message>
std::unique_ptr<TypeWatch> MakeWatch() {
  if constexpr (std::is_same_v<Message, event_t>) {
    return std::make_unique<EventWatch>();
  } else if constexpr (kInChunks<Message>) {
    return std::make_unique<ChunkWatch<Message>>();
  } else {
    return std::make_unique<PlainWatch<Message>>();
  }
}

/// None for a type that is not one of Skein's.
std::unique_ptr<TypeWatch> MakeWatchFor(std::int64_t fingerprint) {
  using Make = std::unique_ptr<TypeWatch> (*)();
  static const auto kMakers = [] {
    std::map<std::int64_t, Make> makers;
    ForEachMessageType([&makers]<typename Message>() { makers[Message::getHash()] = MakeWatch<Message>; });
    return makers;
  }();
  const auto make = kMakers.find(fingerprint);
  return make == kMakers.end() ? nullptr : make->second();
}

std::string Number(double value) { return fmt::format("{:.{}f}", value, value < 10 ? 1 : 0); }

std::string TypeOf(const ChannelTraffic& channel) {
  if (!channel.type.empty()) return channel.type;
  return channel.fingerprint == 0
             ? "no LCM message"
             : fmt::format("unknown {:016x}", static_cast<std::uint64_t>(channel.fingerprint));
}

constexpr bus::Utime kLeastListening = bus::kSecond / 2;

}  // namespace

std::optional<std::int64_t> ChannelTraffic::gaps() const {
  std::optional<std::int64_t> sum;
  for (const auto& [unused, watch] : watches) {
    const auto gaps = watch ? watch->gaps() : std::nullopt;
    if (gaps) sum = sum.value_or(0) + *gaps;
  }
  return sum;
}

std::optional<double> ChannelTraffic::jitter_s() const {
  std::vector<double> intervals_s;
  std::optional<bus::Utime> last;
  for (const Arrival& arrival : arrivals) {
    if (!arrival.new_set) continue;
    if (last) intervals_s.push_back(static_cast<double>(arrival.utime - *last) / bus::kSecond);
    last = arrival.utime;
  }
  if (intervals_s.size() < 2) return std::nullopt;
  const auto count = static_cast<double>(intervals_s.size());
  double mean_s = 0;
  for (const double interval_s : intervals_s) mean_s += interval_s / count;
  double square_s2 = 0;
  for (const double interval_s : intervals_s) square_s2 += std::pow(interval_s - mean_s, 2);
  return std::sqrt(square_s2 / (count - 1));
}

void Traffic::Hear(bus::Utime now, const std::string& channel, const void* data, std::size_t size) {
  if (channels_.size() >= kMostChannels && !channels_.contains(channel)) {
    ++beyond_;
    return;
  }
  ChannelTraffic& heard = channels_[channel];
  heard.fingerprint = Fingerprint(data, size);
  heard.type = TypeName(heard.fingerprint);
  heard.least_bytes = heard.count == 0 ? size : std::min(heard.least_bytes, size);
  heard.most_bytes = std::max(heard.most_bytes, size);
  heard.bytes += static_cast<std::int64_t>(size);
  ++heard.count;
  const bool new_set = heard.arrivals.empty() || now - heard.arrivals.back().utime > kBurst;
  heard.arrivals.push_back({now, size, new_set});
  while (heard.arrivals.front().utime <= now - kRateWindow) heard.arrivals.pop_front();

  const bool unknown = heard.type.empty() && heard.fingerprint != 0;
  if (unknown) return;
  auto& watch = heard.watches[heard.fingerprint];
  if (!watch) watch = MakeWatchFor(heard.fingerprint);
  if (!watch || !watch->Hear(data, size)) ++heard.undecodable;
}

std::optional<Traffic::Rate> Traffic::RateOf(const ChannelTraffic& channel, bus::Utime now) const {
  const bus::Utime from = std::max(start_, now - kRateWindow);
  if (now - from < kLeastListening) return std::nullopt;
  Rate rate;
  for (const ChannelTraffic::Arrival& arrival : channel.arrivals) {
    if (arrival.utime < from) continue;
    ++rate.messages_s;
    rate.bytes_s += static_cast<double>(arrival.bytes);
  }
  const double seconds = static_cast<double>(now - from) / bus::kSecond;
  return Rate{rate.messages_s / seconds, rate.bytes_s / seconds};
}

std::string TrafficTable(const Traffic& traffic, bus::Utime now, std::size_t width) {
  // Those that are needed least come last.
  Table table = {{"CHANNEL", "HZ", "KB/S", "GAPS", "BAD", "BYTES", "JITTER MS", "COUNT", "TYPE"}};
  Traffic::Rate sum;
  std::int64_t count = 0;
  for (const auto& [name, channel] : traffic.channels()) {
    const auto rate = traffic.RateOf(channel, now);
    sum.messages_s += rate.value_or(Traffic::Rate()).messages_s;
    sum.bytes_s += rate.value_or(Traffic::Rate()).bytes_s;
    count += channel.count;
    const auto jitter_s = channel.jitter_s();
    const auto gaps = channel.gaps();
    table.push_back(
        {Printable(name), rate ? Number(rate->messages_s) : "-", rate ? Number(rate->bytes_s / 1e3) : "-",
         gaps ? std::to_string(*gaps) : "-", std::to_string(channel.undecodable),
         channel.least_bytes == channel.most_bytes
             ? std::to_string(channel.most_bytes)
             : fmt::format("{}-{}", channel.least_bytes, channel.most_bytes),
         jitter_s ? Number(*jitter_s * 1e3) : "-", std::to_string(channel.count), TypeOf(channel)});
  }
  if (traffic.beyond() > 0) {
    table.push_back({"(further channels)", "", "", "", "", "", "", std::to_string(traffic.beyond()), ""});
  }
  table.push_back({"all", Number(sum.messages_s), Number(sum.bytes_s / 1e3), "", "", "", "",
                   std::to_string(count + traffic.beyond()), ""});
  const auto too_wide = [&](const std::string& text) {
    for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
      if (text.find('\n', begin) - begin > width) return true;
    }
    return false;
  };
  std::string text = Aligned(table, 1);
  while (width > 0 && table.front().size() > 2 && too_wide(text)) {
    for (auto& row : table) row.pop_back();
    text = Aligned(table, 1);
  }
  return text;
}

nlohmann::ordered_json TrafficJson(const Traffic& traffic, bus::Utime now) {
  using Json = nlohmann::ordered_json;
  Json channels = Json::array();
  for (const auto& [name, channel] : traffic.channels()) {
    const auto rate = traffic.RateOf(channel, now);
    const auto jitter_s = channel.jitter_s();
    const auto gaps = channel.gaps();
    channels.push_back(
        {{"channel", name},
         {"type", channel.type.empty() ? Json() : Json(channel.type)},
         {"fingerprint", fmt::format("{:016x}", static_cast<std::uint64_t>(channel.fingerprint))},
         {"count", channel.count},
         {"rate_hz", rate ? Json(rate->messages_s) : Json()},
         {"bytes_per_s", rate ? Json(rate->bytes_s) : Json()},
         {"least_bytes", channel.least_bytes},
         {"mean_bytes", static_cast<double>(channel.bytes) / static_cast<double>(channel.count)},
         {"most_bytes", channel.most_bytes},
         {"jitter_s", jitter_s ? Json(*jitter_s) : Json()},
         {"gaps", gaps ? Json(*gaps) : Json()},
         {"undecodable", channel.undecodable}});
  }
  return {{"utime", now},
          {"listened_s", static_cast<double>(now - traffic.start()) / bus::kSecond},
          {"channels", std::move(channels)},
          {"messages_on_further_channels", traffic.beyond()}};
}

}  // namespace skein::cli
