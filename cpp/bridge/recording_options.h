#pragma once

#include <string>

#include "bridge/web_bridge.h"
#include "bus/node_main.h"

namespace skein::bridge {

struct RecordingOptions {
  std::string folder;  ///< --logs, "": none
  std::string file;    ///< --log, "": none
  bool no_bus = false;
};

/// --logs, --log and --no-bus.
void AddRecordingOptions(bus::NodeMain& node, RecordingOptions& recordings);

/// Has a bridge serve them. Throws std::runtime_error, saying what to do, when they cannot be.
void ServeRecordings(const RecordingOptions& recordings, BridgeOptions& options);

}  // namespace skein::bridge
