#pragma once

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/system/error_code.hpp>

namespace skein::bridge {

using Error = boost::system::error_code;

/// Has a coroutine wait for what is begun, and get its error as a value instead of an exception.
inline constexpr auto kAwait = boost::asio::as_tuple(boost::asio::use_awaitable);

}  // namespace skein::bridge
