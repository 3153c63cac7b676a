#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

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

  /// @param channel "CMD_LINK", "CMD_PAYLOAD", "CMD_FORMATION", "CMD_PATH" or
  /// "CMD_SIMULATION". @param body as in README.md.
  /// `done` is called once, possibly at once.
  void Send(const std::string& channel, const nlohmann::json& body, Done done);

  static constexpr bus::Utime kResendAfter = 1 * bus::kSecond;
  static constexpr bus::Utime kGiveUpAfter = 2 * bus::kSecond;
  static constexpr std::size_t kMaxWaiting = 64;

 private:
  template <typename Command>
  void Publish(const std::string& channel, Command command, Done done);

  bus::Bus& bus_;
  bus::CommandOutbox outbox_;
};

}  // namespace skein::bridge
