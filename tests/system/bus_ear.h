#pragma once

#include <functional>
#include <string>

#include "bus/bus.h"
#include "bus/live_executor.h"
#include "bus/transport.h"
#include "system/process.h"

namespace skein::testing {

/// Listens until a message comes of which `is_it` is true. False when none has within `timeout`.
template <typename Message>
bool Hears(const std::string& lcm_url, const std::string& channel,
           const std::function<bool(const Message&)>& is_it, Seconds timeout) {
  const bus::Transport transport = bus::MakeTransport(lcm_url);
  bus::LiveExecutor executor(transport.lcm);
  bus::Bus ear(transport.lcm, "system-test", executor);
  bool heard = false;
  ear.Subscribe<Message>(channel, [&](const Message& message) {
    if (!is_it(message)) return;
    heard = true;
    executor.Stop();
  });
  executor.At(executor.Now() + bus::ToUtime(timeout.count()), [&] { executor.Stop(); });
  executor.Run();
  return heard;
}

/// Whether a node's HEARTBEAT comes within `timeout`.
bool HearsHeartbeat(const std::string& lcm_url, const std::string& node, Seconds timeout = Seconds(15));

}  // namespace skein::testing
