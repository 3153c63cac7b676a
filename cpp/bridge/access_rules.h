#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skein::bridge {

/// Which web pages may talk to the bridge: its own alone, not another that the operator happens to have open.
class AccessRules {
 public:
  /// @param allowed_hosts names beside localhost by which the bridge may be called (--allow-host).
  explicit AccessRules(std::vector<std::string> allowed_hosts);

  /// True when the Host header names localhost, an allowed host or the very address that the connection came
  /// in on. Another name means that somebody else's name points here (DNS rebinding).
  bool HostIsOurs(std::string_view host, std::string_view local_address) const;

  /// True when a page with this Origin header was served under this Host header.
  static bool SameOrigin(std::string_view origin, std::string_view host);

 private:
  std::vector<std::string> allowed_hosts_;
};

/// "example.org" of "Example.org:8080", "::1" of "[::1]:8080"; "" when it is neither.
std::string HostName(std::string_view host);

/// Content-Security-Policy: nothing but our own files, and images of the tile server when there is one.
std::string ContentSecurityPolicy(std::string_view tile_url);

/// What is wrong with a tile URL, "" when nothing is. It needs http(s), a plain host, {z}, {x} and {y}.
std::string TileUrlProblem(std::string_view tile_url);

}  // namespace skein::bridge
