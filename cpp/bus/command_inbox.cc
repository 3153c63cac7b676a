#include "bus/command_inbox.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "bus/channels.h"
#include "bus/text.h"

namespace skein::bus {
namespace {

// Enough for a sender that repeats a request while later ones are under way.
constexpr std::size_t kAnswersKept = 64;
// Each run of the skein command is a session.
constexpr std::size_t kSessionsKept = 256;
// A recording of this very run may be played to it: what it has obeyed it must know again, days later, too.
constexpr std::size_t kRequestIdsKept = 100'000;

}  // namespace

std::optional<Answer> CommandInbox::Known(const Request& request) const {
  const SessionKey key{request.channel, request.session_id};
  const auto last = last_request_ids_.find(key);
  if (last == last_request_ids_.end() || request.request_id > last->second) return std::nullopt;
  if (const auto session = sessions_.find(key); session != sessions_.end()) {
    for (const auto& [request_id, answer] : session->second.answers) {
      if (request_id == request.request_id) return answer;
    }
  }
  return Answer::Refused("request " + std::to_string(request.request_id) + " is not newer than request " +
                         std::to_string(last->second) + ", which was obeyed");
}

Answer CommandInbox::ForAnotherRun() const {
  return Answer::Refused("meant for another run of " + bus_.node() + ": send it again");
}

void CommandInbox::Remember(const Request& request, const Answer& answer) {
  // Not of those who only ask for the address of this run.
  if (!answer.accepted && bus_.logs()) spdlog::info("{} refused: {}", request.channel, answer.reason);
  const SessionKey key{request.channel, request.session_id};
  Session& session = sessions_[key];
  session.answers.emplace_back(request.request_id, answer);
  if (session.answers.size() > kAnswersKept) session.answers.pop_front();
  last_request_ids_[key] = request.request_id;
  session.last_use = ++uses_;
  if (sessions_.size() > kSessionsKept) {
    const auto by_use = [](const auto& a, const auto& b) { return a.second.last_use < b.second.last_use; };
    sessions_.erase(std::min_element(sessions_.begin(), sessions_.end(), by_use));
  }
  // The first one of a channel is its oldest.
  if (last_request_ids_.size() > kRequestIdsKept)
    last_request_ids_.erase(last_request_ids_.lower_bound({key.first, 0}));
}

void CommandInbox::Acknowledge(const Request& request, const Answer& answer) {
  ack_t ack;
  ack.utime = bus_.executor().Now();
  ack.command_session_id = request.session_id;
  ack.command_request_id = request.request_id;
  ack.node = bus_.node();
  ack.session_id = bus_.session_id();
  ack.command_channel = request.channel;
  ack.accepted = answer.accepted;
  ack.reason = Shortened(answer.reason);
  bus_.Publish(channel::kAck, ack);
}

}  // namespace skein::bus
