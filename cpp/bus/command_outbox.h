#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <skein/ack_t.hpp>
#include <string>
#include <utility>

#include "bus/bus.h"
#include "bus/command_inbox.h"

namespace skein::bus {

/// Sends an operator's commands and takes the answers: the other end of CommandInbox. A node obeys what is
/// addressed to its present run, which each ACK tells. So a command to a node that is not known yet, or has
/// been started anew, is refused first, and goes out again at once with the address of the refusal.
class CommandOutbox {
 public:
  using Done = std::function<void(const Answer&)>;

  explicit CommandOutbox(Bus& bus);

  /// Returns the request_id. `done` is called once, when the answer comes, or never.
  template <typename Command>
  std::int64_t Send(const std::string& channel, Command command, Done done) {
    command.session_id = bus_.session_id();
    command.request_id = ++last_request_id_;
    const auto publish = [this, channel, command = std::move(command)](std::int64_t to_session_id) mutable {
      command.utime = bus_.executor().Now();
      command.to_session_id = to_session_id;
      bus_.Publish(channel, command);
    };
    waiting_[last_request_id_] = {channel, publish, std::move(done), addresses_[channel]};
    Repeat(last_request_id_);
    return last_request_id_;
  }

  /// Sends again what has not been answered: a message may get lost.
  void Repeat(std::int64_t request_id);
  /// Gives up. Returns false when it has been answered.
  bool Forget(std::int64_t request_id);
  /// How many commands wait for an answer.
  std::size_t waiting() const { return waiting_.size(); }

 private:
  struct Waiting {
    std::string channel;
    std::function<void(std::int64_t to_session_id)> publish;
    Done done;
    std::int64_t to_session_id = 0;
    bool readdressed = false;
  };

  void Hear(const ack_t& ack);

  Bus& bus_;
  std::int64_t last_request_id_ = 0;
  std::map<std::int64_t, Waiting> waiting_;
  std::map<std::string, std::int64_t> addresses_;  ///< by channel: session_id of who obeys, as ACK tells
};

}  // namespace skein::bus
