#include "bridge/live_hub.h"

#include <map>
#include <nlohmann/json.hpp>

#include "bridge/json_messages.h"
#include "bridge/names_in.h"
#include "config/json_reader.h"

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

ControlDesk::Time Now() { return std::chrono::steady_clock::now(); }

ControlRequest ParseControl(const config::Object& object) {
  using Action = ControlRequest::Action;
  static const std::map<std::string, Action> kActions = {
      {"take", Action::kTake},     {"ask", Action::kAsk},       {"withdraw", Action::kWithdraw},
      {"give", Action::kGive},     {"refuse", Action::kRefuse}, {"release", Action::kRelease},
      {"rename", Action::kRename},
  };
  const config::Value action = object.At("action");
  const auto known = kActions.find(action.Text());
  if (known == kActions.end()) action.Refuse("must be join, " + NamesIn(kActions));
  ControlRequest request;
  request.action = known->second;
  if (request.action == Action::kGive || request.action == Action::kRefuse) {
    request.person = object.At("person").Integer({1, 1e9});
  }
  if (request.action == Action::kRename) request.name = object.At("name").Text();
  return request;
}

Introduction ParseIntroduction(const config::Object& object, const Visitor& visitor) {
  Introduction introduction;
  introduction.name = object.Text("name", visitor.name);
  introduction.token = object.Text("token", "");
  introduction.page = object.Text("page", "");
  introduction.take = object.Boolean("take", true);
  introduction.may_operate = visitor.rights.operate;
  const std::string problem = introduction.name.empty() ? "" : NameProblem(introduction.name);
  if (!problem.empty()) object.At("name").Refuse(problem);
  for (const std::string_view key : {"token", "page"}) {
    if (object.Text(key, "").size() > 100) object.At(key).Refuse("is too long");
  }
  return introduction;
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
    session->Send(ControlFrame(*session));
    sessions_.push_back(session);
  });
}

void LiveHub::Leave(const std::shared_ptr<LiveSession>& session) {
  const int person = std::exchange(session->person, 0);
  if (person == 0) return;
  desk_.Leave(person, Now());
  TellControl();
}

void LiveHub::Broadcast(const LiveFrame& frame) {
  std::erase_if(sessions_, [&](const std::weak_ptr<LiveSession>& weak) {
    const auto session = weak.lock();
    if (session) session->Send(frame);
    return !session;
  });
}

void LiveHub::Look() {
  if (desk_.Look(Now())) TellControl();
}

LiveFrame LiveHub::ControlFrame(const LiveSession& session) const {
  return TextFrame(Dump(desk_.View(session.person, Now())), "control");
}

void LiveHub::WaitFor(const KeptHolder& holder) {
  desk_.WaitFor(holder, Now());
  kept_ = holder;
}

void LiveHub::TellControl() {
  if (const auto holder = desk_.Holder(); holder != kept_) backend_.keep_holder(kept_ = holder);
  for (const auto& weak : sessions_) {
    if (const auto session = weak.lock()) session->Send(ControlFrame(*session));
  }
}

void LiveHub::Introduce(const std::shared_ptr<LiveSession>& session, const Introduction& introduction) {
  Leave(session);
  const int person = desk_.Enter(introduction, Now());
  for (const auto& weak : sessions_) {
    // A dead connection of the same page, which nobody has noticed yet.
    const auto other = weak.lock();
    if (other && other != session && other->person == person) other->person = 0;
  }
  session->person = person;
  TellControl();
}

void LiveHub::Hear(const std::shared_ptr<LiveSession>& session, const std::string& text) {
  json message = config::ParseJson(text);
  if (!message.is_object()) message = json::object();
  const json id = message.value("id", json());
  const bool named = id.is_string() || id.is_number();
  const std::string type = Text(message, "type");
  const auto refuse = [&](const std::string& reason) {
    session->Send(
        Ack(named ? id : json(), Text(message, "channel"), {CommandResult::Outcome::kMalformed, reason}));
  };
  using Obey = void (LiveHub::*)(const std::shared_ptr<LiveSession>&, json);
  static const std::map<std::string, Obey> kTypes = {{"command", &LiveHub::Command},
                                                     {"control", &LiveHub::Control}};
  const auto known = kTypes.find(type);
  if (known == kTypes.end()) return refuse("the message is no JSON object of type " + NamesIn(kTypes));
  if (!named) return refuse("id: must be a text or a number");
  (this->*known->second)(session, std::move(message));
}

void LiveHub::Control(const std::shared_ptr<LiveSession>& session, json message) {
  session->Send(Ack(message["id"], "control", Decide(session, message)));
}

CommandResult LiveHub::Decide(const std::shared_ptr<LiveSession>& session, const json& message) {
  try {
    const config::Object object(config::Value::FromJson(message, "control"),
                                {"type", "id", "action", "name", "token", "page", "take", "person"});
    const bool nobody_commands = !backend_.why_no_command.empty();
    if (object.At("action").Text() == "join") {
      Introduction introduction = ParseIntroduction(object, session->visitor);
      if (nobody_commands) introduction.may_operate = false;
      Introduce(session, introduction);
      return {};
    }
    if (nobody_commands) return {CommandResult::Outcome::kRefused, backend_.why_no_command};
    const ControlRequest request = ParseControl(object);
    if (session->person == 0) object.At("action").Refuse("join comes first");
    const bus::Answer answer = desk_.Ask(session->person, request, Now());
    TellControl();
    return {answer.accepted ? CommandResult::Outcome::kAccepted : CommandResult::Outcome::kRefused,
            answer.reason};
  } catch (const config::ConfigError& error) {
    return {CommandResult::Outcome::kMalformed, error.what()};
  }
}

void LiveHub::Command(const std::shared_ptr<LiveSession>& session, json message) {
  using Outcome = CommandResult::Outcome;
  const json id = message["id"];
  const std::string channel = Text(message, "channel");
  const auto refuse = [&](Outcome outcome, const std::string& reason) {
    session->Send(Ack(id, channel, {outcome, reason}));
  };
  if (channel.empty()) return refuse(Outcome::kMalformed, "channel: must be a text");
  if (!message.contains("body")) return refuse(Outcome::kMalformed, "body: is missing");
  if (message.size() != 4)
    return refuse(Outcome::kMalformed, "only type, id, channel and body belong in a command");
  if (!backend_.why_no_command.empty()) return refuse(Outcome::kRefused, backend_.why_no_command);
  // Who commands without a word of introduction is a program, most likely alone.
  if (session->person == 0)
    Introduce(session, {.name = session->visitor.name, .may_operate = session->visitor.rights.operate});
  if (const std::string why_not = desk_.WhyNot(session->person); !why_not.empty()) {
    return refuse(Outcome::kRefused, why_not);
  }
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
