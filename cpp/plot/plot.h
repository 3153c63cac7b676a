#pragma once

#include <string>
#include <vector>

#include "plot/flight_record.h"

namespace skein::plot {

enum class Figure {
  kAssembly,  ///< Fig. 6 of [1]: forward, left and up error and speed
  kFlight,    ///< Fig. 8 of [1]: the same, altitude and track
};

struct PlotOptions {
  Figure figure = Figure::kFlight;
  std::string time_label = "Time [s]";
};

/// An SVG figure in the manner of [1]: a curve for every UAV, cuts and returns of data links as vertical
/// lines; several runs over one another.
std::string PlotSvg(const std::string& title, const std::vector<FlightRecord>& runs,
                    const PlotOptions& options = {});

}  // namespace skein::plot
