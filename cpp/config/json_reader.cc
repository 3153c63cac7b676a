#include "config/json_reader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>

namespace skein::config {
namespace {

using nlohmann::json;

// Far more than a thousand UAVs need; keeps an endless device from filling the memory.
constexpr std::size_t kMaxFileBytes = 32u << 20;
constexpr int kDeepest = 64;
// As in the messages of the bus: what is read here is sent there.
constexpr std::size_t kLongestText = 4096;

std::string Escaped(std::string_view key) {
  std::string result;
  for (const char c : key) result += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return result;
}

std::string Quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

// nlohmann keeps the last of two equal keys in silence, which would make a slip of copy and paste fly.
class DuplicateKeys {
 public:
  explicit DuplicateKeys(std::string file) : file_(std::move(file)) {}

  bool operator()(json::parse_event_t event, const json& parsed) {
    using Event = json::parse_event_t;
    if (event == Event::object_end || event == Event::array_end) {
      levels_.pop_back();
    } else if (event == Event::key) {
      Level& level = levels_.back();
      level.name = Escaped(parsed.get_ref<const std::string&>());
      if (!level.keys.insert(level.name).second)
        throw ConfigError(file_ + ": " + Pointer() + ": is given twice");
    } else {
      if (!levels_.empty() && levels_.back().array)
        levels_.back().name = std::to_string(levels_.back().next++);
      if (event != Event::value) levels_.push_back({.array = event == Event::array_start});
    }
    return true;
  }

 private:
  struct Level {
    bool array = false;
    int next = 0;
    std::string name = {};
    std::set<std::string> keys = {};
  };

  std::string Pointer() const {
    return std::accumulate(
        levels_.begin(), levels_.end(), std::string(),
        [](const std::string& path, const Level& level) { return path + "/" + level.name; });
  }

