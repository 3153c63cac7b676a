#include "cli/recording.h"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <nlohmann/json.hpp>
#include <skein/recording_command_t.hpp>
#include <string_view>

#include "bus/channels.h"
#include "cli/log/text.h"

namespace skein::cli {
namespace {

constexpr const char* kRecorder = "flight-recorder";
constexpr std::array<std::string_view, 3> kStates = {"stopped", "recording", "interrupted"};

std::string Ask(Station& station, std::int8_t action, const std::string& text) {
  recording_command_t command;
  command.action = action;
  command.operator_name = OperatorName();
  command.text = text;
  return station.Ask(bus::channel::kCmdRecording, command, kRecorder);
}

const recording_status_t& Status(Station& station) {
  if (!station.WaitUntil([&] { return station.picture().recording.has_value(); }, kLongestPeriod)) {
    throw Failure(fmt::format(
        "not recording: {} was not heard for 2.5 s; is it running, and on this LCM URL?", kRecorder));
  }
  return *station.picture().recording;
}

}  // namespace

void StartRecording(Station& station, std::ostream& out) {
  Done(out, "recording begins", Ask(station, recording_command_t::ACTION_START, ""));
}

void StopRecording(Station& station, std::ostream& out) {
  Done(out, "recording is ended", Ask(station, recording_command_t::ACTION_STOP, ""));
}

void PutMarker(Station& station, const std::string& text, std::ostream& out) {
  Done(out, "marker put", Ask(station, recording_command_t::ACTION_MARKER, text));
}

void ShowRecording(Station& station, bool json, std::ostream& out) {
  const recording_status_t& status = Status(station);
  const double seconds = status.started_utime == 0 ? 0 : bus::ToSeconds(status.utime - status.started_utime);
  if (json) {
    const nlohmann::ordered_json shown = {{"state", kStates.at(static_cast<std::size_t>(status.state))},
                                          {"folder", status.folder},
                                          {"recording", status.recording},
                                          {"part", status.part},
                                          {"started_utime", status.started_utime},
                                          {"parts", status.parts},
                                          {"bytes", status.bytes},
                                          {"free_bytes", status.free_bytes},
                                          {"reason", status.reason}};
    out << shown.dump(1) << '\n';
    return;
  }
  if (status.state != recording_status_t::RECORDING) throw Failure("not recording: " + status.reason);
  const auto bytes = [](std::int64_t count) { return ByteText(static_cast<std::uint64_t>(count)); };
  out << fmt::format("recording to {}/{} for {:.0f} s: {} in {} {}, {} are free\n", status.folder,
                     status.recording, seconds, bytes(status.bytes), status.parts,
                     status.parts == 1 ? "file" : "files", bytes(status.free_bytes));
}

}  // namespace skein::cli
