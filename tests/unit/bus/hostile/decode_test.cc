#include "bus/decode.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "unit/bus/hostile/allocations.h"
#include "unit/bus/hostile/samples.h"
#include "unit/bus/hostile/schema.h"
#include "unit/bus/hostile/types.h"

namespace skein::bus::testing {
namespace {

template <typename Message>
class DecodeTest : public ::testing::Test {
 protected:
  /// Decodes and checks that no more memory was asked for than the size of the message allows.
  static bool Decodes(const std::vector<std::uint8_t>& bytes, std::size_t size) {
    const std::size_t before = AllocatedBytes();
    const auto message = Decode<Message>(bytes.data(), size);
    const std::size_t asked = AllocatedBytes() - before;
    EXPECT_LE(asked, 6 * bytes.size() + 1000);
    return message.has_value();
  }
  static bool Decodes(const std::vector<std::uint8_t>& bytes) { return Decodes(bytes, bytes.size()); }

  static bool DecodesAndIsValid(const std::vector<std::uint8_t>& bytes) {
    const auto message = Decode<Message>(bytes.data(), bytes.size());
    return message && Valid(*message);
  }

  std::vector<Place> Places(Place::Kind kind) const {
    static const Schema schema(SKEIN_SOURCE_DIR "/lcmtypes");
    auto places = schema.Places(Message::getTypeName(), good_);
    std::erase_if(places, [kind](const Place& place) { return place.kind != kind; });
    return places;
  }

  const std::vector<std::uint8_t> good_ = Encode(Sample<Message>());
};

TYPED_TEST_SUITE(DecodeTest, Messages);

TYPED_TEST(DecodeTest, TakesAGoodMessage) {
  EXPECT_TRUE(this->Decodes(this->good_));
  EXPECT_TRUE(this->DecodesAndIsValid(this->good_));
  EXPECT_EQ(Encode(*Decode<TypeParam>(this->good_.data(), this->good_.size())), this->good_);
}

TYPED_TEST(DecodeTest, RefusesEveryTruncation) {
  for (std::size_t size = 0; size < this->good_.size(); ++size) {
    // Really cut off, so that a sanitizer sees any look beyond.
    const std::vector<std::uint8_t> cut(this->good_.begin(),
                                        this->good_.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(this->Decodes(cut)) << size << " of " << this->good_.size() << " bytes";
  }
}

TYPED_TEST(DecodeTest, RefusesBytesAfterTheEnd) {
  auto bytes = this->good_;
  bytes.push_back(0);
  EXPECT_FALSE(this->Decodes(bytes));
}

TYPED_TEST(DecodeTest, RefusesASizeThatCannotBe) {
  EXPECT_FALSE(this->Decodes(this->good_, 4'294'967'282));  // what LCM 1.3.1 says of a datagram of 8 bytes
  EXPECT_FALSE(this->Decodes(this->good_, kMaxEncodedBytes<TypeParam> + 1));
}

TYPED_TEST(DecodeTest, RefusesEveryHostileLength) {
  auto places = this->Places(Place::Kind::kArrayLength);
  const auto strings = this->Places(Place::Kind::kStringLength);
  places.insert(places.end(), strings.begin(), strings.end());
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  for (const Place& place : places) {
    for (const std::int64_t length :
         {std::int64_t{-1}, -kMost - 1, -kMost, std::int64_t{-8}, kMost, kMost - 1, kMost / 8, kMost / 8 + 1,
          std::int64_t{1} << 29, std::int64_t{1} << 28, std::int64_t{1'000'000}, place.too_large,
          place.length + 1, place.length - 1}) {
      auto bytes = this->good_;
      WriteInt32(bytes, place.offset, static_cast<std::int32_t>(length));
      EXPECT_EQ(this->Decodes(bytes), length == place.length) << place.field << " of length " << length;
    }
  }
}

TYPED_TEST(DecodeTest, SurvivesAnyFourBytesAnywhere) {
  for (std::size_t offset = 0; offset + 4 <= this->good_.size(); ++offset) {
    for (const std::int32_t value :
         {-1, 0, 1, 0x7FFFFFFF, static_cast<std::int32_t>(0x80000000), 0x00FFFFFF, 0x10000000}) {
      auto bytes = this->good_;
      WriteInt32(bytes, offset, value);
      this->Decodes(bytes);
      this->DecodesAndIsValid(bytes);
    }
  }
}

TYPED_TEST(DecodeTest, RefusesNumbersThatAreNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Place& place : this->Places(Place::Kind::kDouble)) {
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e300, -1e300}) {
      auto bytes = this->good_;
      WriteDouble(bytes, place.offset, value);
      EXPECT_FALSE(this->DecodesAndIsValid(bytes)) << place.field << " = " << value;
    }
  }
}

TYPED_TEST(DecodeTest, RefusesBooleansOtherThanZeroAndOne) {
  for (const Place& place : this->Places(Place::Kind::kBoolean)) {
    for (const int value : {2, 0x7F, 0x80, 0xFF}) {
      auto bytes = this->good_;
      bytes[place.offset] = static_cast<std::uint8_t>(value);
      EXPECT_FALSE(this->Decodes(bytes)) << place.field << " = " << value;
    }
  }
}

TYPED_TEST(DecodeTest, RefusesStringsThatAreNotOneTerminatedUtf8Text) {
  for (const Place& place : this->Places(Place::Kind::kStringLength)) {
    if (place.length < 3) continue;
    const std::size_t first = place.offset + 4;
    const std::size_t nul = first + static_cast<std::size_t>(place.length) - 1;
    const auto with = [&](std::size_t offset, int value) {
      auto bytes = this->good_;
      bytes[offset] = static_cast<std::uint8_t>(value);
      return bytes;
    };
    EXPECT_FALSE(this->Decodes(with(nul, 'x'))) << place.field << " without its NUL";
    EXPECT_FALSE(this->Decodes(with(first, 0))) << place.field << " with a NUL within";
    EXPECT_FALSE(this->DecodesAndIsValid(with(first, 0x1B))) << place.field << " with an escape character";
    EXPECT_FALSE(this->DecodesAndIsValid(with(first, 0x80)))
        << place.field << " with a stray continuation byte";
    EXPECT_FALSE(this->DecodesAndIsValid(with(nul - 1, 0xC3))) << place.field << " with half a character";
    EXPECT_FALSE(this->DecodesAndIsValid(with(first, 0xFF)))
        << place.field << " with a byte that UTF-8 lacks";
  }
}

}  // namespace
}  // namespace skein::bus::testing
