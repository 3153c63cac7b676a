#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "bus/bus.h"

namespace skein::bus {

/// A node's answer to an operator: accepted (perhaps with a remark), or why not.
struct Answer {
  bool accepted = true;
  std::string reason;

  static Answer Accepted(std::string remark = "") { return {true, std::move(remark)}; }
  static Answer Refused(std::string why) { return {false, std::move(why)}; }
};

/// Takes operators' commands (CMD_LINK, CMD_PAYLOAD, CMD_FORMATION, CMD_PATH, CMD_ALARM) and answers each on
/// ACK. A request that comes again (its ACK was lost) is answered again, not done again; one older than the
/// last of its session that was never seen is refused. So is one that is addressed to another run of the node
/// (to_session_id), such as any out of a recording; the answer tells the address of this run. By session and
/// request number, never by age, so clocks do not matter.
///
///   inbox.Obey<link_command_t>(channel::kCmdLink, [this](const link_command_t& command) { return
///   SetLink(command); });
class CommandInbox {
 public:
  explicit CommandInbox(Bus& bus) : bus_(bus) {}

  template <typename Command>
  void Obey(const std::string& channel, std::function<Answer(const Command&)> obey) {
    bus_.Subscribe<Command>(channel, [this, channel, obey = std::move(obey)](const Command& command) {
      const Request request{channel, command.session_id, command.request_id};
      // Not remembered: the same request is obeyed when it comes again with the right address.
      if (command.to_session_id != bus_.session_id()) return Acknowledge(request, ForAnotherRun());
      auto answer = Known(request);
      if (!answer) {
        answer = obey(command);
        Remember(request, *answer);
      }
      Acknowledge(request, *answer);
    });
  }

 private:
  struct Request {
    std::string channel;
    std::int64_t session_id = 0;
    std::int64_t request_id = 0;
  };

  /// The last answers that one sender got on one channel.
  struct Session {
    std::deque<std::pair<std::int64_t, Answer>> answers;  ///< by request_id, in the order of arrival
    std::int64_t last_use = 0;
  };
  using SessionKey = std::pair<std::string, std::int64_t>;  ///< channel and session_id

  Answer ForAnotherRun() const;
  std::optional<Answer> Known(const Request& request) const;
  void Remember(const Request& request, const Answer& answer);
  void Acknowledge(const Request& request, const Answer& answer);

  Bus& bus_;
  std::map<SessionKey, Session> sessions_;
  std::map<SessionKey, std::int64_t> last_request_ids_;  ///< kept for longer than the answers
  std::int64_t uses_ = 0;
};

}  // namespace skein::bus
