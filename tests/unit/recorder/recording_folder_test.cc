#include "recorder/recording_folder.h"

#include <gtest/gtest.h>

#include <memory>

#include "recorder/recording.h"
#include "unit/recorder/folder_for_tests.h"

namespace skein::recorder::testing {
namespace {

namespace fs = std::filesystem;

constexpr bus::Utime kStart = 1'795'618'000'000'000;

class MakeRoomTest : public ::testing::Test {
 protected:
  /// A recording of so many parts of 1000 bytes, begun so many minutes after the first. It runs until it is
  /// destroyed.
  std::unique_ptr<Recording> Record(int minute, int parts) {
    auto recording = std::make_unique<Recording>(
        folder_.path, "flight", Card{"", kStart + minute * 60 * bus::kSecond, "udpm://x", {}},
        links_.path / ("link" + std::to_string(minute)));
    for (int part = 0; part < parts; ++part) {
      recording->NextPart();
      Append(recording->way_in(), Content(100 * minute + part));
      recording->Look();
    }
    return recording;
  }
  /// The same, and it is over.
  std::string Recorded(int minute, int parts) { return Record(minute, parts)->name(); }

  Removal Make(std::int64_t quota_bytes) const { return MakeRoom(folder_.path, {quota_bytes, 0}); }
  bool Has(const std::string& file) const { return fs::exists(folder_.path / file); }

  Folder folder_;
  Folder links_;
};

TEST_F(MakeRoomTest, RemovesTheOldestPartsUntilTheRestFits) {
  const std::string first = Recorded(1, 2);
  const std::string second = Recorded(2, 2);
  Append(folder_.path / (first + ".skein-index"), "index");
  const Removal removal = Make(2500);
  EXPECT_EQ(removal.files, (std::vector<std::string>{first, first + ".01"}));
  EXPECT_EQ(removal.bytes, 2000);
  EXPECT_FALSE(removal.over_quota);
  EXPECT_FALSE(Has(first + ".json")) << "the card goes with the last part";
  EXPECT_FALSE(Has(first + ".skein-index"));
  EXPECT_TRUE(Has(second) && Has(second + ".01") && Has(second + ".json"));
  EXPECT_TRUE(Make(2500).files.empty());
  EXPECT_EQ(Make(1500).files, (std::vector<std::string>{second}));
  EXPECT_TRUE(Has(second + ".json")) << "a part is left";
}

TEST_F(MakeRoomTest, LeavesARunningRecordingWhole) {
  const auto running = Record(1, 3);
  const std::string later = Recorded(2, 1);
  const Removal removal = Make(0);
  EXPECT_EQ(removal.files, std::vector<std::string>{later});
  EXPECT_TRUE(removal.over_quota);
  EXPECT_TRUE(Has(running->name()) && Has(running->name() + ".01") && Has(running->name() + ".02"));
}

TEST_F(MakeRoomTest, RemovesNothingThatStandsOnNoCard) {
  const std::string name = Recorded(1, 1);
  Append(folder_.path / (name + ".01"), Content(7));
  Append(folder_.path / "flight-20200101-000000.lcm", Content(8));
  fs::create_directory(folder_.path / "flight-20200101-000001.lcm");
  EXPECT_EQ(Make(0).files, std::vector<std::string>{name});
  EXPECT_TRUE(Has(name + ".01"));
  EXPECT_TRUE(Has("flight-20200101-000000.lcm"));
}

TEST_F(MakeRoomTest, RemovesNothingThatBeginsOtherwiseThanItsCardSays) {
  const std::string name = Recorded(1, 1);
  fs::remove(folder_.path / name);
  Append(folder_.path / name, Content(9));
  EXPECT_TRUE(Make(0).files.empty());
  EXPECT_TRUE(Has(name));
}

TEST_F(MakeRoomTest, FollowsNoPathAndNoLinkOutOfTheFolder) {
  const std::string name = Recorded(1, 1);
  const fs::path outside = links_.path / "outside.lcm";
  fs::rename(folder_.path / name, outside);
  fs::create_symlink(outside, folder_.path / name);
  EXPECT_TRUE(Make(0).files.empty());

  Append(folder_.path / "flight-x.lcm.json",
         R"({"written_by": "flight-recorder 1", "start_utime": 1, "parts": [{"file": ")" + outside.string() +
             R"(", "begins": ")" + BeginOf(outside) + R"("}]})");
  EXPECT_TRUE(Make(0).files.empty());
  EXPECT_TRUE(fs::exists(outside));
}

TEST_F(MakeRoomTest, MindsNoDamagedCards) {
  const std::string name = Recorded(1, 1);
  Append(folder_.path / "a.lcm.json", "");
  Append(folder_.path / "b.lcm.json", "[1, 2");
  Append(folder_.path / "c.lcm.json", R"({"written_by": "somebody"})");
  Append(folder_.path / "d.lcm.json",
         R"({"written_by": "flight-recorder 1", "start_utime": "x", "parts": 7})");
  EXPECT_EQ(Make(0).files, std::vector<std::string>{name});
}

TEST_F(MakeRoomTest, MakesRoomOnTheDiskAsWell) {
  const std::string name = Recorded(1, 1);
  const Removal removal = MakeRoom(folder_.path, {1'000'000, 1'000'000'000'000'000'000});
  EXPECT_EQ(removal.files, std::vector<std::string>{name});
  EXPECT_TRUE(removal.low);
  EXPECT_FALSE(removal.over_quota);
}

TEST_F(MakeRoomTest, CountsWhatItHasRemovedAsFree) {
  const std::string first = Recorded(1, 1);
  const std::string second = Recorded(2, 1);
  // Their removal frees nothing that the disk would tell, as with a file that somebody still reads.
  constexpr std::int64_t kSparse = 100'000'000'000;
  for (const std::string& name : {first, second}) fs::resize_file(folder_.path / name, kSparse);
  const std::int64_t keep_free = FreeBytes(folder_.path).value() + kSparse / 2;
  const Removal removal = MakeRoom(folder_.path, {10 * kSparse, keep_free});
  EXPECT_EQ(removal.files, std::vector<std::string>{first});
  EXPECT_FALSE(removal.low);
}

TEST(FreeBytes, AreThoseOfTheDiskOnWhichAFolderWouldBe) {
  const Folder folder;
  EXPECT_EQ(FreeBytes(folder.path / "not" / "yet").has_value(), true);
  EXPECT_EQ(MakeRoom(folder.path / "not" / "yet", {}).files.size(), 0U);
}

}  // namespace
}  // namespace skein::recorder::testing
