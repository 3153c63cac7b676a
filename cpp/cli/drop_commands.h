#pragma once

#include <skein/link_command_t.hpp>
#include <string>

#include "bus/executor.h"
#include "cli/drop_plan.h"

namespace skein::cli {

/// How drops are made: by CMD_LINK, or by a program.
///
/// @param drop null: as at the start of the scenario. @param for_s 0: until changed
link_command_t LinkCommand(int id, bool uplink, bool downlink, const Drop* drop, bus::Utime at, double for_s);

/// Runs the program that makes drops instead of CMD_LINK: PROGRAM begin|end NUMBER UAV DIRECTION LOSS
/// DELAY_S. Waits for its end. Throws Failure when it cannot be run or fails.
void CallHook(const std::string& hook, const char* what, int number, const Drop& drop);

}  // namespace skein::cli
