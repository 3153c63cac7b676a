#pragma once

#include <string>
#include <vector>

#include "experiment/flight_record.h"

namespace skein::experiment {

/// An SVG figure in the manner of Figs. 6 and 8 of [1]: forward, left and up error, speed, altitude and track
/// of every UAV, cuts and returns of data links as vertical lines; several runs over one another.
std::string PlotSvg(const std::string& title, const std::vector<FlightRecord>& runs);

}  // namespace skein::experiment
