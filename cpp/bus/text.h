#pragma once

#include <cstddef>
#include <string>

namespace skein::bus {

/// No text in a message has more bytes: receivers refuse one that has (bus/validate.h).
inline constexpr std::size_t kLongestText = 4096;

/// At most `most` bytes of it, cut between two characters of UTF-8; an ellipsis stands for the rest.
std::string Shortened(std::string text, std::size_t most = kLongestText);

}  // namespace skein::bus
