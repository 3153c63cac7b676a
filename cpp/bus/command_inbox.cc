#include "bus/command_inbox.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "bus/channels.h"

namespace skein::bus {
namespace {

// Enough for a sender that repeats a request while later ones are under way.
constexpr std::size_t kAnswersKept = 64;
// Each run of the skein command is a session.
constexpr std::size_t kSessionsKept = 256;

}  // namespace

std::optional<Answer> CommandInbox::Known(const Request& request) const {
  const auto found = sessions_.find({request.channel, request.session_id});
  if (found == sessions_.end()) return std::nullopt;
  const Session& session = found->second;
  for (const auto& [request_id, answer] : session.answers) {
    if (request_id == request.request_id) return answer;
  }
  if (request.request_id > session.last_request_id) return std::nullopt;
  return Answer::Refused("request " + std::to_string(request.request_id) + " is older than request " +
                         std::to_string(session.last_request_id) + ", which was obeyed");
}

void CommandInbox::Remember(const Request& request, const Answer& answer) {
  Session& session = sessions_[{request.channel, request.session_id}];
  session.answers.emplace_back(request.request_id, answer);
  if (session.answers.size() > kAnswersKept) session.answers.pop_front();
  session.last_request_id = request.request_id;
  session.last_use = ++uses_;
  if (sessions_.size() > kSessionsKept) {
    const auto by_use = [](const auto& a, const auto& b) { return a.second.last_use < b.second.last_use; };
    sessions_.erase(std::min_element(sessions_.begin(), sessions_.end(), by_use));
  }
}

void CommandInbox::Acknowledge(const Request& request, const Answer& answer) {
  ack_t ack;
  ack.utime = bus_.executor().Now();
  ack.command_session_id = request.session_id;
  ack.command_request_id = request.request_id;
  ack.node = bus_.node();
  ack.command_channel = request.channel;
  ack.accepted = answer.accepted;
  ack.reason = answer.reason;
  bus_.Publish(channel::kAck, ack);
  if (!answer.accepted && bus_.logs()) spdlog::info("{} refused: {}", request.channel, answer.reason);
}

}  // namespace skein::bus
