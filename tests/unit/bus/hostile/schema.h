#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace skein::bus::testing {

/// Something in an encoded message that a hostile sender could falsify.
struct Place {
  enum class Kind { kArrayLength, kStringLength, kDouble, kBoolean, kInteger };
  Kind kind;
  std::string field;
  std::size_t offset = 0;
  std::int64_t length = 0;     ///< of an array or string (with its NUL), as it stands there
  std::int64_t too_large = 0;  ///< the least such length that the rest of the message cannot hold
  std::string type{};          ///< to which the field belongs, for integers
  std::size_t bytes = 0;       ///< of an integer
};

/// What the .lcm files say, read independently of lcm-gen and of harden.py.
class Schema {
 public:
  explicit Schema(const std::string& directory);

  const std::vector<std::string>& type_names() const { return type_names_; }

  /// Walks through a well-formed message of a type (fingerprint first).
  std::vector<Place> Places(const std::string& type, const std::vector<std::uint8_t>& bytes) const;

 private:
  struct Field {
    std::string type;
    std::string name;
    std::string length_field;  ///< "" when not an array
  };
  struct Walk;

  std::size_t LeastSize(const std::string& type) const;
  void WalkType(const std::string& type, Walk& walk) const;
  std::int64_t WalkValue(const std::string& owner, const std::string& type, const std::string& name,
                         Walk& walk) const;

  std::vector<std::string> type_names_;
  std::map<std::string, std::vector<Field>> types_;
};

std::int32_t ReadInt32(const std::vector<std::uint8_t>& bytes, std::size_t offset);
/// Of so many bytes.
std::int64_t ReadInteger(const std::vector<std::uint8_t>& bytes, std::size_t offset, std::size_t size);
void WriteInteger(std::vector<std::uint8_t>& bytes, std::size_t offset, std::size_t size, std::int64_t value);
void WriteInt32(std::vector<std::uint8_t>& bytes, std::size_t offset, std::int32_t value);
void WriteDouble(std::vector<std::uint8_t>& bytes, std::size_t offset, double value);

}  // namespace skein::bus::testing
