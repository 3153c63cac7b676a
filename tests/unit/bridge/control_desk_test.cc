#include "bridge/control_desk.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace skein::bridge {
namespace {

using namespace std::chrono_literals;
using Action = ControlRequest::Action;

class ControlDeskTest : public ::testing::Test {
 protected:
  int Enter(const std::string& name, bool take = true) {
    return desk_.Enter({.name = name, .take = take}, now_);
  }
  bus::Answer Ask(int person, Action action, int other = 0) {
    return desk_.Ask(person, {.action = action, .person = other}, now_);
  }
  int Holder() const { return desk_.View(0, now_)["holder"]; }
  std::string TokenOf(int person) const { return desk_.View(person, now_)["token"]; }
  bool Look(std::chrono::seconds later) {
    now_ += later;
    return desk_.Look(now_);
  }

  ControlDesk::Time now_{};
  std::vector<std::string> told_;
  ControlDesk desk_{
      [this](const std::string& code, const std::string& text) { told_.push_back(code + ": " + text); }};
};

TEST_F(ControlDeskTest, TheFirstHasControlAndTheOthersAreRefusedByHisName) {
  const int ada = Enter("Ada");
  const int bob = Enter("Bob");
  EXPECT_EQ(desk_.WhyNot(ada), "");
  EXPECT_EQ(desk_.WhyNot(bob), "Ada holds control");
  EXPECT_EQ(Ask(bob, Action::kTake).reason, "Ada holds control: ask for it");
  EXPECT_EQ(told_, (std::vector<std::string>{"control_taken: Ada has taken control"}));
}

TEST_F(ControlDeskTest, KnowsWhoIsThereByHisToken) {
  const int ada = Enter("Ada");
  const std::string token = TokenOf(ada);
  EXPECT_EQ(desk_.Who(token), ada);
  EXPECT_EQ(desk_.Who(token + "x"), 0);
  EXPECT_EQ(desk_.Who(""), 0);
  desk_.Leave(ada, now_);
  EXPECT_EQ(desk_.Who(token), 0);
}

TEST_F(ControlDeskTest, WhoOnlyLooksLeavesControlFree) {
  const int ada = Enter("Ada", false);
  EXPECT_EQ(Holder(), 0);
  EXPECT_EQ(desk_.WhyNot(ada), "nobody holds control: take it first");
  EXPECT_TRUE(Ask(ada, Action::kTake).accepted);
  EXPECT_EQ(Holder(), ada);
}

TEST_F(ControlDeskTest, ASessionWithoutTheRightNeverHoldsControl) {
  const int guest = desk_.Enter({.name = "Guest", .may_operate = false}, now_);
  EXPECT_EQ(Holder(), 0);
  for (const Action action : {Action::kTake, Action::kAsk}) {
    EXPECT_EQ(Ask(guest, action).reason, "this session may only look");
  }
  const int ada = Enter("Ada");
  EXPECT_EQ(Ask(ada, Action::kGive, guest).reason, "Guest may only look");
  EXPECT_EQ(Holder(), ada);
}

TEST_F(ControlDeskTest, TheHolderGivesRefusesAndReleases) {
  const int ada = Enter("Ada");
  const int bob = Enter("Bob");
  EXPECT_FALSE(Ask(bob, Action::kGive, bob).accepted);
  EXPECT_FALSE(Ask(bob, Action::kRelease).accepted);
  Ask(bob, Action::kAsk);
  EXPECT_TRUE(desk_.View(ada, now_)["people"][1]["waits_for_s"].is_number());
  EXPECT_TRUE(Ask(ada, Action::kRefuse, bob).accepted);
  EXPECT_TRUE(desk_.View(ada, now_)["people"][1]["waits_for_s"].is_null());
  EXPECT_TRUE(Ask(ada, Action::kGive, bob).accepted);
  EXPECT_EQ(Holder(), bob);
  EXPECT_FALSE(Ask(ada, Action::kGive, ada).accepted);
  EXPECT_TRUE(Ask(bob, Action::kRelease).accepted);
  EXPECT_EQ(Holder(), 0);
  EXPECT_EQ(told_.back(), "control_released: Bob has released control");
}

TEST_F(ControlDeskTest, ControlThatIsReleasedGoesToWhoAskedFirst) {
  const int ada = Enter("Ada");
  const int bob = Enter("Bob");
  const int cleo = Enter("Cleo");
  Ask(cleo, Action::kAsk);
  now_ += 1s;
  Ask(bob, Action::kAsk);
  Ask(ada, Action::kRelease);
  EXPECT_EQ(Holder(), cleo);
}

TEST_F(ControlDeskTest, WhoAskedMayTakeOverAfterFifteenSecondsWithoutAnAnswer) {
  const int ada = Enter("Ada");
  const int bob = Enter("Bob");
  Ask(bob, Action::kAsk);
  now_ += 14s;
  EXPECT_EQ(Ask(bob, Action::kTake).reason, "Ada has 1 s left to answer");
  now_ += 1s;
  EXPECT_TRUE(Ask(bob, Action::kTake).accepted);
  EXPECT_EQ(Holder(), bob);
  EXPECT_EQ(told_.back(),
            "control_taken_over: Bob has taken over control from Ada, who had not answered for 15 s");
  EXPECT_EQ(desk_.WhyNot(ada), "Bob holds control");
}

TEST_F(ControlDeskTest, ANewHolderHasAllHisTimeToAnswerWhoAskedTheOneBefore) {
  const int ada = Enter("Ada");
  const int bob = Enter("Bob");
  const int cleo = Enter("Cleo");
  Ask(cleo, Action::kAsk);
  now_ += 20s;
  Ask(ada, Action::kGive, bob);
  EXPECT_FALSE(Ask(cleo, Action::kTake).accepted);
}

TEST_F(ControlDeskTest, AHolderWhoseConnectionDropsIsWaitedForTenSeconds) {
  const int ada = Enter("Ada");
  const int bob = Enter("Bob");
  const std::string token = TokenOf(ada);
  desk_.Leave(ada, now_);
  EXPECT_FALSE(Look(9s));
  EXPECT_EQ(desk_.WhyNot(bob), "Ada holds control");
  EXPECT_EQ(desk_.Enter({.name = "Ada", .token = token, .take = false}, now_), ada);
  EXPECT_FALSE(Look(60s));
  EXPECT_EQ(desk_.WhyNot(ada), "");

  desk_.Leave(ada, now_);
  EXPECT_TRUE(Look(10s));
  EXPECT_EQ(Holder(), 0);
  EXPECT_EQ(told_.back(), "control_lost: Ada has been gone for 10 s: control is free");
  EXPECT_NE(desk_.Enter({.name = "Ada", .token = token, .take = false}, now_), ada);
}

TEST_F(ControlDeskTest, ATabThatIsReloadedBeforeAnyAnswerCameIsKnownByTheTokenItMadeUp) {
  const std::string token(ControlDesk::kLeastTokenSize, 'a');
  const int ada = desk_.Enter({.name = "Ada", .token = token, .page = "p1"}, now_);
  EXPECT_EQ(TokenOf(ada), token);
  desk_.Leave(ada, now_);
  EXPECT_EQ(desk_.Enter({.name = "Ada", .token = token, .page = "p2"}, now_), ada);

  const int bob = desk_.Enter({.name = "Bob", .token = "guess me", .page = "p3"}, now_);
  EXPECT_NE(TokenOf(bob), "guess me");
}

TEST_F(ControlDeskTest, ADuplicatedTabIsSomebodyElse) {
  const int first = desk_.Enter({.name = "Ada", .page = "p1"}, now_);
  const int copy = desk_.Enter({.name = "Ada", .token = TokenOf(first), .page = "p2"}, now_);
  EXPECT_NE(copy, first);
  EXPECT_NE(TokenOf(copy), TokenOf(first));
  EXPECT_EQ(desk_.WhyNot(copy), "Ada holds control");
  EXPECT_EQ(desk_.View(copy, now_)["people"][1]["name"], "Ada (2)");
}

TEST_F(ControlDeskTest, ThePageItselfComesBackBeforeItsDeadConnectionIsNoticed) {
  const int first = desk_.Enter({.name = "Ada", .page = "p1"}, now_);
  EXPECT_EQ(desk_.Enter({.name = "Ada", .token = TokenOf(first), .page = "p1"}, now_), first);
  EXPECT_EQ(desk_.View(0, now_)["people"].size(), 1u);
}

TEST_F(ControlDeskTest, WhoHeldControlWhenTheBridgeDiedIsWaitedForByTheNextOne) {
  const std::string token = TokenOf(Enter("Ada"));
  const KeptHolder kept = desk_.Holder().value();
  EXPECT_EQ(kept.name, "Ada");
  EXPECT_EQ(kept.token_sha256.find(token), std::string::npos);
  ControlDesk next([](const std::string&, const std::string&) {});
  next.WaitFor(kept, now_);
  EXPECT_EQ(next.Holder(), kept);
  const int bob = next.Enter({.name = "Bob"}, now_);
  EXPECT_EQ(next.WhyNot(bob), "Ada holds control");
  const int ada = next.Enter({.name = "Ada", .token = token}, now_);
  EXPECT_EQ(next.WhyNot(ada), "");
  EXPECT_EQ(next.Who(token), ada);
  EXPECT_EQ(next.Holder(), kept);
}

TEST_F(ControlDeskTest, WhoDoesNotComeBackAfterTheBridgeDiedHoldsControlNoLonger) {
  desk_.WaitFor({"Ada", "0123"}, now_);
  const int bob = Enter("Bob");
  EXPECT_FALSE(Look(9s));
  EXPECT_FALSE(Ask(bob, Action::kTake).accepted);
  EXPECT_TRUE(Look(1s));
  EXPECT_TRUE(Ask(bob, Action::kTake).accepted);
  EXPECT_EQ(told_.front(), "control_lost: Ada has been gone for 10 s: control is free");
}

TEST_F(ControlDeskTest, ATokenIsTheBusinessOfItsOwnerAlone) {
  const int ada = Enter("Ada");
  const int bob = Enter("Bob");
  EXPECT_EQ(desk_.View(bob, now_).dump().find(TokenOf(ada)), std::string::npos);
  EXPECT_EQ(desk_.View(0, now_)["token"], "");
  EXPECT_EQ(TokenOf(ada).size(), 32u);
}

TEST_F(ControlDeskTest, NamesAreOnesThatAPersonCanTellApart) {
  const int first = Enter("");
  const int second = Enter("");
  EXPECT_EQ(desk_.View(0, now_)["people"][0]["name"], "Operator 1");
  EXPECT_EQ(desk_.View(0, now_)["people"][1]["name"], "Operator 2");
  EXPECT_TRUE(desk_.Ask(second, {.action = Action::kRename, .name = "J\xc3\xbcrgen"}, now_).accepted);
  EXPECT_FALSE(desk_.Ask(second, {.action = Action::kRename, .name = " x"}, now_).accepted);
  EXPECT_FALSE(desk_.Ask(first, {.action = Action::kRename, .name = ""}, now_).accepted);
  EXPECT_EQ(NameProblem("a\nb"), "a name has no control characters");
  EXPECT_EQ(NameProblem(std::string(41, 'a')), "a name has 1 to 40 characters");
  std::string umlauts;
  for (int i = 0; i < 40; ++i) umlauts += "\xc3\xbc";
  EXPECT_EQ(NameProblem(umlauts), "");
}

}  // namespace
}  // namespace skein::bridge
