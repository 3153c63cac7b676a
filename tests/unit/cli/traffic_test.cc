#include "cli/traffic.h"

#include <gtest/gtest.h>

#include <skein/event_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_command_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/link_command_t.hpp>
#include <vector>

#include "bus/chunks.h"
#include "cli/any_message.h"
#include "cli/spy.h"
#include "cli/terminal.h"

namespace skein::cli {
namespace {

constexpr bus::Utime kStart = 1'700'000'000'000'000;

template <typename Message>
std::vector<std::uint8_t> Encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

fleet_state_t State(std::int64_t tick, int vehicles = 1) {
  fleet_state_t state;
  state.utime = kStart + tick * 50'000;
  state.session_id = 7;
  state.tick = tick;
  for (int id = 1; id <= vehicles; ++id) state.vehicles.emplace_back().id = id;
  state.num_vehicles = vehicles;
  state.chunk_count = 1;
  return state;
}

class TrafficTest : public testing::Test {
 protected:
  template <typename Message>
  void Hear(bus::Utime now, const std::string& channel, const Message& message) {
    const auto bytes = Encoded(message);
    traffic_.Hear(now, channel, bytes.data(), bytes.size());
  }
  const ChannelTraffic& At(const std::string& channel) const { return traffic_.channels().at(channel); }

