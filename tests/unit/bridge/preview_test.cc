#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "../experiment/captured_flight.h"
#include "bridge/previewer.h"
#include "bridge_under_test.h"
#include "bus/conversions.h"
#include "raw_client.h"

namespace skein::bridge {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

/// A bridge that has heard some seconds of a flight.
class PreviewTest : public testing::Test {
 protected:
  void Hear(const std::string& scenario, double t_s) {
    flight_.emplace(scenario);
    flight_->FlyUntil(t_s);
    bridge_->OnBus([&](bus::Bus& bus) {
      bus::PublishChunks(bus, bus::channel::kFleetRoster, flight_->roster);
      fleet_state_t state{};
      state.utime = flight_->tick->utime;
      state.session_id = 1;
      for (const auto& vehicle : flight_->tick->vehicles) {
        vehicle_state_t heard = bus::ToMessage(vehicle.truth);
        heard.id = vehicle.id;
        heard.utime = state.utime;
        state.vehicles.push_back(heard);
      }
      bus::PublishChunks(bus, bus::channel::kFleetState, state);
      for (const auto& [id, formation] : flight_->flights) {
        bus.Publish(bus::channel::kFormation, formation.formation);
        bus.Publish(bus::channel::kPath, formation.path);
        bus::PublishChunks(bus, bus::channel::kFormationStatus, formation.status);
      }
    });
    // The bridge has them when what comes behind them has been handled, too.
    bridge_->OnBus([](bus::Bus&) {});
    while (RawClient(bridge_->port()).Get("/api/state").value().body.find("\"paths\":[]") !=
           std::string::npos) {
    }
  }

  json Formation(int id) const {
    const formation_t& formation = flight_->flights.at(id).formation;
    json slots = json::array();
    for (const slot_t& slot : formation.slots) {
      slots.push_back({{"vehicle_id", slot.vehicle_id},
                       {"forward_m", slot.forward_m},
                       {"left_m", slot.left_m},
                       {"up_m", slot.up_m}});
    }
    return {{"formation_id", id}, {"shape", "custom"}, {"slots", slots}};
  }

  static json Path(int id) {
    json waypoints = json::array();
    for (const auto& [east_m, north_m] : {std::pair(0, 30000), {30000, 30000}, {30000, 0}, {60000, 0}}) {
      waypoints.push_back({{"east_m", east_m}, {"north_m", north_m}, {"up_m", 1000}, {"speed_m_s", 50}});
    }
    return {{"formation_id", id}, {"waypoints", waypoints}};
  }

  json Ask(const std::string& what, const json& body) const {
    RawClient client(bridge_->port());
    const auto response = client.Post("/api/preview/" + what, body.dump());
    json answer = json::parse(response.value().body);
    answer["status"] = response->status;
    return answer;
  }

