#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "bus/chunks.h"
#include "bus/decode.h"
#include "bus/validate.h"
#include "recording/log_file.h"

namespace skein::recording {

/// Hands the messages of a log to typed handlers, as a Bus does with live ones: only those that decode wholly
/// and are Valid(). What nobody asked for is not even decoded.
class LogListener {
 public:
  template <typename Message>
  void Hear(const std::string& channel, std::function<void(const Message&)> handler) {
    handlers_[channel] = [handler = std::move(handler)](const LogEvent& event) {
      const auto message = bus::Decode<Message>(event.data.data(), event.data.size());
      if (message && bus::Valid(*message)) handler(*message);
    };
  }

  /// Sets that came in chunks, put together; those of which a chunk is missing, too.
  template <typename Message>
  void HearWhole(const std::string& channel, std::function<void(const Message&)> handler) {
    auto assembler = std::make_shared<bus::ChunkAssembler<Message>>(
        [handler = std::move(handler)](const Message& whole, int) { handler(whole); });
    Hear<Message>(channel, [assembler](const Message& message) { assembler->Add(message); });
  }

  void Take(const LogEvent& event) const {
    const auto handler = handlers_.find(event.channel);
    if (handler != handlers_.end()) handler->second(event);
  }

 private:
  std::map<std::string, std::function<void(const LogEvent&)>, std::less<>> handlers_;
};

}  // namespace skein::recording
