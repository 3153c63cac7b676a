#pragma once

#include <string>

namespace skein::bus {

/// Waits until the hub of a tcpq:// URL takes connections; at once for any other URL. A hub that is started
/// again may take its time, and nodes that come back before it are not to give up. Returns false when SIGINT
/// or SIGTERM came first; they are to be blocked (BlockEndSignals).
bool AwaitHub(const std::string& url);

}  // namespace skein::bus
