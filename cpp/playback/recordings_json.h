#pragma once

#include "bridge/json_messages.h"
#include "playback/recorded_flight.h"
#include "playback/recording_library.h"

namespace skein::playback {

/// The answers of GET /api/recordings and /api/recordings/NAME (cpp/bridge/README.md).
bridge::Json ListJson(const RecordingLibrary& library, const std::vector<RecordingLibrary::Listed>& list,
                      bool live_bus);
bridge::Json RecordingJson(const RecordingFiles& files, const RecordedFlight& flight);

}  // namespace skein::playback
