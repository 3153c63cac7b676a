#include "bus/channel_ear.h"

#include <stdexcept>
#include <utility>

#include "bus/transport.h"

namespace skein::bus {
namespace {

// No message is longer; an 8-byte datagram arrives as one of 4294967282 bytes.
constexpr std::size_t kMostBytes = std::size_t{1} << 28;

}  // namespace

ChannelEar::ChannelEar(lcm::LCM& transport, Handler handler)
    : transport_(transport),
      handler_(std::move(handler)),
      subscription_(transport_.subscribe(".*", &ChannelEar::Hear, this)) {
  if (!subscription_) throw std::runtime_error("cannot subscribe to all channels");
  subscription_->setQueueCapacity(kQueueCapacity);
}

ChannelEar::~ChannelEar() { transport_.unsubscribe(subscription_); }

void ChannelEar::Hear(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  const std::size_t size = buffer->data_size;
  handler_(channel, buffer->data, size > kMostBytes ? 0 : size);
}

}  // namespace skein::bus
