#pragma once

#include <cstdint>
#include <skein/alarm_list_t.hpp>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/link_status_t.hpp>
#include <skein/proximity_t.hpp>
#include <vector>

namespace skein::bus {

/// What splitting and assembling need to know of a type that travels in chunks:
///   Items(message)   its vector, and SetCount the field that tells the vector's length
///   Stream(message)  several independent sequences on one channel (a formation each), else 0
///   Session(message) of the sender, 0 where the type has none
///   Set(message)     what the chunks of one set share and no other set of the session has
///   kConsecutive     whether Set() rises by one from set to set, so that a missing set can be told
template <typename Message>
struct ChunkTraits;

template <>
struct ChunkTraits<fleet_state_t> {
  static auto& Items(auto& message) { return message.vehicles; }
  static void SetCount(fleet_state_t& message, int count) { message.num_vehicles = count; }
  static std::int64_t Stream(const fleet_state_t&) { return 0; }
  static std::int64_t Session(const fleet_state_t& message) { return message.session_id; }
  static std::int64_t Set(const fleet_state_t& message) { return message.tick; }
  static constexpr bool kConsecutive = true;
};

template <>
struct ChunkTraits<fleet_roster_t> {
  static auto& Items(auto& message) { return message.vehicles; }
  static void SetCount(fleet_roster_t& message, int count) { message.num_vehicles = count; }
  static std::int64_t Stream(const fleet_roster_t&) { return 0; }
  static std::int64_t Session(const fleet_roster_t& message) { return message.session_id; }
  static std::int64_t Set(const fleet_roster_t& message) { return message.utime; }
  static constexpr bool kConsecutive = false;
};

template <>
struct ChunkTraits<fleet_command_t> {
  static auto& Items(auto& message) { return message.commands; }
  static void SetCount(fleet_command_t& message, int count) { message.num_commands = count; }
  static std::int64_t Stream(const fleet_command_t&) { return 0; }
  static std::int64_t Session(const fleet_command_t& message) { return message.session_id; }
  static std::int64_t Set(const fleet_command_t& message) { return message.state_tick; }
  static constexpr bool kConsecutive = false;
};

template <>
struct ChunkTraits<formation_status_t> {
  static auto& Items(auto& message) { return message.slots; }
  static void SetCount(formation_status_t& message, int count) { message.num_slots = count; }
  static std::int64_t Stream(const formation_status_t& message) { return message.formation_id; }
  static std::int64_t Session(const formation_status_t&) { return 0; }
  static std::int64_t Set(const formation_status_t& message) { return message.tick; }
  static constexpr bool kConsecutive = false;
};

template <>
struct ChunkTraits<proximity_t> {
  static auto& Items(auto& message) { return message.vehicles; }
  static void SetCount(proximity_t& message, int count) { message.num_vehicles = count; }
  static std::int64_t Stream(const proximity_t&) { return 0; }
  static std::int64_t Session(const proximity_t&) { return 0; }
  static std::int64_t Set(const proximity_t& message) { return message.sweep; }
  static constexpr bool kConsecutive = true;
};

template <>
struct ChunkTraits<alarm_list_t> {
  static auto& Items(auto& message) { return message.alarms; }
  static void SetCount(alarm_list_t& message, int count) { message.num_alarms = count; }
  static std::int64_t Stream(const alarm_list_t&) { return 0; }
  static std::int64_t Session(const alarm_list_t& message) { return message.session_id; }
  static std::int64_t Set(const alarm_list_t& message) { return message.sequence; }
  static constexpr bool kConsecutive = true;
};

template <>
struct ChunkTraits<link_status_t> {
  static auto& Items(auto& message) { return message.links; }
  static void SetCount(link_status_t& message, int count) { message.num_links = count; }
  static std::int64_t Stream(const link_status_t&) { return 0; }
  static std::int64_t Session(const link_status_t&) { return 0; }
  static std::int64_t Set(const link_status_t& message) { return message.sequence; }
  static constexpr bool kConsecutive = true;
};

}  // namespace skein::bus
