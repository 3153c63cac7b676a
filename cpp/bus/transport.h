#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <stdexcept>
#include <string>

namespace skein::bus {

inline constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0";

/// Messages of a subscription that wait. LCM drops silently past this; a node that is this far behind has
/// lost touch anyway.
inline constexpr int kQueueCapacity = 10'000;

/// LCM_DEFAULT_URL when set, else kDefaultUrl.
std::string DefaultUrl();

/// The URL with the receive buffer that Skein asks for when the URL says nothing: for programs that open it
/// themselves, as lcm-logger does. The same when it is not udpm.
std::string WithReceiveBuffer(const std::string& url);

/// Something outside of the program is not as it must be: no route, a taken port. what() tells what to do
/// about it.
class StartError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Transport {
  std::shared_ptr<lcm::LCM> lcm;
  std::int64_t receive_buffer_bytes = 0;  ///< granted by the kernel; 0: not an UDP socket
};

/// Opens an LCM URL. Throws StartError; where a multicast route is missing, with the command that makes one.
/// A receive buffer smaller than the URL asks for (recv_buf_size) is logged.
Transport MakeTransport(const std::string& url);

}  // namespace skein::bus
