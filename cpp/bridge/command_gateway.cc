#include "bridge/command_gateway.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bridge/command_parser.h"
#include "bridge/names_in.h"
#include "bus/channels.h"
#include "bus/validate.h"
#include "config/scenario.h"

namespace skein::bridge {
namespace {

using Outcome = CommandResult::Outcome;

constexpr const char* kSimulator = "fleet-simulator";
constexpr const char* kController = "formation-controller";
constexpr const char* kMonitor = "collision-monitor";
constexpr const char* kRecorder = "flight-recorder";

}  // namespace

CommandGateway::CommandGateway(bus::Bus& bus) : bus_(bus), outbox_(bus) {
  Take(bus::channel::kCmdLink, kSimulator,
       [this](const nlohmann::json& body) { return ParseLinkCommand(body, bus_.executor().Now()); });
  Take(bus::channel::kCmdPayload, kSimulator, ParsePayloadCommand);
  Take(bus::channel::kCmdFormation, kController, ParseFormationCommand);
  Take(bus::channel::kCmdPath, kController, ParsePathCommand);
  Take(bus::channel::kCmdSimulation, kSimulator, ParseSimulationCommand);
  Take(bus::channel::kCmdAlarm, kMonitor, ParseAlarmCommand);
  Take(bus::channel::kCmdRecording, kRecorder, ParseRecordingCommand);
}

template <typename Parse>
void CommandGateway::Take(const char* channel, const char* obeyed_by, Parse parse) {
  channels_.emplace_back(channel, [=, this](const nlohmann::json& body, const Done& done) {
    Publish(channel, obeyed_by, parse(body), done);
  });
}

void CommandGateway::Send(const std::string& channel, const nlohmann::json& body, Done done) {
  if (outbox_.waiting() >= kMaxWaiting) {
    done({Outcome::kBusy, "too many commands wait for an answer: try again in 2 s"});
    return;
  }
  const auto known =
      std::ranges::find_if(channels_, [&](const auto& entry) { return entry.first == channel; });
  if (known == channels_.end()) {
    done({Outcome::kMalformed, "channel: must be " + NamesIn(channels_) + ", is " + channel.substr(0, 40)});
    return;
  }
  try {
    known->second(body, done);
  } catch (const config::ConfigError& error) {
    done({Outcome::kMalformed, error.what()});
  }
}

template <typename Command>
void CommandGateway::Publish(const std::string& channel, const char* obeyed_by, Command command, Done done) {
  // The nodes drop what is not valid in silence; the numbers were checked field by field, but not every text.
  if (!bus::Valid(command)) {
    done({Outcome::kMalformed, channel + ": holds a text that is too long or has control characters"});
    return;
  }
  const std::int64_t request_id =
      outbox_.Send(channel, std::move(command), [done](const bus::Answer& answer) {
        done({answer.accepted ? Outcome::kAccepted : Outcome::kRefused, answer.reason});
      });
  const bus::Utime now = bus_.executor().Now();
  bus_.executor().At(now + kResendAfter, [this, request_id] { outbox_.Repeat(request_id); });
  bus_.executor().At(now + kGiveUpAfter, [this, request_id, channel, obeyed_by, done = std::move(done)] {
    if (!outbox_.Forget(request_id)) return;
    done({Outcome::kNoAnswer, "nobody answered " + channel + " within 2 s: is " + obeyed_by + " running?"});
  });
}

}  // namespace skein::bridge
