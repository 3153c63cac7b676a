#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <random>

#include "bridge_under_test.h"
#include "bus/channels.h"
#include "bus/command_inbox.h"
#include "frame_reader.h"
#include "live_client.h"

namespace skein::bridge {
namespace {

using nlohmann::json;

constexpr const char* kCut =
    R"({"type":"command","id":"c1","channel":"CMD_LINK","body":{"vehicle_id":1,"mode":"silent"}})";

constexpr int kLittleBuffer = 64 * 1024;

/// So many letters that nothing can pack.
std::string Noise(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::string text(size, 'x');
  for (char& letter : text) letter = static_cast<char>(']' + random() % 34);
  return text;
}

event_t Event(const std::string& text) {
  event_t event{};
  event.event_node = "fleet-simulator";
  event.code = "test";
  event.text = text;
  return event;
}

TEST(Live, GreetsABrowserAndThenStreams) {
  BridgeUnderTest bridge;
  LiveClient browser(bridge.port());
  const auto hello = browser.Read();
  ASSERT_TRUE(hello);
  EXPECT_EQ(json::parse(hello->bytes)["type"], "hello");
  EXPECT_TRUE(json::parse(hello->bytes)["tile_url"].is_null());
  bridge.OnBus(SendTwoVehicles);
  EXPECT_EQ(browser.ReadText("roster")["vehicles"].size(), 2u);
  FrameReader motion(browser.ReadBinary(1));
  EXPECT_EQ(motion.count, 2u);
  EXPECT_DOUBLE_EQ(motion.t_s, 1);
  EXPECT_EQ(motion.Ints(), (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(motion.Floats(), (std::vector<float>{100, 200}));
  EXPECT_EQ(FrameReader(browser.ReadBinary(2)).count, 2u);
}

TEST(Live, GivesALateComerTheLastOfEachBeforeAnythingNew) {
  BridgeUnderTest bridge;
  {
    LiveClient first(bridge.port());
    bridge.OnBus(SendTwoVehicles);
    EXPECT_FALSE(first.ReadText("roster").is_null());
  }
  for (int round = 0; round < 3; ++round) {
    LiveClient browser(bridge.port());
    EXPECT_EQ(json::parse(browser.Read().value().bytes)["type"], "hello");
    EXPECT_EQ(json::parse(browser.Read().value().bytes)["type"], "bus");
    EXPECT_EQ(json::parse(browser.Read().value().bytes)["type"], "roster");
    EXPECT_TRUE(browser.Read().value().binary);
  }
}

TEST(Live, TellsTwoBrowsersTheSame) {
  BridgeUnderTest bridge;
  LiveClient one(bridge.port());
  LiveClient two(bridge.port());
  EXPECT_FALSE(one.ReadText("bus").is_null());
  EXPECT_FALSE(two.ReadText("bus").is_null());
  bridge.OnBus([](bus::Bus& other) { other.Publish(bus::channel::kEvent, Event("Achtung \xc3\xbc")); });
  EXPECT_EQ(one.ReadText("event")["text"], "Achtung \xc3\xbc");
  EXPECT_EQ(two.ReadText("event")["code"], "test");
}

TEST(Live, AnswersCommandsWithTheirId) {
  BridgeUnderTest bridge;
  std::unique_ptr<bus::CommandInbox> inbox;
  bridge.OnBus([&](bus::Bus& other) {
    inbox = std::make_unique<bus::CommandInbox>(other);
    inbox->Obey<link_command_t>(bus::channel::kCmdLink, [](const link_command_t& command) {
      return command.vehicle_id == 1 ? bus::Answer::Accepted("cut")
                                     : bus::Answer::Refused("there is no UAV 9");
    });
  });
  LiveClient browser(bridge.port(), "http://127.0.0.1:" + std::to_string(bridge.port()));
  browser.Send(kCut);
  EXPECT_EQ(
      browser.ReadText("ack"),
      (json{{"type", "ack"}, {"id", "c1"}, {"channel", "CMD_LINK"}, {"accepted", true}, {"reason", "cut"}}));
  browser.Send(R"({"type":"command","id":2,"channel":"CMD_LINK","body":{"vehicle_id":9,"mode":"up"}})");
  const json refused = browser.ReadText("ack");
  EXPECT_EQ(refused["id"], 2);
  EXPECT_EQ(refused["accepted"], false);
  EXPECT_EQ(refused["reason"], "there is no UAV 9");
}

TEST(Live, GivesControlToNobodyInAReplay) {
  BridgeOptions options;
  options.hello.replay = {{"kind", "player"}, {"name", "triangle"}};
  BridgeUnderTest bridge(options);
  LiveClient browser(bridge.port());
  EXPECT_EQ(browser.ReadText("hello")["replay"]["name"], "triangle");
  browser.Send(R"({"type":"control","id":"j","action":"join","name":"Ada"})");
  EXPECT_EQ(browser.ReadText("ack")["accepted"], true);
  browser.Send(R"({"type":"control","id":"t","action":"take"})");
  const json taken = browser.ReadText("ack");
  EXPECT_EQ(taken["accepted"], false);
  EXPECT_EQ(taken["reason"], "this is a replay: nothing can be commanded");
  browser.Send(kCut);
  const json refused = browser.ReadText("ack");
  EXPECT_EQ(refused["accepted"], false);
  EXPECT_EQ(refused["reason"], "this is a replay: nothing can be commanded");
}

TEST(Live, SaysWhenNobodyAnswersACommand) {
  BridgeUnderTest bridge;
  LiveClient browser(bridge.port());
  browser.Send(kCut);
  const json ack = browser.ReadText("ack");
  EXPECT_EQ(ack["accepted"], false);
  EXPECT_EQ(ack["reason"], "nobody answered CMD_LINK within 2 s: is fleet-simulator running?");
}

TEST(Live, SaysWhatIsWrongWithAMessage) {
  BridgeUnderTest bridge;
  LiveClient browser(bridge.port());
  const auto reason = [&](const std::string& text) {
    browser.Send(text);
    const json ack = browser.ReadText("ack");
    EXPECT_EQ(ack["accepted"], false) << text;
    return ack["reason"].get<std::string>();
  };
  EXPECT_NE(reason("not json").find("no JSON"), std::string::npos);
  EXPECT_NE(reason("[1]").find("no JSON object"), std::string::npos);
  EXPECT_NE(reason(R"({"type":"hello"})").find("of type command"), std::string::npos);
  EXPECT_NE(reason(R"({"type":"command","channel":"CMD_LINK","body":{}})").find("id:"), std::string::npos);
  EXPECT_NE(reason(R"({"type":"command","id":"a","body":{}})").find("channel:"), std::string::npos);
  EXPECT_NE(reason(R"({"type":"command","id":"a","channel":"CMD_LINK"})").find("body:"), std::string::npos);
  EXPECT_NE(reason(R"({"type":"command","id":"a","channel":"CMD_LINK","body":{},"x":1})").find("only"),
            std::string::npos);
  EXPECT_NE(reason(R"({"type":"command","id":"a","channel":"CMD_LINK","body":[]})").find("must be an object"),
            std::string::npos);
  EXPECT_NE(reason(std::string(100'000, '[')).find("no JSON"), std::string::npos);
}

// Whole JSON, so that it is looked at: nlohmann's copies recurse.
TEST(Live, RefusesWhatIsNestedTooDeep) {
  BridgeUnderTest bridge;
  LiveClient browser(bridge.port());
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  for (const std::size_t levels : {std::size_t{100}, std::size_t{400'000}}) {
    browser.Send(R"({"type":"command","id":)" + nested(levels) + "}");
    EXPECT_NE(browser.ReadText("ack")["reason"].get<std::string>().find("no JSON"), std::string::npos);
  }
  browser.Send(R"({"type":"command","id":"a","channel":"CMD_LINK","body":)" + nested(20) + "}");
  EXPECT_NE(browser.ReadText("ack")["reason"].get<std::string>().find("must be an object"),
            std::string::npos);
}

TEST(Live, LetsABrowserHaveOnlySoManyCommandsWaiting) {
  BridgeUnderTest bridge;
  LiveClient browser(bridge.port());
  for (int i = 0; i <= LiveHub::kMaxWaitingCommands; ++i) browser.Send(kCut);
  EXPECT_NE(browser.ReadText("ack")["reason"].get<std::string>().find("too many"), std::string::npos);
}

TEST(Live, LetsOneBrowserCommandAtATimeAndTellsAllWho) {
  BridgeUnderTest bridge;
  LiveClient ada(bridge.port());
  LiveClient bob(bridge.port());
  const auto ask = [](LiveClient& browser, const std::string& rest) {
    browser.Send(R"({"type":"control","id":"k",)" + rest + "}");
    return browser.ReadText("ack");
  };
  EXPECT_EQ(ask(ada, R"("action":"release")")["reason"], "control: /action: join comes first");
  EXPECT_EQ(ask(ada, R"("action":"join","name":"Ada","page":"a")")["accepted"], true);
  // Before anything else is read of Bob's, for that would skip it.
  const json seen = bob.ReadText("event");
  EXPECT_EQ(seen["code"], "control_taken");
  EXPECT_EQ(seen["text"], "Ada has taken control");
  EXPECT_EQ(ask(bob, R"("action":"join","name":"Bob","page":"b")")["accepted"], true);
  bob.Send(kCut);
  EXPECT_EQ(bob.ReadText("ack")["reason"], "Ada holds control");

  json control;
  while (control.is_null() || control["people"].size() != 2) control = ada.ReadText("control");
  EXPECT_EQ(control["holder"], control["you"]);
  const int bobs_number = control["people"][1]["id"];
  EXPECT_EQ(ask(ada, R"("action":"give","person":)" + std::to_string(bobs_number))["accepted"], true);
  bob.Send(kCut);
  EXPECT_EQ(bob.ReadText("ack")["reason"],
            "nobody answered CMD_LINK within 2 s: is fleet-simulator running?");
  EXPECT_EQ(ask(bob, R"("action":"dance")")["reason"],
            "control: /action: must be join, ask, give, refuse, release, rename, take or withdraw");
  EXPECT_EQ(ask(bob, R"("action":"rename","name":"\u0007")")["accepted"], false);
}

TEST(Live, RefusesForeignPagesAndOtherPaths) {
  BridgeUnderTest bridge;
  EXPECT_THROW(LiveClient(bridge.port(), "http://evil.example"), std::runtime_error);
  EXPECT_THROW(LiveClient(bridge.port(), "null"), std::runtime_error);
  EXPECT_THROW(LiveClient(bridge.port(), "", "/api/state"), std::runtime_error);
}

TEST(Live, EndsTheConnectionOfABrowserThatBreaksTheRules) {
  BridgeUnderTest bridge;
  LiveClient binary(bridge.port());
  binary.Send("bytes", true);
  EXPECT_TRUE(binary.ReadText("never").is_null());
  LiveClient unmasked(bridge.port());
  unmasked.SendRaw("\x81\x05hello");  // frames from a browser must be masked
  EXPECT_TRUE(unmasked.ReadText("never").is_null());
  LiveClient huge(bridge.port());
  huge.SendRaw(
      std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14));  // 2^63 - 1 bytes to come
  EXPECT_TRUE(huge.ReadText("never").is_null());
  LiveClient good(bridge.port());
  EXPECT_FALSE(good.ReadText("hello").is_null());
}

TEST(Live, ASlowBrowserDoesNotDelayAFastOneAndSkipsToTheNewest) {
  BridgeUnderTest bridge;
  LiveClient slow(bridge.port(), "", "/live", kLittleBuffer);
  LiveClient fast(bridge.port());
  EXPECT_FALSE(slow.ReadText("bus").is_null());
  EXPECT_FALSE(fast.ReadText("bus").is_null());
  // 150 kB at a time even when packed, far more in all than the kernel keeps for a browser that does not
  // read.
  constexpr int kRounds = 12;
  std::mt19937 random(1);
  for (int round = 1; round <= kRounds; ++round) {
    bridge.OnBus([&](bus::Bus& other) {
      formation_t formation{};
      formation.utime = round;
      formation.formation_id = 1;
      formation.control = "skein";
      formation.shape = "custom";
      formation.radius_m = 150;
      formation.height_m = 50;
      formation.d_mod_m = 150;
      formation.advisory_tau_s = 30;
      formation.caution_tau_s = 15;
      formation.spacing_m = round;
      slot_t slot{};
      slot.vehicle_id = 1;
      formation.slots.assign(4'000, slot);
      for (slot_t& one : formation.slots) {
        one.vehicle_id = static_cast<int>(&one - formation.slots.data()) + 1;
        one.forward_m = 1e-3 * static_cast<double>(random());
        one.left_m = 1e-3 * static_cast<double>(random());
        one.up_m = 1e-3 * static_cast<double>(random());
      }
      formation.num_slots = 4'000;
      other.Publish(bus::channel::kFormation, formation);
    });
    ASSERT_EQ(fast.ReadText("formation")["spacing_m"], round);
  }
  int seen = 0;
  double last = 0;
  while (last < kRounds) {
    const json formation = slow.ReadText("formation");
    ASSERT_FALSE(formation.is_null());
    EXPECT_GT(formation["spacing_m"].get<double>(), last);
    last = formation["spacing_m"];
    ++seen;
  }
  EXPECT_LT(seen, kRounds);
}

TEST(Live, CutsOffABrowserThatLetsTooMuchWait) {
  BridgeUnderTest bridge;
  LiveClient stuck(bridge.port(), "", "/live", kLittleBuffer);
  LiveClient fast(bridge.port());
  EXPECT_FALSE(stuck.ReadText("bus").is_null());
  EXPECT_FALSE(fast.ReadText("bus").is_null());
  // Events must not be lost: 8 MB of them, even when packed, are more than is kept for anybody.
  for (int i = 0; i < 30; ++i) {
    bridge.OnBus([i](bus::Bus& other) {
      for (int j = 0; j < 100; ++j) other.Publish(bus::channel::kEvent, Event(Noise(4000, 100 * i + j)));
    });
    for (int j = 0; j < 100; ++j) ASSERT_FALSE(fast.ReadText("event").is_null());
  }
  int events = 0;
  while (!stuck.ReadText("event").is_null()) ++events;
  EXPECT_LT(events, 3000);
}

}  // namespace
}  // namespace skein::bridge
