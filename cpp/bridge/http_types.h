#pragma once

// GCC 12 with Boost 1.74 needs <utility> before Boost's own headers.
#include <utility>

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <string_view>

namespace skein::bridge {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;
using HttpHead = boost::beast::http::request_header<>;

inline constexpr std::string_view kJson = "application/json";

inline std::string_view View(boost::beast::string_view text) { return {text.data(), text.size()}; }

/// A target up to its question mark.
inline std::string_view PathOf(std::string_view target) { return target.substr(0, target.find('?')); }

}  // namespace skein::bridge
