#pragma once

/// Who sends and hears what: lcmtypes/README.md.
namespace skein::bus::channel {

inline constexpr const char* kFleetRoster = "FLEET_ROSTER";
inline constexpr const char* kFleetState = "FLEET_STATE";
inline constexpr const char* kCmdFleet = "CMD_FLEET";
inline constexpr const char* kCmdLink = "CMD_LINK";
inline constexpr const char* kCmdPayload = "CMD_PAYLOAD";
inline constexpr const char* kCmdSimulation = "CMD_SIMULATION";
inline constexpr const char* kCmdFormation = "CMD_FORMATION";
inline constexpr const char* kCmdPath = "CMD_PATH";
inline constexpr const char* kCmdAlarm = "CMD_ALARM";
inline constexpr const char* kCmdRecording = "CMD_RECORDING";
inline constexpr const char* kFormation = "FORMATION";
inline constexpr const char* kPath = "PATH";
inline constexpr const char* kFormationStatus = "FORMATION_STATUS";
inline constexpr const char* kProximity = "PROXIMITY";
inline constexpr const char* kLinkStatus = "LINK_STATUS";
inline constexpr const char* kAlarms = "ALARMS";
inline constexpr const char* kRecording = "RECORDING";
inline constexpr const char* kAck = "ACK";
inline constexpr const char* kEvent = "EVENT";
inline constexpr const char* kHeartbeat = "HEARTBEAT";

}  // namespace skein::bus::channel
