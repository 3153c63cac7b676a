#include "playback/recording_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "unit/playback/recorded_flights.h"

namespace skein::playback {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* kMagic = "\xED\xA1\xDA\x01";

class RecordingFolderTest : public testing::Test {
 protected:
  /// Not written to for an hour.
  fs::path Put(const std::string& name, const std::string& content = kMagic) {
    fs::path file = folder_.path() / name;
    std::ofstream(file, std::ios::binary) << content;
    fs::last_write_time(file, fs::file_time_type::clock::now() - 1h);
    return file;
  }
  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const RecordingFiles& files : FindRecordings(folder_.path())) names.push_back(files.name);
    return names;
  }
  std::optional<RecordingFiles> Find(const std::string& name) const {
    return FindRecording(folder_.path(), name, false);
  }

  FreshFolder folder_;
};

TEST_F(RecordingFolderTest, ListsLogsByNameAndByWhatTheyBeginWith) {
  for (const char* name : {"a.lcm", "a.lcm.01", "b.lcm.00", "b.lcm.01", "plain", ".hidden.lcm", "a.lcm.json"})
    Put(name);
  Put("notes.txt", "no log");
  fs::create_symlink(folder_.path() / "a.lcm", folder_.path() / "link.lcm");
  EXPECT_EQ(Names(), (std::vector<std::string>{"a.lcm", "b.lcm", "plain"}));
  EXPECT_EQ(Find("b.lcm")->parts.size(), 2U);
}

TEST_F(RecordingFolderTest, FindsNothingThatIsNotListed) {
  Put("a.lcm");
  Put("a.lcm.01");
  Put("notes.txt", "no log");
  Put(".hidden.lcm");
  for (const char* name :
       {"", "a.lcm.01", ".", "..", "../a.lcm", "./a.lcm", "notes.txt", ".hidden.lcm", "b.lcm"}) {
    EXPECT_FALSE(Find(name)) << name;
  }
  EXPECT_TRUE(Find("a.lcm"));
}

TEST_F(RecordingFolderTest, LeavesWhatIsNoCardWhereItIs) {
  Put("hundred");
  const fs::path scenario = Put("hundred.json", R"({"name": "hundred", "vehicles": []})");
  EXPECT_EQ(RemoveRecording(folder_.path(), *Find("hundred")), "");
  EXPECT_TRUE(Names().empty());
  EXPECT_TRUE(fs::exists(scenario));
}

TEST_F(RecordingFolderTest, RemovesTheCardOfFlightRecorder) {
  Put("a.lcm");
  Put("a.lcm.json", R"({"written_by": "flight-recorder 0.1.0"})");
  EXPECT_EQ(RemoveRecording(folder_.path(), *Find("a.lcm")), "");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(RecordingFolderTest, TakesWhatHasJustChangedForOneThatIsWrittenUnlessACardSaysOtherwise) {
  const fs::path log = Put("a.lcm");
  fs::last_write_time(log, fs::file_time_type::clock::now());
  EXPECT_TRUE(Find("a.lcm")->recording_now);
  Put("a.lcm.json", R"({"channels": []})");
  EXPECT_TRUE(Find("a.lcm")->recording_now) << "somebody else's file proves nothing";
  const fs::path card = Put("a.lcm.json", R"({"written_by": "flight-recorder 0.1.0"})");
  EXPECT_FALSE(Find("a.lcm")->recording_now);
  const int holder = open(card.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(holder, LOCK_EX | LOCK_NB), 0);
  EXPECT_TRUE(Find("a.lcm")->recording_now);
  close(holder);
}

}  // namespace
}  // namespace skein::playback
