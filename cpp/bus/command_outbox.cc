#include "bus/command_outbox.h"

#include "bus/channels.h"

namespace skein::bus {
namespace {

constexpr std::size_t kMostChannels = 100;
constexpr std::size_t kLongestChannel = 32;

}  // namespace

CommandOutbox::CommandOutbox(Bus& bus) : bus_(bus) {
  bus_.Subscribe<ack_t>(channel::kAck, [this](const ack_t& ack) { Hear(ack); });
}

void CommandOutbox::Repeat(std::int64_t request_id) {
  const auto entry = waiting_.find(request_id);
  if (entry != waiting_.end()) entry->second.publish(entry->second.to_session_id);
}

bool CommandOutbox::Forget(std::int64_t request_id) { return waiting_.erase(request_id) > 0; }

void CommandOutbox::Hear(const ack_t& ack) {
  // From answers to others, too; but not whatever somebody invents.
  const bool is_command =
      ack.command_channel.starts_with("CMD_") && ack.command_channel.size() <= kLongestChannel;
  if (is_command && (addresses_.size() < kMostChannels || addresses_.contains(ack.command_channel)))
    addresses_[ack.command_channel] = ack.session_id;
  if (ack.command_session_id != bus_.session_id()) return;
  const auto entry = waiting_.find(ack.command_request_id);
  if (entry == waiting_.end() || entry->second.channel != ack.command_channel) return;
  Waiting& waiting = entry->second;
  if (ack.session_id != waiting.to_session_id) {
    // Another run than was meant: it has refused. Once only, so that two nodes cannot toss a command about.
    if (std::exchange(waiting.readdressed, true)) return;
    waiting.to_session_id = ack.session_id;
    return Repeat(ack.command_request_id);
  }
  // Out of the table first: `done` may send the next command.
  const Done done = std::move(waiting.done);
  waiting_.erase(entry);
  done({ack.accepted != 0, ack.reason});
}

}  // namespace skein::bus
