#include "bus/chunks.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace skein::bus {
namespace {

constexpr Utime kTick = 50'000;

fleet_state_t State(std::int64_t tick, int vehicles, std::int64_t session_id = 100,
                    Utime start = 1'000'000'000) {
  fleet_state_t state;
  state.utime = start + tick * kTick;
  state.session_id = session_id;
  state.tick = tick;
  for (int id = 1; id <= vehicles; ++id) {
    state.vehicles.emplace_back();
    state.vehicles.back().id = id;
  }
  return state;
}

// 77 B an item: two in a chunk.
std::vector<fleet_state_t> Chunks(const fleet_state_t& state) { return Split(state, 160); }

std::vector<int> Ids(const fleet_state_t& state) {
  std::vector<int> ids;
  for (const auto& vehicle : state.vehicles) ids.push_back(vehicle.id);
  return ids;
}

class ChunkAssemblerTest : public testing::Test {
 protected:
  struct Delivery {
    std::int64_t tick;
    int vehicles;
    int missing;
    bool operator==(const Delivery&) const = default;
  };

  void Add(const fleet_state_t& chunk) {
    const auto found = assembler_.Add(chunk);
    gaps_ += found.gaps;
    jumps_ += found.time_jumped ? 1 : 0;
    refused_ += found.refused ? 1 : 0;
  }
  void AddAll(const fleet_state_t& state) {
    for (const auto& chunk : Chunks(state)) Add(chunk);
  }
  std::vector<std::int64_t> Ticks() const {
    std::vector<std::int64_t> ticks;
    for (const auto& delivery : delivered_) ticks.push_back(delivery.tick);
    return ticks;
  }

  std::vector<Delivery> delivered_;
  std::int64_t gaps_ = 0;
  int jumps_ = 0;
  int refused_ = 0;
  ChunkAssembler<fleet_state_t> assembler_{[this](const fleet_state_t& whole, int missing) {
    EXPECT_EQ(whole.num_vehicles, static_cast<int>(whole.vehicles.size()));
    delivered_.push_back({whole.tick, whole.num_vehicles, missing});
  }};
};

TEST(Split, KeepsEveryItemInOrderAndNumbersTheChunks) {
  const auto chunks = Chunks(State(7, 5));
  ASSERT_EQ(chunks.size(), 3U);
  EXPECT_EQ(Ids(chunks[0]), (std::vector<int>{1, 2}));
  EXPECT_EQ(Ids(chunks[1]), (std::vector<int>{3, 4}));
  EXPECT_EQ(Ids(chunks[2]), (std::vector<int>{5}));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(chunks[i].chunk, i);
    EXPECT_EQ(chunks[i].chunk_count, 3);
    EXPECT_EQ(chunks[i].num_vehicles, static_cast<int>(chunks[i].vehicles.size()));
    EXPECT_EQ(chunks[i].tick, 7);
  }
}

TEST(Split, MakesOneChunkOfNothing) {
  const auto chunks = Chunks(State(0, 0));
  ASSERT_EQ(chunks.size(), 1U);
  EXPECT_EQ(chunks[0].chunk_count, 1);
}

