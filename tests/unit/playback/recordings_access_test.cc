// Every request and message about a recording, as everybody.

#include <chrono>
#include <filesystem>
#include <thread>

#include "bridge/access_fixture.h"
#include "playback/recorded_flights.h"
#include "playback/recordings.h"

namespace skein::playback {
namespace {

namespace fs = std::filesystem;
using bridge::LiveClient;
using nlohmann::json;
using namespace std::chrono_literals;

class RecordingsAccess : public bridge::AccessTest {
 protected:
  RecordingsAccess() {
    fs::copy_file(LinkDropLog(), file_);
    // Nobody has written to it for long.
    fs::last_write_time(file_, fs::file_time_type::clock::now() - 1h);
  }
  void Serve(bool live_bus) {
    bridge::BridgeOptions options;
    options.make_recordings = [this, live_bus] {
      return std::make_shared<const bridge::Recordings>(
          MakeRecordings(std::make_shared<RecordingLibrary>(logs_.path()), {}, live_bus));
    };
    if (!live_bus) options.hello.replay = {{"kind", "log"}, {"name", ""}};
    Start(options);
  }
  /// Until it has been indexed, 60 s at most.
  void WaitForIndex() const {
    for (int i = 0; i < 600; ++i) {
      const int status = Status("GET", kTarget, "", Bearer(viewer_));
      if (status == 200) return;
      ASSERT_EQ(status, 202);
      std::this_thread::sleep_for(100ms);
    }
    FAIL() << "it is never indexed";
  }

  const std::string kName = "link-drop-20261125-120000.lcm";
  const std::string kTarget = "/api/recordings/" + kName;
  const std::string kLive = "/live?recording=" + kName;
  FreshFolder logs_;
  fs::path file_ = logs_.path() / kName;
};

TEST_F(RecordingsAccess, EveryRequestIsAnsweredAsEachMay) {
  Serve(true);
  WaitForIndex();
  const std::string control = TakeControl();
  for (const Row& row : std::vector<Row>{
           {"GET", "/api/recordings", "", 401, 200, 200, 200},
           {"GET", kTarget, "", 401, 200, 200, 200},
           {"GET", kTarget + "/file", "", 401, 200, 200, 200},
           {"GET", kTarget + "/file?part=1", "", 401, 404, 404, 404},
           {"GET", "/api/history?ids=1&recording=" + kName, "", 401, 200, 200, 200},
       }) {
    Try(row, control);
    Try({"HEAD", row.target, "", row.none, row.viewer, row.other, row.holder}, control);
  }
  for (const char* method : {"POST", "PUT", "PATCH"})
    Try({method, kTarget, "{}", 401, 403, 405, 405}, control);
  Try({"DELETE", kTarget + "/file", "", 401, 403, 405, 405}, control);
  Try({"DELETE", "/api/recordings", "", 401, 403, 405, 405}, control);

  // One after the other, for it is there only until somebody may.
  const auto remove = [&](const std::string& headers) { return Status("DELETE", kTarget, "", headers); };
  EXPECT_EQ(remove(""), 401);
  EXPECT_EQ(remove(control), 401);
  EXPECT_EQ(remove(Bearer(viewer_)), 403);
  EXPECT_EQ(remove(Bearer(viewer_) + control), 403);
  EXPECT_EQ(remove(Bearer(other_)), 403);
  EXPECT_EQ(remove(Bearer(other_) + "Control-Token: x\r\n"), 403);
  EXPECT_TRUE(fs::exists(file_));
  tried_.insert("DELETE " + kTarget);
  for (const std::string& path : {std::string("/api/recordings"), kTarget, kTarget + "/file"})
    ExpectAllAllowedTried(path, control);
  EXPECT_EQ(remove(Bearer(holder_) + control), 200);
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(RecordingsAccess, WithoutALiveFlightAnOperatorDeletesAndNobodyCommands) {
  Serve(false);
  for (const auto& [channel, body] : bridge::kCommands)
    Try({"POST", "/api/command", CommandJson(channel, body), 401, 403, 409, 409}, "");
  EXPECT_EQ(Status("DELETE", kTarget, "", ""), 401);
  EXPECT_EQ(Status("DELETE", kTarget, "", Bearer(viewer_)), 403);
  EXPECT_TRUE(fs::exists(file_));
  EXPECT_EQ(Status("DELETE", kTarget, "", Bearer(other_)), 200);
  EXPECT_FALSE(fs::exists(file_));
  bridge_->OnBus([this](bus::Bus&) { EXPECT_TRUE(heard_.empty()); });
}

TEST_F(RecordingsAccess, WhoeverMayLookPlaysForHimselfAndNobodyCommandsThere) {
  Serve(true);
  TakeControl();
  EXPECT_EQ(Upgrade(kLive, "").status, 401);
  EXPECT_EQ(Upgrade(kLive, Bearer("skein_wrong")).status, 401);
  EXPECT_EQ(Upgrade(kLive, Cookie("skein_wrong")).status, 401);
  const std::map<std::string, json> playback{
      {"play", json::object()}, {"pause", json::object()}, {"seek", {{"t_s", 1}}},
      {"step", json::object()}, {"speed", {{"speed", 2}}}, {"loop", {{"loop", nullptr}}},
  };
  for (const std::string& token : {viewer_, other_, holder_}) {
    const auto browser = Live(token, kLive);
    std::set<std::string> actions;
    for (const auto& [action, more] : playback) {
      json message{{"type", "playback"}, {"id", "p"}, {"action", action}};
      message.update(more);
      EXPECT_EQ(Ask(*browser, message.dump())["accepted"], true) << message;
      actions.insert(action);
    }
    const json unknown = Ask(*browser, R"({"type":"playback","id":"x","action":"x"})");
    EXPECT_EQ(bridge::NamedIn(unknown["reason"], "/action: must be "), actions);

    for (const auto& [channel, body] : bridge::kCommands) {
      const std::string command = R"({"type":"command","id":"c",)" + CommandJson(channel, body).substr(1);
      EXPECT_EQ(Ask(*browser, command)["accepted"], false) << command;
    }
    for (const char* action : {"join", "take", "ask", "release", "withdraw", "play"}) {
      const json control{{"type", "control"}, {"id", "c"}, {"action", action}};
      EXPECT_EQ(Ask(*browser, control.dump())["accepted"], false) << control;
    }
  }
  bridge_->OnBus([this](bus::Bus&) { EXPECT_TRUE(heard_.empty()); });
}

}  // namespace
}  // namespace skein::playback
