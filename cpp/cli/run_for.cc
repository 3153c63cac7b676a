#include "cli/run_for.h"

#include <memory>

namespace skein::cli {

bool RunFor(bus::LiveExecutor& executor, bus::Utime duration) {
  const auto over = std::make_shared<bool>(false);
  // A timer cannot be taken back. Once this run has ended early, its timer finds nobody and ends no later
  // run.
  executor.At(executor.Now() + duration, [&executor, run = std::weak_ptr(over)] {
    const auto is_over = run.lock();
    if (!is_over) return;
    *is_over = true;
    executor.Stop();
  });
  executor.Run();
  return *over;
}

}  // namespace skein::cli
