#include "bridge/live_hub.h"

#include <nlohmann/json.hpp>

#include "bridge/json_messages.h"

namespace skein::bridge {
namespace {

using nlohmann::json;

LiveFrame Ack(const json& id, const std::string& channel, const CommandResult& result) {
  return TextFrame(Dump({{"type", "ack"},
                         {"id", Json(id)},
                         {"channel", channel},
                         {"accepted", result.accepted()},
                         {"reason", result.reason}}));
}

/// The text at `key`, "" when there is none.
std::string Text(const json& object, const char* key) {
  const auto member = object.find(key);
  return member != object.end() && member->is_string() ? member->get<std::string>() : "";
}

}  // namespace

void LiveHub::Join(const std::shared_ptr<LiveSession>& session) {
  backend_.snapshot([this, weak = std::weak_ptr(session)](const std::vector<LiveFrame>& frames) {
    const auto session = weak.lock();
    if (!session) return;
    for (const LiveFrame& frame : frames) session->Send(frame);
    sessions_.push_back(session);
  });
}

void LiveHub::Broadcast(const LiveFrame& frame) {
  std::erase_if(sessions_, [&](const std::weak_ptr<LiveSession>& weak) {
    const auto session = weak.lock();
    if (session) session->Send(frame);
    return !session;
  });
}

void LiveHub::Hear(const std::shared_ptr<LiveSession>& session, const std::string& text) const {
  json message = json::parse(text, nullptr, false);
  if (!message.is_object()) message = json::object();
  const json id = message.value("id", json());
  const std::string channel = Text(message, "channel");
  const auto refuse = [&](CommandResult::Outcome outcome, const char* reason) {
    session->Send(Ack(id.is_string() || id.is_number() ? id : json(), channel, {outcome, reason}));
  };
  using Outcome = CommandResult::Outcome;
  if (Text(message, "type") != "command")
    return refuse(Outcome::kMalformed, "the message is no JSON object of type command");
  if (!id.is_string() && !id.is_number())
    return refuse(Outcome::kMalformed, "id: must be a text or a number");
  if (channel.empty()) return refuse(Outcome::kMalformed, "channel: must be a text");
  if (!message.contains("body")) return refuse(Outcome::kMalformed, "body: is missing");
  if (message.size() != 4)
    return refuse(Outcome::kMalformed, "only type, id, channel and body belong in a command");
  if (session->waiting_commands >= kMaxWaitingCommands) {
    return refuse(Outcome::kBusy, "too many commands wait for an answer: try again in 2 s");
  }
  ++session->waiting_commands;
  backend_.command(channel, std::move(message["body"]),
                   [weak = std::weak_ptr(session), id, channel](const CommandResult& result) {
                     const auto session = weak.lock();
                     if (!session) return;
                     --session->waiting_commands;
                     session->Send(Ack(id, channel, result));
                   });
}

}  // namespace skein::bridge
