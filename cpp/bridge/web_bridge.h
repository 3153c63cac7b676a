#pragma once

// GCC 12 with Boost 1.74 needs <utility> before Asio.
#include <utility>

#include <boost/asio/io_context.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bridge/bus_mirror.h"
#include "bridge/command_gateway.h"
#include "bridge/map_tiles.h"
#include "bridge/previewer.h"
#include "bridge/recordings.h"
#include "bridge/web_server.h"
#include "bus/events.h"
#include "bus/live_executor.h"
#include "bus/state_file.h"

namespace skein::bridge {

struct BridgeOptions {
  std::string listen = "127.0.0.1";
  std::uint16_t port = 8080;  ///< 0: any that is free
  std::filesystem::path web_folder;
  std::vector<std::string> allowed_hosts;
  std::filesystem::path tokens_file;  ///< of the tokens that are demanded, "": none
  std::optional<MapTiles> tiles;
  /// Makes what serves recordings, owned by the bridge alone (its threads end with it); none: there are none.
  std::function<std::shared_ptr<const Recordings>()> make_recordings;
  /// Where is kept who holds control, so that he still does when the bridge was killed and is back; "":
  /// nowhere.
  std::filesystem::path state_file;
  HelloInfo hello;
};

/// The bus on one side, browsers on the other, a thread each. Mirror and gateway live on the bus's thread,
/// the web server on its own, flights ahead on two more; they share nothing but frames that never change, and
/// hand work over by posting it. README.md draws it.
class WebBridge {
 public:
  /// Serves at once. Throws bus::StartError when it cannot listen. `executor` is that of `bus`, and does not
  /// run any more when the bridge ends.
  WebBridge(bus::Bus& bus, bus::LiveExecutor& executor, const BridgeOptions& options);
  ~WebBridge();
  WebBridge(const WebBridge&) = delete;
  WebBridge& operator=(const WebBridge&) = delete;

  std::uint16_t port() const { return port_; }

 private:
  Backend MakeBackend(bus::LiveExecutor& executor, bool replay);
  /// Who held control when the bridge died a moment ago; none: nobody.
  std::optional<KeptHolder> ReadHolder();
  void SaveHolder();

  bus::LiveExecutor& executor_;
  BusMirror mirror_;
  CommandGateway gateway_;
  bus::Events events_;
  bus::StateFile state_file_;
  std::optional<KeptHolder> holder_;  ///< on the bus's thread
  boost::asio::io_context web_context_;
  WebServer server_;
  std::uint16_t port_;
  std::thread web_thread_;
  Previewer previewer_;  ///< last: its threads end before what they post to
};

}  // namespace skein::bridge
