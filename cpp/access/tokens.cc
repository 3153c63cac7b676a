#include "access/tokens.h"

#include <sodium.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>

#include "config/json_reader.h"
#include "files/atomic_file.h"

namespace skein::access {
namespace {

namespace fs = std::filesystem;

// Recognised when found where it does not belong: in a log, in a repository.
constexpr std::string_view kPrefix = "skein_";
constexpr std::size_t kSecretBytes = 32;
constexpr std::size_t kLongestName = 40;
constexpr std::size_t kLongestSecret = 200;

using Hash = std::array<unsigned char, crypto_hash_sha256_BYTES>;

void StartSodium() {
  if (sodium_init() < 0) throw AccessError("libsodium cannot start: the system gives no random numbers");
}

/// The secret is 32 random bytes: nobody finds it by trying, so a fast hash is as good as a slow one.
Hash HashOf(std::string_view secret) {
  Hash hash;
  crypto_hash_sha256(hash.data(), reinterpret_cast<const unsigned char*>(secret.data()), secret.size());
  return hash;
}

std::string Hex(const Hash& hash) {
  std::array<char, 2 * crypto_hash_sha256_BYTES + 1> text;
  return sodium_bin2hex(text.data(), text.size(), hash.data(), hash.size());
}

std::string RandomSecret() {
  std::array<unsigned char, kSecretBytes> random;
  randombytes_buf(random.data(), random.size());
  constexpr int kVariant = sodium_base64_VARIANT_URLSAFE_NO_PADDING;
  std::array<char, sodium_base64_ENCODED_LEN(kSecretBytes, kVariant)> text;
  sodium_bin2base64(text.data(), text.size(), random.data(), random.size(), kVariant);
  return std::string(kPrefix) + text.data();
}

std::string UtcNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text;
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

/// A secret file is its owner's alone; one that others can read is no secret, one that they can write is
/// worse.
void RefuseIfOpenToOthers(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0)
    throw AccessError(file.string() +
                      ": there are no tokens; make one: skein token new NAME --role operator");
  if ((status.st_mode & 077) != 0)
    throw AccessError(file.string() + ": others than its owner have access to it: chmod 600 " +
                      file.string() + ", and make new tokens if somebody may have changed it");
}

Token ReadToken(const config::Value& value) {
  const config::Object object(value, {"name", "role", "sha256", "created"});
  Token token;
  token.name = object.At("name").Text();
  const std::string role = object.At("role").Text();
  if (role != NameOf(Role::kViewer) && role != NameOf(Role::kOperator))
    object.At("role").Refuse("must be viewer or operator");
  token.role = role == NameOf(Role::kOperator) ? Role::kOperator : Role::kViewer;
  token.sha256 = object.At("sha256").Text();
  const bool hex = token.sha256.size() == 2 * crypto_hash_sha256_BYTES &&
                   token.sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!hex) object.At("sha256").Refuse("must be 64 hexadecimal digits");
  token.created = object.Text("created", "");
  return token;
}

void WriteTokens(const fs::path& file, const std::vector<Token>& tokens) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Token& token : tokens) {
    list.push_back({{"name", token.name},
                    {"role", NameOf(token.role)},
                    {"sha256", token.sha256},
                    {"created", token.created}});
  }
  try {
    if (file.has_parent_path()) fs::create_directories(file.parent_path());
    files::WriteAtomically(file, nlohmann::ordered_json{{"tokens", list}}.dump(2) + "\n", 0600);
  } catch (const std::exception& error) {
    throw AccessError(error.what());
  }
}

std::vector<Token> ReadIfThere(const fs::path& file) {
  return fs::exists(file) ? ReadTokens(file) : std::vector<Token>();
}

auto OfName(const std::string& name) {
  return [&name](const Token& token) { return token.name == name; };
}

}  // namespace

std::string Sha256(std::string_view secret) { return Hex(HashOf(secret)); }

std::string_view NameOf(Role role) { return role == Role::kOperator ? "operator" : "viewer"; }

fs::path DefaultTokensFile() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config != '\0') return fs::path(config) / "skein/tokens.json";
  const char* home = std::getenv("HOME");
  return fs::path(home != nullptr && *home != '\0' ? home : "/root") / ".config/skein/tokens.json";
}

std::vector<Token> ReadTokens(const fs::path& file) {
  RefuseIfOpenToOthers(file);
  std::vector<Token> tokens;
  try {
    for (const config::Value& value :
         config::Object(config::Value::FromFile(file), {"tokens"}).Items("tokens"))
      tokens.push_back(ReadToken(value));
  } catch (const config::ConfigError& error) {
    throw AccessError(error.what());
  }
  return tokens;
}

std::string NewToken(const fs::path& file, const std::string& name, Role role) {
  StartSodium();
  const bool printable = std::ranges::all_of(name, [](unsigned char c) { return c >= 0x20 && c != 0x7F; });
  if (name.empty() || name.size() > kLongestName || !printable)
    throw AccessError("a name has 1 to 40 bytes, without control characters");
  std::vector<Token> tokens = ReadIfThere(file);
  if (std::ranges::any_of(tokens, OfName(name)))
    throw AccessError(name + " has a token already: skein token revoke takes it away");
  const std::string secret = RandomSecret();
  tokens.push_back({name, role, Hex(HashOf(secret)), UtcNow()});
  WriteTokens(file, tokens);
  return secret;
}

void RevokeToken(const fs::path& file, const std::string& name) {
  std::vector<Token> tokens = ReadTokens(file);
  if (std::erase_if(tokens, OfName(name)) == 0)
    throw AccessError(name + " has no token; skein token list names who has");
  WriteTokens(file, tokens);
}

const Token* Find(const std::vector<Token>& tokens, std::string_view secret) {
  if (secret.size() > kLongestSecret) return nullptr;
  const std::string sha256 = Hex(HashOf(secret));
  const Token* found = nullptr;
  for (const Token& token : tokens) {
    if (sodium_memcmp(token.sha256.data(), sha256.data(), sha256.size()) == 0) found = &token;
  }
  return found;
}

}  // namespace skein::access
