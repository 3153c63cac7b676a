#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "cli/drop_plan.h"
#include "cli/station.h"

namespace skein::cli {

struct DropsOptions {
  std::vector<std::string> vehicles;  ///< a single drop of these; or whose links random drops hit (none: all)
  double at_s = -1;                   ///< time of the scenario; -1: at once
  double for_s = 35;
  std::string direction = "both";  ///< random drops: "any", too
  double loss = -1;                ///< -1: 1, or 0 with a delay
  double delay_s = 0;

  std::string file;        ///< a list instead
  std::vector<Drop> list;  ///< what it says
  bool check = false;      ///< only read it and write it down anew
  bool from_now = false;   ///< its times count from now, not from the scenario's start
  double repeat_s = 0;     ///< the plan begins again every so often

  bool random = false;
  RandomDrops random_drops;
  int count = 0;  ///< of random drops; 0: until stopped

  double limit_s = 5;  ///< a cut is to be found within this
  std::string hook;    ///< called to begin and end drops, instead of CMD_LINK; "" for none
  bool json = false;
};

/// Cuts data links by a plan, watches what the monitor finds of it, and reports that. Throws Failure (exit
/// code 1) when a cut was missed or found late.
void RunDrops(Station& station, const DropsOptions& options, std::ostream& out);

}  // namespace skein::cli
