// flight-recorder with the real lcm-logger: what is recorded, and what is told when nothing is.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <skein/event_t.hpp>
#include <skein/recording_status_t.hpp>
#include <string>
#include <thread>
#include <vector>

#include "bus/channels.h"
#include "system/bus_ear.h"
#include "system/process.h"
#include "system/small_disk.h"

namespace skein::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// The whole events of one log file.
struct LogEvents {
  std::vector<std::string> channels;
  std::vector<std::int64_t> numbers;  ///< of messages of NumberStream
  std::vector<event_t> events;        ///< EVENT
};

void Read(const fs::path& file, LogEvents& read) {
  lcm::LogFile log(file.string(), "r");
  ASSERT_TRUE(log.good()) << file;
  while (const lcm::LogEvent* item = log.readNextEvent()) {
    read.channels.push_back(item->channel);
    if (item->channel == "NUMBERS") {
      read.numbers.push_back(std::stoll(std::string(static_cast<const char*>(item->data), 12)));
    } else if (item->channel == bus::channel::kEvent) {
      read.events.emplace_back();
      ASSERT_GT(read.events.back().decode(item->data, 0, item->datalen), 0);
    }
  }
}

bool Holds(const LogEvents& log, const std::string& code, const std::string& text = "") {
  return std::ranges::any_of(log.events, [&](const event_t& event) {
    return event.code == code && event.text.find(text) != std::string::npos;
  });
}

/// Publishes messages of 1 kB with rising numbers, one each 5 ms, for as long as it lives.
class NumberStream {
 public:
  explicit NumberStream(const std::string& url)
      : lcm_(bus::MakeTransport(url).lcm), thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            std::string text = std::to_string(++last_);
            text.resize(1000, ' ');
            lcm_->publish("NUMBERS", text.data(), static_cast<unsigned>(text.size()));
            std::this_thread::sleep_for(5ms);
          }
        }) {}

  /// Ends the stream.
  std::int64_t Last() {
    thread_.request_stop();
    thread_.join();
    return last_;
  }

 private:
  std::shared_ptr<lcm::LCM> lcm_;
  std::int64_t last_ = 0;
  std::jthread thread_;
};

class RecorderTest : public ::testing::Test {
 protected:
  ~RecorderTest() override { fs::remove_all(folder_); }

  std::vector<std::string> Command(const std::vector<std::string>& more = {"--keep-free-gb", "0"}) const {
    std::vector<std::string> command{Program("flight-recorder"), "--lcm-url", url_, "--folder", folder_};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }

  /// Waits for a RECORDING of this state of which `is_it` is true.
  bool HearsStatus(std::int8_t state, const std::function<bool(const recording_status_t&)>& is_it,
                   Seconds timeout = Seconds(30)) {
    return Hears<recording_status_t>(
        url_, bus::channel::kRecording,
        [&](const recording_status_t& status) {
          status_ = status;
          return status.state == state && is_it(status);
        },
        timeout);
  }
  bool IsRecording(int parts = 1, Seconds timeout = Seconds(30)) {
    return HearsStatus(
        recording_status_t::RECORDING, [&](const auto& status) { return status.parts >= parts; }, timeout);
  }

  /// The command `skein record ...`.
  Finished Record(const std::vector<std::string>& words) const {
    std::vector<std::string> command{Program("skein"), "--lcm-url", url_, "record"};
    command.insert(command.end(), words.begin(), words.end());
    return RunToEnd(command);
  }

  /// The parts of the recording that RECORDING told of last, in order.
  std::vector<fs::path> Parts() const {
    std::vector<fs::path> parts;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(status_.recording) && !name.ends_with(".json")) parts.push_back(entry.path());
    }
    std::ranges::sort(parts);
    return parts;
  }

  LogEvents ReadAll() const {
    LogEvents all;
    for (const fs::path& part : Parts()) Read(part, all);
    return all;
  }

  pid_t Logger() const { return FindProcess("lcm-logger", url_); }

  std::string url_ = FreshLcmUrl();
  std::string folder_ = FreshFolder("skein-recorder-test");
  recording_status_t status_;  ///< the last that was heard
};

