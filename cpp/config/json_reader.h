#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/scenario.h"

namespace skein::config {

/// Both ends belong to it.
struct Range {
  double least = 0;
  double most = 0;
};

/// A number as messages tell it.
std::string Shown(double number);

/// The text of a file of at most 32 MiB. Throws ConfigError when there is none, it is a folder, empty or no
/// text.
/// @param kind what the file is to be, for who names a folder: "a scenario file".
std::string ReadTextFile(const std::filesystem::path& file, const std::string& kind);

/// What a stranger sent, as JSON; discarded when it is none, or nests more than 64 levels: nlohmann's copies
/// recurse, and some hundred thousand levels would overflow the stack.
nlohmann::json ParseJson(std::string_view text);

/// A JSON value that knows its file and its JSON pointer, so that whatever is wrong with it is refused with
/// both. All readers throw ConfigError when the value is of another type or out of range.
class Value {
 public:
  /// Reads and parses a whole file. Refused: what cannot be read, is a folder, is empty, is no JSON (with
  /// line and column), or gives one key twice in an object.
  static Value FromFile(const std::filesystem::path& file);

  /// What did not come from a file. `name` stands where a file's name would: "CMD_LINK: /vehicle_id: must be
  /// ...".
  static Value FromJson(nlohmann::json json, std::string name);

  double Number(Range range) const;
  int Integer(Range range) const;
  bool Boolean() const;
  std::string Text() const;  ///< not empty, and such as messages carry: no control characters, at most 4 KiB
  std::vector<Value> Items() const;
  /// Key and value of every member, for objects whose keys are free.
  std::vector<std::pair<std::string, Value>> Members() const;
  bool IsText() const;

  /// "/vehicles/2/speed_m_s"; "" is the whole file.
  const std::string& pointer() const { return pointer_; }

  [[noreturn]] void Refuse(const std::string& reason) const;

 private:
  friend class Object;
  struct Document;
  Value(std::shared_ptr<const Document> document, const nlohmann::json& json, std::string pointer);
  Value Child(const nlohmann::json& json, std::string_view name) const;
  [[noreturn]] void RefuseType(std::string_view wanted) const;

  std::shared_ptr<const Document> document_;
  const nlohmann::json* json_;
  std::string pointer_;
};

/// A JSON object of which every key is known: others are refused when it is made, with the nearest key that
/// is known.
class Object {
 public:
  Object(Value value, std::initializer_list<std::string_view> known_keys);
  /// Looks once more at an object whose keys have been checked.
  explicit Object(Value checked) : value_(std::move(checked)) {}

  bool Has(std::string_view key) const;
  std::optional<Value> Find(std::string_view key) const;
  /// Refused when missing.
  Value At(std::string_view key) const;

  double Number(std::string_view key, Range range) const { return At(key).Number(range); }
  double Number(std::string_view key, Range range, double otherwise) const;
  bool Boolean(std::string_view key, bool otherwise) const;
  std::string Text(std::string_view key, std::string_view otherwise) const;
  /// The items of an array, none when it is missing.
  std::vector<Value> Items(std::string_view key) const;

  /// Refuses two keys that exclude one another.
  void RefuseBoth(std::string_view key, std::string_view other) const;

  const Value& value() const { return value_; }

 private:
  Value value_;
};

/// The candidate that is like `word` to within a few letters, for "did you mean".
std::optional<std::string> Nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "unknown shape "tringle"; did you mean "triangle"?", or the list of all when none is near.
std::string UnknownName(std::string_view kind, std::string_view word,
                        const std::vector<std::string>& candidates);

}  // namespace skein::config
