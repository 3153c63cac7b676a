// Recordings that real processes made, served by a real web-bridge that has no bus; and files that are none.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "system/flight_log.h"
#include "system/http.h"
#include "system/live_flight.h"
#include "unit/bridge/live_client.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;
using bridge::LiveClient;
using nlohmann::json;
namespace fs = std::filesystem;

/// A web-bridge that serves recordings only.
class RecordingsBridge {
 public:
  explicit RecordingsBridge(std::vector<std::string> options) {
    options.insert(options.begin(), {Program("web-bridge"), "--port", std::to_string(port_)});
    process_ = std::make_unique<Process>(options);
    EXPECT_TRUE(process_->WaitForOutput("http://", 30s)) << process_->output();
  }
  int port() const { return port_; }

  /// The answer for a recording, once it has been indexed; null when it never is.
  json Describe(const std::string& name) {
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    while (std::chrono::steady_clock::now() < deadline) {
      const auto body = HttpGet(port_, "/api/recordings/" + name);
      if (body) return json::parse(*body);
      std::this_thread::sleep_for(50ms);
    }
    return nullptr;
  }

  /// A browser that sees the recording, once it is open.
  std::unique_ptr<LiveClient> Watch(const std::string& target) {
    auto client = std::make_unique<LiveClient>(port_, "", target);
    for (;;) {
      const json playback = client->ReadText("playback");
      if (playback.is_null() || playback["state"] != "opening") return client;
    }
  }

 private:
  int port_ = FreeTcpPort();
  std::unique_ptr<Process> process_;
};

/// A flight of 8 s with a cut link, recorded by lcm-logger.
class ARecordedFlight : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = FreshFolder("skein-recordings");
    LiveFlight flight("triangle", Log());
    ASSERT_TRUE(flight.WaitUntil(2, 30s));
    const Finished cut =
        RunToEnd({Program("skein"), "--lcm-url", flight.lcm_url(), "link", "cut", "3", "--for", "2"});
    ASSERT_EQ(cut.exit_code, 0) << cut.output;
    ASSERT_TRUE(flight.WaitUntil(8, 30s));
    ASSERT_TRUE(flight.End());
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }
  static std::string Log() { return folder_ + "/flight.lcm"; }

  static inline std::string folder_;
};

TEST_F(ARecordedFlight, IsShownAsItWasFromItsFileAlone) {
  const FlightLog log = ReadFlightLog(Log());
  RecordingsBridge bridge({"--log", Log()});
  const json recording = bridge.Describe("flight.lcm");
  ASSERT_FALSE(recording.is_null());
  EXPECT_EQ(recording["vehicles"], 3);
  EXPECT_EQ(recording["scenario"], "Triangle on a closed path");
  EXPECT_TRUE(
      std::ranges::any_of(recording["marks"], [](const json& mark) { return mark["code"] == "link_cut"; }));
  EXPECT_TRUE(recording["damage"].empty()) << recording["damage"];
  for (const json& channel : recording["channels"]) {
    if (channel["name"] == "LCM_SELF_TEST") continue;  // LCM's own
    EXPECT_TRUE(channel["known"]) << channel;
    EXPECT_EQ(channel["undecodable"], 0) << channel;
  }

  const auto client = bridge.Watch("/live");  // there is only one
  client->Send(R"({"type":"playback","id":"end","action":"seek","t_s":1e6})");
  EXPECT_EQ(client->ReadText("hello")["recordings"], (json{{"live_bus", false}, {"only", "flight.lcm"}}));
  EXPECT_EQ(client->ReadText("path")["type"], "path");
  EXPECT_EQ(client->ReadText("heartbeat")["type"], "heartbeat");
  const std::string motion = client->ReadBinary(1);
  std::uint32_t count = 0;
  std::memcpy(&count, motion.data() + 4, sizeof count);
  ASSERT_EQ(count, 3U);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::int32_t id = 0;
    float north_m = 0;
    std::memcpy(&id, motion.data() + 24 + 4 * i, sizeof id);
    std::memcpy(&north_m, motion.data() + 24 + 4 * (2 * count + i), sizeof north_m);
    // Rounded on the way.
    EXPECT_NEAR(north_m, log.curves.at(id).back().state.north_m, 1.0 / 64);
  }
}

