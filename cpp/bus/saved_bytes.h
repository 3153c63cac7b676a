#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "bus/decode.h"
#include "bus/validate.h"

namespace skein::bus {

/// Puts numbers and messages behind one another, for a StateFile.
class SavedBytes {
 public:
  void Add(std::int64_t number) { bytes_.append(reinterpret_cast<const char*>(&number), sizeof number); }
  void Add(double number) { Add(std::bit_cast<std::int64_t>(number)); }
  void Add(const std::string& text) {
    Add(static_cast<std::int64_t>(text.size()));
    bytes_ += text;
  }
  template <typename Message>
  requires std::is_class_v<Message>
  void Add(const Message& message) {
    const int size = message.getEncodedSize();
    Add(static_cast<std::int64_t>(size));
    const std::size_t start = bytes_.size();
    bytes_.resize(start + static_cast<std::size_t>(size));
    message.encode(bytes_.data() + start, 0, size);
  }

  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Takes them off the front again, in the same order; none when the bytes do not hold one.
class SavedReader {
 public:
  explicit SavedReader(std::string_view bytes) : rest_(bytes) {}

  std::optional<std::int64_t> Number() {
    std::int64_t number = 0;
    if (rest_.size() < sizeof number) return std::nullopt;
    std::memcpy(&number, rest_.data(), sizeof number);
    rest_.remove_prefix(sizeof number);
    return number;
  }
  std::optional<double> Real() {
    const auto number = Number();
    if (!number) return std::nullopt;
    return std::bit_cast<double>(*number);
  }
  std::optional<std::string_view> Text() {
    const auto size = Number();
    if (!size || *size < 0 || static_cast<std::size_t>(*size) > rest_.size()) return std::nullopt;
    const std::string_view text = rest_.substr(0, static_cast<std::size_t>(*size));
    rest_.remove_prefix(text.size());
    return text;
  }
  /// One that is also Valid().
  template <typename Message>
  std::optional<Message> Take() {
    const auto bytes = Text();
    if (!bytes) return std::nullopt;
    auto message = Decode<Message>(bytes->data(), bytes->size());
    if (message && !Valid(*message)) return std::nullopt;
    return message;
  }

 private:
  std::string_view rest_;
};

}  // namespace skein::bus
