#include "cli/any_message.h"

#include <map>
#include <skein/fields.hpp>
#include <type_traits>
#include <vector>

#include "bus/decode.h"
#include "bus/validate.h"

namespace skein::cli {
namespace {

using Json = nlohmann::ordered_json;

template <typename Message>
Json Fields(const Message& message);

template <typename Value>
Json FieldValue(const Value& value) {
  if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string>) {
    return value;
  } else {
    return Fields(value);
  }
}

template <typename Value>
Json FieldValue(const std::vector<Value>& values) {
  Json list = Json::array();
  for (const Value& value : values) list.push_back(FieldValue(value));
  return list;
}

template <typename Message>
Json Fields(const Message& message) {
  Json fields = Json::object();
  VisitFields(message, [&fields](const char* name, const auto& value) { fields[name] = FieldValue(value); });
  return fields;
}

template <typename Message>
std::optional<Json> Read(const void* data, std::size_t size) {
  const auto message = bus::Decode<Message>(data, size);
  if (!message) return std::nullopt;
  // Parts of messages have no rules of their own.
  if constexpr (requires { bus::Valid(*message); }) {
    if (!bus::Valid(*message)) return std::nullopt;
  }
  return Fields(*message);
}

struct MessageType {
  const char* name;
  std::optional<Json> (*read)(const void* data, std::size_t size);
};

const std::map<std::int64_t, MessageType>& Types() {
  static const auto kTypes = [] {
    std::map<std::int64_t, MessageType> types;
    ForEachMessageType([&types]<typename Message>() {
      types[Message::getHash()] = {Message::getTypeName(), Read<Message>};
    });
    return types;
  }();
  return kTypes;
}

}  // namespace

std::int64_t Fingerprint(const void* data, std::size_t size) {
  if (size < 8) return 0;
  std::uint64_t fingerprint = 0;
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (int i = 0; i < 8; ++i) fingerprint = fingerprint << 8 | bytes[i];
  return static_cast<std::int64_t>(fingerprint);
}

std::string TypeName(std::int64_t fingerprint) {
  const auto type = Types().find(fingerprint);
  return type == Types().end() ? "" : type->second.name;
}

std::optional<Json> ReadFields(const void* data, std::size_t size) {
  const auto type = Types().find(Fingerprint(data, size));
  if (type == Types().end()) return std::nullopt;
  return type->second.read(data, size);
}

}  // namespace skein::cli
