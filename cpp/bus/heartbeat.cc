#include "bus/heartbeat.h"

#include "bus/channels.h"

namespace skein::bus {

void StartHeartbeat(Bus& bus, std::int64_t receive_buffer_bytes) {
  bus.executor().Every(kSecond, [&bus, receive_buffer_bytes] { SendHeartbeat(bus, receive_buffer_bytes); });
}

void SendHeartbeat(Bus& bus, std::int64_t receive_buffer_bytes) {
  const BusStatistics& statistics = bus.statistics();
  heartbeat_t heartbeat;
  heartbeat.utime = bus.executor().Now();
  heartbeat.heartbeat_node = bus.node();
  heartbeat.version = SKEIN_VERSION;
  heartbeat.session_id = bus.session_id();
  heartbeat.start_utime = bus.session_id();  // which is the utime of the start
  heartbeat.messages_in = statistics.messages_in;
  heartbeat.messages_out = statistics.messages_out;
  heartbeat.gaps = statistics.gaps;
  heartbeat.undecodable = statistics.undecodable;
  heartbeat.handler_exceptions = statistics.handler_exceptions;
  heartbeat.worst_handler_us = bus.TakeWorstHandler();
  heartbeat.receive_buffer_bytes = receive_buffer_bytes;
  bus.Publish(channel::kHeartbeat, heartbeat);
}

}  // namespace skein::bus
