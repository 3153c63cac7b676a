#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "cli/station.h"

/// What `skein` can do, each a function of its options. They print to `out` and throw Failure, or
/// config::ConfigError for a file that cannot be used.
namespace skein::cli {

struct LinkOptions {
  std::vector<std::string> vehicles;
  bool up_only = false;
  bool down_only = false;
  bool frozen = false;
  double for_s = 0;  ///< 0: until restored
  double at_s = -1;  ///< time of the scenario; -1: at once
};
void CutLink(Station& station, const LinkOptions& options, std::ostream& out);
void RestoreLink(Station& station, const LinkOptions& options, std::ostream& out);

void SwitchPayload(Station& station, const std::vector<std::string>& vehicles, bool on, std::ostream& out);

/// @param id 0: all of them.
void ShowFormation(Station& station, int id, bool json, std::ostream& out);
void ApplyFormation(Station& station, const std::string& file, std::ostream& out);
void HoldFormation(Station& station, int id, std::ostream& out);
void ResumeFormation(Station& station, int id, std::ostream& out);
void RemoveFormation(Station& station, int id, std::ostream& out);

/// Prints GeoJSON. @param id 0: the only formation that has a path.
void ShowPath(Station& station, int id, std::ostream& out);

struct PathOptions {
  std::string file;
  int formation_id = 0;  ///< 0: the only one there is
  bool closed = false;   ///< also when the file does not say so
};
void UploadPath(Station& station, const PathOptions& options, std::ostream& out);
/// Takes the path away: straight on.
void ClearPath(Station& station, int id, std::ostream& out);

/// Those that this machine finds by name.
void ListScenarios(std::ostream& out);
/// The simulated fleet starts anew, with the same scenario when none is named.
void StartScenario(Station& station, const std::optional<std::string>& name, std::ostream& out);

struct StatusOptions {
  bool watch = false;
  bool json = false;
};
void ShowStatus(Station& station, const StatusOptions& options, std::ostream& out);

}  // namespace skein::cli
