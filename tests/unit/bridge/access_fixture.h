#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bridge_under_test.h"
#include "bus/command_inbox.h"
#include "live_client.h"
#include "raw_client.h"

namespace skein::bridge {

/// One good command for each channel of operators.
inline const std::vector<std::pair<std::string, std::string>> kCommands{
    {"CMD_LINK", R"({"vehicle_id":1,"mode":"silent"})"},
    {"CMD_PAYLOAD", R"({"vehicle_ids":[1],"on":true})"},
    {"CMD_FORMATION", R"({"action":"hold","formation":{"formation_id":1}})"},
    {"CMD_PATH", R"({"formation_id":1,"waypoints":[]})"},
    {"CMD_SIMULATION", R"({"action":"restart"})"},
    {"CMD_ALARM", R"({"action":"acknowledge","alarm_session_id":1,"alarm_ids":[1]})"},
    {"CMD_RECORDING", R"({"action":"start"})"},
};
std::set<std::string> ChannelsOfCommands();

/// {"a", "b", "c"} of what a refusal says that there is: "must be a, b or c", behind `before`.
std::set<std::string> NamedIn(const std::string& refusal, std::string_view before);

/// A bridge that demands tokens, and somebody of each kind who tries what can be tried.
class AccessTest : public testing::Test {
 protected:
  AccessTest();
  ~AccessTest() override;
  void Start(BridgeOptions options = {});

  std::uint16_t port() const { return bridge_->port(); }
  static std::string Bearer(const std::string& token) {
    return token.empty() ? "" : "Authorization: Bearer " + token + "\r\n";
  }
  std::string Cookie(const std::string& token) const {
    return "Cookie: skein_" + std::to_string(port()) + "=" + token + "\r\n";
  }
  static std::string CommandJson(const std::string& channel, const std::string& body) {
    return R"({"channel":")" + channel + R"(","body":)" + body + "}";
  }

  RawResponse Send(const std::string& method, const std::string& target, const std::string& body,
                   const std::string& headers) const;
  int Status(const std::string& method, const std::string& target, const std::string& body,
             const std::string& headers) const {
    return Send(method, target, body, headers).status;
  }
  /// Asks for a WebSocket; the status is 101 when it is granted.
  RawResponse Upgrade(const std::string& target, const std::string& headers) const;

  std::unique_ptr<LiveClient> Live(const std::string& token, const std::string& target = "/live") const {
    return std::make_unique<LiveClient>(port(), "", target, 0, token);
  }
  static nlohmann::json Ask(LiveClient& browser, const std::string& message);
  /// Somebody at the page who holds control, and the header that says so.
  std::string TakeControl();

  struct Row {
    std::string method, target, body;
    /// Statuses for nobody, a viewer, an operator without control, and one who holds it.
    int none, viewer, other, holder;
  };
  /// @param control the header of who holds control
  void Try(const Row& row, const std::string& control);
  /// Whether each method that the bridge says is allowed at `path` has been tried there.
  void ExpectAllAllowedTried(const std::string& path, const std::string& control);

  std::filesystem::path folder_;
  std::filesystem::path tokens_;
  std::string viewer_, other_, holder_;
  std::map<std::string, int> heard_;  ///< commands on the bus by channel; of its thread
  std::set<std::string> tried_;       ///< "GET /api/state", without a query
  std::unique_ptr<bus::CommandInbox> inbox_;
  std::unique_ptr<BridgeUnderTest> bridge_;
  std::unique_ptr<LiveClient> page_;
};

}  // namespace skein::bridge
