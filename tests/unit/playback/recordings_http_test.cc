// Recordings over HTTP and WebSocket, of a bridge with a live bus beside them.

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "bridge/bridge_under_test.h"
#include "bridge/live_client.h"
#include "bridge/raw_client.h"
#include "playback/recorded_flights.h"
#include "playback/recordings.h"

namespace skein::playback {
namespace {

namespace fs = std::filesystem;
using bridge::LiveClient;
using bridge::RawClient;
using bridge::RawResponse;
using nlohmann::json;
using namespace std::chrono_literals;

constexpr const char* kName = "link-drop-20261125-120000.lcm";

/// A file that nobody has written to for long.
void Age(const fs::path& file) { fs::last_write_time(file, fs::file_time_type::clock::now() - 1h); }

class RecordingsHttp : public testing::Test {
 protected:
  RecordingsHttp() {
    Put(kName);
    bridge::BridgeOptions options;
    options.make_recordings = [this] {
      return std::make_shared<const bridge::Recordings>(
          MakeRecordings(std::make_shared<RecordingLibrary>(folder_.path()), {}, true));
    };
    bridge_ = std::make_unique<bridge::BridgeUnderTest>(options);
  }

  void Put(const std::string& name) {
    fs::copy_file(LinkDropLog(), folder_.path() / name);
    Age(folder_.path() / name);
  }

  RawResponse Get(const std::string& target, const std::string& more_headers = "") {
    return RawClient(bridge_->port()).Get(target, more_headers).value();
  }
  RawResponse Delete(const std::string& target, const std::string& more_headers = "") {
    RawClient client(bridge_->port());
    client.Send("DELETE " + target + " HTTP/1.1\r\nHost: localhost\r\n" + more_headers + "\r\n");
    return client.Receive().value();
  }
  /// Asks until it has been indexed, 60 s at most.
  RawResponse GetIndexed(const std::string& target) {
    for (int i = 0; i < 600; ++i) {
      RawResponse response = Get(target);
      if (response.status != 202) return response;
      EXPECT_TRUE(json::parse(response.body).contains("progress"));
      std::this_thread::sleep_for(100ms);
    }
    return {};
  }
  /// A browser that holds control, and its token.
  std::string TakeControl(LiveClient& client) {
    client.Send(R"({"type":"control","id":"1","action":"join","name":"Ada"})");
    for (;;) {
      const json control = client.ReadText("control");
      if (control.is_null()) return "";
      if (control["you"] != 0 && control["holder"] == control["you"]) return control["token"];
    }
  }

