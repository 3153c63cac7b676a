#include "bridge/sign_in.h"

#include <nlohmann/json.hpp>

#include "config/json_reader.h"

namespace skein::bridge {
namespace {

namespace http = boost::beast::http;
using http::status;

constexpr std::string_view kTwelveHours = "43200";

/// @param secret "": the browser is to forget it.
std::string Cookie(const HttpHead& head, std::uint16_t port, std::string_view secret) {
  std::string cookie =
      CookieName(port) + "=" + std::string(secret) + "; Path=/; HttpOnly; SameSite=Strict; Max-Age=";
  cookie += secret.empty() ? "0" : kTwelveHours;
  // Behind a proxy with TLS it is never to go out in the clear.
  if (View(head["X-Forwarded-Proto"]) == "https") cookie += "; Secure";
  return cookie;
}

std::string Reason(std::string_view reason) { return nlohmann::json{{"reason", reason}}.dump(); }

}  // namespace

std::string CookieName(std::uint16_t port) { return "skein_" + std::to_string(port); }

HttpResponse SignIn::Answer(const HttpRequest& request, std::uint16_t port,
                            const std::string& address) const {
  if (request.method() == http::verb::delete_) {
    HttpResponse response = make_(status::ok, kJson, "{}");
    response.set(http::field::set_cookie, Cookie(request, port, ""));
    return response;
  }
  if (request.method() != http::verb::post) {
    // Who got here is known, or nobody need be.
    return Who(doorkeeper_.Identify(doorkeeper_.SecretOf(request, port)));
  }
  const auto body = config::ParseJson(request.body());
  if (!body.is_object() || body.size() != 1 || !body.contains("token") || !body["token"].is_string())
    return make_(status::bad_request, kJson, Reason("the request must be {\"token\": \"...\"}"));
  const auto secret = body["token"].get<std::string>();
  const auto visitor = doorkeeper_.Admit(secret, address);
  if (!visitor) return TooMany(doorkeeper_.Wait(address));
  if (!visitor->rights.look)
    return make_(status::unauthorized, kJson,
                 Reason("this token opens nothing here: it is mistyped, or revoked"));
  HttpResponse response = Who(*visitor);
  // Nothing that could end the cookie early is in a token that is known.
  if (doorkeeper_.demands_tokens()) response.set(http::field::set_cookie, Cookie(request, port, secret));
  return response;
}

HttpResponse SignIn::Unknown(const HttpHead& head, std::uint16_t port) const {
  HttpResponse response =
      make_(status::unauthorized, kJson, Reason("sign in first: show a token (skein token new makes one)"));
  response.set(http::field::www_authenticate, "Bearer");
  if (head.count(http::field::cookie) > 0) response.set(http::field::set_cookie, Cookie(head, port, ""));
  return response;
}

HttpResponse SignIn::TooMany(std::chrono::seconds wait) const {
  const std::string seconds = std::to_string(wait.count());
  HttpResponse response = make_(status::too_many_requests, kJson,
                                Reason("too many wrong tokens: try again in " + seconds + " s"));
  response.set(http::field::retry_after, seconds);
  return response;
}

HttpResponse SignIn::Who(const Visitor& visitor) const {
  const bool demanded = doorkeeper_.demands_tokens();
  return make_(status::ok, kJson,
               nlohmann::json{{"signed_in", demanded},
                              {"name", visitor.name},
                              {"role", visitor.rights.operate ? "operator" : "viewer"}}
                   .dump());
}

}  // namespace skein::bridge