  std::unique_ptr<BridgeUnderTest> bridge_ = std::make_unique<BridgeUnderTest>();
  std::optional<experiment::CapturedFlight> flight_;
};

TEST_F(PreviewTest, TellsWhatAnEditWouldDo) {
  Hear("triangle.json", 80);
  json formation = Formation(1);
  std::swap(formation["slots"][1]["vehicle_id"], formation["slots"][2]["vehicle_id"]);
  const json answer = Ask("formation", {{"formation", formation}});
  EXPECT_EQ(answer["status"], 200);
  EXPECT_EQ(answer["ok"], true) << answer["reason"];
  EXPECT_EQ(answer["complete"], true);
  EXPECT_EQ(answer["utime"], flight_->tick->utime);
  EXPECT_EQ(answer["least"]["ids"], json({2, 3}));
  EXPECT_EQ(answer["least"]["inside_cylinder"], true);
  EXPECT_EQ(answer["nearest"].size(), 3u);
  EXPECT_GT(answer["settle_s"], 10);
  EXPECT_FALSE(answer["limits"].empty());
  ASSERT_EQ(answer["tracks"].size(), 3u);
  EXPECT_EQ(answer["tracks"][0]["points"][0].size(), 4u);
}

TEST_F(PreviewTest, TellsHowAPathWouldBeFlownOrJustItsGeometry) {
  Hear("triangle.json", 80);
  json path = Path(1);
  const json flown = Ask("path", path);
  EXPECT_EQ(flown["ok"], true) << flown["reason"];
  EXPECT_GT(flown["duration_s"], 50);
  EXPECT_EQ(flown["legs"].size(), 4u);
  EXPECT_EQ(flown["legs"][0]["from"], nullptr);
  EXPECT_EQ(flown["legs"][1]["from"], 0);
  EXPECT_EQ(flown["problems"], json::array());
  path["geometry_only"] = true;
  const json geometry = Ask("path", path);
  EXPECT_EQ(geometry["line"], flown["line"]);
  EXPECT_EQ(geometry["legs"], flown["legs"]);
  EXPECT_FALSE(geometry.contains("tracks"));
  path["waypoints"][2]["speed_m_s"] = 200;
  path["waypoints"][3]["turn_radius_m"] = 10;
  const json refused = Ask("path", path);
  EXPECT_EQ(refused["status"], 200);
  EXPECT_EQ(refused["ok"], false);
  ASSERT_EQ(refused["problems"].size(), 1u);
  EXPECT_EQ(refused["problems"][0]["waypoint_index"], 2);
  EXPECT_EQ(refused["line"], json::array());
}

TEST_F(PreviewTest, PublishesNothing) {
  Hear("triangle.json", 80);
  int messages = 0;
  const auto count = [](const lcm::ReceiveBuffer*, const std::string& channel, int* counter) {
    if (channel != bus::channel::kHeartbeat) ++*counter;
  };
  lcm::Subscription* subscription = nullptr;
  bridge_->OnBus(
      [&](bus::Bus& other) { subscription = other.transport().subscribeFunction(".*", +count, &messages); });
  EXPECT_EQ(Ask("formation", {{"formation", Formation(1)}})["ok"], true);
  EXPECT_EQ(Ask("path", Path(1))["ok"], true);
  bridge_->OnBus([&](bus::Bus& other) { other.transport().unsubscribe(subscription); });
  EXPECT_EQ(messages, 0);
}

TEST_F(PreviewTest, RefusesWhatIsNotRightByName) {
  Hear("triangle.json", 1);
  const auto reason = [this](const std::string& what, const json& body) {
    const json answer = Ask(what, body);
    EXPECT_EQ(answer["status"], 400);
    EXPECT_EQ(answer["ok"], false);
    return answer["reason"].get<std::string>();
  };
  EXPECT_EQ(reason("formation", json::array()), "the request is no JSON object");
  EXPECT_NE(reason("formation", json::object()).find("formation"), std::string::npos);
  EXPECT_NE(reason("formation", {{"formation", {{"formation_id", 1}}}}).find("has no slots"),
            std::string::npos);
  json formation = Formation(1);
  formation["slots"][2]["left_m"] = "far";
  EXPECT_NE(reason("formation", {{"formation", formation}}).find("/formation/slots/2/left_m"),
            std::string::npos);
  json path = Path(1);
  path["waypoints"][1].erase("up_m");
  EXPECT_NE(reason("path", path).find("/waypoints/1"), std::string::npos);
  path = Path(1);
  path["geometry_only"] = 1;
  EXPECT_NE(reason("path", path).find("geometry_only"), std::string::npos);
  RawClient client(bridge_->port());
  EXPECT_EQ(client.Get("/api/preview/path").value().status, 405);
  EXPECT_EQ(RawClient(bridge_->port())
                .Post("/api/preview/path", "{", "Origin: http://evil.example\r\n")
                .value()
                .status,
            403);
}

TEST_F(PreviewTest, SaysThatThereIsNoFleetYet) {
  const json answer = Ask("path", Path(1));
  EXPECT_EQ(answer["ok"], false);
  EXPECT_NE(answer["reason"].get<std::string>().find("no fleet is known yet"), std::string::npos);
}

/// A hundred UAVs over 90 km take longer to fly than anybody waits.
class LongPreviewTest : public PreviewTest {
 protected:
  LongPreviewTest() { Hear("hundred.json", 1); }

  std::unique_ptr<RawClient> SendLong() {
    auto client = std::make_unique<RawClient>(bridge_->port());
    const std::string body = Path(1).dump();
    client->Send("POST /api/preview/path HTTP/1.1\r\nHost: localhost\r\nContent-Length: " +
                 std::to_string(body.size()) + "\r\n\r\n" + body);
    return client;
  }
};

TEST_F(LongPreviewTest, AnswersOthersMeanwhileAndEndsAtOnceWithTheBridge) {
  const auto flying = SendLong();
  EXPECT_EQ(RawClient(bridge_->port()).Get("/api/vehicles").value().status, 200);
  json geometry = Path(2);
  geometry["geometry_only"] = true;
  EXPECT_EQ(Ask("path", geometry)["ok"], true);
  const auto start = Clock::now();
  bridge_.reset();
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(2));
  EXPECT_FALSE(flying->Receive());
}

TEST_F(LongPreviewTest, TurnsAwayWhomItCannotServeAndGivesUpForThoseWhoHaveGone) {
  std::vector<std::unique_ptr<RawClient>> clients;
  for (std::size_t i = 0; i < Previewer::kMostWaiting + 1; ++i) {
    clients.push_back(SendLong());
    // One flies, the others wait; each is in its place before the next one asks.
    RawClient(bridge_->port()).Get("/api/vehicles");
  }
  const json busy = Ask("path", Path(1));
  EXPECT_EQ(busy["status"], 503);
  EXPECT_EQ(busy["ok"], false);
  const auto start = Clock::now();
  clients.clear();
  json short_one = {{"formation", Formation(1)}};
  while (Ask("formation", short_one)["status"] == 503 && Clock::now() - start < std::chrono::seconds(20)) {
  }
  // Four flights to their end would take four times five seconds.
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(10));
}

}  // namespace
}  // namespace skein::bridge