  std::string file_;
  std::vector<Level> levels_;
};

// "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error ..." -> "syntax error ..."
std::string PlainReason(const std::string& what) {
  for (const std::string_view marker : {": ", "] "}) {
    const auto position = what.find(marker);
    if (position != std::string::npos) return what.substr(position + marker.size());
  }
  return what;
}

// The parser's own line and column are wrong where a number ends a line.
std::string LineAndColumn(const std::string& text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const auto line = 1 + std::count(text.begin(), end, '\n');
  const auto line_start = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
  return "line " + std::to_string(line) + ", column " + std::to_string(1 + (end - line_start));
}

std::size_t Distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string ReadTextFile(const std::filesystem::path& file, const std::string& kind) {
  const std::string name = file.string();
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw ConfigError(name + ": there is no such file");
  if (std::filesystem::is_directory(status)) throw ConfigError(name + ": is a folder, not " + kind);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw ConfigError(name + ": cannot be read: " + std::strerror(errno));
  std::string text;
  std::array<char, 65'536> block{};
  do {
    stream.read(block.data(), block.size());
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  } while (stream && text.size() <= kMaxFileBytes);
  if (stream.bad()) throw ConfigError(name + ": cannot be read");
  if (text.size() > kMaxFileBytes) throw ConfigError(name + ": is larger than 32 MiB");
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw ConfigError(name + ": is empty");
  if (text.find('\0') != std::string::npos) throw ConfigError(name + ": is no text file");
  return text;
}

std::string Shown(double number) {
  std::ostringstream text;
  text.precision(10);
  text << number;
  return text.str();
}

json ParseJson(std::string_view text) {
  bool too_deep = false;
  const auto keep = [&](int depth, json::parse_event_t, json&) {
    too_deep |= depth > kDeepest;
    return !too_deep;
  };
  json parsed = json::parse(text, keep, false);
  return too_deep ? json(json::value_t::discarded) : parsed;
}

struct Value::Document {
  std::string file;
  json root;
};

Value Value::FromFile(const std::filesystem::path& file) {
  const std::string text = ReadTextFile(file, "a scenario file");
  auto document = std::make_shared<Document>();
  document->file = file.string();
  try {
    DuplicateKeys duplicates(document->file);
    document->root = json::parse(
        text, [&](int, json::parse_event_t event, json& parsed) { return duplicates(event, parsed); });
  } catch (const json::parse_error& error) {
    throw ConfigError(document->file + ": " + LineAndColumn(text, error.byte) + ": " +
                      PlainReason(error.what()));
  } catch (const json::exception& error) {
    throw ConfigError(document->file + ": " + PlainReason(error.what()));
  }
  const json& root = document->root;
  return Value(std::move(document), root, "");
}

Value Value::FromJson(json json, std::string name) {
  const auto document = std::make_shared<const Document>(Document{std::move(name), std::move(json)});
  return Value(document, document->root, "");
}

Value::Value(std::shared_ptr<const Document> document, const json& json, std::string pointer)
    : document_(std::move(document)), json_(&json), pointer_(std::move(pointer)) {}

Value Value::Child(const json& json, std::string_view name) const {
  return Value(document_, json, pointer_ + "/" + Escaped(name));
}

double Value::Number(Range range) const {
  if (!json_->is_number()) RefuseType("a number");
  const double number = json_->get<double>();
  if (!(number >= range.least && number <= range.most)) {
    Refuse("must be " + Shown(range.least) + " .. " + Shown(range.most) + ", is " + Shown(number));
  }
  return number;
}

int Value::Integer(Range range) const {
  if (!json_->is_number()) RefuseType("a whole number");
  const double number = Number(range);
  if (number != std::floor(number)) Refuse("must be a whole number, is " + Shown(number));
  return static_cast<int>(number);
}

bool Value::Boolean() const {
  if (!json_->is_boolean()) RefuseType("true or false");
  return json_->get<bool>();
}

std::string Value::Text() const {
  if (!json_->is_string()) RefuseType("a text");
  auto text = json_->get<std::string>();
  if (text.empty()) Refuse("must not be empty");
  if (text.size() > kLongestText) Refuse("is longer than " + std::to_string(kLongestText) + " bytes");
  const auto is_control = [](unsigned char c) { return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7F; };
  if (std::ranges::any_of(text, is_control)) Refuse("has a control character in it");
  return text;
}

std::vector<Value> Value::Items() const {
  if (!json_->is_array()) RefuseType("an array");
  std::vector<Value> items;
  for (const json& item : *json_) items.push_back(Child(item, std::to_string(items.size())));
  return items;
}

std::vector<std::pair<std::string, Value>> Value::Members() const {
  if (!json_->is_object()) RefuseType("an object");
  std::vector<std::pair<std::string, Value>> members;
  for (const auto& [key, value] : json_->items()) members.emplace_back(key, Child(value, key));
  return members;
}

bool Value::IsText() const { return json_->is_string(); }

void Value::Refuse(const std::string& reason) const {
  throw ConfigError(document_->file + ": " + (pointer_.empty() ? "" : pointer_ + ": ") + reason);
}

void Value::RefuseType(std::string_view wanted) const {
  const std::string is = json_->is_null()     ? "null"
                         : json_->is_string() ? "a text"
                         : json_->is_array()  ? "an array"
                         : json_->is_object() ? "an object"
                         : json_->is_number() ? "a number"
                                              : json_->dump();
  Refuse("must be " + std::string(wanted) + ", is " + is);
}

Object::Object(Value value, std::initializer_list<std::string_view> known_keys) : value_(std::move(value)) {
  const std::vector<std::string> known(known_keys.begin(), known_keys.end());
  for (const auto& [key, member] : value_.Members()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      const auto nearest = Nearest(key, known);
      member.Refuse("unknown key" + (nearest ? "; did you mean " + Quoted(*nearest) + "?" : ""));
    }
  }
}

bool Object::Has(std::string_view key) const { return value_.json_->contains(key); }

std::optional<Value> Object::Find(std::string_view key) const {
  const auto member = value_.json_->find(key);
  if (member == value_.json_->end()) return std::nullopt;
  return value_.Child(*member, key);
}

Value Object::At(std::string_view key) const {
  auto member = Find(key);
  if (!member) value_.Refuse("the key " + Quoted(key) + " is missing");
  return *std::move(member);
}

double Object::Number(std::string_view key, Range range, double otherwise) const {
  const auto member = Find(key);
  return member ? member->Number(range) : otherwise;
}

bool Object::Boolean(std::string_view key, bool otherwise) const {
  const auto member = Find(key);
  return member ? member->Boolean() : otherwise;
}

std::string Object::Text(std::string_view key, std::string_view otherwise) const {
  const auto member = Find(key);
  return member ? member->Text() : std::string(otherwise);
}

std::vector<Value> Object::Items(std::string_view key) const {
  const auto member = Find(key);
  return member ? member->Items() : std::vector<Value>();
}

void Object::RefuseBoth(std::string_view key, std::string_view other) const {
  if (Has(key) && Has(other)) At(other).Refuse("cannot be given beside " + Quoted(key));
}

std::optional<std::string> Nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::optional<std::string> nearest;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = Distance(word, candidate);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string UnknownName(std::string_view kind, std::string_view word,
                        const std::vector<std::string>& candidates) {
  std::string message = "unknown " + std::string(kind) + " " + Quoted(word) + "; ";
  if (const auto nearest = Nearest(word, candidates))
    return message + "did you mean " + Quoted(*nearest) + "?";
  message += "there are ";
  for (const std::string& candidate : candidates) {
    message += (candidate == candidates.front() ? "" : ", ") + Quoted(candidate);
  }
  return message;
}

}  // namespace skein::config
