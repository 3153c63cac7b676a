#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "access/tokens.h"
#include "bridge/access_rules.h"
#include "bridge/recording_options.h"
#include "bridge/static_files.h"
#include "bridge/web_bridge.h"
#include "bus/node_main.h"
#include "bus/number_checks.h"

int main(int argc, char** argv) {
  namespace bridge = skein::bridge;
  skein::bus::NodeMain node(
      "web-bridge",
      "Serves the web app, streams the bus to browsers and takes their commands; serves "
      "recordings, too.");
  bridge::BridgeOptions options;
  options.web_folder = bridge::DefaultWebFolder(std::filesystem::read_symlink("/proc/self/exe"));
  std::string web_folder;
  std::string tiles;
  node.app()
      .add_option("--listen", options.listen, "Address to listen on; one that others reach needs --tokens")
      ->capture_default_str();
  std::string tokens;
  node.app()
      .add_option(
          "--tokens", tokens,
          "File of the tokens that let people in, as skein token makes it; without FILE the one that it "
          "makes by itself (" +
              skein::access::DefaultTokensFile().string() + ")")
      ->type_name("FILE")
      ->expected(0, 1)
      ->default_str(skein::access::DefaultTokensFile());
  node.app().add_option("--port", options.port, "TCP port, 0 for a free one")->capture_default_str();
  node.app()
      .add_option("--web", web_folder, "Folder of the built web app (default: the project's own)")
      ->check(CLI::ExistingDirectory);
  node.app().add_option(
      "--allow-host", options.allowed_hosts,
      "Name by which browsers may call this bridge, beside localhost and its address; may be repeated");
  node.app()
      .add_option("--tile-url", options.hello.tile_url,
                  "Map tiles over the offline map, such as https://tile.openstreetmap.org/{z}/{x}/{y}.png")
      ->check([](const std::string& url) { return bridge::TileUrlProblem(url); });
  node.app()
      .add_option(
          "--tiles", tiles,
          "Your own map, with no internet: a folder of raster tiles {z}/{x}/{y}.png, or a PMTiles file")
      ->check(CLI::ExistingPath);
  node.app().add_option("--tile-attribution", options.hello.tile_attribution,
                        "What the map must say of its tiles");
  node.app().add_option("--state-file", options.state_file,
                        "Keeps who holds control here, who still does after a restart within 10 s");
  std::string replay;
  double replay_speed = 1;
  auto* replay_option = node.app().add_option("--replay", replay,
                                              "Name of a recording that lcm-logplayer plays on this bus: the "
                                              "page says so, and nothing can be commanded");
  node.app()
      .add_option("--replay-speed", replay_speed,
                  "So many times as fast as it was it is played, for the page to say")
      ->needs(replay_option)
      ->check(skein::bus::Positive())
      ->capture_default_str();
  bridge::RecordingOptions recordings;
  bridge::AddRecordingOptions(node, recordings);
  return node.Run(argc, argv, [&](skein::bus::Bus& bus, skein::bus::LiveExecutor& executor) {
    if (!web_folder.empty()) {
      options.web_folder = web_folder;
      if (!std::filesystem::exists(options.web_folder / "index.html")) {
        throw std::runtime_error("--web " + web_folder + ": holds no index.html");
      }
    }
    options.tokens_file = tokens;
    if (!tiles.empty()) {
      options.tiles.emplace(tiles);
      options.hello.tiles = options.tiles->Description();
    }
    if (!replay.empty())
      options.hello.replay = {{"kind", "player"}, {"name", replay}, {"speed", replay_speed}};
    options.hello.version = SKEIN_VERSION;
    options.hello.lcm_url = node.lcm_url();
    bridge::ServeRecordings(recordings, options);
    auto result = std::make_shared<bridge::WebBridge>(bus, executor, options);
    spdlog::info("http://{}:{}", options.listen, result->port());
    return result;
  });
}