TEST_F(RecorderTest, RecordsFromItsStartToItsEndAndSaysSoInTheLog) {
  Process recorder(Command());
  ASSERT_TRUE(IsRecording()) << recorder.output();
  recorder.Signal(SIGTERM);
  EXPECT_EQ(recorder.WaitForEnd(20s), 0) << recorder.output();
  EXPECT_EQ(Logger(), 0);
  const LogEvents log = ReadAll();
  EXPECT_TRUE(Holds(log, "recording_started", status_.recording));
  EXPECT_TRUE(Holds(log, "recording_stopped"));
}

TEST_F(RecorderTest, IsNamedAfterTheScenarioThatItHearsAndBeginsAnotherWithAnother) {
  Process recorder(Command());
  ASSERT_TRUE(IsRecording()) << recorder.output();
  EXPECT_TRUE(status_.recording.starts_with("flight-")) << status_.recording;
  Process simulator({Program("fleet-simulator"), "--lcm-url", url_, "--scenario", "triangle"},
                    {{"SKEIN_SCENARIOS", SKEIN_SOURCE_DIR "/scripts/scenarios"}});
  const auto named = [](const std::string& name) {
    return [name](const recording_status_t& status) { return status.recording.starts_with(name); };
  };
  ASSERT_TRUE(HearsStatus(recording_status_t::RECORDING, named("triangle-"))) << recorder.output();
  const std::string triangle = status_.recording;
  ASSERT_EQ(RunToEnd({Program("skein"), "--lcm-url", url_, "scenario", "load", "crossing"}).exit_code, 0);
  ASSERT_TRUE(HearsStatus(recording_status_t::RECORDING, named("crossing-"))) << recorder.output();
  recorder.Signal(SIGTERM);
  EXPECT_EQ(recorder.WaitForEnd(20s), 0);
  EXPECT_TRUE(fs::exists(folder_ + "/" + triangle));
  EXPECT_EQ(std::ranges::count_if(fs::directory_iterator(folder_), [](const auto&) { return true; }), 4)
      << "two recordings and their cards, and nothing of the first name";
}

TEST_F(RecorderTest, LosesNothingFromOnePartToTheNext) {
  Process recorder(Command({"--keep-free-gb", "0", "--split-mb", "0.1"}));
  ASSERT_TRUE(IsRecording()) << recorder.output();
  NumberStream stream(url_);
  EXPECT_TRUE(IsRecording(6, 30s)) << recorder.output();
  const std::int64_t last = stream.Last();
  recorder.Signal(SIGTERM);
  EXPECT_EQ(recorder.WaitForEnd(20s), 0) << recorder.output();
  const LogEvents log = ReadAll();
  EXPECT_GE(Parts().size(), 6U);
  std::int64_t expected = 0;
  for (const std::int64_t number : log.numbers) ASSERT_EQ(number, ++expected);
  EXPECT_EQ(expected, last);
}

TEST_F(RecorderTest, ReplacesAKilledLoggerWithinTwoSecondsAndWhatWasWrittenReplays) {
  Process recorder(Command());
  ASSERT_TRUE(IsRecording()) << recorder.output();
  kill(Logger(), SIGKILL);
  EXPECT_TRUE(IsRecording(2, 2s)) << recorder.output();
  recorder.Signal(SIGTERM);
  EXPECT_EQ(recorder.WaitForEnd(20s), 0) << recorder.output();
  ASSERT_EQ(Parts().size(), 2U);
  LogEvents first;
  Read(Parts()[0], first);
  EXPECT_FALSE(first.channels.empty());
  LogEvents second;
  Read(Parts()[1], second);
  EXPECT_TRUE(Holds(second, "recording_resumed", Parts()[1].filename().string()));
  EXPECT_NE(recorder.output().find("recording_interrupted: not recording: lcm-logger was killed (signal 9)"),
            std::string::npos)
      << recorder.output();
}

