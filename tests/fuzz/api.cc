// What browsers send, once it is JSON or a query: the first byte chooses for whom.
#include <nlohmann/json.hpp>
#include <string_view>

#include "bridge/byte_range.h"
#include "bridge/command_parser.h"
#include "bridge/history_query.h"
#include "bridge/previewer.h"
#include "bridge/url.h"
#include "bus/validate.h"
#include "config/scenario.h"
#include "fuzz_target.h"

namespace skein {
namespace {

using nlohmann::json;

template <typename Parse>
void TryBody(std::string_view text, Parse parse) {
  const json body = json::parse(text, nullptr, false);
  if (body.is_discarded()) return;
  try {
    parse(body);
  } catch (const config::ConfigError&) {
  }
}

/// What has been parsed is sent: so it must be what receivers take.
template <typename Command>
void TryCommand(std::string_view text, Command (*parse)(const json&)) {
  TryBody(text, [&](const json& body) {
    Command command = parse(body);
    command.utime = command.session_id = command.request_id = command.to_session_id = 1;
    fuzz::Require(bus::Valid(command), "a command that was parsed is valid");
  });
}

void Try(std::uint8_t choice, std::string_view text) {
  switch (choice % 11) {
    case 0:
      return TryCommand<link_command_t>(text,
                                        [](const json& body) { return bridge::ParseLinkCommand(body, 1); });
    case 1:
      return TryCommand(text, bridge::ParsePayloadCommand);
    case 2:
      return TryCommand(text, bridge::ParseFormationCommand);
    case 3:
      return TryCommand(text, bridge::ParsePathCommand);
    case 4:
      return TryCommand(text, bridge::ParseSimulationCommand);
    case 5:
      return TryCommand(text, bridge::ParseAlarmCommand);
    case 6:
      return TryCommand(text, bridge::ParseRecordingCommand);
    case 7:
      return TryBody(text, bridge::ParseFormationPreview);
    case 8:
      return TryBody(text, bridge::ParsePathPreview);
    case 9:
      bridge::ParseHistoryQuery(text);
      if (const auto decoded = bridge::PercentDecoded(text))
        fuzz::Require(bridge::PercentDecoded(bridge::PercentEncoded(*decoded)) == decoded,
                      "what is encoded is decoded to the same");
      return;
    default: {
      constexpr std::uint64_t kSize = 1000;
      const bridge::ByteRange range = bridge::ParseByteRange(text, kSize);
      if (range.kind == bridge::ByteRange::Kind::kPart)
        fuzz::Require(range.length > 0 && range.first < kSize && range.length <= kSize - range.first,
                      "a part lies within the file");
    }
  }
}

}  // namespace
}  // namespace skein

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) skein::Try(data[0], {reinterpret_cast<const char*>(data + 1), size - 1});
  return 0;
}
