// skein log on what lcm-logger recorded of real processes.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "recording/recording.h"
#include "system/flight_log.h"
#include "system/live_flight.h"

namespace skein::testing {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

class LogExport : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = FreshFolder("skein-log-export");
    file_ = folder_ + "/triangle.lcm";
    LiveFlight flight("triangle", file_);
    ASSERT_TRUE(flight.WaitUntil(2, 60s));
    const Finished cut =
        RunToEnd({Program("skein"), "--lcm-url", flight.lcm_url(), "link", "cut", "3", "--for", "3"});
    ASSERT_EQ(cut.exit_code, 0) << cut.output;
    ASSERT_TRUE(flight.WaitUntil(12, 60s));
    ASSERT_TRUE(flight.End());
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }

  /// `skein log WORDS`, with the file as the second word.
  static Finished Log(std::vector<std::string> words, const std::string& file = file_) {
    std::vector<std::string> command = {Program("skein"), "log", words.front(), file};
    command.insert(command.end(), words.begin() + 1, words.end());
    return RunToEnd(command);
  }

  static inline std::string folder_;
  static inline std::string file_;
};

TEST_F(LogExport, ReadsEveryEventThatLcmLoggerWrote) {
  const recording::Recording recording(file_);
  recording::RecordingReader reader(recording);
  lcm::LogFile other(file_, "r");
  std::int64_t count = 0;
  while (const lcm::LogEvent* expected = other.readNextEvent()) {
    const auto event = reader.Next();
    ASSERT_TRUE(event) << count;
    ASSERT_EQ(event->number, expected->eventnum);
    ASSERT_EQ(event->utime, expected->timestamp);
    ASSERT_EQ(event->channel, expected->channel);
    ASSERT_EQ(event->data.size(), static_cast<std::size_t>(expected->datalen));
    ++count;
  }
  EXPECT_FALSE(reader.Next());
  EXPECT_TRUE(reader.damage().empty());
  EXPECT_GT(count, 500);
}

TEST_F(LogExport, TellsWhatWasFlown) {
  const Finished ran = Log({"info", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const json info = json::parse(ran.output);
  EXPECT_EQ(info["flights"][0]["scenario"], "Triangle on a closed path");
  EXPECT_EQ(info["flights"][0]["vehicles"].size(), 3U);
  EXPECT_GT(info["duration_s"], 11);
  EXPECT_TRUE(info["damage"].empty());
  for (const json& channel : info["channels"]) {
    // LCM tries itself out at its start; nothing else is not ours.
    EXPECT_EQ(channel["known"], channel["name"] != "LCM_SELF_TEST") << channel;
    EXPECT_EQ(channel["undecodable"], 0) << channel;
  }
  const Finished events = Log({"events"});
  EXPECT_NE(events.output.find("link_cut "), std::string::npos) << events.output;
}

TEST_F(LogExport, ExportsTracksAndFigures) {
  const FlightLog log = ReadFlightLog(file_);
  const json collection = json::parse(Log({"geojson", "--points", "--tolerance-m", "0"}).output);
  std::size_t states = 0;
  for (const auto& [id, curve] : log.curves) states += curve.size();
  std::size_t points = 0;
  for (const json& feature : collection["features"]) points += feature["properties"]["kind"] == "track";
  EXPECT_EQ(points, states);

  const std::string svg = folder_ + "/figure.svg";
  const Finished plot = Log({"plot", "--figure", "8", "--out", svg});
  EXPECT_EQ(plot.exit_code, 0) << plot.output;
  EXPECT_TRUE(std::filesystem::exists(svg));
  const Finished again = Log({"plot", "--figure", "6", "--out", svg});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_EQ(again.output, "skein: " + svg + ": exists already; --force replaces it\n");
  EXPECT_NE(Log({"kml"}).output.find("</kml>"), std::string::npos);
}

TEST_F(LogExport, CutsAPartThatLcmReads) {
  const std::string part = folder_ + "/part.lcm";
  const Finished cut = Log({"cut", "--from", "4", "--to", "9", "--out", part});
  ASSERT_EQ(cut.exit_code, 0) << cut.output;
  const FlightLog log = ReadFlightLog(part);
  EXPECT_EQ(log.curves.size(), 3U);
  EXPECT_NEAR(json::parse(Log({"info", "--json"}, part).output)["duration_s"].get<double>(), 5, 0.2);
  // A part of a flight agrees with the whole.
  EXPECT_EQ(Log({"diff", part, "--tolerance-m", "0.001"}).exit_code, 0);
}

TEST_F(LogExport, SaysHowItWent) {
  EXPECT_EQ(Log({"info"}, folder_).exit_code, 2);
  EXPECT_EQ(Log({"csv", "--channel", "NOBODY"}).exit_code, 2);
  EXPECT_EQ(Log({"csv", "--channel", "FLEET_STATE", "--out", "/dev/full"}).exit_code, 1);
  const std::string damaged = folder_ + "/damaged.lcm";
  std::filesystem::copy_file(file_, damaged);
  std::filesystem::resize_file(damaged, std::filesystem::file_size(damaged) - 5);
  const Finished csv = Log({"csv", "--channel", "HEARTBEAT"}, damaged);
  EXPECT_EQ(csv.exit_code, 0);
  EXPECT_NE(csv.output.find("are damaged and left out; `skein log info` says where"), std::string::npos);
}

TEST_F(LogExport, EndsQuietlyWhenNobodyReadsOn) {
  const Finished head = RunToEnd(
      {"bash", "-c",
       Program("skein") + " log csv " + file_ + " --channel FLEET_STATE | head -1; echo ${PIPESTATUS[0]}"});
  // 141: SIGPIPE, as cat and grep end; 0 if all of it had gone into the pipe before.
  EXPECT_TRUE(head.output.ends_with("payload_on\n141\n") || head.output.ends_with("payload_on\n0\n"))
      << head.output;
  EXPECT_EQ(std::count(head.output.begin(), head.output.end(), '\n'), 2);
}

}  // namespace
}  // namespace skein::testing
