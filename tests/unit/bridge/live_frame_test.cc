#include "bridge/live_frame.h"

#include <gtest/gtest.h>

#include <iostream>
#include <random>
#include <stdexcept>

namespace skein::bridge {
namespace {

TEST(LiveFrame, IsSentAsItIsWhenItIsSmall) {
  const std::string text(kPackFrom - 1, 'x');
  const LiveFrame frame = TextFrame(text, "key");
  EXPECT_EQ(*frame.bytes, text);
  EXPECT_FALSE(frame.binary);
  EXPECT_EQ(frame.key, "key");
  EXPECT_EQ(Unpacked(frame).bytes, frame.bytes);
}

TEST(LiveFrame, OfALargeTextIsSmallerAndTheSameAgain) {
  std::string text;
  for (int i = 0; text.size() < 20'000; ++i) text += R"({"vehicle_id":)" + std::to_string(i) + "},";
  const LiveFrame frame = TextFrame(text, "statuses");
  EXPECT_TRUE(frame.binary);
  EXPECT_EQ(frame.key, "statuses");
  EXPECT_EQ(frame.bytes->at(0), kPackedKind);
  EXPECT_EQ(frame.bytes->at(2), 0);
  EXPECT_LT(frame.bytes->size(), text.size() / 3);
  EXPECT_EQ(*Unpacked(frame).bytes, text);
  EXPECT_FALSE(Unpacked(frame).binary);
}

TEST(LiveFrame, HoldsNoMoreThanItsSizeWhileItWaits) {
  const LiveFrame frame = TextFrame(std::string(60'000, 'x'));
  EXPECT_LT(frame.bytes->size(), 1000U);
  EXPECT_LT(frame.bytes->capacity(), 2 * frame.bytes->size());
}

TEST(LiveFrame, OfColumnsOfAnyLengthIsTheSameAgain) {
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  for (std::size_t size = kPackFrom; size < kPackFrom + 9; ++size) {
    std::string bytes(size, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const LiveFrame frame = BinaryFrame(bytes, "motion");
    EXPECT_EQ(frame.bytes->at(2), 1);
    EXPECT_EQ(*Unpacked(frame).bytes, bytes) << size;
    EXPECT_TRUE(Unpacked(frame).binary);
  }
}

TEST(LiveFrame, OfAnyTextIsTheSameAgain) {
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  for (int trial = 0; trial < 1000; ++trial) {
    // Letters, and pieces of what came before.
    std::string text(1, 'x');
    while (text.size() < kPackFrom + trial) {
      if (random() % 3 == 0) {
        text += text.substr(random() % text.size(), 3 + random() % 25);
      } else {
        text.push_back(static_cast<char>('a' + random() % (1 + trial % 26)));
      }
    }
    ASSERT_EQ(*Unpacked(TextFrame(text)).bytes, text) << "trial " << trial;
  }
}

TEST(LiveFrame, SortsTheBytesOfWords) {
  // Numbers that rise by one: sorted, only every fourth byte is news.
  std::string bytes;
  for (std::uint32_t i = 0; i < 1000; ++i) bytes.append(reinterpret_cast<const char*>(&i), sizeof i);
  EXPECT_LT(BinaryFrame(bytes, "motion").bytes->size(), bytes.size() / 4);
  EXPECT_GT(TextFrame(bytes).bytes->size(), bytes.size() / 4);
}

TEST(LiveFrame, IsRefusedWhenItIsPackedAndNotWhole) {
  const std::string packed = *TextFrame(std::string(5000, 'x')).bytes;
  for (const std::size_t size : {std::size_t{1}, std::size_t{7}, packed.size() / 2}) {
    const auto part = std::make_shared<const std::string>(packed.substr(0, size));
    EXPECT_THROW(Unpacked({part, true, ""}), std::invalid_argument) << size;
  }
}

}  // namespace
}  // namespace skein::bridge
