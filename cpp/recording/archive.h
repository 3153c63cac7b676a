#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace skein::recording {

/// Writes what ArchiveReader reads. A struct is described once for both, by a function found by its argument:
///   template <typename Archive> void Describe(Archive& archive, SeekPoint& point) { archive(point.utime,
///   ...); }
/// Numbers are as they lie in memory: for caches on this machine only.
class ArchiveWriter {
 public:
  template <typename... Fields>
  void operator()(Fields&... fields) {
    (One(fields), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  void One(T& field) {
    if constexpr (std::is_arithmetic_v<T>) {
      bytes_.append(reinterpret_cast<const char*>(&field), sizeof field);
    } else {
      Describe(*this, field);
    }
  }
  void One(std::string& text) {
    Size(text.size());
    bytes_ += text;
  }
  template <typename T>
  void One(std::vector<T>& items) {
    Size(items.size());
    for (T& item : items) One(item);
  }
  void Size(std::size_t size) {
    std::uint64_t number = size;
    One(number);
  }

  std::string bytes_;
};

/// Throws std::runtime_error where the bytes end too early; nothing in them makes it take more memory than a
/// small multiple of theirs.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename... Fields>
  void operator()(Fields&... fields) {
    (One(fields), ...);
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  template <typename T>
  void One(T& field) {
    if constexpr (std::is_same_v<T, bool>) {
      field = Take(sizeof field).front() != 0;  // any byte may stand in a damaged file
    } else if constexpr (std::is_arithmetic_v<T>) {
      std::memcpy(&field, Take(sizeof field).data(), sizeof field);
    } else {
      Describe(*this, field);
    }
  }
  void One(std::string& text) { text = Take(Size()); }
  template <typename T>
  void One(std::vector<T>& items) {
    // An item takes one byte at least, so a size that lies runs out of bytes soon.
    for (std::size_t left = Size(); left > 0; --left) One(items.emplace_back());
  }
  std::size_t Size() {
    std::uint64_t number = 0;
    One(number);
    return number;
  }
  std::string_view Take(std::size_t size) {
    if (size > bytes_.size()) throw std::runtime_error("it ends too early");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  std::string_view bytes_;
};

}  // namespace skein::recording
