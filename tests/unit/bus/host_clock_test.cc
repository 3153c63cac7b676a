#include "bus/host_clock.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace skein::bus {
namespace {

namespace fs = std::filesystem;

class HostClockTest : public ::testing::Test {
 protected:
  HostClockTest() {
    std::string name = (fs::temp_directory_path() / "skein-clock-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    file_ = folder_ / "clock";
  }
  ~HostClockTest() override { fs::remove_all(folder_); }

  /// As if the wall clock had been so far ahead when the file was written.
  void Shift(Utime ahead) const {
    std::ifstream in(file_);
    std::string boot;
    Utime offset = 0;
    ASSERT_TRUE(in >> boot >> offset);
    std::ofstream(file_) << boot << " " << offset + ahead << "\n";
  }
  static Utime Wall() {
    return std::chrono::duration_cast<std::chrono::microseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
  }
  static constexpr Utime kAbout = kSecond / 2;

  fs::path folder_;
  fs::path file_;
};

TEST_F(HostClockTest, IsTheWallClockWhenNobodyIsThere) {
  const HostClock clock(file_);
  EXPECT_NEAR(clock.Now(), Wall(), kAbout);
  EXPECT_NEAR(clock.WallAhead(), 0, kAbout);
}

TEST_F(HostClockTest, IsThatOfThoseWhoAreThere) {
  const HostClock first(file_);
  Shift(-3600 * kSecond);  // the wall clock is an hour ahead of what they go by
  const HostClock second(file_);
  EXPECT_NEAR(second.Now(), Wall() - 3600 * kSecond, kAbout);
  EXPECT_NEAR(second.WallAhead(), 3600 * kSecond, kAbout);
}

TEST_F(HostClockTest, IsSetAnewOnceAllAreGone) {
  {
    const HostClock first(file_);
    Shift(3600 * kSecond);
  }
  const HostClock second(file_);
  EXPECT_NEAR(second.Now(), Wall(), kAbout);
}

TEST_F(HostClockTest, ThatCannotBeSharedIsOnesOwn) {
  EXPECT_NEAR(HostClock("").Now(), Wall(), kAbout);
  EXPECT_NEAR(HostClock(folder_ / "missing" / "clock").Now(), Wall(), kAbout);
  EXPECT_NEAR(HostClock(folder_).Now(), Wall(), kAbout);
  const HostClock first(file_);
  for (const std::string text : {"", "another-boot 12345\n", "no number\n"}) {
    std::ofstream(file_) << text;
    EXPECT_NEAR(HostClock(file_).Now(), Wall(), kAbout) << text;
  }
}

TEST_F(HostClockTest, FollowsNoLinkToAnotherFile) {
  std::ofstream(folder_ / "other") << "kept";
  fs::create_symlink(folder_ / "other", file_);
  EXPECT_NEAR(HostClock(file_).Now(), Wall(), kAbout);
  std::ifstream other(folder_ / "other");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(other), {}), "kept");
}

}  // namespace
}  // namespace skein::bus
