#include "recorder/recording.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "recording/card.h"
#include "unit/recorder/folder_for_tests.h"

namespace skein::recorder::testing {
namespace {

namespace fs = std::filesystem;

constexpr bus::Utime kStart = 1'795'618'000'000'000;

Recording Make(const Folder& folder) {
  return {folder.path / "logs", "triangle", Card{"Triangle", kStart, "udpm://x", {}},
          folder.path / "now.lcm"};
}

bool IsLocked(const fs::path& card) {
  const int fd = open(card.c_str(), O_RDONLY);
  const bool locked = flock(fd, LOCK_EX | LOCK_NB) != 0;
  close(fd);
  return locked;
}

TEST(PartName, CountsBehindTheName) {
  EXPECT_EQ(PartName("a.lcm", 0), "a.lcm");
  EXPECT_EQ(PartName("a.lcm", 1), "a.lcm.01");
  EXPECT_EQ(PartName("a.lcm", 100), "a.lcm.100");
}

TEST(FileStem, HasNothingThatAShellMinds) {
  EXPECT_EQ(FileStem("Link drop (paper, section IV)"), "link-drop-paper-section-iv");
  EXPECT_EQ(FileStem("paper-assembly"), "paper-assembly");
  EXPECT_EQ(FileStem("../../etc/passwd"), "etc-passwd");
  EXPECT_EQ(FileStem("\xE6\xB5\x8B\xE8\xAF\x95"), "flight");
  EXPECT_EQ(FileStem(""), "flight");
  EXPECT_LE(FileStem(std::string(5000, 'x')).size(), 80U);
}

TEST(RecordingTest, LeadsFromPartToPartAndPutsThemOnItsCard) {
  const Folder folder;
  Recording recording = Make(folder);
  EXPECT_TRUE(recording.name().starts_with("triangle-2026")) << recording.name();
  recording.NextPart();
  Append(recording.way_in(), Content(1));
  recording.Look();
  recording.NextPart();
  Append(recording.way_in(), Content(2, 500));
  recording.Look();
  EXPECT_EQ(recording.bytes(), 1500);
  EXPECT_EQ(recording.part(), recording.name() + ".01");
  EXPECT_EQ(fs::file_size(folder.path / "logs" / recording.name()), 1000U);
  ASSERT_EQ(recording.card().parts.size(), 2U);
  EXPECT_EQ(recording.card().parts[1].begins, BeginOf(folder.path / "logs" / recording.part()));
}

TEST(RecordingTest, TakesTheSamePartAgainWhenNothingWasWritten) {
  const Folder folder;
  Recording recording = Make(folder);
  recording.NextPart();
  Append(recording.way_in(), "");
  recording.Look();
  recording.NextPart();
  EXPECT_EQ(recording.parts(), 1);
}

TEST(RecordingTest, NeverWritesIntoAFileThatIsThere) {
  const Folder folder;
  std::string name;
  {
    Recording recording = Make(folder);
    name = recording.name();
    Append(folder.path / "logs" / PartName(name, 1), "somebody else's");
    recording.NextPart();
    Append(recording.way_in(), Content(1));
    recording.Look();
    recording.NextPart();
    EXPECT_EQ(recording.part(), PartName(name, 2));
  }
  EXPECT_NE(Make(folder).name(), name) << "of the same second";
}

TEST(RecordingTest, IsRenamedWhileItIsWritten) {
  const Folder folder;
  Recording recording = Make(folder);
  recording.NextPart();
  std::ofstream writer(recording.way_in(), std::ios::app);
  writer << Content(1) << std::flush;
  recording.Look();
  const std::string before = recording.name();
  recording.Rename("crossing", "Crossing");
  writer << Content(2) << std::flush;
  recording.Look();
  EXPECT_EQ(recording.bytes(), 2000);
  EXPECT_TRUE(recording.name().starts_with("crossing-"));
  EXPECT_FALSE(fs::exists(folder.path / "logs" / before));
  EXPECT_FALSE(fs::exists(skein::recording::CardOf(folder.path / "logs" / before)));
  EXPECT_TRUE(IsLocked(skein::recording::CardOf(folder.path / "logs" / recording.name())));
}

TEST(RecordingTest, LocksItsCardForAsLongAsItIsWritten) {
  const Folder folder;
  fs::path card;
  {
    Recording recording = Make(folder);
    card = skein::recording::CardOf(folder.path / "logs" / recording.name());
    EXPECT_TRUE(IsLocked(card));
    recording.NextPart();
    Append(recording.way_in(), Content(1));
    recording.Look();
    EXPECT_TRUE(IsLocked(card)) << "written anew";
  }
  EXPECT_FALSE(IsLocked(card));
}

}  // namespace
}  // namespace skein::recorder::testing
