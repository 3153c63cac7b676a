#pragma once

// GCC 12 with Boost 1.74 needs <utility> before Asio.
#include <utility>

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/tcp_stream.hpp>

#include "bridge/recordings_router.h"

namespace skein::bridge {

/// Sends a file piece by piece, so that one of any size takes no memory and nobody waits long for the disk.
/// An error when the connection can be used no more: it broke, was too slow, or the file became shorter.
boost::asio::awaitable<boost::system::error_code> SendFile(boost::beast::tcp_stream& stream,
                                                           const RecordingsRouter::Download& download,
                                                           bool head_only);

}  // namespace skein::bridge