TEST_F(RecorderTest, ReplacesALoggerThatWritesNothing) {
  Process recorder(Command());
  ASSERT_TRUE(IsRecording()) << recorder.output();
  kill(Logger(), SIGSTOP);
  EXPECT_TRUE(HearsStatus(recording_status_t::INTERRUPTED, [](const auto&) { return true; }))
      << recorder.output();
  EXPECT_TRUE(IsRecording(2)) << recorder.output();
}

TEST_F(RecorderTest, GoesOnInAnotherFileWhenItsOwnIsTakenAway) {
  Process recorder(Command());
  ASSERT_TRUE(IsRecording()) << recorder.output();
  fs::remove(Parts().at(0));
  EXPECT_TRUE(IsRecording(2)) << recorder.output();
}

TEST_F(RecorderTest, TakesItsLoggerWithItWhenItIsKilled) {
  Process recorder(Command());
  ASSERT_TRUE(IsRecording()) << recorder.output();
  const pid_t logger = Logger();
  ASSERT_NE(logger, 0);
  // lcm-logger keeps what is new to itself for a moment.
  ASSERT_TRUE(HearsStatus(recording_status_t::RECORDING,
                          [this](const auto&) { return Holds(ReadAll(), "recording_started"); }));
  kill(recorder.pid(), SIGKILL);
  EXPECT_TRUE(WaitUntilGone({logger}, 2s));
  EXPECT_TRUE(Holds(ReadAll(), "recording_started"));
}

TEST_F(RecorderTest, ObeysTheOperator) {
  Process recorder(Command());
  ASSERT_TRUE(IsRecording()) << recorder.output();
  Finished marker = Record({"marker", "gusts from here on"});
  EXPECT_EQ(marker.exit_code, 0) << marker.output;
  Finished status = Record({"status"});
  EXPECT_EQ(status.exit_code, 0) << status.output;
  EXPECT_NE(status.output.find(status_.recording), std::string::npos) << status.output;

  EXPECT_EQ(Record({"stop"}).exit_code, 0);
  ASSERT_TRUE(HearsStatus(recording_status_t::STOPPED, [](const auto&) { return true; }));
  status = Record({"status"});
  EXPECT_EQ(status.exit_code, 1);
  EXPECT_NE(status.output.find("not recording: stopped by skein"), std::string::npos) << status.output;
  marker = Record({"marker", "in vain"});
  EXPECT_NE(marker.output.find("nothing is recorded now"), std::string::npos) << marker.output;
  EXPECT_EQ(Record({"marker", " "}).exit_code, 1);
  EXPECT_TRUE(WaitUntilGone({Logger()}, 5s));
  const LogEvents first = ReadAll();
  EXPECT_TRUE(Holds(first, "marker", "gusts from here on"));
  EXPECT_TRUE(Holds(first, "recording_stopped"));
  EXPECT_FALSE(Holds(first, "marker", "in vain"));

  const std::string before = status_.recording;
  EXPECT_EQ(Record({"start"}).exit_code, 0);
  ASSERT_TRUE(IsRecording()) << recorder.output();
  EXPECT_NE(status_.recording, before);
}

TEST_F(RecorderTest, StartsAsSoonAsTheLastRecordingHasEnded) {
  Process recorder(Command());
  ASSERT_TRUE(IsRecording()) << recorder.output();
  const std::string before = status_.recording;
  const pid_t writing = Logger();
  ASSERT_EQ(kill(writing, SIGSTOP), 0);
  EXPECT_EQ(Record({"stop"}).exit_code, 0);
  const Finished start = Record({"start"});
  EXPECT_EQ(start.exit_code, 0) << start.output;
  EXPECT_NE(start.output.find("as soon as the last recording is ended"), std::string::npos) << start.output;
  ASSERT_EQ(kill(writing, SIGCONT), 0);
  ASSERT_TRUE(IsRecording()) << recorder.output();
  EXPECT_NE(status_.recording, before);
}

