#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "playback/recorded_flight.h"

namespace skein::playback {

/// A folder that lives as long as this.
class FreshFolder {
 public:
  FreshFolder();
  ~FreshFolder();
  FreshFolder(const FreshFolder&) = delete;
  FreshFolder& operator=(const FreshFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The experiment of the paper, recorded: three UAVs, the link of UAV 3 is cut from 200 s to 235 s. And
/// beside it: a note at 100 s, HEARTBEATs of a "formation-controller" until 270 s, channel STRANGER with 3
/// messages, and a FLEET_STATE that cannot be decoded. Made once, at the first call.
const std::filesystem::path& LinkDropLog();

inline constexpr double kNote_s = 100;
inline constexpr double kCut_s = 200;
inline constexpr double kControllerGone_s = 270;

/// Opened, without an index beside it.
std::shared_ptr<const RecordedFlight> Open(const std::filesystem::path& log);

}  // namespace skein::playback
