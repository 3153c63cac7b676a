#include "bridge/recording_options.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "playback/recordings.h"
#include "recording/recording.h"

namespace skein::bridge {
namespace {

// A bus with nobody on it.
constexpr const char* kNoBus = "memq://";

}  // namespace

void AddRecordingOptions(bus::NodeMain& node, RecordingOptions& recordings) {
  auto* const url = node.app().get_option("--lcm-url");
  auto* const logs = node.app()
                         .add_option("--logs", recordings.folder,
                                     "Folder of recordings to serve beside the live flight, such as logs")
                         ->check(CLI::ExistingDirectory);
  auto* const no_bus = node.app().add_flag_callback(
      "--no-bus",
      [&] {
        recordings.no_bus = true;
        node.SetLcmUrl(kNoBus);
      },
      "With --logs: recordings only, no live flight");
  no_bus->needs(logs)->excludes(url);
  node.app()
      .add_option_function<std::string>(
          "--log",
          [&](const std::string& file) {
            recordings.file = file;
            recordings.no_bus = true;
            node.SetLcmUrl(kNoBus);
          },
          "One recording to serve alone, without a bus: a log of lcm-logger, or the first of its parts")
      ->excludes(logs)
      ->excludes(url);
}

void ServeRecordings(const RecordingOptions& recordings, BridgeOptions& options) {
  namespace fs = std::filesystem;
  if (recordings.folder.empty() && recordings.file.empty()) return;
  fs::path folder = recordings.folder;
  std::string only;
  if (!recordings.file.empty()) {
    // Says at once what is wrong with it.
    const recording::Recording opened(recordings.file);
    const fs::path file = fs::weakly_canonical(recordings.file);
    folder = file.parent_path();
    only = file.filename().string();
  }
  options.hello.recordings = {{"live_bus", !recordings.no_bus}, {"only", only.empty() ? Json() : Json(only)}};
  if (recordings.no_bus) options.hello.replay = {{"kind", "log"}, {"name", only}};
  options.make_recordings = [folder, only, hello = options.hello, live_bus = !recordings.no_bus] {
    return std::make_shared<const Recordings>(playback::MakeRecordings(
        std::make_shared<playback::RecordingLibrary>(folder, only), hello, live_bus));
  };
}

}  // namespace skein::bridge
