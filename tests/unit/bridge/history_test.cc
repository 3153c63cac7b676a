#include "bridge/history_answer.h"

#include <gtest/gtest.h>

#include <cstring>

namespace skein::bridge {
namespace {

using recording::FleetTable;
using recording::History;
using recording::HistoryRow;

constexpr bus::Utime kNow = 1'000'000'000;

vehicle_state_t State(std::int32_t id, double up_m) {
  vehicle_state_t state{};
  state.id = id;
  state.up_m = up_m;
  state.speed_m_s = 50;
  state.course_rad = 7;  // unwrapped: 7 - 2 pi
  return state;
}

void Fly(FleetTable& fleet, const std::vector<std::int32_t>& ids, double up_m) {
  fleet_state_t message{};
  for (const std::int32_t id : ids) message.vehicles.push_back(State(id, up_m));
  fleet.Take(message, kNow);
}

void Lose(FleetTable& fleet, std::int32_t id) {
  vehicle_link_t link{};
  link.id = id;
  link.downlink = link_status_t::LINK_LOST;
  link_status_t links{};
  links.links = {link};
  fleet.Take(links);
}

/// Reads an answer of GET /api/history as cpp/bridge/README.md describes it.
class HistoryReader {
 public:
  explicit HistoryReader(std::string bytes) : bytes_(std::move(bytes)) {
    kind = Number<std::uint8_t>(0);
    id_count = Number<std::uint32_t>(4);
    start_utime = Number<double>(8);
    sample_count = Number<std::uint32_t>(16);
  }

  double t_s(std::size_t sample) const { return Number<double>(24 + 8 * sample); }
  std::int32_t id(std::size_t vehicle) const { return Number<std::int32_t>(ids_at() + 4 * vehicle); }
  float value(std::size_t vehicle, std::size_t column, std::size_t sample) const {
    return Number<float>(values_at() + 4 * ((vehicle * 9 + column) * sample_count + sample));
  }
  int flags(std::size_t vehicle, std::size_t sample) const {
    return Number<std::uint8_t>(values_at() + 36 * id_count * sample_count + vehicle * sample_count + sample);
  }
  std::size_t expected_size() const { return values_at() + 37 * id_count * sample_count; }
  std::size_t size() const { return bytes_.size(); }

  int kind = 0;
  std::size_t id_count = 0;
  double start_utime = 0;
  std::size_t sample_count = 0;

 private:
  std::size_t ids_at() const { return 24 + 8 * sample_count; }
  std::size_t values_at() const { return ids_at() + 4 * id_count; }
  template <typename T>
  T Number(std::size_t place) const {
    T number{};
    if (place + sizeof number > bytes_.size()) throw std::runtime_error("the answer is too short");
    std::memcpy(&number, bytes_.data() + place, sizeof number);
    return number;
  }

