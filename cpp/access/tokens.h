#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Who may do what, by tokens: secrets that are handed to people and programs, of which only hashes are kept.
namespace skein::access {

/// Says what is wrong and what to do.
struct AccessError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Role { kViewer, kOperator };

/// "viewer" or "operator".
std::string_view NameOf(Role role);

struct Token {
  std::string name;  ///< whose it is
  Role role = Role::kViewer;
  std::string sha256;   ///< of the secret, 64 hexadecimal digits
  std::string created;  ///< UTC, "2026-11-28T03:00:00Z"
};

/// $XDG_CONFIG_HOME/skein/tokens.json, or that in ~/.config.
std::filesystem::path DefaultTokensFile();

/// Reads a file of tokens. Throws AccessError: it is not there, anybody but its owner may read or write it,
/// or it is not one of ours (with the place in it).
std::vector<Token> ReadTokens(const std::filesystem::path& file);

/// Makes a token and keeps its hash; the file and its folder are made when they are missing.
/// @return the secret, which is nowhere else. Throws AccessError, also for a name that has one already.
std::string NewToken(const std::filesystem::path& file, const std::string& name, Role role);

/// Throws AccessError when there is none of that name.
void RevokeToken(const std::filesystem::path& file, const std::string& name);

/// Of a secret that nobody can find by trying: 64 hexadecimal digits.
std::string Sha256(std::string_view secret);

/// Whose secret it is; null when nobody's. Takes the same time whether and where it is found.
const Token* Find(const std::vector<Token>& tokens, std::string_view secret);

}  // namespace skein::access
