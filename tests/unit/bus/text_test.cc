#include "bus/text.h"

#include <gtest/gtest.h>

namespace skein::bus {
namespace {

TEST(Shortened, LeavesWhatFits) { EXPECT_EQ(Shortened("Gruß", 5), "Gruß"); }

TEST(Shortened, CutsBetweenCharactersAndSaysSo) {
  EXPECT_EQ(Shortened("abcdefgh", 6), "abc…");
  EXPECT_EQ(Shortened("abßdefgh", 6), "ab…") << "ß has two bytes";
  EXPECT_EQ(Shortened(std::string(kLongestText + 1, 'x')).size(), kLongestText);
}

}  // namespace
}  // namespace skein::bus
