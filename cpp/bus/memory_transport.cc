#include "bus/memory_transport.h"

#include <mutex>

namespace skein::bus {

std::shared_ptr<lcm::LCM> MemoryTransport() {
  // LCM fills tables that all instances share whenever one is made, so one thread at a time.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  return std::make_shared<lcm::LCM>("memq://");
}

}  // namespace skein::bus
