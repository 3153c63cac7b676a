#include "cli/drop_ledger.h"

#include <gtest/gtest.h>

namespace skein::cli {
namespace {

using Link = DropLedger::Link;

constexpr double kLimitS = 5;

bus::Utime At(double seconds) { return bus::ToUtime(1000 + seconds); }

Drop Cut(double for_s) { return {.vehicle = "1", .for_s = for_s}; }

/// A ledger that has seen UAV 1 up.
class DropLedgerTest : public ::testing::Test {
 protected:
  DropLedgerTest() { ledger.Hear(1, Link::kUp, At(-1)); }
  std::string Outcome(std::size_t index, double now_s) const {
    return ledger.records().at(index).Outcome(kLimitS, At(now_s));
  }
  DropLedger ledger{kLimitS};
};

TEST_F(DropLedgerTest, TellsWhenACutWasFoundAndWhenItWasBack) {
  ledger.Begin(1, 1, Cut(10), At(0), true);
  EXPECT_EQ(ledger.Hear(1, Link::kLate, At(2)).found, nullptr);
  const auto news = ledger.Hear(1, Link::kLost, At(4));
  ASSERT_NE(news.found, nullptr);
  EXPECT_FALSE(news.is_false);
  EXPECT_EQ(news.found->detection_s(), 4);
  EXPECT_EQ(ledger.Hear(1, Link::kLost, At(5)).found, nullptr) << "told again";
  EXPECT_FALSE(ledger.IsSettled(At(9)));
  const auto back = ledger.Hear(1, Link::kUp, At(13)).back;
  ASSERT_NE(back, nullptr);
  EXPECT_EQ(*back->back, At(13));
  EXPECT_EQ(Outcome(0, 14), "found");
  EXPECT_TRUE(ledger.IsSettled(At(14)));
}

TEST_F(DropLedgerTest, HoldsAgainstTheMonitorWhatItFindsLateOrMisses) {
  ledger.Begin(1, 1, Cut(20), At(0), true);
  ledger.Hear(1, Link::kLost, At(5.1));
  ledger.Hear(1, Link::kUp, At(23));
  ledger.Begin(2, 1, Cut(5), At(30), true);
  EXPECT_EQ(Outcome(1, 35.5), "pending");
  EXPECT_EQ(Outcome(0, 50), "late");
  EXPECT_EQ(Outcome(1, 50), "missed");
}

TEST_F(DropLedgerTest, DoesNotCountWhatNeedNotBeFound) {
  ledger.Begin(1, 1, Cut(4.9), At(0), true);
  ledger.Begin(2, 2, {.vehicle = "2", .for_s = 20, .loss = 0.3}, At(0), true);
  ledger.Begin(3, 3, {.vehicle = "3", .downlink = false, .for_s = 20}, At(0), false);
  EXPECT_EQ(Outcome(0, 30), "short");
  EXPECT_EQ(Outcome(1, 30), "degraded");
  EXPECT_EQ(Outcome(2, 30), "not judged");
}

TEST_F(DropLedgerTest, CountsAShortCutThatIsFoundAllTheSame) {
  ledger.Begin(1, 1, Cut(4), At(0), true);
  ledger.Hear(1, Link::kLost, At(4.05));
  EXPECT_EQ(Outcome(0, 10), "found");
}

TEST_F(DropLedgerTest, HoldsNothingAgainstTheMonitorOfACutThatWasOverBefore) {
  ledger.Begin(1, 1, Cut(4.5), At(0), true);
  const auto news = ledger.Hear(1, Link::kLost, At(5.3));
  EXPECT_NE(news.found, nullptr);
  EXPECT_FALSE(news.is_false);
  EXPECT_EQ(Outcome(0, 10), "short");
}

TEST_F(DropLedgerTest, CountsOfTwoThatOverlapTheFirstOne) {
  ledger.Begin(1, 1, Cut(12), At(0), true);
  ledger.Begin(2, 1, Cut(20), At(3), true);
  ledger.Hear(1, Link::kLost, At(4));
  EXPECT_EQ(ledger.records()[0].detection_s(), 4);
  EXPECT_EQ(Outcome(0, 30), "found");
  EXPECT_EQ(Outcome(1, 30), "overlapped");
}

TEST_F(DropLedgerTest, CountsNeitherWhenTheFirstOneIsTooShortToBeFoundAlone) {
  ledger.Begin(1, 1, Cut(2), At(0), true);
  ledger.Begin(2, 1, Cut(20), At(1), true);
  EXPECT_FALSE(ledger.Hear(1, Link::kLost, At(5.5)).is_false);
  EXPECT_EQ(Outcome(0, 30), "overlapped");
  EXPECT_EQ(Outcome(1, 30), "overlapped");
}

TEST_F(DropLedgerTest, DoesNotCountACutOfALinkThatIsNotUpYet) {
  ledger.Begin(1, 1, Cut(10), At(0), true);
  ledger.Hear(1, Link::kLost, At(4));
  ledger.Begin(2, 1, Cut(10), At(12), true);
  EXPECT_EQ(Outcome(1, 30), "overlapped");
}

TEST_F(DropLedgerTest, TellsALossThatNobodyMade) {
  EXPECT_TRUE(ledger.Hear(1, Link::kLost, At(0)).is_false);
  EXPECT_FALSE(ledger.Hear(1, Link::kLost, At(1)).is_false) << "once is enough";
  ledger.Hear(1, Link::kUp, At(2));
  ledger.Begin(1, 1, Cut(10), At(3), true);
  ledger.Hear(1, Link::kLost, At(7));
  ledger.Hear(1, Link::kUp, At(16));
  EXPECT_TRUE(ledger.Hear(1, Link::kLost, At(20)).is_false) << "long after the drop";
  ASSERT_EQ(ledger.false_losses().size(), 2u);
  EXPECT_EQ(ledger.false_losses()[1].utime, At(20));
  EXPECT_FALSE(ledger.Hear(9, Link::kLost, At(21)).is_false) << "was lost before we came";
}

TEST_F(DropLedgerTest, DoesNotBlameTheMonitorForCutsOfOthers) {
  ledger.HearCut(1, true, At(0));
  EXPECT_FALSE(ledger.Hear(1, Link::kLost, At(4)).is_false);
  ledger.HearCut(1, false, At(10));
  ledger.Hear(1, Link::kUp, At(13));
  EXPECT_TRUE(ledger.Hear(1, Link::kLost, At(20)).is_false);
}

TEST_F(DropLedgerTest, ForgetsWhatNeverBeganWhenStopped) {
  ledger.Begin(1, 1, Cut(100), At(0), true);
  ledger.Begin(2, 2, Cut(100), At(11), true);
  ledger.Stop(At(10));
  ASSERT_EQ(ledger.records().size(), 1u);
  EXPECT_EQ(ledger.records()[0].end, At(10));
}

}  // namespace
}  // namespace skein::cli
