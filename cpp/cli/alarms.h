#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "cli/station.h"

/// Alarms on the command line. All throw Failure when no list of alarms is heard.
namespace skein::cli {

struct AlarmsOptions {
  bool history = false;  ///< those that are over, too
  bool json = false;
};
void ShowAlarms(Station& station, const AlarmsOptions& options, std::ostream& out);

/// @param ids as listed, or just "all": all that the list knew when it was asked for.
void AcknowledgeAlarms(Station& station, const std::vector<std::string>& ids, std::ostream& out);
void ShelveAlarms(Station& station, const std::vector<std::string>& ids, double for_s, std::ostream& out);
void UnshelveAlarms(Station& station, const std::vector<std::string>& ids, std::ostream& out);

}  // namespace skein::cli
