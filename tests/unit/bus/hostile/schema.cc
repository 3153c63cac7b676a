#include "unit/bus/hostile/schema.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace skein::bus::testing {
namespace {

const std::map<std::string, std::size_t> kSizes = {{"int8_t", 1},  {"boolean", 1}, {"int16_t", 2},
                                                   {"int32_t", 4}, {"int64_t", 8}, {"float", 4},
                                                   {"double", 8},  {"string", 5}};

}  // namespace

struct Schema::Walk {
  const std::vector<std::uint8_t>& bytes;
  std::size_t offset = 8;
  std::vector<Place> places;
};

Schema::Schema(const std::string& directory) {
  static const std::regex comment("//[^\n]*");
  static const std::regex head(R"(struct\s+(\w+))");
  static const std::regex field(R"((\w+)\s+(\w+)\s*(?:\[\s*(\w+)\s*\])?\s*;)");
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() != ".lcm") continue;
    std::ifstream file(entry.path());
    std::string text{std::istreambuf_iterator<char>(file), {}};
    text = std::regex_replace(text, comment, "");
    text = std::regex_replace(text, std::regex(R"(const\s[^;]*;)"), "");
    std::smatch match;
    if (!std::regex_search(text, match, head))
      throw std::runtime_error(entry.path().string() + ": no struct");
    const std::string name = match[1];
    text = match.suffix();
    for (std::sregex_iterator found(text.begin(), text.end(), field), end; found != end; ++found) {
      types_[name].push_back({(*found)[1], (*found)[2], (*found)[3]});
    }
    type_names_.push_back(name);
  }
  std::sort(type_names_.begin(), type_names_.end());
}

std::size_t Schema::LeastSize(const std::string& type) const {
  if (const auto size = kSizes.find(type); size != kSizes.end()) return size->second;
  std::size_t sum = 0;
  for (const Field& field : types_.at(type)) sum += field.length_field.empty() ? LeastSize(field.type) : 0;
  return sum;
}

std::vector<Place> Schema::Places(const std::string& type, const std::vector<std::uint8_t>& bytes) const {
  Walk walk{bytes, 8, {}};
  WalkType(type, walk);
  if (walk.offset != bytes.size())
    throw std::runtime_error("the walk through " + type + " did not end at its end");
  return walk.places;
}

void Schema::WalkType(const std::string& type, Walk& walk) const {
  std::map<std::string, std::pair<std::int64_t, std::size_t>> numbers;  // value and offset by field
  for (const Field& field : types_.at(type)) {
    if (field.length_field.empty()) {
      const std::size_t offset = walk.offset;
      numbers[field.name] = {WalkValue(type, field.type, field.name, walk), offset};
      continue;
    }
    const auto [length, offset] = numbers.at(field.length_field);
    const std::size_t rest = walk.bytes.size() - walk.offset;
    // The length is no integer of its own.
    std::erase_if(walk.places, [at = offset](const Place& place) {
      return place.kind == Place::Kind::kInteger && place.offset == at;
    });
    walk.places.push_back({Place::Kind::kArrayLength, field.name, offset, length,
                           static_cast<std::int64_t>(rest / LeastSize(field.type)) + 1});
    for (std::int64_t i = 0; i < length; ++i) WalkValue(type, field.type, field.name, walk);
  }
}

std::int64_t Schema::WalkValue(const std::string& owner, const std::string& type, const std::string& name,
                               Walk& walk) const {
  const std::size_t offset = walk.offset;
  if (type == "string") {
    const std::int32_t length = ReadInt32(walk.bytes, offset);
    walk.places.push_back({Place::Kind::kStringLength, name, offset, length,
                           static_cast<std::int64_t>(walk.bytes.size() - offset - 4) + 1});
    walk.offset += 4 + static_cast<std::size_t>(length);
    return 0;
  }
  const auto size = kSizes.find(type);
  if (size == kSizes.end()) {
    WalkType(type, walk);
    return 0;
  }
  walk.offset += size->second;
  if (type == "double") walk.places.push_back({Place::Kind::kDouble, name, offset});
  if (type == "boolean") walk.places.push_back({Place::Kind::kBoolean, name, offset});
  if (type.starts_with("int"))
    walk.places.push_back({Place::Kind::kInteger, name, offset, 0, 0, owner, size->second});
  return type == "int32_t" ? ReadInt32(walk.bytes, offset) : 0;
}

std::int32_t ReadInt32(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes.at(offset + i);
  return static_cast<std::int32_t>(value);
}

std::int64_t ReadInteger(const std::vector<std::uint8_t>& bytes, std::size_t offset, std::size_t size) {
  // All ones when it is negative.
  auto value = static_cast<std::uint64_t>(static_cast<std::int8_t>(bytes.at(offset)));
  for (std::size_t i = 1; i < size; ++i) value = value << 8 | bytes.at(offset + i);
  return static_cast<std::int64_t>(value);
}

void WriteInteger(std::vector<std::uint8_t>& bytes, std::size_t offset, std::size_t size,
                  std::int64_t value) {
  for (std::size_t i = 0; i < size; ++i)
    bytes.at(offset + i) =
        static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * (size - 1 - i)));
}

void WriteInt32(std::vector<std::uint8_t>& bytes, std::size_t offset, std::int32_t value) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes.at(offset + i) = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (24 - 8 * i));
  }
}

void WriteDouble(std::vector<std::uint8_t>& bytes, std::size_t offset, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (std::size_t i = 0; i < 8; ++i) bytes.at(offset + i) = static_cast<std::uint8_t>(bits >> (56 - 8 * i));
}

}  // namespace skein::bus::testing
