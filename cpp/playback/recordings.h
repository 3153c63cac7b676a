#pragma once

#include <memory>
#include <string>

#include "bridge/bus_mirror.h"
#include "bridge/recordings.h"
#include "playback/recording_library.h"

namespace skein::playback {

/// What the web server needs to serve the recordings of a library, each browser with a player of its own.
/// @param hello of the bridge, as for live flights.
bridge::Recordings MakeRecordings(std::shared_ptr<RecordingLibrary> library, const bridge::HelloInfo& hello,
                                  bool live_bus);

/// So many browsers may look at recordings at once; each has a thread.
inline constexpr std::size_t kMostViewers = 32;

}  // namespace skein::playback
