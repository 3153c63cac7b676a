#pragma once

#include <filesystem>
#include <ostream>
#include <string>

namespace skein::cli {

struct DoctorOptions {
  std::string lcm_url;                    ///< "": the default one
  std::filesystem::path folder = "logs";  ///< of recordings
  double listen_s = 2.5;                  ///< for HEARTBEAT, which comes once a second
  bool json = false;
};

/// Looks at this machine and at the bus, and says what of it will make trouble and what to do about it.
/// @return the exit code: 1 when something will not work, 0 also when something could be better.
int Doctor(const DoctorOptions& options, std::ostream& out);

}  // namespace skein::cli
