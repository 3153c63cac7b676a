#pragma once

#include <skein/formation_t.hpp>
#include <skein/path_t.hpp>
#include <string>
#include <variant>

#include "bus/executor.h"
#include "config/scenario.h"
#include "controller/formation_flight.h"

namespace skein::controller {

/// FORMATION and PATH as the controller repeats them.
formation_t FormationMessage(const FormationFlight& flight, bus::Utime utime);
path_t PathMessage(const FormationFlight& flight, bus::Utime utime);

/// The formation that a message describes, or why it describes none, in words for an operator.
std::variant<config::FormationConfig, std::string> ToFormationConfig(const formation_t& message);

}  // namespace skein::controller
