#include "core/alarm_register.h"
#include "unit/core/time_steps.h"

#include <gtest/gtest.h>

namespace skein {
namespace {

using Result = AlarmRegister::Result;

AlarmCondition Link(int id, AlertLevel severity = AlertLevel::kWarning) {
  return {"link:" + std::to_string(id), severity, "link of UAV" + std::to_string(id), id};
}

AlarmState StateOf(const AlarmRegister& alarms, std::int64_t id) { return alarms.Find(id)->state(); }

TEST(AlarmRegister, RaisesOnceForAsLongAsTheConditionLasts) {
  AlarmRegister alarms;
  alarms.Raise(10, Link(3));
  const std::int64_t revision = alarms.revision();
  alarms.Raise(20, Link(3));
  EXPECT_EQ(alarms.revision(), revision);
  ASSERT_EQ(alarms.open().size(), 1U);
  EXPECT_EQ(alarms.open()[0].id, 1);
  EXPECT_EQ(alarms.open()[0].raised_utime, 10);
  EXPECT_EQ(alarms.open()[0].state(), AlarmState::kUnacknowledged);
}

TEST(AlarmRegister, IsOverWhenAcknowledgedAndThenEnded) {
  AlarmRegister alarms;
  alarms.Raise(10, Link(3));
  EXPECT_EQ(alarms.Acknowledge(20, 1, "Ann"), Result::kDone);
  EXPECT_EQ(StateOf(alarms, 1), AlarmState::kAcknowledged);
  EXPECT_EQ(alarms.Acknowledge(21, 1, "Bob"), Result::kAlready);
  alarms.End(30, "link:3");
  EXPECT_TRUE(alarms.open().empty());
  ASSERT_EQ(alarms.history().size(), 1U);
  EXPECT_EQ(alarms.history()[0].acknowledged->by, "Ann");
  EXPECT_EQ(alarms.history()[0].ended_utime, 30);
  EXPECT_EQ(alarms.Acknowledge(40, 1, "Bob"), Result::kOver);
  EXPECT_EQ(alarms.Acknowledge(40, 9, "Bob"), Result::kUnknown);
}

TEST(AlarmRegister, StaysUntilAcknowledgedWhenItEndedUnseen) {
  AlarmRegister alarms;
  alarms.Raise(10, Link(3));
  alarms.End(20, "link:3");
  EXPECT_EQ(StateOf(alarms, 1), AlarmState::kEnded);
  alarms.Advance(1000 * kSecond);
  EXPECT_EQ(StateOf(alarms, 1), AlarmState::kEnded);
  EXPECT_EQ(alarms.Acknowledge(30, 1, "Ann"), Result::kDone);
  EXPECT_EQ(StateOf(alarms, 1), AlarmState::kOver);
}

TEST(AlarmRegister, ThatComesBackIsANewOccurrence) {
  AlarmRegister alarms;
  alarms.Raise(10, Link(3));
  alarms.End(20, "link:3");
  alarms.Raise(30, Link(3));
  ASSERT_EQ(alarms.open().size(), 1U);
  EXPECT_EQ(alarms.open()[0].id, 2);
  EXPECT_EQ(StateOf(alarms, 1), AlarmState::kOver);
  EXPECT_FALSE(alarms.Find(1)->acknowledged);
  // Who saw only the first one has not acknowledged the second.
  EXPECT_EQ(alarms.AcknowledgeUpTo(40, 1, "Ann"), 0);
  EXPECT_EQ(StateOf(alarms, 2), AlarmState::kUnacknowledged);

  alarms.Acknowledge(50, 2, "Ann");
  alarms.End(60, "link:3");
  alarms.Raise(70, Link(3));
  EXPECT_EQ(StateOf(alarms, 3), AlarmState::kUnacknowledged);
}

TEST(AlarmRegister, ThatBecomesWorseMustBeAcknowledgedAgain) {
  AlarmRegister alarms;
  alarms.Raise(10, Link(3, AlertLevel::kCaution));
  alarms.Acknowledge(20, 1, "Ann");
  alarms.Raise(30, Link(3, AlertLevel::kWarning));
  ASSERT_EQ(alarms.open().size(), 1U);
  EXPECT_EQ(alarms.open()[0].id, 2);
  EXPECT_EQ(alarms.open()[0].state(), AlarmState::kUnacknowledged);
  EXPECT_EQ(alarms.open()[0].condition.severity, AlertLevel::kWarning);
}

TEST(AlarmRegister, ThatBecomesBetterShowsTheWorstUntilAcknowledged) {
  AlarmRegister alarms;
  alarms.Raise(10, Link(3, AlertLevel::kWarning));
  alarms.Raise(20, Link(3, AlertLevel::kCaution));
  EXPECT_EQ(alarms.open()[0].condition.severity, AlertLevel::kWarning);
  alarms.Acknowledge(30, 1, "Ann");
  alarms.Raise(40, Link(3, AlertLevel::kCaution));
  EXPECT_EQ(alarms.open()[0].id, 1);
  EXPECT_EQ(alarms.open()[0].condition.severity, AlertLevel::kCaution);
  EXPECT_EQ(alarms.open()[0].state(), AlarmState::kAcknowledged);
}

TEST(AlarmRegister, ThatIsShelvedComesAndGoesUnseenUntilTheTimeIsOver) {
  AlarmRegister alarms;
  alarms.Raise(0, Link(3, AlertLevel::kCaution));
  EXPECT_EQ(alarms.Shelve(1, {60 * kSecond, "Ann"}), Result::kDone);
  EXPECT_EQ(StateOf(alarms, 1), AlarmState::kShelved);
  alarms.End(10 * kSecond, "link:3");
  EXPECT_EQ(StateOf(alarms, 1), AlarmState::kShelved);
  alarms.Raise(20 * kSecond, Link(3, AlertLevel::kCaution));
  EXPECT_EQ(StateOf(alarms, 2), AlarmState::kShelved);
  EXPECT_EQ(alarms.counts().on[2], 0);
  EXPECT_EQ(alarms.counts().unacknowledged[2], 0);
  alarms.Advance(60 * kSecond - 1);
  EXPECT_EQ(StateOf(alarms, 2), AlarmState::kShelved);
  alarms.Advance(60 * kSecond);
  EXPECT_EQ(StateOf(alarms, 2), AlarmState::kUnacknowledged);
}

TEST(AlarmRegister, ThatEndedOnTheShelfIsOverWhenItsTimeIs) {
  AlarmRegister alarms;
  alarms.Raise(0, Link(3));
  alarms.Shelve(1, {60 * kSecond, "Ann"});
  alarms.End(10 * kSecond, "link:3");
  alarms.Advance(60 * kSecond);
  EXPECT_TRUE(alarms.open().empty());
  EXPECT_EQ(StateOf(alarms, 1), AlarmState::kOver);
}

TEST(AlarmRegister, ThatBecomesWorseLeavesTheShelf) {
  AlarmRegister alarms;
  alarms.Raise(0, Link(3, AlertLevel::kCaution));
  alarms.Shelve(1, {60 * kSecond, "Ann"});
  alarms.Raise(10, Link(3, AlertLevel::kWarning));
  EXPECT_EQ(StateOf(alarms, 2), AlarmState::kUnacknowledged);
}

TEST(AlarmRegister, ThatIsTakenOffTheShelfMustBeAcknowledgedAgain) {
  AlarmRegister alarms;
  alarms.Raise(0, Link(3));
  alarms.Acknowledge(1, 1, "Ann");
  alarms.Shelve(1, {60 * kSecond, "Ann"});
  EXPECT_EQ(alarms.Unshelve(2, 1), Result::kDone);
  EXPECT_EQ(StateOf(alarms, 1), AlarmState::kUnacknowledged);
  EXPECT_EQ(alarms.Unshelve(3, 1), Result::kAlready);
}

TEST(AlarmRegister, ListsTheMostUrgentFirst) {
  AlarmRegister alarms;
  alarms.Raise(0, Link(1));
  alarms.Raise(1, Link(2, AlertLevel::kCaution));
  alarms.Raise(2, Link(3, AlertLevel::kCaution));
  alarms.Raise(3, Link(4));
  alarms.Raise(4, Link(5));
  alarms.Acknowledge(5, 1, "Ann");
  alarms.End(6, "link:5");
  alarms.Shelve(4, {60 * kSecond, "Ann"});
  std::vector<std::int64_t> ids;
  for (const Alarm& alarm : alarms.open()) ids.push_back(alarm.id);
  EXPECT_EQ(ids, (std::vector<std::int64_t>{3, 2, 1, 5, 4}));
  EXPECT_EQ(alarms.counts().on[3], 1);
  EXPECT_EQ(alarms.counts().on[2], 2);
  EXPECT_EQ(alarms.counts().unacknowledged[3], 1);
  EXPECT_EQ(alarms.counts().unacknowledged[2], 2);
}

TEST(AlarmRegister, StaysSmallHoweverMuchHappens) {
  AlarmRegister alarms;
  for (int id = 1; id <= 2000; ++id) {
    alarms.Raise(id, Link(id));
    alarms.End(id, "link:" + std::to_string(id));
  }
  EXPECT_EQ(alarms.open().size(), AlarmRegister::kMostEnded);
  EXPECT_EQ(alarms.open().back().id, 1501);
  EXPECT_EQ(alarms.history().size(), AlarmRegister::kHistory);
  EXPECT_EQ(alarms.history().front().id, 1500);
}

}  // namespace
}  // namespace skein
