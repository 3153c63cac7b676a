// Every message's safe decode: the first byte chooses the type.
#include <vector>

#include "bus/decode.h"
#include "bus/validate.h"
#include "fuzz_target.h"

namespace skein {
namespace {

template <typename Message>
void Try(const std::uint8_t* data, std::size_t size) {
  const auto message = bus::Decode<Message>(data, size);
  if (!message) return;
  std::vector<std::uint8_t> again(static_cast<std::size_t>(message->getEncodedSize()));
  fuzz::Require(again.size() == size, "a message that was decoded is as long as its bytes");
  message->encode(again.data(), 0, static_cast<int>(again.size()));
  bus::Valid(*message);
}

using Attempt = void (*)(const std::uint8_t*, std::size_t);
constexpr Attempt kAttempts[] = {
    Try<ack_t>,
    Try<alarm_command_t>,
    Try<alarm_list_t>,
    Try<event_t>,
    Try<fleet_command_t>,
    Try<fleet_roster_t>,
    Try<fleet_state_t>,
    Try<formation_command_t>,
    Try<formation_t>,
    Try<formation_status_t>,
    Try<heartbeat_t>,
    Try<link_command_t>,
    Try<link_status_t>,
    Try<path_command_t>,
    Try<path_t>,
    Try<payload_command_t>,
    Try<proximity_t>,
    Try<recording_command_t>,
    Try<recording_status_t>,
    Try<simulation_command_t>,
};

}  // namespace
}  // namespace skein

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  skein::kAttempts[data[0] % std::size(skein::kAttempts)](data + 1, size - 1);
  return 0;
}
