// LCM logs, damaged in any way: all of it is read, and nothing is read twice.
#include "fuzz_target.h"
#include "recording/log_file.h"
#include "recording/log_index.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const skein::fuzz::MemoryFile file(".lcm");
  try {
    const skein::recording::LogFile log(file.Hold(data, size));
    skein::recording::LogReader reader(log);
    std::uint64_t end = 0;
    std::uint64_t taken = 0;
    while (const auto event = reader.Next()) {
      skein::fuzz::Require(event->offset >= end, "events follow one another");
      end = event->offset + event->bytes();
      taken += event->bytes();
      skein::fuzz::Require(end <= size, "an event ends within the file");
    }
    skein::fuzz::Require(taken + reader.damaged_bytes() == size, "every byte is an event's, or damage");
    skein::recording::IndexLog(log, [](double) { return true; });
  } catch (const std::runtime_error&) {
    // No log at all.
  }
  return 0;
}