  Traffic traffic_{kStart};
};

TEST_F(TrafficTest, TellsRateBandwidthAndSizeOfEachChannel) {
  for (int tick = 0; tick < 40; ++tick) Hear(kStart + tick * 50'000, "FLEET_STATE", State(tick));
  const ChannelTraffic& states = At("FLEET_STATE");
  const std::size_t bytes = Encoded(State(0)).size();
  EXPECT_EQ(states.type, "fleet_state_t");
  EXPECT_EQ(states.count, 40);
  EXPECT_EQ(states.least_bytes, bytes);
  EXPECT_EQ(states.most_bytes, bytes);
  const Traffic::Rate rate = traffic_.RateOf(states, kStart + 2 * bus::kSecond).value();
  EXPECT_DOUBLE_EQ(rate.messages_s, 20);
  EXPECT_DOUBLE_EQ(rate.bytes_s, 20.0 * static_cast<double>(bytes));
  EXPECT_NEAR(states.jitter_s().value(), 0, 1e-12);
  EXPECT_EQ(states.gaps(), 0);
  EXPECT_EQ(states.undecodable, 0);
}

TEST_F(TrafficTest, ForgetsOldRates) {
  for (int tick = 0; tick < 40; ++tick) Hear(kStart + tick * 50'000, "FLEET_STATE", State(tick));
  EXPECT_EQ(traffic_.RateOf(At("FLEET_STATE"), kStart + 60 * bus::kSecond)->messages_s, 0);
}

TEST_F(TrafficTest, MeasuresJitterFromBurstToBurst) {
  bus::Utime now = kStart;
  for (int i = 0; i < 10; ++i) {
    now += i % 2 == 0 ? 40'000 : 60'000;
    // Two chunks, one right behind the other.
    Hear(now, "FLEET_STATE", State(i));
    Hear(now + 100, "FLEET_STATE", State(i));
  }
  EXPECT_NEAR(At("FLEET_STATE").jitter_s().value(), 0.0105, 0.0005);
}

TEST_F(TrafficTest, CountsWhatNeverCame) {
  for (const int tick : {1, 2, 5, 6}) Hear(kStart + tick, "FLEET_STATE", State(tick));
  EXPECT_EQ(At("FLEET_STATE").gaps(), 2);
  auto chunks = bus::Split(State(7, 200));
  ASSERT_GE(chunks.size(), 2U);
  chunks.erase(chunks.begin());
  for (const auto& chunk : chunks) Hear(kStart + 7, "FLEET_STATE", chunk);
  Hear(kStart + 8, "FLEET_STATE", State(8));
  EXPECT_EQ(At("FLEET_STATE").gaps(), 3);

  event_t event;
  event.code = "test";
  for (const auto& [node, sequence] : std::vector<std::pair<std::string, int>>{
           {"a", 1}, {"b", 9}, {"a", 2}, {"b", 12}, {"a", 1}, {"a", 2}}) {
    event.event_node = node;
    event.event_sequence = sequence;
    Hear(kStart, "EVENT", event);
  }
  EXPECT_EQ(At("EVENT").gaps(), 2);
  // Nothing in these numbers them.
  Hear(kStart, "CMD_LINK", link_command_t{});
  EXPECT_EQ(At("CMD_LINK").gaps(), std::nullopt);
}

TEST_F(TrafficTest, TellsWhatIsNotSkeinsAndWhatCannotBeRead) {
  const std::vector<std::uint8_t> stranger = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  traffic_.Hear(kStart, "POSE", stranger.data(), stranger.size());
  EXPECT_EQ(At("POSE").type, "");
  EXPECT_EQ(At("POSE").fingerprint, 0x0102030405060708);
  EXPECT_EQ(At("POSE").undecodable, 0);
  auto bytes = Encoded(State(1));
  traffic_.Hear(kStart, "FLEET_STATE", bytes.data(), bytes.size() - 1);
  auto wrong = State(2);
  wrong.chunk_count = 0;
  Hear(kStart, "FLEET_STATE", wrong);
  traffic_.Hear(kStart, "FLEET_STATE", nullptr, 0);
  EXPECT_EQ(At("FLEET_STATE").undecodable, 3);
  const std::string table = TrafficTable(traffic_, kStart + bus::kSecond, 0);
  EXPECT_NE(table.find("unknown 0102030405060708"), std::string::npos) << table;
  const auto json = TrafficJson(traffic_, kStart + bus::kSecond);
  EXPECT_EQ(json["channels"][0]["undecodable"], 3);
  EXPECT_TRUE(json["channels"][1]["type"].is_null());
}

TEST_F(TrafficTest, ShowsNoNameThatATerminalObeys) {
  Hear(kStart, "\x1b]0;title\x07POSE", State(0));
  const std::string table = TrafficTable(traffic_, kStart + bus::kSecond, 0);
  EXPECT_NE(table.find("?]0;title?POSE"), std::string::npos) << table;
  EXPECT_EQ(table.find('\x1b'), std::string::npos);
}

TEST_F(TrafficTest, OnlyCountsWhatComesOnInventedChannelsWithoutEnd) {
  for (int i = 0; i < 3'000; ++i) Hear(kStart, "CHANNEL_" + std::to_string(i), State(0));
  Hear(kStart, "CHANNEL_0", State(1));
  EXPECT_EQ(traffic_.channels().size(), Traffic::kMostChannels);
  EXPECT_EQ(traffic_.beyond(), 2'000);
  EXPECT_EQ(At("CHANNEL_0").count, 2) << "a known one is followed as before";
  const std::string table = TrafficTable(traffic_, kStart + bus::kSecond, 0);
  EXPECT_NE(table.find("(further channels)"), std::string::npos);
  EXPECT_NE(table.find("3001"), std::string::npos) << "the sum counts all";
  EXPECT_EQ(TrafficJson(traffic_, kStart)["messages_on_further_channels"], 2'000);
}

TEST_F(TrafficTest, LeavesColumnsOutWhereTheTerminalIsNarrow) {
  Hear(kStart, "FLEET_STATE", State(1));
  const std::string wide = TrafficTable(traffic_, kStart + bus::kSecond, 0);
  EXPECT_NE(wide.find("TYPE"), std::string::npos);
  const std::string narrow = TrafficTable(traffic_, kStart + bus::kSecond, 30);
  EXPECT_EQ(narrow.find("TYPE"), std::string::npos);
  EXPECT_NE(narrow.find("CHANNEL"), std::string::npos);
  EXPECT_LE(narrow.find('\n'), 30U);
  // Never less than the name and how often.
  EXPECT_NE(TrafficTable(traffic_, kStart + bus::kSecond, 3).find("HZ"), std::string::npos);
}

TEST(AnyMessage, HasTheFieldsOfItsFileInTheirOrder) {
  fleet_state_t state = State(3, 2);
  state.vehicles[1].up_m = 500.5;
  state.vehicles[1].payload_on = 1;
  const auto bytes = Encoded(state);
  const auto fields = ReadFields(bytes.data(), bytes.size());
  ASSERT_TRUE(fields);
  EXPECT_EQ(fields->begin().key(), "utime");
  EXPECT_EQ((*fields)["tick"], 3);
  EXPECT_FALSE(fields->contains("num_vehicles"));
  ASSERT_EQ((*fields)["vehicles"].size(), 2U);
  EXPECT_EQ((*fields)["vehicles"][1]["up_m"], 500.5);
  EXPECT_EQ((*fields)["vehicles"][1]["payload_on"], true);
  EXPECT_FALSE(ReadFields(bytes.data(), bytes.size() - 1));
  EXPECT_FALSE(ReadFields(bytes.data(), 3));
}

TEST(MessageText, ShowsListsAsTablesOrFieldByFieldWhereTheyAreTooWide) {
  const auto bytes = Encoded(State(3, 2));
  const auto fields = ReadFields(bytes.data(), bytes.size()).value();
  const std::string wide = MessageText(fields, 0);
  EXPECT_NE(wide.find("(2023-11-14 22:13:20.150 UTC)"), std::string::npos) << wide;
  EXPECT_NE(wide.find("vehicles[2]\n"), std::string::npos) << wide;
  EXPECT_EQ(wide.find("vehicles[1]\n"), std::string::npos) << wide;
  const std::string narrow = MessageText(fields, 60);
  EXPECT_NE(narrow.find("vehicles[0]\n"), std::string::npos) << narrow;
  EXPECT_NE(narrow.find("vehicles[1]\n"), std::string::npos) << narrow;
}

TEST(MessageText, ShowsNoTextThatATerminalObeys) {
  EXPECT_EQ(MessageText({{"name", "a\xC2\x9B"}, {"texts", {"\x1b[2J"}}}, 0), "name  a??\ntexts[1] ?[2J\n");
}

TEST(MessageText, NestsMessagesInMessages) {
  formation_command_t command;
  command.formation.name = "Alpha";
  command.formation.slots.resize(1);
  command.formation.num_slots = 1;
  const auto bytes = Encoded(command);
  const std::string text = MessageText(ReadFields(bytes.data(), bytes.size()).value(), 0);
  EXPECT_NE(text.find("formation\n  utime"), std::string::npos) << text;
  EXPECT_NE(text.find("  slots[1]\n"), std::string::npos) << text;
}

TEST(AnyMessage, IsNoneWhenAValueBreaksARuleOfItsFile) {
  const auto bytes = Encoded(formation_t{});  // without a control
  EXPECT_EQ(TypeName(Fingerprint(bytes.data(), bytes.size())), "formation_t");
  EXPECT_FALSE(ReadFields(bytes.data(), bytes.size()));
}

TEST(Terminal, CutsWhatDoesNotFit) {
  EXPECT_EQ(Fitted("one\ntwo\n", {}), "one\ntwo\n");
  EXPECT_EQ(Fitted("abcdef\n", {3, 10}), "abc\n");
  EXPECT_EQ(Fitted("\xc3\xa4\xc3\xb6\xc3\xbc\n", {2, 10}), "\xc3\xa4\xc3\xb6\n");
  EXPECT_EQ(Fitted("1\n2\n3\n4\n5\n6\n", {10, 4}), "1\n2\n... and 4 lines more\n");
}

}  // namespace
}  // namespace skein::cli
