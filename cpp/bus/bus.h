#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bus/decode.h"
#include "bus/executor.h"
#include "bus/validate.h"

namespace skein::bus {

struct BusStatistics {
  std::int64_t messages_in = 0;
  std::int64_t messages_out = 0;
  std::int64_t gaps = 0;
  std::int64_t undecodable = 0;
  std::int64_t handler_exceptions = 0;
  std::int64_t worst_handler_us = 0;  ///< since TakeWorstHandler()
};

/// A node's typed view of the LCM bus. Every node has its own, also where several share one transport (memq).
///
///   Bus bus(transport, "collision-monitor", executor);
///   bus.Subscribe<fleet_state_t>("FLEET_STATE", [&](const fleet_state_t& state) { ... });
///   bus.Publish("PROXIMITY", proximity);
///
/// Publish from the executor's thread only. A handler gets messages that decoded wholly and whose values
/// passed Valid() (bus/validate.h); anything else is counted and dropped. An exception that leaves a handler
/// is counted and logged, never passed into LCM. Subscriptions end with the Bus, so never destroy one within
/// a handler.
class Bus {
 public:
  /// @param transport shared, not null. @param node the executable's name, as HEARTBEAT tells it.
  Bus(std::shared_ptr<lcm::LCM> transport, std::string node, Executor& executor);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  template <typename Message>
  void Subscribe(const std::string& channel, std::function<void(const Message&)> handler) {
    SubscribeBytes(channel, [handler = std::move(handler)](const void* data, std::size_t size) {
      const auto message = Decode<Message>(data, size);
      if (!message || !Valid(*message)) return false;
      handler(*message);
      return true;
    });
  }

  template <typename Message>
  void Publish(const std::string& channel, const Message& message) {
    std::byte* buffer = EncodeBuffer(static_cast<std::size_t>(message.getEncodedSize()));
    PublishBytes(channel, message.encode(buffer, 0, message.getEncodedSize()));
  }

  /// Adds to the gaps that HEARTBEAT reports (see ChunkAssembler).
  void CountGaps(std::int64_t missed);
  /// Adds to what HEARTBEAT reports as undecodable: messages that are well by themselves, but not with
  /// others.
  void CountRefusal(const std::string& channel);
  /// Channels on which something was refused for the first time since the last call.
  std::vector<std::string> TakeNewlyRefused();

  /// For Events: 1, 2, ...
  std::int64_t NextEventSequence();

  /// Longest handler since the last call [us], for HEARTBEAT.
  std::int64_t TakeWorstHandler();

  /// Whether what the node tells people goes into this process's log, too (so unless said otherwise). Off for
  /// nodes that only try a flight out beside a live one.
  void SetLogs(bool logs);
  bool logs() const;

  const std::string& node() const;
  /// Identifies this run of the node; a later start has a larger one (utime of the start).
  std::int64_t session_id() const;
  const BusStatistics& statistics() const;
  Executor& executor();
  lcm::LCM& transport();

 private:
  /// Returns whether the bytes were a good message.
  using BytesHandler = std::function<bool(const void* data, std::size_t size)>;
  void SubscribeBytes(const std::string& channel, BytesHandler handler);
  std::byte* EncodeBuffer(std::size_t size);
  void PublishBytes(const std::string& channel, int size);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::bus