TEST(Split, MakesLargerChunksOfALargeSetRatherThanMany) {
  EXPECT_EQ(Split(State(0, 1'000)).size(), 12U);
  const auto chunks = Split(State(0, 5'000));
  EXPECT_LE(chunks.size(), 13U);
  const auto largest = Split(State(0, 20'000));
  EXPECT_GT(largest.size(), 13U);
  for (const auto& chunk : largest) EXPECT_LT(chunk.getEncodedSize(), 65'000) << "fits into a datagram";
}

TEST(Split, GivesAnItemThatIsTooLongAChunkOfItsOwn) { EXPECT_EQ(Split(State(0, 3), 10).size(), 3U); }

TEST_F(ChunkAssemblerTest, DeliversASetWhenItsLastChunkHasCome) {
  auto chunks = Chunks(State(0, 5));
  std::swap(chunks[0], chunks[2]);
  std::vector<int> ids;
  ChunkAssembler<fleet_state_t> assembler([&](const fleet_state_t& whole, int missing) {
    ids = Ids(whole);
    EXPECT_EQ(missing, 0);
  });
  assembler.Add(chunks[0]);
  assembler.Add(chunks[1]);
  EXPECT_TRUE(ids.empty());
  assembler.Add(chunks[2]);
  EXPECT_EQ(ids, (std::vector<int>{1, 2, 3, 4, 5}));
}

TEST_F(ChunkAssemblerTest, DeliversWhatIsThereWhenTheNextSetBegins) {
  auto chunks = Chunks(State(0, 5));
  Add(chunks[0]);
  Add(chunks[2]);
  EXPECT_TRUE(delivered_.empty());
  AddAll(State(1, 5));
  EXPECT_EQ(delivered_, (std::vector<Delivery>{{0, 3, 1}, {1, 5, 0}}));
  EXPECT_EQ(gaps_, 1);
}

TEST_F(ChunkAssemblerTest, CountsNothingAsLostThatWasSentBeforeItCame) {
  const auto chunks = Chunks(State(4, 9));
  ASSERT_EQ(chunks.size(), 5U);
  Add(chunks[2]);
  Add(chunks[4]);
  Add(chunks[1]);  // late, on its way
  AddAll(State(5, 9));
  EXPECT_EQ(delivered_, (std::vector<Delivery>{{4, 5, 2}, {5, 9, 0}}));
  EXPECT_EQ(gaps_, 1) << "chunk 3 is lost; chunk 0 was sent before";
  Add(Chunks(State(6, 9))[2]);
  AddAll(State(7, 9));
  EXPECT_EQ(gaps_, 1 + 4) << "later sets count as a whole";
}

TEST_F(ChunkAssemblerTest, CountsTheChunksOfSetsThatNeverCame) {
  AddAll(State(0, 5));
  AddAll(State(3, 5));
  EXPECT_EQ(gaps_, 2 * 3);
  EXPECT_EQ(jumps_, 0);
}

TEST_F(ChunkAssemblerTest, SkipsDuplicatesAndOlderSets) {
  AddAll(State(5, 5));
  AddAll(State(5, 5));
  AddAll(State(4, 5));
  AddAll(State(6, 5));
  EXPECT_EQ(Ticks(), (std::vector<std::int64_t>{5, 6}));
  EXPECT_EQ(gaps_, 0);
  EXPECT_EQ(refused_, 0) << "networks double and overtake";
}

TEST_F(ChunkAssemblerTest, TakesALaterSessionAtOnceAndLeavesTheEarlierOneBehind) {
  AddAll(State(500, 2, 100));
  AddAll(State(0, 2, 200, 1'000'000'000));
  for (int tick = 501; tick < 520; ++tick) {  // both go on: the earlier one never gets three in a row
    AddAll(State(tick, 2, 100));
    AddAll(State(tick - 500, 2, 200));
  }
  ASSERT_GT(delivered_.size(), 2U);
  EXPECT_EQ(delivered_[1].tick, 0);
  EXPECT_EQ(delivered_.size(), 21U);
  EXPECT_EQ(gaps_, 0);
  EXPECT_EQ(jumps_, 0);
  EXPECT_EQ(refused_, 19) << "the earlier one should be silent";
}

TEST_F(ChunkAssemblerTest, RefusesNothingThatAnEarlierSessionHadOnItsWay) {
  AddAll(State(500, 2, 100));
  AddAll(State(0, 2, 200, 1'000'000'000 + 501 * kTick));
  AddAll(State(499, 2, 100));
  AddAll(State(500, 2, 100));
  EXPECT_EQ(delivered_.size(), 2U);
  EXPECT_EQ(refused_, 0);
}

TEST_F(ChunkAssemblerTest, RefusesTimesThatAreADayOff) {
  AddAll(State(0, 2));
  for (int tick = 1; tick < 10; ++tick) {
    AddAll(State(tick, 2));
    for (const std::int64_t off : {-1, 1}) {
      auto wrong = State(tick + 1, 2);
      wrong.utime += off * 86'400 * kSecond;
      AddAll(wrong);
    }
  }
  EXPECT_EQ(delivered_.size(), 10U);
  EXPECT_EQ(refused_, 18);
  EXPECT_EQ(jumps_, 0);
}

TEST_F(ChunkAssemblerTest, RefusesNothingOfASourceThatBeganAnewUnheard) {
  AddAll(State(500, 2));
  AddAll(State(1, 2, 100, 1'000'000'000 + 600 * kTick));
  AddAll(State(2, 2, 100, 1'000'000'000 + 600 * kTick));
  EXPECT_EQ(refused_, 0) << "its set 0 was lost";
}

TEST_F(ChunkAssemblerTest, RefusesASetInWhichAUavIsTwiceInTwoChunks) {
  auto state = State(0, 5);
  state.vehicles[4].id = 1;
  AddAll(state);
  EXPECT_TRUE(delivered_.empty());
  EXPECT_EQ(refused_, 1);
  AddAll(State(1, 5));
  EXPECT_EQ(delivered_.size(), 1U);
  // Also when the last chunk does not come.
  state.tick = 2;
  state.utime += 2 * kTick;
  state.vehicles[2].id = 2;
  const auto chunks = Chunks(state);
  Add(chunks[0]);
  Add(chunks[1]);
  AddAll(State(3, 5));
  EXPECT_EQ(delivered_.size(), 2U);
  EXPECT_EQ(refused_, 2);
  EXPECT_EQ(gaps_, 1);
}

TEST_F(ChunkAssemblerTest, TakesALaterSetZeroAtOnceAsItsSenderWasStartedAnew) {
  AddAll(State(500, 2));
  AddAll(State(0, 2, 100, 1'000'000'000 + 600 * kTick));
  AddAll(State(1, 2, 100, 1'000'000'000 + 600 * kTick));
  EXPECT_EQ(Ticks(), (std::vector<std::int64_t>{500, 0, 1}));
  EXPECT_EQ(jumps_, 0);
  EXPECT_EQ(gaps_, 0);
}

TEST_F(ChunkAssemblerTest, TakesASourceWhoseTimeHasJumpedBackAfterThreeRisingStamps) {
  AddAll(State(100, 5));
  for (int tick = 10; tick < 15; ++tick) AddAll(State(tick, 5));
  EXPECT_EQ(Ticks(), (std::vector<std::int64_t>{100, 12, 13, 14}));
  EXPECT_EQ(jumps_, 1);
}

TEST_F(ChunkAssemblerTest, TakesTheRealSourceAgainAfterOneMessageFromTheFarFuture) {
  AddAll(State(0, 2));
  auto wild = State(1, 2);
  wild.utime += 1'000'000 * kSecond;
  AddAll(wild);
  for (int tick = 1; tick < 4; ++tick) AddAll(State(tick, 2));
  EXPECT_EQ(Ticks(), (std::vector<std::int64_t>{0, 1, 2, 3}));
  EXPECT_EQ(jumps_, 0);
}

TEST_F(ChunkAssemblerTest, RecoversFromASessionThatNobodyCanFollow) {
  AddAll(State(0, 2));
  AddAll(State(0, 2, 1'000'000'000'000'000));
  for (int tick = 1; tick < 5; ++tick) AddAll(State(tick, 2));
  EXPECT_EQ(Ticks(), (std::vector<std::int64_t>{0, 0, 3, 4}));
  EXPECT_EQ(jumps_, 1);
}

TEST_F(ChunkAssemblerTest, IgnoresAChunkThatContradictsItsSet) {
  auto chunks = Chunks(State(0, 4));
  Add(chunks[0]);
  auto other = chunks[1];
  other.chunk_count = 77;
  Add(other);
  EXPECT_EQ(refused_, 1);
  Add(chunks[1]);
  EXPECT_EQ(delivered_, (std::vector<Delivery>{{0, 4, 0}}));
}

TEST(ChunkAssembler, KeepsTheFormationsOfOneChannelApart) {
  std::vector<std::pair<int, int>> delivered;
  ChunkAssembler<formation_status_t> assembler([&](const formation_status_t& whole, int) {
    delivered.emplace_back(whole.formation_id, static_cast<int>(whole.tick));
  });
  for (int tick : {4, 8}) {
    for (int formation_id : {1, 2}) {
      formation_status_t status;
      status.utime = tick * kTick;
      status.formation_id = formation_id;
      status.tick = tick;
      status.chunk_count = 1;
      EXPECT_EQ(assembler.Add(status).gaps, 0);
    }
  }
  EXPECT_EQ(delivered, (std::vector<std::pair<int, int>>{{1, 4}, {2, 4}, {1, 8}, {2, 8}}));
}

}  // namespace
}  // namespace skein::bus
