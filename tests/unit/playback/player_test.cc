#include "playback/player.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "playback/recorded_flights.h"

namespace skein::playback {
namespace {

using nlohmann::json;

/// A player, its browser and a clock that goes when it is told to.
class PlayerTest : public testing::Test {
 protected:
  void Wait(double seconds) {
    for (double left_s = seconds; left_s > 1e-9; left_s -= Player::kPeriod_s)
      player_.Advance(Player::kPeriod_s);
  }
  json playback() const { return Last("playback"); }
  json Last(const std::string& type) const {
    for (auto text = texts_.rbegin(); text != texts_.rend(); ++text) {
      if ((*text)["type"] == type) return *text;
    }
    return nullptr;
  }
  int Count(const std::string& type) const {
    return static_cast<int>(
        std::ranges::count_if(texts_, [&](const json& text) { return text["type"] == type; }));
  }
  void Forget() {
    texts_.clear();
    motions_ = 0;
  }

  std::vector<json> texts_;
  int motions_ = 0;
  Player player_{Open(LinkDropLog()), {}, [this](const bridge::LiveFrame& packed) {
                   const bridge::LiveFrame frame = bridge::Unpacked(packed);
                   if (frame.key == "motion") ++motions_;
                   if (!frame.binary) texts_.push_back(json::parse(*frame.bytes));
                 }};
};

TEST_F(PlayerTest, BeginsPausedWithAPictureOfTheBeginning) {
  EXPECT_EQ(texts_.front()["type"], "reset");
  EXPECT_EQ(texts_[1]["type"], "hello");
  EXPECT_EQ(playback()["state"], "paused");
  EXPECT_EQ(playback()["t_s"], 0);
  EXPECT_NEAR(playback()["duration_s"].get<double>(), 400, 1);
  Forget();
  Wait(5);
  EXPECT_TRUE(texts_.empty());
}

TEST_F(PlayerTest, PlaysInRealTimeAndTellsFourTimesASecond) {
  player_.Play();
  Wait(2);
  EXPECT_NEAR(player_.t_s(), 2, 0.01);
  EXPECT_NEAR(Count("playback"), 2 + 8, 2);
  EXPECT_NEAR(motions_, 20, 3);
  EXPECT_EQ(Count("reset"), 1);
  player_.Pause();
  Wait(2);
  EXPECT_NEAR(player_.t_s(), 2, 0.01);
  EXPECT_EQ(playback()["state"], "paused");
}

TEST_F(PlayerTest, PlaysFastAndSlowly) {
  player_.SetSpeed(50);
  player_.Play();
  Wait(4);
  EXPECT_NEAR(player_.t_s(), 200, 0.1);
  player_.SetSpeed(0.1);
  Wait(10);
  EXPECT_NEAR(player_.t_s(), 201, 0.1);
  EXPECT_EQ(playback()["speed"], 0.1);
}

TEST_F(PlayerTest, ShowsWhatFastMotionLeftOutWhenItIsPaused) {
  player_.SetSpeed(50);
  player_.Play();
  Wait(1);
  Forget();
  player_.Pause();
  EXPECT_EQ(Count("reset"), 1);
}

TEST_F(PlayerTest, JumpsAndKeepsPlaying) {
  player_.Play();
  player_.Seek(210);
  EXPECT_EQ(Last("statuses")["statuses"][0]["mode"], 2);  // avoiding
  Wait(1);
  EXPECT_NEAR(player_.t_s(), 211, 0.01);
  player_.Seek(1e9);
  EXPECT_EQ(player_.t_s(), player_.duration_s());
  player_.Seek(-3);
  EXPECT_EQ(player_.t_s(), 0);
}

TEST_F(PlayerTest, PlaysBackwardsInJumps) {
  player_.Seek(220);
  Forget();
  player_.SetSpeed(-2);
  player_.Play();
  Wait(2);
  EXPECT_NEAR(player_.t_s(), 216, 0.1);
  EXPECT_EQ(playback()["direction"], -1);
  EXPECT_EQ(playback()["speed"], 2);
  EXPECT_GT(Count("reset"), 4);
  EXPECT_LE(Count("reset"), 11);
}

TEST_F(PlayerTest, EndsAtTheEndAndBeginsAgainFromTheOtherOne) {
  player_.Seek(player_.duration_s() - 1);
  player_.Play();
  Wait(2);
  EXPECT_EQ(playback()["state"], "ended");
  EXPECT_EQ(player_.t_s(), player_.duration_s());
  player_.Play();
  EXPECT_EQ(player_.t_s(), 0);
  player_.SetSpeed(-1);
  Wait(1);
  EXPECT_EQ(playback()["state"], "ended");
  EXPECT_EQ(player_.t_s(), 0);
  player_.Play();
  EXPECT_EQ(player_.t_s(), player_.duration_s());
}

TEST_F(PlayerTest, StepsByOnePeriodOfFleetStateAndShowsEachStep) {
  player_.Seek(100);
  player_.Play();
  Forget();
  player_.Step(1);
  EXPECT_EQ(playback()["state"], "paused");
  EXPECT_NEAR(player_.t_s(), 100.05, 1e-6);
  EXPECT_EQ(Count("reset"), 0);
  EXPECT_GE(motions_, 1);
  player_.Step(-1);
  EXPECT_NEAR(player_.t_s(), 100, 1e-6);
  EXPECT_EQ(Count("reset"), 1);
}

TEST_F(PlayerTest, PlaysALoopOverAndOver) {
  player_.SetLoop(std::pair(50.0, 52.0));
  player_.Seek(51);
  player_.Play();
  Wait(2);
  EXPECT_NEAR(player_.t_s(), 51, 0.2);
  EXPECT_EQ(playback()["loop"], (json{50.0, 52.0}));
  player_.SetSpeed(-1);
  Wait(2);
  EXPECT_NEAR(player_.t_s(), 51, 0.3);
  player_.SetLoop(std::nullopt);
  EXPECT_TRUE(playback()["loop"].is_null());
  player_.SetLoop(std::pair(1000.0, 2000.0));
  EXPECT_LE(playback()["loop"][1].get<double>(), player_.duration_s());
}

TEST_F(PlayerTest, HasTheEventsBeforeTheMomentAndNoneAfter) {
  player_.Seek(kNote_s - 1);
  const auto marked = [this] {
    return std::ranges::any_of(
        texts_, [](const json& text) { return text["type"] == "event" && text["code"] == "marker"; });
  };
  EXPECT_FALSE(marked());
  player_.Seek(kNote_s + 60);
  EXPECT_TRUE(marked());
  Forget();
  player_.Seek(kNote_s - 1);
  EXPECT_FALSE(marked());
}

}  // namespace
}  // namespace skein::playback
