#pragma once

#include <string>
#include <vector>

#include "config/scenario.h"
#include "experiment/tick.h"
#include "plot/flight_record.h"

namespace skein::experiment {

/// Keeps of a flight what is plotted, five times a second.
class FlightSampler {
 public:
  FlightSampler(const config::Scenario& scenario, std::string label);
  void Add(const Tick& tick);
  const plot::FlightRecord& record() const { return record_; }

 private:
  plot::FlightRecord record_;
  std::vector<bool> cut_;  ///< as record_.vehicles
};

}  // namespace skein::experiment
