#include "recording/held_messages.h"

#include <algorithm>

#include "bus/channels.h"

namespace skein::recording {

bus::Utime LongestPause(std::string_view channel) {
  if (channel == bus::channel::kFleetState) return bus::kSecond / 2;  // 20 Hz
  return bus::kSecond * 5 / 2;                                        // 1 Hz
}

HeldMessages::Stream& HeldMessages::Find(const std::string& name) {
  const auto known = streams_.find(name);
  if (known != streams_.end()) return known->second;
  if (streams_.size() >= kMostStreams) return nobody_;
  Stream& stream = streams_[name];
  stream.last.stream = static_cast<std::uint32_t>(index_.streams.size());
  stream.longest_pause = LongestPause(name.substr(0, name.find('/')));
  index_.streams.push_back(name);
  return stream;
}

HeldMessages::Stream& HeldMessages::Find(Channel& channel, std::int64_t id) {
  const auto known = channel.streams.find(id);
  if (known != channel.streams.end()) return *known->second;
  Stream& stream = Find(channel.name + "/" + std::to_string(id));
  if (&stream != &nobody_) channel.streams.emplace(id, &stream);
  return stream;
}

void HeldMessages::Begin(Stream& stream, bus::Utime utime, std::uint64_t offset) {
  if (stream.seen && utime - stream.last.utime > stream.longest_pause) Keep(stream.last);
  stream.last.utime = utime;
  stream.last.offset = offset;
  stream.last.messages = 1;
  stream.seen = true;
}

void HeldMessages::Keep(const HeldMessage& message) {
  if (message.stream < index_.streams.size() && index_.held.size() < kMostKept)
    index_.held.push_back(message);
}

void HeldMessages::See(const fleet_state_t& state, bus::Utime utime, std::uint64_t offset) {
  for (const vehicle_state_t& vehicle : state.vehicles) {
    Begin(Find(vehicles_, vehicle.id), utime, offset);
  }
}

void HeldMessages::Finish() {
  for (const auto& [name, stream] : streams_) {
    if (stream.seen) Keep(stream.last);
  }
  std::ranges::stable_sort(index_.held, {}, &HeldMessage::utime);
}

}  // namespace skein::recording