  std::string bytes_;
};

TEST(History, TakesASampleASecondFromTheStartOn) {
  FleetTable fleet;
  Fly(fleet, {1}, 1000);
  History history;
  history.Take(fleet, -1, kNow);  // not started yet
  for (double t_s = 0; t_s < 10; t_s += 0.25) history.Take(fleet, t_s, kNow);
  ASSERT_EQ(history.samples().size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(history.samples()[i]->t_s, static_cast<double>(i));
}

TEST(History, IsNotPutOffByASampleThatIsLateNorFilledByASilentBus) {
  FleetTable fleet;
  Fly(fleet, {1}, 1000);
  History history;
  for (const double t_s : {0., 1.9, 2.1, 2.1, 2.1, 3.}) history.Take(fleet, t_s, kNow);
  std::vector<double> times;
  for (const auto& sample : history.samples()) times.push_back(sample->t_s);
  EXPECT_EQ(times, (std::vector{0., 1.9, 2.1, 3.}));
}

TEST(History, KeepsEverySecondSampleWhenThereAreTooManyAndStillBeginsAtTheStart) {
  FleetTable fleet;
  Fly(fleet, {1}, 1000);
  History history({.samples = 100, .rows = 1'000'000});
  for (int t_s = 0; t_s < 1000; ++t_s) {
    history.Take(fleet, double(t_s), kNow);
    ASSERT_LE(history.samples().size(), 100u);
  }
  EXPECT_EQ(history.spacing_s(), 16);
  const auto& samples = history.samples();
  EXPECT_GT(samples.size(), 50u);
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i]->t_s, 16. * static_cast<double>(i));
}

TEST(History, HoldsNoMoreRowsThanAllowedHoweverManyFly) {
  FleetTable fleet;
  std::vector<std::int32_t> ids;
  for (int id = 1; id <= 50; ++id) ids.push_back(id);
  Fly(fleet, ids, 1000);
  History history({.samples = 1000, .rows = 2000});
  std::size_t rows = 0;
  for (int t_s = 0; t_s < 500; ++t_s) {
    history.Take(fleet, double(t_s), kNow);
    rows = 0;
    for (const auto& sample : history.samples()) rows += sample->rows.size();
    ASSERT_LE(rows, 2000u);
  }
  EXPECT_GE(rows, 1000u);
}

TEST(History, BeginsAnewWhenTimeRunsBackwards) {
  FleetTable fleet;
  Fly(fleet, {1}, 1000);
  History history;
  for (const double t_s : {100., 101., 0., 1.}) history.Take(fleet, t_s, kNow);
  ASSERT_EQ(history.samples().size(), 2u);
  EXPECT_EQ(history.samples()[0]->t_s, 0);
}

TEST(History, DoesNotPassOffWhatWasHeardLastAsNews) {
  FleetTable fleet;
  Fly(fleet, {1, 2}, 1000);
  Lose(fleet, 2);
  History history;
  history.Take(fleet, 0, kNow);
  history.Take(fleet, 1, kNow + 3 * bus::kSecond);
  const auto& samples = history.samples();
  EXPECT_EQ(samples[0]->rows[0].flags, HistoryRow::kHeard);
  EXPECT_EQ(samples[0]->rows[1].flags, 0);
  EXPECT_EQ(samples[1]->rows[0].flags, 0);
}

TEST(HistoryAnswer, HasTheColumnsThatBrowsersExpectInTheOrderAskedFor) {
  FleetTable fleet;
  Fly(fleet, {3, 7}, 1000);
  slot_status_t slot{};
  slot.vehicle_id = 7;
  slot.forward_error_m = 1.5;
  slot.left_error_m = -2.5;
  slot.up_error_m = 3.5;
  fleet.Take(4, {slot});
  vehicle_proximity_t near{};
  near.id = 7;
  near.nearest_id = 3;
  near.nearest_horizontal_m = 510;
  near.nearest_vertical_m = 20;
  near.tau_s = 12.5;
  proximity_t proximity{};
  proximity.vehicles = {near};
  fleet.Take(proximity);
  History history;
  history.Take(fleet, 0.25, kNow);
  Fly(fleet, {3, 7, 5}, 1100);  // UAV 5 joins
  history.Take(fleet, 1.25, kNow);
  history.Take(fleet, 2.25, kNow);

  const HistoryReader all(EncodeHistory(history.samples(), {{7, 5, 99}}, 1'577'836'800'000'000));
  EXPECT_EQ(all.kind, 3);
  EXPECT_EQ(all.id_count, 3u);
  EXPECT_EQ(all.start_utime, 1'577'836'800'000'000.);
  ASSERT_EQ(all.sample_count, 3u);
  EXPECT_EQ(all.size(), all.expected_size());
  EXPECT_EQ(all.t_s(0), 0.25);
  EXPECT_EQ(all.t_s(2), 2.25);
  EXPECT_EQ(all.id(0), 7);
  EXPECT_EQ(all.id(2), 99);
  const float seven[] = {1000, 50, 0.7168147f, 1.5f, -2.5f, 3.5f, 510, 20, 12.5f};
  for (std::size_t column = 0; column < 9; ++column) EXPECT_FLOAT_EQ(all.value(0, column, 0), seven[column]);
  EXPECT_EQ(all.flags(0, 0), HistoryRow::kHeard | HistoryRow::kHasSlot);
  EXPECT_EQ(all.value(0, 0, 1), 1100);
  EXPECT_EQ(all.flags(1, 0), 0);  // not there yet
  EXPECT_EQ(all.value(1, 8, 0), -1);
  EXPECT_EQ(all.flags(1, 1), HistoryRow::kHeard);
  EXPECT_EQ(all.value(1, 0, 1), 1100);
  EXPECT_EQ(all.flags(2, 2), 0);  // nobody
  EXPECT_EQ(all.value(2, 6, 2), -1);

  const HistoryReader newer(EncodeHistory(history.samples(), {{7}, 1.25}, 1));
  ASSERT_EQ(newer.sample_count, 1u);
  EXPECT_EQ(newer.t_s(0), 2.25);
  EXPECT_EQ(HistoryReader(EncodeHistory({}, {{7}}, 0)).size(), 28u);
}

TEST(HistoryQuery, IsReadOrRefusedWithASentence) {
  const auto good = std::get<HistoryQuery>(ParseHistoryQuery("ids=3,1,20&since=12.5"));
  EXPECT_EQ(good.ids, (std::vector<std::int32_t>{3, 1, 20}));
  EXPECT_EQ(good.since_s, 12.5);
  EXPECT_EQ(std::get<HistoryQuery>(ParseHistoryQuery("ids=1")).since_s, -1);
  for (const char* bad : {"", "since=3", "ids=", "ids=0", "ids=1,,2", "ids=1,x", "ids=1;2", "ids=99999999999",
                          "ids=1&since=soon", "ids=1&since=nan", "ids=1&since=", "ids=1&until=3"}) {
    EXPECT_TRUE(std::holds_alternative<std::string>(ParseHistoryQuery(bad))) << bad;
  }
  std::string many = "ids=1";
  for (int id = 2; id <= 33; ++id) many += "," + std::to_string(id);
  EXPECT_TRUE(std::get<std::string>(ParseHistoryQuery(many)).starts_with("ids: not more than 32"));
}

}  // namespace
}  // namespace skein::bridge
