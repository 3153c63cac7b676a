// Every message on the WebSocket, as everybody.

#include "access_fixture.h"

namespace skein::bridge {
namespace {

using nlohmann::json;

class AccessMessages : public AccessTest {
 protected:
  AccessMessages() { Start(); }

  static std::string Control(const std::string& action, int person = 0) {
    json message{{"type", "control"}, {"id", "c"}, {"action", action}};
    if (person != 0) message["person"] = person;
    if (action == "rename") message["name"] = "X";
    return message.dump();
  }
  static std::string Command(const std::string& channel, const std::string& body) {
    return R"({"type":"command","id":"c",)" + CommandJson(channel, body).substr(1);
  }
};

TEST_F(AccessMessages, TheDoorIsShutForWhoShowsNoTokenOrAWrongOne) {
  EXPECT_EQ(Upgrade("/live", "").status, 401);
  EXPECT_EQ(Upgrade("/live", Bearer("skein_wrong")).status, 401);
  EXPECT_EQ(Upgrade("/live", Cookie("skein_wrong")).status, 401);
  EXPECT_EQ(Upgrade("/live", TakeControl()).status, 401);
  for (const std::string& token : {viewer_, other_, holder_}) {
    EXPECT_EQ(Upgrade("/live", Bearer(token)).status, 101);
    EXPECT_EQ(Upgrade("/live", Cookie(token)).status, 101);
  }
}

TEST_F(AccessMessages, EveryMessageIsAnsweredAsEachMay) {
  TakeControl();
  const auto viewer = Live(viewer_);
  const auto other = Live(other_);
  for (LiveClient* one : {viewer.get(), other.get()}) EXPECT_EQ(Ask(*one, Control("join"))["accepted"], true);
  constexpr int kHilde = 1, kVera = 2, kOtto = 3;  // as they have come

  struct MessageRow {
    std::string message;
    bool viewer, other, holder;
  };
  std::vector<MessageRow> rows{
      {Control("take"), false, false, true},
      {Control("give", kHilde), false, false, false},
      {Control("give", kVera), false, false, false},
      {Control("refuse", kOtto), false, false, false},
      {Control("rename"), true, true, true},
      {R"({"type":"playback","id":"p","action":"play"})", false, false, false},
      {Command("CMD_FLEET", "{}"), false, false, false},
      {Command("CMD_NONE", "{}"), false, false, false},
  };
  for (const auto& [channel, body] : kCommands) rows.push_back({Command(channel, body), false, false, true});
  const std::string cut = Command("CMD_LINK", kCommands[0].second);
  rows.insert(rows.end(), {
                              {Control("ask"), false, true, true},
                              {Control("refuse", kOtto), false, false, true},
                              {Control("ask"), false, true, true},
                              {Control("withdraw"), true, true, true},
                              {Control("release"), false, false, true},
                              // Now it is free: the viewer is the first to try.
                              {Control("ask"), false, true, true},
                              {cut, false, true, false},
                              {Control("take"), false, true, false},
                              {Control("give", kVera), false, false, false},
                              {Control("give", kHilde), false, true, false},
                              {cut, false, false, true},
                          });
  std::set<std::string> types, actions{"join"};
  for (const MessageRow& row : rows) {
    EXPECT_EQ(Ask(*viewer, row.message)["accepted"], row.viewer) << row.message << " by a viewer";
    EXPECT_EQ(Ask(*other, row.message)["accepted"], row.other) << row.message << " by another operator";
    EXPECT_EQ(Ask(*page_, row.message)["accepted"], row.holder) << row.message << " by who holds control";
    const json message = json::parse(row.message);
    if (message["type"] != "playback") types.insert(message["type"]);
    if (message["type"] == "control") actions.insert(message["action"]);
  }
  bridge_->OnBus([this](bus::Bus&) {
    for (const auto& [channel, body] : kCommands)
      EXPECT_EQ(heard_[channel], channel == "CMD_LINK" ? 3 : 1) << channel;
    EXPECT_EQ(heard_.size(), kCommands.size());
  });

  // Nothing is left out of what the bridge says that it has.
  const auto refusal = [&](const std::string& message) {
    return Ask(*page_, message)["reason"].get<std::string>();
  };
  EXPECT_EQ(NamedIn(refusal(R"({"type":"x","id":"x"})"), "of type "), types);
  EXPECT_EQ(NamedIn(refusal(Control("x")), "/action: must be "), actions);
  EXPECT_EQ(NamedIn(refusal(Command("CMD_NONE", "{}")), "channel: must be "), ChannelsOfCommands());
}

TEST_F(AccessMessages, AViewerNeverHoldsControlThoughNobodyElseDoes) {
  for (const bool introduces_itself : {true, false}) {
    const auto viewer = Live(viewer_);
    if (introduces_itself) {
      EXPECT_EQ(Ask(*viewer,
                    R"({"type":"control","id":"j","action":"join","name":"Hilde","take":true})")["accepted"],
                true);
      for (const char* action : {"take", "ask"})
        EXPECT_EQ(Ask(*viewer, Control(action))["reason"], "this session may only look") << action;
    }
    for (const auto& [channel, body] : kCommands)
      EXPECT_EQ(Ask(*viewer, Command(channel, body))["reason"], "nobody holds control: take it first");
  }
  bridge_->OnBus([this](bus::Bus&) { EXPECT_TRUE(heard_.empty()); });
}

}  // namespace
}  // namespace skein::bridge
