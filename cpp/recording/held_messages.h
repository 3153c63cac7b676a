#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

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

  /// One of the chunks that replace the set before together.
  template <typename Message>
  void SeeChunk(const std::string& channel, const Message& message, bus::Utime utime, std::uint64_t offset) {
    using Traits = bus::ChunkTraits<Message>;
    Stream& stream = Find(channel + "/" + std::to_string(Traits::Stream(message)));
    const SetId set{Traits::Session(message), Traits::Set(message)};
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
  using SetId = std::pair<std::int64_t, std::int64_t>;
  struct Stream {
    HeldMessage last;
    bus::Utime longest_pause = 0;
    SetId set;
    bool seen = false;
  };

  Stream& Find(const std::string& name);
  void Begin(Stream& stream, bus::Utime utime, std::uint64_t offset);
  void Keep(const HeldMessage& message);

  // A log that would need more is none of ours.
  static constexpr std::size_t kMostStreams = 100'000;
  static constexpr std::size_t kMostKept = 1'000'000;

  LogIndex& index_;
  std::unordered_map<std::string, Stream> streams_;
  std::unordered_map<std::int32_t, Stream*> vehicles_;
  Stream nobody_{{.stream = UINT32_MAX}, 0, {}, false};  ///< stands for those that are too many
};

}  // namespace skein::recording