  FreshFolder folder_;
  std::unique_ptr<bridge::BridgeUnderTest> bridge_;
};

TEST_F(RecordingsHttp, ListsRecordingsAndIndexesThemInTheBackground) {
  std::ofstream(folder_.path() / "empty.lcm");
  Age(folder_.path() / "empty.lcm");
  std::ofstream(folder_.path() / "notes.txt") << "no log";
  fs::create_directory(folder_.path() / "folder.lcm");
  json first = json::parse(Get("/api/recordings").body);
  ASSERT_EQ(first["recordings"].size(), 2U);
  json list;
  for (int i = 0; i < 600 && list.empty(); ++i) {
    json now = json::parse(Get("/api/recordings").body)["recordings"];
    const bool all = std::ranges::all_of(now, [](const json& one) { return one["progress"] == 1; });
    if (all) list = now;
    std::this_thread::sleep_for(100ms);
  }
  ASSERT_EQ(list.size(), 2U);
  const json& empty = list[list[0]["name"] == "empty.lcm" ? 0 : 1];
  const json& good = list[list[0]["name"] == "empty.lcm" ? 1 : 0];
  EXPECT_NE(empty["problem"].get<std::string>().find("empty"), std::string::npos);
  EXPECT_EQ(good["name"], kName);
  EXPECT_EQ(good["indexed"], true);
  EXPECT_EQ(good["vehicles"], 3);
  EXPECT_EQ(good["markers"], 1);
  EXPECT_EQ(good["recording_now"], false);
  EXPECT_GE(good["alarms"], 1);
  EXPECT_NEAR(good["duration_s"].get<double>(), 400, 1);
  EXPECT_TRUE(fs::exists(folder_.path() / (std::string(kName) + ".skein-index")));
}

TEST_F(RecordingsHttp, DescribesARecording) {
  const json recording = json::parse(GetIndexed(std::string("/api/recordings/") + kName).body);
  EXPECT_EQ(recording["vehicles"], 3);
  EXPECT_EQ(recording["flights"].size(), 1U);
  const auto mark =
      std::ranges::find_if(recording["marks"], [](const json& one) { return one["kind"] == "marker"; });
  ASSERT_NE(mark, recording["marks"].end());
  EXPECT_NEAR((*mark)["t_s"].get<double>(), kNote_s, 0.1);
  EXPECT_EQ((*mark)["text"], "look at this");
  EXPECT_TRUE(std::ranges::any_of(recording["marks"], [](const json& one) {
    return one["kind"] == "alarm" && one["code"] == "link:3" && one["severity"] == 3;
  }));
  const auto stranger =
      std::ranges::find_if(recording["channels"], [](const json& one) { return one["name"] == "STRANGER"; });
  ASSERT_NE(stranger, recording["channels"].end());
  EXPECT_EQ((*stranger)["known"], false);
  EXPECT_EQ((*stranger)["count"], 3);
  const auto& density = recording["density"];
  EXPECT_EQ(density["bin_s"], 1);
  EXPECT_EQ(density["events"].size(), 401U);
}

TEST_F(RecordingsHttp, GivesTheCurvesOfTheWholeFlight) {
  const RawResponse response = GetIndexed(std::string("/api/history?recording=") + kName + "&ids=1,2,3");
  EXPECT_EQ(response.status, 200);
  std::uint32_t samples = 0;
  std::memcpy(&samples, response.body.data() + 16, sizeof samples);
  EXPECT_NEAR(samples, 400, 3);
  EXPECT_EQ(Get(std::string("/api/history?recording=") + kName + "&ids=x").status, 400);
  EXPECT_EQ(Get(std::string("/api/history?recording=") + kName + "&ids=1&at=x").status, 400);
}

TEST_F(RecordingsHttp, IsDownloadedWholeOrInParts) {
  const std::string target = std::string("/api/recordings/") + kName + "/file";
  std::ifstream stream(LinkDropLog(), std::ios::binary);
  const std::string log(std::istreambuf_iterator<char>(stream), {});
  const RawResponse whole = Get(target);
  EXPECT_EQ(whole.status, 200);
  EXPECT_EQ(whole.body, log);
  const RawResponse part = Get(target, "Range: bytes=1000-1999\r\n");
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, log.substr(1000, 1000));
  EXPECT_EQ(part.headers.at("content-range"), "bytes 1000-1999/" + std::to_string(log.size()));
  EXPECT_EQ(Get(target, "Range: bytes=-10\r\n").body, log.substr(log.size() - 10));
  EXPECT_EQ(Get(target, "Range: bytes=99999999999-\r\n").status, 416);
  EXPECT_EQ(Get(target, "Range: bytes=0-9\r\nIf-Range: \"old\"\r\n").status, 200);
  EXPECT_EQ(Get(target + "?part=1").status, 404);
  EXPECT_EQ(Get(target + "?part=x").status, 404);
  RawClient client(bridge_->port());
  client.Send("HEAD " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto head = client.Receive(true);
  EXPECT_EQ(head->headers.at("content-length"), std::to_string(log.size()));
  EXPECT_EQ(client.Get("/api/recordings")->status, 200);  // the connection goes on
}

TEST_F(RecordingsHttp, NeverLeadsOutOfTheFolder) {
  const FreshFolder elsewhere;
  fs::copy_file(LinkDropLog(), elsewhere.path() / "secret.lcm");
  fs::create_symlink(elsewhere.path() / "secret.lcm", folder_.path() / "link.lcm");
  fs::create_symlink(elsewhere.path(), folder_.path() / "away");
  const std::string name = elsewhere.path().filename().string();
  for (const std::string& bad :
       {"../" + name + "/secret.lcm", "..%2F" + name + "%2Fsecret.lcm", "%2e%2e%2f" + name + "%2fsecret.lcm",
        "%252e%252e%252f" + name + "%252fsecret.lcm", std::string("link.lcm"), std::string("away/secret.lcm"),
        std::string("away%2Fsecret.lcm"), std::string("%2Fetc%2Fpasswd"), std::string("%00"),
        std::string(".."), std::string("."), std::string("%2e%2e"), std::string("%zz"), std::string("")}) {
    for (const char* more : {"", "/file"}) {
      EXPECT_EQ(Get("/api/recordings/" + bad + more).status, 404) << bad << more;
    }
    EXPECT_EQ(Delete("/api/recordings/" + bad).status / 100, 4) << bad;
    EXPECT_THROW(LiveClient(bridge_->port(), "", "/live?recording=" + bad + "x"), std::exception) << bad;
  }
  EXPECT_TRUE(fs::exists(elsewhere.path() / "secret.lcm"));
  EXPECT_EQ(json::parse(Get("/api/recordings").body)["recordings"].size(), 1U);
}

TEST_F(RecordingsHttp, IsDeletedOnlyByWhoHoldsControlAndNotWhileItIsRecorded) {
  const std::string target = std::string("/api/recordings/") + kName;
  const RawResponse nobody = Delete(target);
  EXPECT_EQ(nobody.status, 403);
  EXPECT_EQ(json::parse(nobody.body)["deleted"], false);
  LiveClient ada(bridge_->port());
  const std::string token = TakeControl(ada);
  ASSERT_FALSE(token.empty());
  EXPECT_EQ(Delete(target, "Control-Token: " + token + "x\r\n").status, 403);
  EXPECT_EQ(Delete(target, "Control-Token: " + token + "\r\nOrigin: http://elsewhere.example\r\n").status,
            403);

  fs::last_write_time(folder_.path() / kName, fs::file_time_type::clock::now());
  const RawResponse running = Delete(target, "Control-Token: " + token + "\r\n");
  EXPECT_EQ(running.status, 409);
  EXPECT_EQ(json::parse(running.body)["reason"], "it is being recorded now");
  Age(folder_.path() / kName);

  GetIndexed(target);  // so that there is an index beside it
  EXPECT_EQ(Delete(target, "Control-Token: " + token + "\r\n").status, 200);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  for (;;) {
    const json event = ada.ReadText("event");
    ASSERT_FALSE(event.is_null());
    if (event["code"] == "recording_deleted") break;
  }
  EXPECT_EQ(Delete(target, "Control-Token: " + token + "\r\n").status, 404);
}

TEST_F(RecordingsHttp, PlaysToEachBrowserByItself) {
  const std::string target = std::string("/live?recording=") + kName;
  LiveClient ada(bridge_->port(), "", target);
  LiveClient ben(bridge_->port(), "", target);
  const json hello = ada.ReadText("hello");
  EXPECT_EQ(hello["replay"], (json{{"kind", "log"}, {"name", kName}}));
  json playback = ada.ReadText("playback");
  while (playback["state"] == "opening") playback = ada.ReadText("playback");
  EXPECT_EQ(playback["state"], "paused");

  ada.Send(R"({"type":"playback","id":"a","action":"seek","t_s":210})");
  EXPECT_EQ(ada.ReadText("reset")["type"], "reset");
  EXPECT_EQ(ada.ReadText("roster")["vehicles"].size(), 3U);
  EXPECT_EQ(ada.ReadText("statuses")["statuses"][0]["mode"], 2);
  const std::string motion = ada.ReadBinary(1);
  double t_s = 0;
  std::memcpy(&t_s, motion.data() + 16, sizeof t_s);
  EXPECT_NEAR(t_s, 210, 0.1);
  const json ack = ada.ReadText("ack");
  EXPECT_EQ(ack["id"], "a");
  EXPECT_EQ(ack["accepted"], true);

  ben.Send(R"({"type":"playback","id":1,"action":"play"})");
  do {
    playback = ben.ReadText("playback");
    ASSERT_FALSE(playback.is_null());
  } while (playback["t_s"] < 1);
  EXPECT_LT(playback["t_s"], 100);
  EXPECT_EQ(playback["state"], "playing");
}

TEST_F(RecordingsHttp, CommandsNothingAndSaysWhatIsWrongWithARequest) {
  LiveClient client(bridge_->port(), "", std::string("/live?recording=") + kName);
  const auto answer = [&](const std::string& text) {
    client.Send(text);
    return client.ReadText("ack");
  };
  EXPECT_EQ(answer(R"({"type":"command","id":"1","channel":"CMD_PAYLOAD","body":{}})")["accepted"], false);
  EXPECT_EQ(answer(R"({"type":"control","id":"1","action":"take"})")["accepted"], false);
  EXPECT_EQ(answer("nonsense")["accepted"], false);
  for (const char* bad : {R"({"type":"playback","id":"b","action":"fly"})", R"({"type":"playback","id":"b"})",
                          R"({"type":"playback","id":"b","action":"seek"})",
                          R"({"type":"playback","id":"b","action":"seek","t_s":"x"})",
                          R"({"type":"playback","id":"b","action":"speed","speed":0})",
                          R"({"type":"playback","id":"b","action":"speed","speed":51})",
                          R"({"type":"playback","id":"b","action":"loop"})",
                          R"({"type":"playback","id":"b","action":"loop","loop":[3,3]})",
                          R"({"type":"playback","id":"b","action":"loop","loop":[3]})",
                          R"({"type":"playback","id":"b","action":"step","steps":1.5})"}) {
    const json ack = answer(bad);
    EXPECT_EQ(ack["accepted"], false) << bad;
    EXPECT_EQ(ack["id"], "b") << bad;
    EXPECT_NE(ack["reason"], "") << bad;
  }
  EXPECT_EQ(answer(R"({"type":"playback","id":"g","action":"loop","loop":null})")["accepted"], true);
  EXPECT_EQ(answer(R"({"type":"playback","id":"g","action":"speed","speed":-0.1})")["accepted"], true);
}

TEST_F(RecordingsHttp, SaysWhyARecordingCannotBeOpened) {
  std::ofstream(folder_.path() / "noise.lcm") << std::string(10'000, 'x');
  LiveClient client(bridge_->port(), "", "/live?recording=noise.lcm");
  json playback = client.ReadText("playback");
  while (playback["state"] == "opening") playback = client.ReadText("playback");
  EXPECT_EQ(playback["state"], "failed");
  EXPECT_EQ(playback["problem"], "noise.lcm: is not an LCM log: there is no event in it");
  EXPECT_EQ(GetIndexed("/api/recordings/noise.lcm").status, 422);
  EXPECT_EQ(Get("/api/recordings/nothing.lcm").status, 404);
}

TEST(WithoutRecordings, TheBridgeSaysSo) {
  bridge::BridgeUnderTest bridge;
  EXPECT_EQ(RawClient(bridge.port()).Get("/api/recordings")->status, 404);
  EXPECT_THROW(LiveClient(bridge.port(), "", "/live?recording=x.lcm"), std::exception);
  LiveClient client(bridge.port());
  const json hello = client.ReadText("hello");
  EXPECT_TRUE(hello["recordings"].is_null());
  EXPECT_TRUE(hello["replay"].is_null());
}

}  // namespace
}  // namespace skein::playback
