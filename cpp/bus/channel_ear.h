#pragma once

#include <cstddef>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <string>

namespace skein::bus {

/// Hears every channel of the bus as bytes, known or not.
class ChannelEar {
 public:
  /// `size` is 0 for what LCM 1.3.1 makes of a datagram that is too short.
  using Handler = std::function<void(const std::string& channel, const void* data, std::size_t size)>;

  /// `handler` must not throw: an exception in the middle of LCM ends the process.
  ChannelEar(lcm::LCM& transport, Handler handler);
  ~ChannelEar();
  ChannelEar(const ChannelEar&) = delete;
  ChannelEar& operator=(const ChannelEar&) = delete;

 private:
  void Hear(const lcm::ReceiveBuffer* buffer, const std::string& channel);

  lcm::LCM& transport_;
  Handler handler_;
  lcm::Subscription* subscription_;
};

}  // namespace skein::bus
