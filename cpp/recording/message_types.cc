#include "recording/message_types.h"

#include <cstdint>
#include <map>
#include <skein/fields.hpp>

#include "bus/decode.h"
#include "bus/validate.h"

namespace skein::recording {
namespace {

template <typename Message>
bool IsGood(std::span<const std::byte> data) {
  const auto message = bus::Decode<Message>(data.data(), data.size());
  return message && bus::Valid(*message);
}

/// By fingerprint. Types that are only parts of others have no channel, and no Valid().
std::map<std::int64_t, MessageType> AllTypes() {
  std::map<std::int64_t, MessageType> types;
  ForEachMessageType([&types]<typename Message>() {
    if constexpr (requires(const Message& message) { bus::Valid(message); }) {
      types[Message::getHash()] = {Message::getTypeName(), &IsGood<Message>};
    }
  });
  return types;
}

}  // namespace

const MessageType* TypeOf(std::span<const std::byte> data) {
  static const auto types = AllTypes();
  if (data.size() < sizeof(std::int64_t)) return nullptr;
  std::uint64_t fingerprint = 0;
  for (std::size_t i = 0; i < sizeof fingerprint; ++i) {
    fingerprint = fingerprint << 8 | static_cast<std::uint64_t>(data[i]);
  }
  const auto found = types.find(static_cast<std::int64_t>(fingerprint));
  return found == types.end() ? nullptr : &found->second;
}

}  // namespace skein::recording
