#include "cli/station.h"

#include <gtest/gtest.h>

#include <memory>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"

namespace skein::cli {
namespace {

TEST(Station, ForgetsWhatItsSenderNoLongerRepeats) {
  const std::shared_ptr<lcm::LCM> transport = bus::MakeTransport("memq://").lcm;
  bus::SimulatedExecutor executor(transport);
  bus::Bus monitor(transport, "monitor", executor);
  bus::Bus bus(transport, "skein", executor);
  Station station(bus, [&](bus::Utime duration) {
    executor.RunFor(duration);
    return true;
  });
  const auto say_links = [&] {
    link_status_t links{};
    links.utime = executor.Now();
    links.sequence = executor.Now();
    bus::PublishChunks(monitor, bus::channel::kLinkStatus, links);
  };
  path_t path = bus::ToMessage(Path::Straight({0, 0}, 0, 1000, 50));
  path.utime = executor.Now();
  path.formation_id = 1;
  monitor.Publish(bus::channel::kPath, path);
  for (int i = 0; i < 4; ++i) {
    say_links();
    executor.RunFor(bus::kSecond);
  }
  ASSERT_EQ(station.picture().paths.size(), 1u);
  station.ForgetWhatIsOld();
  EXPECT_TRUE(station.picture().links.has_value());
  EXPECT_TRUE(station.picture().paths.empty());
  executor.RunFor(2 * bus::kSecond);
  station.ForgetWhatIsOld();
  EXPECT_FALSE(station.picture().links.has_value());
}

}  // namespace
}  // namespace skein::cli
