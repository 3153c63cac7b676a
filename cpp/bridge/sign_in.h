#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "bridge/doorkeeper.h"
#include "bridge/http_types.h"

namespace skein::bridge {

/// Of the cookie that holds a token. Browsers send a host's cookies to all its ports, so the port is in it.
std::string CookieName(std::uint16_t port);

/// /api/session: who one is (GET), signing in with a token (POST) and out (DELETE).
class SignIn {
 public:
  static constexpr std::string_view kPath = "/api/session";
  using Make =
      std::function<HttpResponse(boost::beast::http::status, std::string_view mime_type, std::string)>;

  SignIn(Doorkeeper& doorkeeper, Make make) : doorkeeper_(doorkeeper), make_(std::move(make)) {}

  /// @param port that we listen on. @param address of whoever asks, for the limit on guesses.
  HttpResponse Answer(const HttpRequest& request, std::uint16_t port, const std::string& address) const;

  /// Turns away who has shown no token, or a wrong one; and makes a browser forget the wrong one.
  HttpResponse Unknown(const HttpHead& head, std::uint16_t port) const;
  /// Turns away who has shown too many wrong ones.
  HttpResponse TooMany(std::chrono::seconds wait) const;

 private:
  HttpResponse Who(const Visitor& visitor) const;

  Doorkeeper& doorkeeper_;
  Make make_;
};

}  // namespace skein::bridge
