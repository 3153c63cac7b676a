#include "cli/run_for.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include "bus/transport.h"

namespace skein::cli {
namespace {

TEST(RunFor, EndsAtItsOwnTimeAfterARunThatWasInterrupted) {
  const auto transport = bus::MakeTransport("memq://");
  bus::LiveExecutor executor(transport.lcm);
  kill(getpid(), SIGINT);
  EXPECT_FALSE(RunFor(executor, bus::kSecond / 10));
  // The first run's timer goes off meanwhile.
  const bus::Utime start = executor.Now();
  EXPECT_TRUE(RunFor(executor, 3 * bus::kSecond / 10));
  EXPECT_GE(executor.Now() - start, 3 * bus::kSecond / 10);
}

}  // namespace
}  // namespace skein::cli
