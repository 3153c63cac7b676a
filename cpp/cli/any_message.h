#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace skein::cli {

/// What a message says of its type: the first eight bytes, 0 when it has none.
std::int64_t Fingerprint(const void* data, std::size_t size);

/// The name of a type of Skein ("fleet_state_t"), "" when it is somebody else's.
std::string TypeName(std::int64_t fingerprint);

/// The fields of a message of any type of Skein, named and ordered as in its .lcm file (without those that
/// only tell how long an array is). None when the type is unknown, when the bytes are not exactly one
/// message, or when a value breaks a rule of its file.
std::optional<nlohmann::ordered_json> ReadFields(const void* data, std::size_t size);

}  // namespace skein::cli
