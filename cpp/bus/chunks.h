#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.h"
#include "bus/chunk_order.h"
#include "bus/chunk_traits.h"
#include "bus/events.h"
#include "bus/refusals.h"
#include "bus/validate.h"

namespace skein::bus {

/// Encoded items in one chunk are at most this long [B]: most of it fits into the kernel's default buffer
/// (tests/bench/README.md).
inline constexpr int kChunkBytes = 7000;
/// A set of items that is larger than so many of those has larger chunks instead: lcm-logger 1.3.1 lets 30
/// messages wait, then drops, and a set this large needs larger buffers anyway.
inline constexpr int kMostUsualChunks = 12;
/// These are not smaller than so: of datagrams between 8,000 and 16,000 B the kernel's buffer holds half as
/// many bytes (tests/bench/README.md).
inline constexpr int kLeastLargeChunkBytes = 16'000;
/// A datagram holds 65,507 B.
inline constexpr int kLargestChunkBytes = 60'000;
/// So much goes out at once, four full chunks; a quarter of what the kernel's default buffer holds.
inline constexpr int kBurstBytes = 29'000;
/// And so many messages: a sixth of what lcm-logger lets wait.
inline constexpr int kBurstMessages = 5;

/// How large the chunks of a set are [B].
template <typename Message>
int ChunkBytesFor(const Message& whole) {
  std::int64_t bytes = 0;
  for (const auto& item : ChunkTraits<Message>::Items(whole)) bytes += item._getEncodedSizeNoHash();
  if (bytes <= kMostUsualChunks * kChunkBytes) return kChunkBytes;
  return static_cast<int>(
      std::clamp<std::int64_t>(bytes / kMostUsualChunks, kLeastLargeChunkBytes, kLargestChunkBytes));
}

/// Splits a message into chunks of at most chunk_bytes of items (0: as ChunkBytesFor says); at least one
/// chunk, even when there is nothing in it.
template <typename Message>
std::vector<Message> Split(const Message& whole, int chunk_bytes = 0) {
  using Traits = ChunkTraits<Message>;
  if (chunk_bytes == 0) chunk_bytes = ChunkBytesFor(whole);
  Message empty = whole;
  Traits::Items(empty).clear();
  std::vector<Message> chunks{empty};
  int bytes = 0;
  for (const auto& item : Traits::Items(whole)) {
    const int item_bytes = item._getEncodedSizeNoHash();
    if (bytes > 0 && bytes + item_bytes > chunk_bytes) {
      chunks.push_back(empty);
      bytes = 0;
    }
    Traits::Items(chunks.back()).push_back(item);
    bytes += item_bytes;
  }
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    chunks[i].chunk = static_cast<int>(i);
    chunks[i].chunk_count = static_cast<int>(chunks.size());
    Traits::SetCount(chunks[i], static_cast<int>(Traits::Items(chunks[i]).size()));
  }
  return chunks;
}

/// Publishes messages that follow one another, with a pause after each kBurstBytes or kBurstMessages, because
/// loss comes from bursts.
class Burst {
 public:
  explicit Burst(Bus& bus) : bus_(bus) {}

  template <typename Message>
  void Publish(const std::string& channel, const Message& message) {
    const int size = message.getEncodedSize();
    if (bytes_ > 0 && (bytes_ + size > kBurstBytes || messages_ == kBurstMessages)) {
      bus_.executor().PauseBurst();
      bytes_ = messages_ = 0;
    }
    bus_.Publish(channel, message);
    bytes_ += size;
    ++messages_;
  }

 private:
  Bus& bus_;
  int bytes_ = 0;
  int messages_ = 0;
};

/// Publishes a message in chunks; chunk, chunk_count and the item count are filled in.
template <typename Message>
void PublishChunks(Burst& burst, const std::string& channel, const Message& whole, int chunk_bytes = 0) {
  for (const Message& chunk : Split(whole, chunk_bytes)) burst.Publish(channel, chunk);
}
template <typename Message>
void PublishChunks(Bus& bus, const std::string& channel, const Message& whole, int chunk_bytes = 0) {
  Burst burst(bus);
  PublishChunks(burst, channel, whole, chunk_bytes);
}

/// Puts the chunks of a set (a tick, a sweep) together again. The handler gets a set when its last chunk has
/// come or, with what is there, when the next one begins. Duplicates and older sets are skipped. SetOrder
/// says what else is taken.
template <typename Message>
class ChunkAssembler {
 public:
  /// @param whole all items in the order of the chunks, as chunk 0 of 1. @param missing how many chunks never
  /// came.
  using Handler = std::function<void(const Message& whole, int missing)>;

  explicit ChunkAssembler(Handler handler) : handler_(std::move(handler)) {}

  /// What Add found out beside the set.
  struct Found {
    std::int64_t gaps =
        0;  ///< chunks and sets that are now known to be missing (a missing set counts as its chunks)
    bool time_jumped = false;
    const char* refused = nullptr;  ///< why the message, or the whole set, was
  };
  Found Add(const Message& message);

