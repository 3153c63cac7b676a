#include "bridge/binary_frames.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/frames.h"

namespace skein::bridge {
namespace {

static_assert(std::endian::native == std::endian::little, "columns are copied as they lie in memory");

using recording::FleetRow;
using Rows = std::vector<std::pair<std::int32_t, const FleetRow*>>;

template <typename Number>
void Append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

std::string Header(unsigned char kind, std::size_t count, FrameTime time) {
  std::string bytes;
  Append(bytes, kind);
  Append(bytes, std::uint8_t{1});
  Append(bytes, std::uint16_t{0});
  Append(bytes, static_cast<std::uint32_t>(count));
  Append(bytes, static_cast<double>(time.utime));
  Append(bytes, time.t_s);
  return bytes;
}

/// Rounded to a part of a metre, radian or second (a power of two) that nobody sees on a map: figures that
/// mean nothing would have to be sent, too.
float Rounded(double value, double parts) { return static_cast<float>(std::round(value * parts) / parts); }
constexpr double kOfMetre = 32;
constexpr double kOfRadian = 2048;
constexpr double kOfSecond = 32;

template <typename Number, typename Field>
void Column(std::string& bytes, const Rows& rows, Field field) {
  for (const auto& [id, row] : rows) Append(bytes, static_cast<Number>(field(*row)));
}

/// A column of a part of the row that may not be known: `otherwise` stands there then.
template <typename Number, typename Part, typename Value>
void Column(std::string& bytes, const Rows& rows, std::optional<Part> FleetRow::*part, Value Part::*field,
            Number otherwise) {
  for (const auto& [id, row] : rows) {
    Append(bytes, row->*part ? static_cast<Number>((*(row->*part)).*field) : otherwise);
  }
}

template <typename Part, typename Value>
void RoundedColumn(std::string& bytes, const Rows& rows, std::optional<Part> FleetRow::*part,
                   Value Part::*field, double parts, float otherwise = 0) {
  for (const auto& [id, row] : rows) {
    Append(bytes, row->*part ? Rounded((*(row->*part)).*field, parts) : otherwise);
  }
}

}  // namespace

std::string EncodeMotion(const recording::FleetTable& fleet, FrameTime time, bus::Utime now) {
  Rows rows;
  for (const auto& [id, row] : fleet.rows()) {
    if (row.state) rows.emplace_back(id, &row);
  }
  std::string bytes = Header(kMotionKind, rows.size(), time);
  const auto state = &FleetRow::state;
  for (const auto& [id, row] : rows) Append(bytes, id);
  RoundedColumn(bytes, rows, state, &vehicle_state_t::east_m, kOfMetre);
  RoundedColumn(bytes, rows, state, &vehicle_state_t::north_m, kOfMetre);
  RoundedColumn(bytes, rows, state, &vehicle_state_t::up_m, kOfMetre);
  RoundedColumn(bytes, rows, state, &vehicle_state_t::speed_m_s, kOfMetre);
  Column<float>(bytes, rows,
                [](const FleetRow& row) { return Rounded(WrapAngle(row.state->course_rad), kOfRadian); });
  RoundedColumn(bytes, rows, state, &vehicle_state_t::climb_rad, kOfRadian);
  Column<float>(bytes, rows,
                [&](const FleetRow& row) { return Rounded(bus::ToSeconds(now - row.heard_at), kOfSecond); });
  Column<std::uint8_t>(bytes, rows, [](const FleetRow& row) {
    return (row.state->payload_on ? 1 : 0) | (row.info && row.info->has_payload ? 2 : 0);
  });
  return bytes;
}

std::string EncodeStatus(const recording::FleetTable& fleet, FrameTime time) {
  Rows rows;
  for (const auto& [id, row] : fleet.rows()) rows.emplace_back(id, &row);
  std::string bytes = Header(kStatusKind, rows.size(), time);
  const auto slot = &FleetRow::slot;
  const auto near = &FleetRow::proximity;
  const auto link = &FleetRow::link;
  for (const auto& [id, row] : rows) Append(bytes, id);
  Column<std::int32_t>(bytes, rows, [](const FleetRow& row) { return row.formation_id; });
  RoundedColumn(bytes, rows, slot, &slot_status_t::forward_error_m, kOfMetre);
  RoundedColumn(bytes, rows, slot, &slot_status_t::left_error_m, kOfMetre);
  RoundedColumn(bytes, rows, slot, &slot_status_t::up_error_m, kOfMetre);
  Column(bytes, rows, near, &vehicle_proximity_t::nearest_id, std::int32_t{0});
  RoundedColumn(bytes, rows, near, &vehicle_proximity_t::nearest_horizontal_m, kOfMetre, -1);
  RoundedColumn(bytes, rows, near, &vehicle_proximity_t::nearest_vertical_m, kOfMetre, -1);
  Column(bytes, rows, near, &vehicle_proximity_t::tau_id, std::int32_t{0});
  RoundedColumn(bytes, rows, near, &vehicle_proximity_t::tau_s, kOfSecond, -1);
  Column(bytes, rows, near, &vehicle_proximity_t::level_with_id, std::int32_t{0});
  RoundedColumn(bytes, rows, link, &vehicle_link_t::downlink_age_s, kOfSecond, -1);
  RoundedColumn(bytes, rows, link, &vehicle_link_t::uplink_age_s, kOfSecond, -1);
  RoundedColumn(bytes, rows, link, &vehicle_link_t::estimated_east_m, kOfMetre);
  RoundedColumn(bytes, rows, link, &vehicle_link_t::estimated_north_m, kOfMetre);
  RoundedColumn(bytes, rows, link, &vehicle_link_t::estimated_up_m, kOfMetre);
  RoundedColumn(bytes, rows, link, &vehicle_link_t::horizontal_uncertainty_m, kOfMetre);
  RoundedColumn(bytes, rows, link, &vehicle_link_t::vertical_uncertainty_m, kOfMetre);
  Column(bytes, rows, near, &vehicle_proximity_t::level, std::uint8_t{0});
  constexpr auto kUnknown = static_cast<std::uint8_t>(link_status_t::LINK_UNKNOWN);
  Column(bytes, rows, link, &vehicle_link_t::downlink, kUnknown);
  Column(bytes, rows, link, &vehicle_link_t::uplink, kUnknown);
  Column<std::uint8_t>(bytes, rows, [](const FleetRow& row) {
    return (row.slot ? 1 : 0) | (row.slot && row.slot->flown ? 2 : 0);
  });
  return bytes;
}

}  // namespace skein::bridge
