#include "bridge/doorkeeper.h"

#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <boost/asio/ip/address.hpp>

#include "bridge/sign_in.h"

namespace skein::bridge {
namespace {

constexpr std::string_view kBearer = "Bearer ";

std::string_view Trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// The value of a cookie, "" when it is not there.
std::string_view CookieValue(std::string_view cookies, std::string_view name) {
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    const std::string_view one = Trimmed(cookies.substr(0, end));
    if (one.starts_with(name) && one.substr(name.size()).starts_with('=')) return one.substr(name.size() + 1);
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
  }
  return {};
}

}  // namespace

Doorkeeper::Doorkeeper(std::filesystem::path tokens_file) : file_(std::move(tokens_file)) {
  if (!demands_tokens()) return;
  stamp_ = StampOfFile();
  tokens_ = access::ReadTokens(file_);
}

std::string Doorkeeper::SecretOf(const HttpHead& head, std::uint16_t port) const {
  namespace http = boost::beast::http;
  const std::string_view authorization = View(head[http::field::authorization]);
  if (authorization.starts_with(kBearer)) return std::string(Trimmed(authorization.substr(kBearer.size())));
  return std::string(CookieValue(View(head[http::field::cookie]), CookieName(port)));
}

Visitor Doorkeeper::Identify(std::string_view secret) const {
  if (!demands_tokens()) return {};
  const access::Token* token = secret.empty() ? nullptr : access::Find(tokens_, secret);
  if (!token) return {"", {false, false}};
  return {token->name, {true, token->role == access::Role::kOperator}};
}

std::optional<Visitor> Doorkeeper::Admit(std::string_view secret, const std::string& address) {
  if (!demands_tokens() || secret.empty()) return Identify(secret);
  const auto now = std::chrono::steady_clock::now();
  if (limit_.Wait(address, now) > std::chrono::seconds(0)) return std::nullopt;
  Visitor visitor = Identify(secret);
  if (!visitor.rights.look && limit_.Count(address, now) && tell_) {
    tell_("wrong_tokens", address + " has shown " + std::to_string(GuessLimit::kGuesses) +
                              " wrong tokens within a minute, and is not heard for the rest of it");
  }
  return visitor;
}

std::chrono::seconds Doorkeeper::Wait(const std::string& address) const {
  return limit_.Wait(address, std::chrono::steady_clock::now());
}

Doorkeeper::Stamp Doorkeeper::StampOfFile() const {
  struct stat status {};
  if (stat(file_.c_str(), &status) != 0) return {};
  return {status.st_ino, status.st_ctim.tv_sec * 1'000'000'000 + status.st_ctim.tv_nsec};
}

bool Doorkeeper::Refresh() {
  if (!demands_tokens()) return false;
  const Stamp stamp = StampOfFile();
  if (stamp == stamp_) return false;
  stamp_ = stamp;
  try {
    tokens_ = access::ReadTokens(file_);
  } catch (const access::AccessError& error) {
    spdlog::error("{}: nobody is let in", error.what());
    tokens_.clear();
  }
  return true;
}

std::string AddressOf(const HttpHead& head, const std::string& remote_address) {
  if (!IsLoopback(remote_address)) return remote_address;
  std::string_view forwarded = View(head["X-Forwarded-For"]);
  // The last one is what the proxy itself has seen; those before it anybody can make up.
  forwarded = Trimmed(forwarded.substr(forwarded.find_last_of(',') + 1));
  return forwarded.empty() || forwarded.size() > 64 ? remote_address : std::string(forwarded);
}

bool IsLoopback(const std::string& address) {
  if (address == "localhost") return true;
  boost::system::error_code error;
  const auto ip = boost::asio::ip::make_address(address, error);
  return !error && ip.is_loopback();
}

}  // namespace skein::bridge
