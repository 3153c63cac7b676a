#include "bridge/command_gateway.h"

#include <nlohmann/json.hpp>

#include "bridge/command_parser.h"
#include "bus/channels.h"
#include "bus/validate.h"
#include "config/scenario.h"

namespace skein::bridge {
namespace {

using Outcome = CommandResult::Outcome;

const char* Obeys(const std::string& channel) {
  if (channel == bus::channel::kCmdAlarm) return "collision-monitor";
  if (channel == bus::channel::kCmdRecording) return "flight-recorder";
  const bool fleet = channel == bus::channel::kCmdLink || channel == bus::channel::kCmdPayload ||
                     channel == bus::channel::kCmdSimulation;
  return fleet ? "fleet-simulator" : "formation-controller";
}

}  // namespace

CommandGateway::CommandGateway(bus::Bus& bus) : bus_(bus), outbox_(bus) {}

void CommandGateway::Send(const std::string& channel, const nlohmann::json& body, Done done) {
  if (outbox_.waiting() >= kMaxWaiting) {
    done({Outcome::kBusy, "too many commands wait for an answer: try again in 2 s"});
    return;
  }
  // `done` is not moved on: a body that is refused needs it too.
  try {
    if (channel == bus::channel::kCmdLink) {
      Publish(channel, ParseLinkCommand(body, bus_.executor().Now()), done);
    } else if (channel == bus::channel::kCmdPayload) {
      Publish(channel, ParsePayloadCommand(body), done);
    } else if (channel == bus::channel::kCmdFormation) {
      Publish(channel, ParseFormationCommand(body), done);
    } else if (channel == bus::channel::kCmdPath) {
      Publish(channel, ParsePathCommand(body), done);
    } else if (channel == bus::channel::kCmdSimulation) {
      Publish(channel, ParseSimulationCommand(body), done);
    } else if (channel == bus::channel::kCmdAlarm) {
      Publish(channel, ParseAlarmCommand(body), done);
    } else if (channel == bus::channel::kCmdRecording) {
      Publish(channel, ParseRecordingCommand(body), done);
    } else {
      done({Outcome::kMalformed,
            "channel: must be CMD_LINK, CMD_PAYLOAD, CMD_FORMATION, CMD_PATH, CMD_SIMULATION, CMD_ALARM or "
            "CMD_RECORDING, is " +
                channel.substr(0, 40)});
    }
  } catch (const config::ConfigError& error) {
    done({Outcome::kMalformed, error.what()});
  }
}

template <typename Command>
void CommandGateway::Publish(const std::string& channel, Command command, Done done) {
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
  bus_.executor().At(now + kGiveUpAfter, [this, request_id, channel, done = std::move(done)] {
    if (!outbox_.Forget(request_id)) return;
    done({Outcome::kNoAnswer,
          "nobody answered " + channel + " within 2 s: is " + Obeys(channel) + " running?"});
  });
}

}  // namespace skein::bridge
