#pragma once

#include <string>

#include "recording/fleet_table.h"

namespace skein::bridge {

/// Header of both: u8 kind, u8 version = 1, u16 0, u32 count, f64 utime [us], f64 t_s since the scenario's
/// start. Little-endian columns follow, first those of 4 bytes, so that a browser can lay typed arrays over
/// them. README.md has the layout.
struct FrameTime {
  bus::Utime utime = 0;  ///< of the latest FLEET_STATE
  double t_s = -1;       ///< -1: not known
};

inline constexpr unsigned char kMotionKind = 1;
inline constexpr unsigned char kStatusKind = 2;
inline constexpr unsigned char kHistoryKind = 3;  ///< history_answer.h

/// Where everybody is; UAVs never heard are left out.
std::string EncodeMotion(const recording::FleetTable& fleet, FrameTime time, bus::Utime now);

/// Slots, proximity and links of everybody.
std::string EncodeStatus(const recording::FleetTable& fleet, FrameTime time);

}  // namespace skein::bridge