 private:
  using Traits = ChunkTraits<Message>;

  struct Stream {
    SetOrder order;
    std::map<int, Message> chunks;  ///< of the current set
    std::size_t items = 0;          ///< in them
    int chunk_count = 0;
    int joined_at = 0;  ///< chunk of the very first set with which we came to it: those before are not lost
    bool delivered = true;
  };

  void Deliver(Stream& stream, Found& found);

  // More streams than this are noise.
  static constexpr std::size_t kMostStreams = 10'000;
  // Ten times the fleet that Skein is made for: what a node remembers of a set is bounded, whatever is sent.
  static constexpr std::size_t kMostItems = 50'000;

  Handler handler_;
  std::map<std::int64_t, Stream> streams_;
};

template <typename Message>
typename ChunkAssembler<Message>::Found ChunkAssembler<Message>::Add(const Message& message) {
  Found found;
  if (streams_.size() >= kMostStreams && !streams_.contains(Traits::Stream(message))) {
    found.refused = "it is of one more formation than there can be";
    return found;
  }
  const auto [entry, is_new] = streams_.try_emplace(Traits::Stream(message));
  Stream& stream = entry->second;
  const std::int64_t last_set = stream.order.current().set;
  const auto verdict = stream.order.Judge({Traits::Session(message), message.utime, Traits::Set(message)});
  if (verdict == SetOrder::Verdict::kLate) return found;
  if (verdict == SetOrder::Verdict::kFalse) {
    found.refused = "its time does not go on from that of the others, or it is of an earlier run";
    return found;
  }
  found.time_jumped = verdict == SetOrder::Verdict::kTakenAgain;
  if (verdict != SetOrder::Verdict::kSame) {
    if (!stream.delivered) {
      const auto missing = stream.chunk_count - static_cast<int>(stream.chunks.size());
      const auto before = std::distance(stream.chunks.begin(), stream.chunks.lower_bound(stream.joined_at));
      found.gaps += missing - (stream.joined_at - static_cast<int>(before));
      Deliver(stream, found);
    }
    if (Traits::kConsecutive && verdict == SetOrder::Verdict::kNext) {
      found.gaps += (Traits::Set(message) - last_set - 1) * message.chunk_count;
    }
    stream.chunks.clear();
    stream.items = 0;
    stream.chunk_count = message.chunk_count;
    stream.joined_at = is_new ? message.chunk : 0;
    stream.delivered = false;
  }
  if (message.chunk_count != stream.chunk_count) {
    found.refused = "it contradicts its set";
    return found;
  }
  if (stream.delivered) return found;
  if (stream.chunk_count == 1) {  // nothing to put together: no copy
    stream.delivered = true;
    handler_(message, 0);
    return found;
  }
  if (stream.chunks.emplace(message.chunk, message).second) stream.items += Traits::Items(message).size();
  if (stream.items > kMostItems) {
    stream.chunks.clear();
    stream.delivered = true;
    found.refused = "its set has too many items";
    return found;
  }
  if (static_cast<int>(stream.chunks.size()) == stream.chunk_count) Deliver(stream, found);
  return found;
}

template <typename Message>
void ChunkAssembler<Message>::Deliver(Stream& stream, Found& found) {
  const int missing = stream.chunk_count - static_cast<int>(stream.chunks.size());
  Message whole = stream.chunks.begin()->second;
  auto& items = Traits::Items(whole);
  for (auto chunk = std::next(stream.chunks.begin()); chunk != stream.chunks.end(); ++chunk) {
    const auto& more = Traits::Items(chunk->second);
    items.insert(items.end(), more.begin(), more.end());
  }
  whole.chunk = 0;
  whole.chunk_count = 1;
  Traits::SetCount(whole, static_cast<int>(items.size()));
  stream.chunks.clear();
  stream.delivered = true;
  // Each chunk is valid, but a UAV may be in two of them.
  if (!Valid(whole)) {
    found.refused = "its chunks contradict each other";
    return;
  }
  handler_(whole, missing);
}

/// Subscribes to a channel whose messages come in chunks. Gaps go to the Bus' statistics; a source whose time
/// has jumped is told as the event "time_jumped" when `events` is given, again after 10 s at the earliest.
template <typename Message>
void SubscribeChunks(Bus& bus, const std::string& channel, typename ChunkAssembler<Message>::Handler handler,
                     Events* events = nullptr) {
  bus.Subscribe<Message>(
      channel, [&bus, channel, events, told = Utime{0},
                assembler = ChunkAssembler<Message>(std::move(handler))](const Message& message) mutable {
        const auto found = assembler.Add(message);
        bus.CountGaps(found.gaps);
        if (found.refused) Refuse(bus, channel, found.refused);
        const Utime now = bus.executor().Now();
        if (found.time_jumped && events && (told == 0 || now - told >= 10 * kSecond)) {
          told = now;
          events->Tell(event_t::ADVISORY, "time_jumped",
                       "the time stamps of " + channel + " have jumped; they are taken again");
        }
      });
}

}  // namespace skein::bus
