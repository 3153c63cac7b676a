// Scenario files: refused with file, place and reason, or read.
#include "config/scenario.h"
#include "fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const skein::fuzz::MemoryFile file(".json");
  const auto& path = file.Hold(data, size);
  try {
    const skein::config::Scenario scenario = skein::config::LoadScenario(path);
    skein::fuzz::Require(!scenario.vehicles.empty(), "a scenario has UAVs");
  } catch (const skein::config::ConfigError& error) {
    const std::string reason = error.what();
    skein::fuzz::Require(reason.starts_with(path.string() + ": ") && reason.size() > path.string().size() + 2,
                         "what is refused is told with file and reason");
  }
  return 0;
}
