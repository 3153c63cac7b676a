#include "files/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <system_error>

namespace skein::files {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  AtomicFileTest() { fs::create_directories(folder_); }
  ~AtomicFileTest() override { fs::remove_all(folder_); }

  static std::string Content(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::size_t Files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_ = fs::temp_directory_path() / ("skein_atomic_" + std::to_string(getpid()));
};

TEST_F(AtomicFileTest, TheNewTakesThePlaceOfTheOldAndNothingElseIsLeft) {
  const fs::path file = folder_ / "state";
  WriteAtomically(file, "old");
  WriteAtomically(file, std::string(3'000'000, 'n'), 0600);
  EXPECT_EQ(Content(file), std::string(3'000'000, 'n'));
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  EXPECT_EQ(Files(), 1u);
}

TEST_F(AtomicFileTest, TheNewBelongsToWhoHadTheOld) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  const fs::path file = folder_ / "tokens";
  WriteAtomically(file, "old");
  ASSERT_EQ(chown(file.c_str(), 65534, 65533), 0);
  WriteAtomically(file, "new", 0600);
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, 65534u);
  EXPECT_EQ(status.st_gid, 65533u);
  EXPECT_EQ(status.st_mode & 07777, 0600u);
}

TEST_F(AtomicFileTest, WhenItCannotBeWrittenTheOldIsStillThereAndTheReasonIsTold) {
  // A folder cannot be replaced by a file.
  const fs::path file = folder_ / "state";
  fs::create_directory(file);
  try {
    WriteAtomically(file, "new");
    FAIL() << "it was written";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
  }
  EXPECT_TRUE(fs::is_directory(file));
  EXPECT_EQ(Files(), 1u);
  EXPECT_THROW(WriteAtomically("/dev/full/state", "new"), std::system_error);
}

}  // namespace
}  // namespace skein::files
