#pragma once

#include <ostream>
#include <string>

#include "cli/station.h"

/// The recording on the command line. All throw Failure when flight-recorder is not heard.
namespace skein::cli {

void StartRecording(Station& station, std::ostream& out);
void StopRecording(Station& station, std::ostream& out);
/// A note of the operator's: an EVENT, and so a part of the recording.
void PutMarker(Station& station, const std::string& text, std::ostream& out);
/// Throws Failure also when nothing is recorded, unless it is `json`, which says so itself.
void ShowRecording(Station& station, bool json, std::ostream& out);

}  // namespace skein::cli
