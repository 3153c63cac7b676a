#pragma once

#include <nlohmann/json_fwd.hpp>
#include <skein/alarm_command_t.hpp>
#include <skein/formation_command_t.hpp>
#include <skein/link_command_t.hpp>
#include <skein/path_command_t.hpp>
#include <skein/payload_command_t.hpp>
#include <skein/recording_command_t.hpp>
#include <skein/simulation_command_t.hpp>

#include "bus/executor.h"

namespace skein::bridge {

/// Commands from JSON bodies (README.md has their fields); utime, session_id and request_id are left for the
/// sender. A field that is unknown, missing, of the wrong type or out of range throws config::ConfigError
/// with channel, place and reason: "CMD_LINK: /vehicle_id: must be a whole number, is 1.5".
/// @{
link_command_t ParseLinkCommand(const nlohmann::json& body, bus::Utime now);
payload_command_t ParsePayloadCommand(const nlohmann::json& body);
formation_command_t ParseFormationCommand(const nlohmann::json& body);
path_command_t ParsePathCommand(const nlohmann::json& body);
simulation_command_t ParseSimulationCommand(const nlohmann::json& body);
alarm_command_t ParseAlarmCommand(const nlohmann::json& body);
recording_command_t ParseRecordingCommand(const nlohmann::json& body);
/// @}

}  // namespace skein::bridge
