#pragma once

#include <memory>
#include <string>
#include <vector>

#include "system/process.h"

namespace skein::testing {

/// Simulator, controller, monitor and lcm-logger over multicast, each a process of its own. Starts them so
/// that the recording holds the flight from tick 0.
class LiveFlight {
 public:
  /// @param log the recording to be made.
  LiveFlight(const std::string& scenario, const std::string& log);

  const std::string& lcm_url() const { return url_; }

  /// Waits until the scenario is `t_s` old, at most `timeout` from now.
  bool WaitUntil(double t_s, Seconds timeout);

  /// Ends all; the recorder last. Whether each ended cleanly.
  bool End();

 private:
  std::string url_ = FreshLcmUrl();
  std::unique_ptr<Process> recorder_;
  std::vector<std::unique_ptr<Process>> nodes_;
};

}  // namespace skein::testing
