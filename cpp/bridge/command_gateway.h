#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.h"
#include "bus/command_outbox.h"

namespace skein::bridge {

struct CommandResult {
  enum class Outcome { kAccepted, kRefused, kMalformed, kBusy, kNoAnswer };
  Outcome outcome = Outcome::kAccepted;
  std::string reason;  ///< "" when accepted without a remark

  bool accepted() const { return outcome == Outcome::kAccepted; }
};

/// Puts a browser's commands on the bus and waits for the node that obeys. Sends again after 1 s, gives up
/// after 2 s.
class CommandGateway {
 public:
  using Done = std::function<void(const CommandResult&)>;

  explicit CommandGateway(bus::Bus& bus);
  CommandGateway(const CommandGateway&) = delete;
  CommandGateway& operator=(const CommandGateway&) = delete;

  /// @param channel of an operator's command, "CMD_LINK" for one; others are refused by name. @param body as
  /// in README.md. `done` is called once, possibly at once.
  void Send(const std::string& channel, const nlohmann::json& body, Done done);

  static constexpr bus::Utime kResendAfter = 1 * bus::kSecond;
  static constexpr bus::Utime kGiveUpAfter = 2 * bus::kSecond;
  static constexpr std::size_t kMaxWaiting = 64;

 private:
  using SendBody = std::function<void(const nlohmann::json& body, const Done&)>;

  template <typename Parse>
  void Take(const char* channel, const char* obeyed_by, Parse parse);
  template <typename Command>
  void Publish(const std::string& channel, const char* obeyed_by, Command command, Done done);

  bus::Bus& bus_;
  bus::CommandOutbox outbox_;
  std::vector<std::pair<std::string, SendBody>> channels_;  ///< all that are taken
};

}  // namespace skein::bridge