TEST_F(RecorderTest, KeepsRoomOnTheDiskAndSaysWhyItDoesNotRecord) {
  Process recorder(Command({"--keep-free-gb", "1000000"}));
  ASSERT_TRUE(HearsStatus(recording_status_t::INTERRUPTED, [](const recording_status_t& status) {
    return status.reason.find("disk full") != std::string::npos;
  })) << recorder.output();
  EXPECT_EQ(Logger(), 0);
  const Finished status = Record({"status"});
  EXPECT_EQ(status.exit_code, 1);
  EXPECT_NE(status.output.find("not recording: disk full"), std::string::npos) << status.output;
}

TEST_F(RecorderTest, OutlivesAFullDiskAndGoesOnWhenThereIsRoomAgain) {
  const SmallDisk disk(folder_, "4m");
  if (disk.refused() != 0) GTEST_SKIP() << "a small disk cannot be mounted: " << strerror(disk.refused());
  const std::string ballast = folder_ + "/ballast";
  std::ofstream(ballast) << std::string(2'500'000, '.');
  Process recorder(Command());
  ASSERT_TRUE(IsRecording()) << recorder.output();
  NumberStream stream(url_);
  ASSERT_TRUE(HearsStatus(
      recording_status_t::INTERRUPTED,
      [](const recording_status_t& status) { return status.reason.find("disk full") != std::string::npos; },
      30s))
      << recorder.output();
  EXPECT_TRUE(recorder.WaitForOutput("disk_full: not recording: disk full", 2s)) << recorder.output();
  const LogEvents before = ReadAll();
  EXPECT_GT(before.numbers.size(), 500U);
  EXPECT_TRUE(std::ranges::is_sorted(before.numbers));
  stream.Last();

  fs::remove(ballast);
  ASSERT_TRUE(IsRecording(2)) << recorder.output();
  recorder.Signal(SIGTERM);
  EXPECT_EQ(recorder.WaitForEnd(20s), 0) << recorder.output();
  EXPECT_TRUE(Holds(ReadAll(), "recording_resumed"));
}

TEST_F(RecorderTest, ASecondOneStandsByAndTakesOver) {
  Process first(Command());
  ASSERT_TRUE(IsRecording()) << first.output();
  const std::string recording = status_.recording;
  Process second(Command());
  ASSERT_TRUE(second.WaitForOutput("stands by", 5s)) << second.output();
  first.Signal(SIGKILL);
  ASSERT_TRUE(second.WaitForOutput("takes over", 5s)) << second.output();
  ASSERT_TRUE(HearsStatus(recording_status_t::RECORDING, [&](const recording_status_t& status) {
    return status.recording != recording;
  })) << second.output();
}

TEST_F(RecorderTest, SaysWhenThereCanBeNoFolder) {
  folder_ = "/proc/skein-recordings";
  Process recorder(Command());
  ASSERT_TRUE(HearsStatus(recording_status_t::INTERRUPTED, [](const recording_status_t& status) {
    return status.reason.find("there is no folder /proc/skein-recordings, and it cannot be made") !=
           std::string::npos;
  })) << recorder.output();
}

TEST_F(RecorderTest, RemovesItsOldestRecordingsBeyondTheQuotaAndNothingElse) {
  std::string oldest;
  for (int i = 0; i < 3; ++i) {
    Process recorder(Command());
    ASSERT_TRUE(IsRecording()) << recorder.output();
    if (i == 0) oldest = status_.recording;
    recorder.Signal(SIGTERM);
    ASSERT_EQ(recorder.WaitForEnd(20s), 0) << recorder.output();
  }
  const fs::path foreign = folder_ + "/flight-20200101-000000.lcm";
  fs::copy(folder_ + "/" + oldest, foreign);
  Process recorder(Command({"--keep-free-gb", "0", "--quota-gb", "0"}));
  ASSERT_TRUE(IsRecording()) << recorder.output();
  EXPECT_FALSE(fs::exists(folder_ + "/" + oldest));
  EXPECT_TRUE(fs::exists(foreign));
  EXPECT_TRUE(fs::exists(folder_ + "/" + status_.recording));
}

}  // namespace
}  // namespace skein::testing
