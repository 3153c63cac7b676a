#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/decode.h"
#include "unit/bus/hostile/samples.h"
#include "unit/bus/hostile/schema.h"
#include "unit/bus/hostile/types.h"

namespace skein::bus::testing {
namespace {

struct Range {
  std::int64_t lowest;
  std::int64_t highest;
};

constexpr std::int64_t kMost32 = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kMostOfAll = std::int64_t{1} << 62;
constexpr Range kId{1, kMost32};
constexpr Range kIdOrNone{0, kMost32};
constexpr Range kCount{0, kMost32};

/// As the .lcm files promise; a 64-bit field that is not here is a time or a number that rises, 0 to 2^62.
const std::map<std::string, Range> kRanges = {
    {"alarm_command_t.action", {0, 2}},
    {"alarm_list_t.num_advisories", kCount},
    {"alarm_list_t.num_cautions", kCount},
    {"alarm_list_t.num_not_listed", kCount},
    {"alarm_list_t.num_unacknowledged_advisories", kCount},
    {"alarm_list_t.num_unacknowledged_cautions", kCount},
    {"alarm_list_t.num_unacknowledged_warnings", kCount},
    {"alarm_list_t.num_warnings", kCount},
    {"alarm_t.formation_id", kIdOrNone},
    {"alarm_t.id", {1, kMostOfAll}},
    {"alarm_t.other_vehicle_id", kIdOrNone},
    {"alarm_t.severity", {1, 3}},
    {"alarm_t.state", {0, 4}},
    {"alarm_t.vehicle_id", kIdOrNone},
    {"event_t.formation_id", kIdOrNone},
    {"event_t.severity", {0, 3}},
    {"event_t.vehicle_id", kIdOrNone},
    {"formation_command_t.action", {0, 3}},
    {"formation_status_t.formation_id", kId},
    {"formation_status_t.mode", {0, formation_status_t::MODE_WAITING}},
    {"formation_t.formation_id", kId},
    {"link_command_t.mode", {0, 3}},
    {"path_t.formation_id", kId},
    {"recording_command_t.action", {0, recording_command_t::ACTION_MARKER}},
    {"recording_status_t.free_bytes", {-1, kMostOfAll}},
    {"recording_status_t.parts", kCount},
    {"recording_status_t.state", {0, recording_status_t::INTERRUPTED}},
    {"simulation_command_t.action", {0, 1}},
    {"slot_status_t.vehicle_id", kId},
    {"slot_t.vehicle_id", kId},
    {"vehicle_command_t.id", kId},
    {"vehicle_info_t.id", kId},
    {"vehicle_link_t.downlink", {0, 3}},
    {"vehicle_link_t.id", kId},
    {"vehicle_link_t.uplink", {0, 3}},
    {"vehicle_proximity_t.id", kId},
    {"vehicle_proximity_t.level", {0, 3}},
    {"vehicle_proximity_t.level_with_id", kIdOrNone},
    {"vehicle_proximity_t.nearest_id", kIdOrNone},
    {"vehicle_proximity_t.tau_id", kIdOrNone},
    {"vehicle_state_t.id", kId},
};

/// What an operator names and the node has not got, it answers with a refusal on ACK.
const std::set<std::string> kAnswered = {"alarm_command_t.alarm_ids", "link_command_t.vehicle_id",
                                         "path_command_t.formation_id", "payload_command_t.vehicle_ids"};

template <typename Message>
class IntegerTest : public ::testing::Test {
 protected:
  std::vector<Place> Places() const {
    static const Schema schema(SKEIN_SOURCE_DIR "/lcmtypes");
    auto places = schema.Places(Message::getTypeName(), good_);
    std::erase_if(places, [](const Place& place) { return place.kind != Place::Kind::kInteger; });
    return places;
  }
  std::int64_t Read(const Place& place) const { return ReadInteger(good_, place.offset, place.bytes); }
  static std::string NameOf(const Place& place) { return place.type + "." + place.field; }

  std::optional<Range> RangeOf(const Place& place) const {
    // They belong together, and stand together.
    if (place.field == "chunk") return Range{0, ReadInteger(good_, place.offset + 4, 4) - 1};
    if (place.field == "chunk_count") return Range{ReadInteger(good_, place.offset - 4, 4) + 1, 100'000};
    const bool in_a_command = Message::getTypeName() == std::string("formation_command_t");
    const bool is_id = NameOf(place) == "formation_t.formation_id" || NameOf(place) == "slot_t.vehicle_id";
    if (kAnswered.contains(NameOf(place)) || (in_a_command && is_id)) return std::nullopt;
    if (const auto range = kRanges.find(NameOf(place)); range != kRanges.end()) return range->second;
    EXPECT_EQ(place.bytes, 8U) << NameOf(place) << " has no range";
    return Range{0, kMostOfAll};
  }

  bool IsTaken(const Place& place, std::int64_t value) const {
    auto bytes = good_;
    WriteInteger(bytes, place.offset, place.bytes, value);
    const auto message = Decode<Message>(bytes.data(), bytes.size());
    return message && Valid(*message);
  }
  /// The same id in another item would be wrong, too.
  bool StandsElsewhere(const Place& place, std::int64_t value) const {
    for (const Place& other : Places()) {
      if (other.offset != place.offset && NameOf(other) == NameOf(place) && Read(other) == value) return true;
    }
    return false;
  }

  const std::vector<std::uint8_t> good_ = Encode(Sample<Message>());
};

TYPED_TEST_SUITE(IntegerTest, Messages);

TYPED_TEST(IntegerTest, AreTakenWithinTheirRangeAndNowhereBeyond) {
  for (const Place& place : this->Places()) {
    const auto range = this->RangeOf(place);
    if (!range) continue;
    const int bits = static_cast<int>(8 * place.bytes);
    const std::int64_t most = std::numeric_limits<std::int64_t>::max() >> (64 - bits);
    for (const std::int64_t value : {range->lowest, range->highest}) {
      if (this->StandsElsewhere(place, value)) continue;
      EXPECT_TRUE(this->IsTaken(place, value)) << this->NameOf(place) << " = " << value;
    }
    for (const std::int64_t value :
         {range->lowest - 1, range->highest + 1, -most - 1, -most, most, most - 1}) {
      // What does not fit into the field, or is well.
      if (value < -most - 1 || value > most) continue;
      if (value >= range->lowest && value <= range->highest) continue;
      EXPECT_FALSE(this->IsTaken(place, value)) << this->NameOf(place) << " = " << value;
    }
  }
}

}  // namespace
}  // namespace skein::bus::testing
