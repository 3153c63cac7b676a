// Every request, as everybody: access_messages_test.cc has those of the WebSocket, recordings_access_test.cc
// those of recordings.

#include <fstream>
#include <regex>

#include "access_fixture.h"

namespace skein::bridge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class AccessTable : public AccessTest {
 protected:
  AccessTable() {
    fs::create_directories(folder_ / "map" / "3" / "6");
    std::ofstream(folder_ / "map" / "3" / "6" / "3.png") << "a tile";
    BridgeOptions options;
    options.tiles.emplace(folder_ / "map");
    Start(options);
  }
};

TEST_F(AccessTable, EveryRequestIsAnsweredAsEachMay) {
  const std::string control = TakeControl();
  const std::string right_token = json{{"token", viewer_}}.dump();
  std::vector<Row> rows{
      {"GET", "/", "", 200, 200, 200, 200},
      {"GET", "/api/health", "", 200, 200, 200, 200},
      {"GET", "/api/session", "", 401, 200, 200, 200},
      // Signing in and out opens and closes nothing for others, so anybody may.
      {"POST", "/api/session", right_token, 200, 200, 200, 200},
      {"POST", "/api/session", "{}", 400, 400, 400, 400},
      {"PUT", "/api/session", right_token, 405, 405, 405, 405},
      {"DELETE", "/api/session", "", 200, 200, 200, 200},
      {"GET", "/api/state", "", 401, 200, 200, 200},
      {"GET", "/api/vehicles", "", 401, 200, 200, 200},
      {"GET", "/api/scenarios", "", 401, 200, 200, 200},
      {"GET", "/api/history", "", 401, 400, 400, 400},
      {"GET", "/api/history?ids=1", "", 401, 200, 200, 200},
      {"GET", "/api/recordings", "", 401, 404, 404, 404},  // this bridge has none
      {"GET", "/api/recordings/x", "", 401, 404, 404, 404},
      {"GET", "/api/recordings/x/file", "", 401, 404, 404, 404},
      {"DELETE", "/api/recordings/x", "", 401, 403, 404, 404},
      {"GET", "/tiles/3/6/3.png", "", 401, 200, 200, 200},
      {"GET", "/tiles/3/6/4.png", "", 401, 204, 204, 204},
      {"GET", "/tiles.pmtiles", "", 401, 404, 404, 404},
      {"GET", "/live", "", 426, 426, 426, 426},
      {"GET", "/api/none", "", 401, 404, 404, 404},
      {"POST", "/api/none", "", 401, 403, 405, 405},
      {"GET", "/api//state", "", 401, 404, 404, 404},
      {"GET", "/api/%73tate", "", 401, 404, 404, 404},
      {"GET", "//api/state", "", 200, 200, 200, 200},  // the page, as any path without an extension
      {"GET", "/api/command", "", 401, 405, 405, 405},
      {"PUT", "/api/command", CommandJson("CMD_LINK", kCommands[0].second), 401, 403, 405, 405},
      {"OPTIONS", "/api/command", "", 401, 403, 405, 405},
      {"POST", "/api/command", CommandJson("CMD_FLEET", "{}"), 401, 403, 409, 400},
      {"POST", "/api/command", CommandJson("CMD_NONE", "{}"), 401, 403, 409, 400},
      {"POST", "/api/command", "[", 401, 403, 409, 400},
      {"POST", "/api/preview/formation", "{}", 401, 403, 400, 400},
      {"POST", "/api/preview/path", "{}", 401, 403, 400, 400},
  };
  for (const auto& [channel, body] : kCommands)
    rows.push_back({"POST", "/api/command", CommandJson(channel, body), 401, 403, 409, 200});
  for (const Row& row : rows) {
    Try(row, control);
    if (row.method == "GET")
      Try({"HEAD", row.target, "", row.none, row.viewer, row.other, row.holder}, control);
  }
  // Only who holds control has been heard, once for each.
  bridge_->OnBus([this](bus::Bus&) {
    for (const auto& [channel, body] : kCommands) EXPECT_EQ(heard_[channel], 1) << channel;
    EXPECT_EQ(heard_.size(), kCommands.size());
  });

  // Nothing is left out of what the bridge says that it has.
  const auto unknown =
      Send("POST", "/api/command", CommandJson("CMD_NONE", "{}"), Bearer(holder_) + control).body;
  EXPECT_EQ(NamedIn(json::parse(unknown)["reason"], "channel: must be "), ChannelsOfCommands());
  const std::string api = Send("GET", "/api/none", "", Bearer(viewer_)).body;
  const std::regex path("/api/[a-z/]+");
  std::set<std::string> paths{"/"};
  for (std::sregex_iterator found(api.begin(), api.end(), path), end; found != end; ++found)
    paths.insert(found->str());
  EXPECT_GE(paths.size(), 11U) << api;
  for (const std::string& one : paths) ExpectAllAllowedTried(one, control);
}

}  // namespace
}  // namespace skein::bridge
