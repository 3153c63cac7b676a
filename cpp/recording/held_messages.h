#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bus/channels.h"
#include "bus/chunk_traits.h"
#include "recording/log_index.h"

namespace skein::recording {

/// Finds the HeldMessages of a log.
class HeldMessages {
 public:
  explicit HeldMessages(LogIndex& index) : index_(index) {}

  /// A message that stands for itself.
  void See(const std::string& channel, const std::string& of, bus::Utime utime, std::uint64_t offset) {
    Begin(Find(channel + "/" + of), utime, offset);
  }

  /// What comes again and again, and its last.
  struct Stream {
    HeldMessage last;
    bus::Utime longest_pause = 0;
    std::pair<std::int64_t, std::int64_t> set;  ///< session and set of chunks
    bool seen = false;
  };
  /// A channel of chunks, and which of its streams are whose.
  struct Channel {
    std::string name;
    std::unordered_map<std::int64_t, Stream*> streams{};
  };

  /// One of the chunks that replace the set before together.
  template <typename Message>
  void SeeChunk(Channel& channel, const Message& message, bus::Utime utime, std::uint64_t offset) {
    using Traits = bus::ChunkTraits<Message>;
    Stream& stream = Find(channel, Traits::Stream(message));
    const std::pair set{Traits::Session(message), Traits::Set(message)};
    if (stream.seen && stream.set == set) {
      ++stream.last.messages;
      return;
    }
    Begin(stream, utime, offset);
    stream.set = set;
  }

  /// One of the chunks of FLEET_STATE: each UAV in it stands for itself.
  void See(const fleet_state_t& state, bus::Utime utime, std::uint64_t offset);

  /// No more comes.
  void Finish();

 private:
  Stream& Find(const std::string& name);
  Stream& Find(Channel& channel, std::int64_t id);
  void Begin(Stream& stream, bus::Utime utime, std::uint64_t offset);
  void Keep(const HeldMessage& message);

  // A log that would need more is none of ours.
  static constexpr std::size_t kMostStreams = 100'000;
  static constexpr std::size_t kMostKept = 1'000'000;

  LogIndex& index_;
  std::unordered_map<std::string, Stream> streams_;
  Channel vehicles_{bus::channel::kFleetState};
  Stream nobody_{{.stream = UINT32_MAX}, 0, {}, false};  ///< stands for those that are too many
};

}  // namespace skein::recording
