#include "bridge_under_test.h"

#include <future>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/conversions.h"

namespace skein::bridge {

BridgeUnderTest::BridgeUnderTest(BridgeOptions options) {
  options.port = 0;
  bridge_ = std::make_unique<WebBridge>(bus_, executor_, options);
  thread_ = std::thread([this] { executor_.Run(); });
  // Run() forgets a Stop() that came before it.
  OnBus([](bus::Bus&) {});
}

BridgeUnderTest::~BridgeUnderTest() {
  executor_.Stop();
  thread_.join();
}

void BridgeUnderTest::OnBus(const std::function<void(bus::Bus&)>& action) {
  std::promise<void> done;
  executor_.Post([&] {
    action(other_);
    done.set_value();
  });
  done.get_future().wait();
}

fleet_roster_t TwoVehicles() {
  fleet_roster_t roster{};
  roster.utime = 2'000'000;
  roster.start_utime = 1'000'000;
  roster.session_id = 1;
  roster.scenario = "Two";
  for (const int id : {1, 2}) {
    roster.vehicles.push_back(bus::ToMessage(id, "UAV" + std::to_string(id), VehicleModel{}, true));
  }
  return roster;
}

void SendTwoVehicles(bus::Bus& bus) {
  bus::PublishChunks(bus, bus::channel::kFleetRoster, TwoVehicles());
  fleet_state_t state{};
  state.utime = 2'000'000;
  state.session_id = 1;
  for (const int id : {1, 2}) {
    vehicle_state_t vehicle = bus::ToMessage(VehicleState{.east_m = 100. * id, .speed_m_s = 50});
    vehicle.utime = state.utime;
    vehicle.id = id;
    state.vehicles.push_back(vehicle);
  }
  bus::PublishChunks(bus, bus::channel::kFleetState, state);
}

}  // namespace skein::bridge