TEST_F(ARecordedFlight, IsPlayedUpToWhereItIsCutShortAndPastWhatIsDamaged) {
  std::ifstream stream(Log(), std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const std::string name = "damaged.lcm";
  bytes.replace(bytes.size() / 2, 5000, std::string(5000, '\xFF'));
  std::ofstream(fs::path(folder_) / name, std::ios::binary) << bytes.substr(0, bytes.size() - 13);

  RecordingsBridge bridge({"--logs", folder_, "--no-bus"});
  const json recording = bridge.Describe(name);
  ASSERT_FALSE(recording.is_null());
  ASSERT_EQ(recording["damage"].size(), 2U) << recording["damage"];
  // An event of which only the end is overwritten still tells its length, and is none of the gap.
  EXPECT_GT(recording["damage"][0]["bytes"], 4000);
  EXPECT_EQ(recording["damage"][1]["reason"], "the last event is cut short");
  const auto client = bridge.Watch("/live?recording=" + name);
  client->Send(R"({"type":"playback","id":"end","action":"seek","t_s":1e6})");
  EXPECT_EQ(client->ReadText("roster")["vehicles"].size(), 3U);
  fs::remove(fs::path(folder_) / name);
}

TEST_F(ARecordedFlight, GoesOnThroughItsParts) {
  const std::string folder = FreshFolder("skein-parts");
  const std::string name = "parts.lcm";
  // Cut between two events: they begin with the magic word.
  std::ifstream stream(Log(), std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const std::size_t cut = bytes.find("\xED\xA1\xDA\x01", bytes.size() / 2);
  std::ofstream(fs::path(folder) / name, std::ios::binary) << bytes.substr(0, cut);
  std::ofstream(fs::path(folder) / (name + ".01"), std::ios::binary) << bytes.substr(cut);
  RecordingsBridge bridge({"--logs", folder, "--no-bus"});
  const json parts = bridge.Describe(name);
  RecordingsBridge whole_bridge({"--log", Log()});
  const json whole = whole_bridge.Describe("flight.lcm");
  EXPECT_EQ(parts["parts"], 2);
  for (const char* same : {"duration_s", "vehicles", "bytes", "flights", "channels"}) {
    EXPECT_EQ(parts[same], whole[same]) << same;
  }
  EXPECT_TRUE(parts["damage"].empty()) << parts["damage"];
  const auto client = bridge.Watch("/live?recording=" + name);
  client->Send(R"({"type":"playback","id":"1","action":"seek","t_s":7})");
  EXPECT_EQ(client->ReadText("formation")["type"], "formation");
  EXPECT_EQ(client->ReadText("ack")["accepted"], true);
  fs::remove_all(folder);
}

struct NoLog {
  const char* what;
  std::function<void(const fs::path&)> make;
  const char* reason;
};

TEST(WebBridgeLog, SaysWhatIsWrongWithAFileThatIsNoLog) {
  const fs::path folder = FreshFolder("skein-no-log");
  const std::vector<NoLog> cases = {
      {"missing", [](const fs::path&) {}, "cannot be opened"},
      {"folder", [](const fs::path& file) { fs::create_directory(file); }, "is a folder"},
      {"empty", [](const fs::path& file) { std::ofstream{file}; }, "is empty"},
      {"text", [](const fs::path& file) { std::ofstream(file) << std::string(100'000, 'x'); },
       "is not an LCM log"},
      {"sparse",
       [](const fs::path& file) {
         std::ofstream{file};
         fs::resize_file(file, 10'000'000'000);
       },
       "is not an LCM log"},
  };
  for (const NoLog& no_log : cases) {
    const fs::path file = folder / no_log.what;
    no_log.make(file);
    const Finished refused =
        RunToEnd({Program("web-bridge"), "--port", std::to_string(FreeTcpPort()), "--log", file}, 20s);
    EXPECT_EQ(refused.exit_code, 2) << no_log.what;
    EXPECT_NE(refused.output.find(no_log.reason), std::string::npos) << refused.output;
    EXPECT_NE(refused.output.find(file.string()), std::string::npos) << refused.output;
  }
  fs::remove_all(folder);
}

TEST(WebBridgeLog, RefusesOptionsThatDoNotGoTogether) {
  const std::string port = std::to_string(FreeTcpPort());
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--no-bus"},
                                                  {"--log", "x.lcm", "--logs", "."},
                                                  {"--logs", "/no/such/folder"},
                                                  {"--log", "x.lcm", "--lcm-url", "memq://"}}) {
    std::vector<std::string> command = {Program("web-bridge"), "--port", port};
    command.insert(command.end(), options.begin(), options.end());
    EXPECT_EQ(RunToEnd(command, 20s).exit_code, 2) << options.front();
  }
}

}  // namespace
}  // namespace skein::testing
