// Paths as GeoJSON, as skein path upload reads them.
#include "cli/geojson.h"

#include "config/scenario.h"
#include "fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const skein::fuzz::MemoryFile file(".geojson");
  const auto& path = file.Hold(data, size);
  const skein::config::Origin origin{40, 116, 50};
  try {
    const skein::cli::PathFile read = skein::cli::ReadPathFile(path, origin);
    skein::fuzz::Require(!read.waypoints.empty(), "a path has waypoints");
  } catch (const skein::config::ConfigError& error) {
    skein::fuzz::Require(std::string(error.what()).starts_with(path.string()),
                         "what is refused is told with its file");
  }
  return 0;
}
