#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "playback/recorded_flight.h"
#include "playback/recording_library.h"

namespace skein::playback {

/// Opens the parts of a recording; each is indexed, unless it was before. `go_on` is told the progress (0 to
/// 1) and ends it by returning false: then there is no result. Parts that cannot be read are left out, and
/// told as damage. Throws std::runtime_error, with the reason, when none can.
std::shared_ptr<const RecordedFlight> OpenRecording(const std::vector<std::filesystem::path>& parts,
                                                    const std::function<bool(double)>& go_on);

RecordingSummary Summarize(const RecordedFlight& flight);

}  // namespace skein::playback
