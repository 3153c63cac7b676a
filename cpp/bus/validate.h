#pragma once

#include <skein/ack_t.hpp>
#include <skein/alarm_command_t.hpp>
#include <skein/alarm_list_t.hpp>
#include <skein/event_t.hpp>
#include <skein/fleet_command_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_command_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/heartbeat_t.hpp>
#include <skein/link_command_t.hpp>
#include <skein/link_status_t.hpp>
#include <skein/path_command_t.hpp>
#include <skein/path_t.hpp>
#include <skein/payload_command_t.hpp>
#include <skein/proximity_t.hpp>
#include <skein/recording_command_t.hpp>
#include <skein/recording_status_t.hpp>
#include <skein/simulation_command_t.hpp>

/// Whether a decoded message keeps what its .lcm file promises: finite numbers of a size that no sum
/// overflows, ids, chunks and enumerations in range, text that is UTF-8 without control characters. Handlers
/// may rely on it (Bus checks it).
///
/// The content of an operator's command is checked only so far that nothing breaks: the node that obeys says
/// in its ACK what is wrong with the rest, which a dropped message could not.
namespace skein::bus {

bool Valid(const ack_t& ack);
bool Valid(const alarm_command_t& command);
bool Valid(const alarm_list_t& list);
bool Valid(const event_t& event);
bool Valid(const fleet_command_t& command);
bool Valid(const fleet_roster_t& roster);
bool Valid(const fleet_state_t& state);
bool Valid(const formation_command_t& command);
bool Valid(const formation_status_t& status);
bool Valid(const formation_t& formation);
bool Valid(const heartbeat_t& heartbeat);
bool Valid(const link_command_t& command);
bool Valid(const link_status_t& status);
bool Valid(const path_command_t& command);
bool Valid(const path_t& path);
bool Valid(const payload_command_t& command);
bool Valid(const proximity_t& proximity);
bool Valid(const recording_command_t& command);
bool Valid(const recording_status_t& status);
bool Valid(const simulation_command_t& command);

}  // namespace skein::bus
