#include "bridge/byte_range.h"

#include <gtest/gtest.h>

namespace skein::bridge {
namespace {

constexpr std::uint64_t kSize = 1000;

void ExpectPart(std::string_view header, std::uint64_t first, std::uint64_t length) {
  const ByteRange range = ParseByteRange(header, kSize);
  EXPECT_EQ(range.kind, ByteRange::Kind::kPart) << header;
  EXPECT_EQ(range.first, first) << header;
  EXPECT_EQ(range.length, length) << header;
}

TEST(ByteRangeTest, ReadsTheThreeForms) {
  ExpectPart("bytes=0-0", 0, 1);
  ExpectPart("bytes=0-126", 0, 127);
  ExpectPart("bytes=990-", 990, 10);
  ExpectPart("bytes=-10", 990, 10);
}

TEST(ByteRangeTest, EndsWithTheFile) {
  ExpectPart("bytes=0-16383", 0, kSize);
  ExpectPart("bytes=999-18446744073709551615", 999, 1);
  ExpectPart("bytes=-5000", 0, kSize);
}

TEST(ByteRangeTest, SaysWhatLiesBehindTheEnd) {
  for (const char* header : {"bytes=1000-", "bytes=1000-2000", "bytes=18446744073709551615-", "bytes=-0"}) {
    EXPECT_EQ(ParseByteRange(header, kSize).kind, ByteRange::Kind::kBeyond) << header;
  }
  EXPECT_EQ(ParseByteRange("bytes=0-", 0).kind, ByteRange::Kind::kBeyond);
  EXPECT_EQ(ParseByteRange("bytes=-1", 0).kind, ByteRange::Kind::kBeyond);
}

TEST(ByteRangeTest, PassesOverWhatItNeedNotUnderstand) {
  for (const char* header :
       {"", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=5-4", "bytes=0-1,5-6", "items=0-1",
        "bytes= 0-1", "bytes=+1-2", "bytes=1--2", "bytes=0x1-2", "bytes=18446744073709551616-"}) {
    EXPECT_EQ(ParseByteRange(header, kSize).kind, ByteRange::Kind::kWhole) << header;
  }
}

}  // namespace
}  // namespace skein::bridge
