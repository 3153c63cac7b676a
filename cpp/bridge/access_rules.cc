#include "bridge/access_rules.h"

#include <algorithm>
#include <cctype>

namespace skein::bridge {
namespace {

std::string Lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

/// What follows "http://" or "https://"; nothing without either.
std::string_view AfterScheme(std::string_view url) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (url.starts_with(scheme)) return url.substr(scheme.size());
  }
  return {};
}

/// "https://tiles.example.org:8443" of a tile URL.
std::string_view TileOrigin(std::string_view tile_url) {
  const std::string_view rest = AfterScheme(tile_url);
  return tile_url.substr(0, tile_url.size() - rest.size() + std::min(rest.find('/'), rest.size()));
}

}  // namespace

AccessRules::AccessRules(std::vector<std::string> allowed_hosts) : allowed_hosts_(std::move(allowed_hosts)) {
  for (std::string& host : allowed_hosts_) host = Lower(host);
}

bool AccessRules::HostIsOurs(std::string_view host, std::string_view local_address) const {
  const std::string name = HostName(host);
  return !name.empty() && (name == "localhost" || name == local_address ||
                           std::ranges::find(allowed_hosts_, name) != allowed_hosts_.end());
}

bool AccessRules::SameOrigin(std::string_view origin, std::string_view host) {
  const std::string_view from = AfterScheme(origin);
  return !from.empty() && Lower(from) == Lower(host);
}

std::string HostName(std::string_view host) {
  std::string_view name = host;
  if (host.starts_with('[')) {
    const auto end = host.find(']');
    if (end == std::string_view::npos) return "";
    name = host.substr(1, end - 1);
    host.remove_prefix(end + 1);
  } else {
    name = host.substr(0, host.find(':'));
    host.remove_prefix(name.size());
  }
  const bool port =
      host.empty() || (host.front() == ':' &&
                       std::ranges::all_of(host.substr(1), [](unsigned char c) { return std::isdigit(c); }));
  return port ? Lower(name) : "";
}

std::string ContentSecurityPolicy(std::string_view tile_url) {
  std::string tiles(TileOrigin(tile_url));
  if (const auto subdomain = tiles.find("{s}"); subdomain != std::string::npos)
    tiles.replace(subdomain, 3, "*");
  return "default-src 'self'; img-src 'self' data:" + (tiles.empty() ? "" : " " + tiles) +
         "; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

std::string TileUrlProblem(std::string_view tile_url) {
  if (AfterScheme(tile_url).empty()) return "must begin with http:// or https://";
  std::string origin(TileOrigin(tile_url));
  std::string host(AfterScheme(origin));
  if (host.starts_with("{s}.")) host.erase(0, 4);
  const bool plain = !host.empty() && std::ranges::all_of(host, [](unsigned char c) {
    return std::isalnum(c) || c == '.' || c == '-' || c == ':';
  });
  if (!plain) return "its host must be a plain name, with {s}. at most before it";
  for (const char* part : {"{z}", "{x}", "{y}"}) {
    if (tile_url.find(part) == std::string_view::npos) return std::string("lacks ") + part;
  }
  return "";
}

}  // namespace skein::bridge
