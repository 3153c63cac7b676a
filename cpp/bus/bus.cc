#include "bus/bus.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cassert>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

namespace skein::bus {
namespace {

// LCM drops silently past this. A node that is this far behind has lost touch anyway.
constexpr int kQueueCapacity = 10'000;

}  // namespace

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
          ++impl.statistics.undecodable;
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
};

Bus::Bus(std::shared_ptr<lcm::LCM> transport, std::string node, Executor& executor)
    : impl_(new Impl{std::move(transport), std::move(node), executor, executor.Now(), {}, true, {}, {}}) {
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
    spdlog::warn("{}: {} could not be sent", impl_->node, channel);
    return;
  }
  ++impl_->statistics.messages_out;
}

void Bus::CountGaps(std::int64_t missed) { impl_->statistics.gaps += missed; }

std::int64_t Bus::TakeWorstHandler() { return std::exchange(impl_->statistics.worst_handler_us, 0); }

void Bus::SetLogs(bool logs) { impl_->logs = logs; }
bool Bus::logs() const { return impl_->logs; }

const std::string& Bus::node() const { return impl_->node; }
std::int64_t Bus::session_id() const { return impl_->session_id; }
const BusStatistics& Bus::statistics() const { return impl_->statistics; }
Executor& Bus::executor() { return impl_->executor; }
lcm::LCM& Bus::transport() { return *impl_->transport; }

}  // namespace skein::bus
