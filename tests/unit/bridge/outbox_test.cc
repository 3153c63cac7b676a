#include "bridge/outbox.h"

#include <gtest/gtest.h>

namespace skein::bridge {
namespace {

std::string Next(Outbox& outbox) {
  const auto frame = outbox.Pop();
  return frame ? *frame->bytes : "nothing";
}

TEST(Outbox, GivesFramesInTheOrderInWhichTheyCame) {
  Outbox outbox;
  EXPECT_TRUE(outbox.Push(TextFrame("a")));
  EXPECT_TRUE(outbox.Push(TextFrame("b", "key")));
  EXPECT_TRUE(outbox.Push(TextFrame("c")));
  EXPECT_EQ(Next(outbox), "a");
  EXPECT_EQ(Next(outbox), "b");
  EXPECT_EQ(Next(outbox), "c");
  EXPECT_EQ(Next(outbox), "nothing");
}

TEST(Outbox, PutsTheNewestInThePlaceOfAnOlderOneOfItsKey) {
  Outbox outbox;
  outbox.Push(BinaryFrame("old motion", "motion"));
  outbox.Push(TextFrame("event"));
  outbox.Push(BinaryFrame("new motion", "motion"));
  EXPECT_EQ(outbox.waiting_bytes(), 15u);
  EXPECT_EQ(Next(outbox), "new motion");
  EXPECT_EQ(Next(outbox), "event");
  EXPECT_EQ(Next(outbox), "nothing");
  EXPECT_EQ(outbox.waiting_bytes(), 0u);
}

TEST(Outbox, GivesASlowFrameItsTurnWhateverOthersPush) {
  Outbox outbox;
  outbox.Push(BinaryFrame("motion 0", "motion"));
  outbox.Push(BinaryFrame("status 0", "status"));
  EXPECT_EQ(Next(outbox), "motion 0");
  for (int i = 1; i < 10; ++i) outbox.Push(BinaryFrame("motion " + std::to_string(i), "motion"));
  EXPECT_EQ(Next(outbox), "status 0");
  EXPECT_EQ(Next(outbox), "motion 9");
}

TEST(Outbox, NeverDropsFramesWithoutAKey) {
  Outbox outbox;
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(outbox.Push(TextFrame(std::to_string(i))));
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(Next(outbox), std::to_string(i));
}

TEST(Outbox, DropsWhatAResetMakesWorthlessButNoAnswer) {
  Outbox outbox;
  outbox.Push(TextFrame("event before"));
  outbox.Push(BinaryFrame("motion before", "motion"));
  LiveFrame answer = TextFrame("ack");
  answer.answer = true;
  outbox.Push(answer);
  outbox.Push(ResetFrame());
  outbox.Push(BinaryFrame("motion", "motion"));
  EXPECT_EQ(Next(outbox), "ack");
  EXPECT_EQ(Next(outbox), R"({"type":"reset"})");
  EXPECT_EQ(Next(outbox), "motion");
  EXPECT_EQ(Next(outbox), "nothing");
  EXPECT_EQ(outbox.waiting_bytes(), 0u);
}

TEST(Outbox, RefusesMoreThanFourMebibytesButTakesAReplacement) {
  Outbox outbox;
  const auto big = [](char byte) {
    LiveFrame frame = TextFrame("", "big");
    frame.bytes = std::make_shared<const std::string>(Outbox::kMaxBytes, byte);
    return frame;
  };
  EXPECT_TRUE(outbox.Push(big('x')));
  EXPECT_FALSE(outbox.Push(TextFrame("y")));
  EXPECT_TRUE(outbox.Push(big('z')));
  EXPECT_EQ(outbox.waiting_bytes(), Outbox::kMaxBytes);
  EXPECT_EQ(Next(outbox).front(), 'z');
  EXPECT_TRUE(outbox.Push(TextFrame("y")));
}

}  // namespace
}  // namespace skein::bridge
