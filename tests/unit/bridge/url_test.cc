#include "bridge/url.h"

#include <gtest/gtest.h>

namespace skein::bridge {
namespace {

TEST(Url, IsDecodedOnceAndRefusedWhereMalformed) {
  EXPECT_EQ(PercentDecoded("a%20b%2Fc"), "a b/c");
  EXPECT_EQ(PercentDecoded("%252e"), "%2e");
  EXPECT_EQ(PercentDecoded(""), "");
  for (const char* bad : {"%", "%2", "%zz", "%2x", "%00", "a%0Ab"}) EXPECT_FALSE(PercentDecoded(bad)) << bad;
}

TEST(Url, EncodesWhatADecoderGivesBack) {
  const std::string text = "flight 1/\u00e4&=%.lcm";
  EXPECT_EQ(PercentEncoded("flight 1.lcm"), "flight%201.lcm");
  EXPECT_EQ(PercentDecoded(PercentEncoded(text)), text);
}

TEST(Url, FindsValuesOfAQuery) {
  EXPECT_EQ(QueryOf("/live?recording=a%20b&x"), "recording=a%20b&x");
  EXPECT_EQ(QueryOf("/live"), "");
  EXPECT_EQ(QueryValue("recording=a%20b&x=1", "recording"), "a b");
  EXPECT_EQ(QueryValue("x=1", "recording"), std::nullopt);
  EXPECT_EQ(QueryValue("recording", "recording"), "");
  EXPECT_EQ(QueryValue("recording=%zz", "recording"), std::nullopt);
  EXPECT_EQ(QueryWithout("a=1&recording=x&b=2&at=3", {"recording", "at"}), "a=1&b=2");
}

}  // namespace
}  // namespace skein::bridge
