#pragma once

#include <filesystem>
#include <string>

namespace skein::recording {

/// Where flight-recorder's card of a recording is: NAME.lcm.json beside NAME.lcm.
std::filesystem::path CardOf(const std::filesystem::path& recording);

/// Whether a file is such a card; a name alone proves nothing.
bool IsCard(const std::filesystem::path& file);

/// Whether flight-recorder holds the card, so writes the recording. One that cannot be opened, or that is
/// just being replaced, counts as held.
bool IsHeld(const std::filesystem::path& card);

}  // namespace skein::recording
