#include "recording/recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "unit/recording/log_maker.h"

namespace skein::recording {
namespace {

namespace fs = std::filesystem;

class RecordingTest : public testing::Test {
 protected:
  RecordingTest() : folder_(fs::path(testing::TempDir()) / ("skein-recording-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directory(folder_);
  }
  ~RecordingTest() override { fs::remove_all(folder_); }

  fs::path Write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  static std::vector<std::int64_t> Numbers(RecordingReader& reader) {
    std::vector<std::int64_t> numbers;
    while (const auto event = reader.Next()) numbers.push_back(event->number);
    return numbers;
  }

  fs::path folder_;
};

TEST_F(RecordingTest, JoinsItsPartsInTheirOrder) {
  const fs::path file = Write("flight.lcm", EventBytes(0, 1, "C", "a"));
  for (int part = 11; part > 0; --part) {
    Write("flight.lcm." + std::string(part < 10 ? "0" : "") + std::to_string(part),
          EventBytes(part, 1, "C", "a"));
  }
  Write("flight.lcm.json", "{}");
  Write("flight.lcm.skein-index", "x");
  Write("flight2.lcm.01", EventBytes(99, 1, "C", "a"));
  const Recording recording(file);
  EXPECT_EQ(recording.parts().size(), 12U);
  EXPECT_TRUE(recording.problems().empty());
  RecordingReader reader(recording);
  EXPECT_EQ(Numbers(reader), (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(reader.bytes_read(), recording.bytes());
  EXPECT_TRUE(reader.damage().empty());
}

TEST_F(RecordingTest, JoinsWhatLcmLoggerItselfHasSplit) {
  for (const char* part : {"00", "01"})
    Write(std::string("flight.lcm.") + part, EventBytes(part[1] - '0', 1, "C", "a"));
  const Recording recording(folder_ / "flight.lcm");
  EXPECT_TRUE(recording.problems().empty());
  RecordingReader reader(recording);
  EXPECT_EQ(Numbers(reader), (std::vector<std::int64_t>{0, 1}));
  // Beside a file of the very name it is one by itself.
  Write("flight.lcm", EventBytes(7, 1, "C", "a"));
  EXPECT_EQ(PartsOf(folder_ / "flight.lcm").size(), 2U);
  EXPECT_EQ(PartsOf(folder_ / "flight.lcm.00").size(), 1U);
}

TEST_F(RecordingTest, GroupsTheFilesOfAFolder) {
  const auto groups =
      GroupParts({"a.lcm.01", "b.lcm", "a.lcm.00", "b.lcm.00", "b.lcm.100", "b.lcm.09", "c.lcm.0"});
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups.at("a.lcm"), (std::vector<fs::path>{"a.lcm.00", "a.lcm.01"}));
  EXPECT_EQ(groups.at("b.lcm"), (std::vector<fs::path>{"b.lcm", "b.lcm.09", "b.lcm.100"}));
  EXPECT_EQ(groups.at("b.lcm.00"), std::vector<fs::path>{"b.lcm.00"});
  EXPECT_EQ(groups.at("c.lcm.0"), std::vector<fs::path>{"c.lcm.0"});
}

TEST_F(RecordingTest, OpensOnePartAlone) {
  Write("flight.lcm", EventBytes(0, 1, "C", "a"));
  const fs::path part = Write("flight.lcm.01", EventBytes(1, 1, "C", "a"));
  const Recording recording(part);
  RecordingReader reader(recording);
  EXPECT_EQ(Numbers(reader), std::vector<std::int64_t>{1});
}

TEST_F(RecordingTest, GoesOnWithoutPartsThatAreGone) {
  Write("flight.lcm.02", EventBytes(2, 1, "C", "a"));
  Write("flight.lcm.05", EventBytes(5, 1, "C", "a"));
  const Recording recording(folder_ / "flight.lcm");
  RecordingReader reader(recording);
  EXPECT_EQ(Numbers(reader), (std::vector<std::int64_t>{2, 5}));
  EXPECT_EQ(recording.problems(),
            (std::vector<std::string>{"parts 0 to 1 are missing", "parts 3 to 4 are missing"}));
}

TEST_F(RecordingTest, TellsOfPartsThatAreNoLog) {
  const fs::path file = Write("flight.lcm", EventBytes(0, 1, "C", "a"));
  Write("flight.lcm.01", "");
  const Recording recording(file);
  ASSERT_EQ(recording.problems().size(), 1U);
  EXPECT_NE(recording.problems()[0].find("flight.lcm.01: is empty"), std::string::npos);
}

TEST_F(RecordingTest, SaysWhatIsDamagedInWhichPart) {
  const fs::path file = Write("flight.lcm", EventBytes(0, 1, "C", "a").append("junk"));
  const fs::path part =
      Write("flight.lcm.01", EventBytes(1, 2, "C", "a") + EventBytes(2, 3, "C", "a").substr(0, 20));
  const Recording recording(file);
  RecordingReader reader(recording);
  EXPECT_EQ(Numbers(reader), (std::vector<std::int64_t>{0, 1}));
  const auto damage = reader.damage();
  ASSERT_EQ(damage.size(), 2U);
  EXPECT_EQ(damage[0].file, file);
  EXPECT_EQ(damage[0].damage.bytes, 4U);
  EXPECT_EQ(damage[1].file, part);
  EXPECT_EQ(damage[1].damage.reason, "the last event is cut short");
  EXPECT_EQ(reader.damaged_bytes(), 24U);
}

TEST_F(RecordingTest, RefusesWhatIsNoRecording) {
  EXPECT_THROW(Recording(folder_ / "missing.lcm"), std::runtime_error);
  EXPECT_THROW(Recording{folder_}, std::runtime_error);
}

}  // namespace
}  // namespace skein::recording
