#pragma once

#include <functional>
#include <string>

#include "cli/drop_ledger.h"

namespace skein::cli {

struct DropReport {
  const DropLedger& ledger;
  double limit_s;
  bus::Utime now;
  bus::Utime scenario_start;
  std::function<std::string(int)> callsign;
};

/// Found later than the limit, or not at all.
int Failures(const DropReport& report);
/// A few lines for people.
std::string DropSummary(const DropReport& report);
/// Everything: a record for each drop of each UAV, false losses, the summary.
std::string DropsAsJson(const DropReport& report);

}  // namespace skein::cli
