#include "bus/bus.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <exception>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bus/transport.h"

namespace skein::bus {

struct Bus::Impl {
  struct Subscription {
    Impl& impl;
    std::string channel;
    BytesHandler handler;
    lcm::Subscription* handle = nullptr;

    void OnMessage(const lcm::ReceiveBuffer* buffer, const std::string&) {
      const Utime start = impl.executor.Now();
      try {
        if (handler(buffer->data, buffer->data_size)) {
          ++impl.statistics.messages_in;
        } else {
          impl.CountRefusal(channel);
        }
      } catch (const std::exception& error) {
        impl.CountException(channel, error.what());
      } catch (...) {
        impl.CountException(channel, "unknown exception");
      }
      impl.statistics.worst_handler_us =
          std::max(impl.statistics.worst_handler_us, impl.executor.Now() - start);
    }
  };

  void CountRefusal(const std::string& refused_channel) {
    ++statistics.undecodable;
    if (refused.insert(refused_channel).second) newly_refused.push_back(refused_channel);
  }

  void CountException(const std::string& channel, const char* what) {
    ++statistics.handler_exceptions;
    spdlog::error("{}: handler of {} failed: {}", node, channel, what);
  }

  std::shared_ptr<lcm::LCM> transport;
  std::string node;
  Executor& executor;
  std::int64_t session_id;
  BusStatistics statistics;
  bool logs = true;
  std::vector<std::unique_ptr<Subscription>> subscriptions;
  std::vector<std::byte> encode_buffer;
  std::set<std::string> refused;  ///< channels on which anything was
  std::vector<std::string> newly_refused;
  std::int64_t event_sequence = 0;
  std::int64_t unsent = 0;  ///< messages in a row
};

Bus::Bus(std::shared_ptr<lcm::LCM> transport, std::string node, Executor& executor)
    : impl_(new Impl{
          std::move(transport), std::move(node), executor, executor.Now(), {}, true, {}, {}, {}, {}, {}}) {
  assert(impl_->transport && impl_->transport->good());
}

Bus::~Bus() {
  for (const auto& subscription : impl_->subscriptions) impl_->transport->unsubscribe(subscription->handle);
}

void Bus::SubscribeBytes(const std::string& channel, BytesHandler handler) {
  auto subscription =
      std::make_unique<Impl::Subscription>(Impl::Subscription{*impl_, channel, std::move(handler)});
  subscription->handle =
      impl_->transport->subscribe(channel, &Impl::Subscription::OnMessage, subscription.get());
  if (!subscription->handle) throw std::runtime_error("cannot subscribe to " + channel);
  subscription->handle->setQueueCapacity(kQueueCapacity);
  impl_->subscriptions.push_back(std::move(subscription));
}

std::byte* Bus::EncodeBuffer(std::size_t size) {
  if (impl_->encode_buffer.size() < size) impl_->encode_buffer.resize(size);
  return impl_->encode_buffer.data();
}

void Bus::PublishBytes(const std::string& channel, int size) {
  assert(size > 0);
  if (impl_->transport->publish(channel, impl_->encode_buffer.data(), static_cast<unsigned>(size)) != 0) {
    // No route, or an interface that is down: twenty times a second, until somebody mends it.
    if (impl_->unsent++ == 0)
      spdlog::warn("{}: {} could not be sent: {}", impl_->node, channel, std::strerror(errno));
    return;
  }
  if (impl_->unsent > 0) {
    spdlog::warn("{}: messages can be sent again; {} could not", impl_->node, impl_->unsent);
    impl_->unsent = 0;
  }
  ++impl_->statistics.messages_out;
}

void Bus::CountGaps(std::int64_t missed) { impl_->statistics.gaps += missed; }

void Bus::CountRefusal(const std::string& channel) { impl_->CountRefusal(channel); }
std::vector<std::string> Bus::TakeNewlyRefused() { return std::exchange(impl_->newly_refused, {}); }
std::int64_t Bus::NextEventSequence() { return ++impl_->event_sequence; }

std::int64_t Bus::TakeWorstHandler() { return std::exchange(impl_->statistics.worst_handler_us, 0); }

void Bus::SetLogs(bool logs) { impl_->logs = logs; }
bool Bus::logs() const { return impl_->logs; }

const std::string& Bus::node() const { return impl_->node; }
std::int64_t Bus::session_id() const { return impl_->session_id; }
const BusStatistics& Bus::statistics() const { return impl_->statistics; }
Executor& Bus::executor() { return impl_->executor; }
lcm::LCM& Bus::transport() { return *impl_->transport; }

}  // namespace skein::bus
