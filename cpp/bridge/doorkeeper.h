#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "access/tokens.h"
#include "bridge/guess_limit.h"
#include "bridge/http_types.h"
#include "bridge/rights.h"

namespace skein::bridge {

/// Where a request came from.
struct Caller {
  std::string local_address;  ///< of ours, that the connection came in on
  std::uint16_t local_port = 0;
  std::string remote_address;  ///< of theirs
};

/// Somebody who has shown a token; or anybody, where none is demanded.
struct Visitor {
  std::string name{};  ///< that his token was made for, "" when none is demanded
  Rights rights{};
};

/// Decides who may look and who may operate: by tokens, when it was given a file of them; else whoever
/// reaches the port may do all. A token is shown in the header "Authorization: Bearer", or in the cookie that
/// signing in sets. The cookie is the token itself, so that a bridge that starts anew knows it, and a token
/// that is revoked opens nothing from that moment on.
class Doorkeeper {
 public:
  /// @param tokens_file empty: none are demanded. Throws access::AccessError.
  explicit Doorkeeper(std::filesystem::path tokens_file);

  bool demands_tokens() const { return !file_.empty(); }

  /// The token that a request shows, "" when it shows none.
  std::string SecretOf(const HttpHead& head, std::uint16_t port) const;

  /// Nobody, who may do nothing, when it opens nothing.
  Visitor Identify(std::string_view secret) const;

  /// What Identify() says, but for an address that has shown too many wrong ones.
  /// @return none: it must wait `Wait()` first.
  std::optional<Visitor> Admit(std::string_view secret, const std::string& address);
  std::chrono::seconds Wait(const std::string& address) const;

  /// Reads the file again if it has changed. A file that cannot be read opens nothing, and is told of once.
  /// @return whether somebody's rights may have changed.
  bool Refresh();

  /// Told when an address has shown too many wrong tokens, with code and text of an EVENT.
  using Tell = std::function<void(const std::string& code, const std::string& text)>;
  void SetTell(Tell tell) { tell_ = std::move(tell); }

 private:
  /// Another one whenever content, owner or mode have changed.
  struct Stamp {
    std::uint64_t inode = 0;
    std::int64_t changed_ns = 0;
    bool operator==(const Stamp&) const = default;
  };
  Stamp StampOfFile() const;

  std::filesystem::path file_;
  std::vector<access::Token> tokens_;
  Stamp stamp_;
  GuessLimit limit_;
  Tell tell_;
};

/// Whose address counts for the limit: a proxy on this host says in X-Forwarded-For for whom it asks.
std::string AddressOf(const HttpHead& head, const std::string& remote_address);

/// Whether only this host reaches an address to listen on.
bool IsLoopback(const std::string& address);

}  // namespace skein::bridge
