#include "playback/stage.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "playback/recorded_flights.h"

namespace skein::playback {
namespace {

using nlohmann::json;

void Ignore(const bridge::LiveFrame&) {}

/// A picture by what is in it; texts without what depends on when it was drawn.
std::map<std::string, std::string> Picture(const Stage& stage) {
  std::map<std::string, std::string> picture;
  int events = 0;
  for (const bridge::LiveFrame& packed : stage.mirror().Snapshot()) {
    const bridge::LiveFrame frame = bridge::Unpacked(packed);
    if (frame.binary) {
      picture[frame.key] = *frame.bytes;
      continue;
    }
    json message = json::parse(*frame.bytes);
    message.erase("line");
    const std::string type = message["type"];
    // What is repeated and does not change keeps the time at which it was heard first.
    if (type == "roster" || type == "path" || type == "formation") message.erase("utime");
    picture[type == "event" ? "event" + std::to_string(1000 + events++) : frame.key + type] = message.dump();
  }
  return picture;
}

class AMomentOfARecording : public testing::TestWithParam<double> {};

TEST_P(AMomentOfARecording, LooksTheSameWhetherOneJumpsThereOrPlaysFromTheBeginning) {
  const auto flight = Open(LinkDropLog());
  const bus::Utime moment = flight->start() + bus::ToUtime(GetParam());
  const auto jumped = Stage::At(*flight, moment, {}, Ignore);
  const auto played = Stage::At(*flight, flight->start(), {}, Ignore);
  for (bus::Utime utime = flight->start(); utime < moment; utime += bus::kSecond / 20) {
    played->PlayUntil(utime);
  }
  played->PlayUntil(moment);
  const auto expected = Picture(*played);
  const auto picture = Picture(*jumped);
  EXPECT_GE(picture.size(), 6U);
  for (const auto& [key, content] : expected) {
    ASSERT_TRUE(picture.contains(key)) << key;
    EXPECT_EQ(picture.at(key), content) << key;
  }
  for (const auto& [key, content] : picture) EXPECT_TRUE(expected.contains(key)) << key;
}

// In good order; while UAV 3 is lost, when it has been for long; climbing; after it has come back; when the
// controller has just gone silent, and has been for long.
INSTANTIATE_TEST_SUITE_P(Stage, AMomentOfARecording,
                         testing::Values(0, 0.3, 7.77, 100.02, 199.99, 201, 204.3, 215, 234.9, 240, 272,
                                         290));

TEST(Stage, ShowsAUavThatHasBeenLostForLongWhereItWasLastHeard) {
  const auto flight = Open(LinkDropLog());
  const auto stage = Stage::At(*flight, flight->start() + bus::ToUtime(kCut_s + 30), {}, Ignore);
  const json vehicles = json::parse(stage->mirror().Vehicles().dump())["vehicles"];
  ASSERT_EQ(vehicles.size(), 3U);
  EXPECT_EQ(vehicles[2]["downlink"], "lost");
  EXPECT_NEAR(vehicles[2]["age_s"].get<double>(), 30, 1);
  EXPECT_LT(vehicles[0]["age_s"].get<double>(), 0.1);
}

TEST(Stage, KeepsTheCurvesThatTheLiveMirrorHadInTheIndex) {
  const auto flight = Open(LinkDropLog());
  const auto played = Stage::At(*flight, flight->start(), {}, Ignore);
  for (bus::Utime utime = flight->start(); utime <= flight->end(); utime += bus::kSecond / 20) {
    played->PlayUntil(utime);
  }
  const auto& live = played->mirror().FlightSoFar();
  ASSERT_EQ(flight->parts()[0].index->flights.size(), 1U);
  const auto& indexed = flight->parts()[0].index->flights[0].samples;
  ASSERT_GT(live.size(), 250U);
  ASSERT_EQ(indexed.size(), live.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    // A sample is taken at the first event or timer of a second; not always the same one.
    EXPECT_NEAR(indexed[i]->t_s, live[i]->t_s, 0.3);
    ASSERT_EQ(indexed[i]->rows.size(), live[i]->rows.size());
    for (std::size_t row = 0; row < live[i]->rows.size(); ++row) {
      EXPECT_NEAR(indexed[i]->rows[row].values[0], live[i]->rows[row].values[0], 5);
    }
  }
}

TEST(Stage, LeavesNoEventOutInFastMotion) {
  const auto flight = Open(LinkDropLog());
  int events = 0;
  const auto stage = Stage::At(*flight, flight->start(), {}, [&](const bridge::LiveFrame& frame) {
    if (!frame.binary && frame.bytes->find(R"("type":"event")") != std::string::npos) ++events;
  });
  const auto before = stage->mirror().State()["events"].size();
  for (bus::Utime utime = flight->start(); utime < flight->end(); utime += bus::ToUtime(2.5)) {
    stage->PlayUntil(utime);
  }
  stage->PlayUntil(flight->end());
  EXPECT_EQ(static_cast<std::size_t>(events) + before, flight->parts()[0].index->told.size());
}

}  // namespace
}  // namespace skein::playback
