#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace skein::bridge {

/// Reads a binary frame byte by byte, as the description of the layout in cpp/bridge/README.md says and with
/// nothing of the encoder.
class FrameReader {
 public:
  explicit FrameReader(std::string bytes) : bytes_(std::move(bytes)) {
    kind = Unsigned(1);
    version = Unsigned(1);
    reserved = Unsigned(2);
    count = Unsigned(4);
    utime = Double();
    t_s = Double();
  }

  std::vector<std::int32_t> Ints() {
    std::vector<std::int32_t> column;
    for (std::uint64_t i = 0; i < count; ++i) column.push_back(static_cast<std::int32_t>(Unsigned(4)));
    return column;
  }
  std::vector<float> Floats() {
    std::vector<float> column;
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto bits = static_cast<std::uint32_t>(Unsigned(4));
      float value;
      std::memcpy(&value, &bits, sizeof value);
      column.push_back(value);
    }
    return column;
  }
  std::vector<int> Bytes() {
    std::vector<int> column;
    for (std::uint64_t i = 0; i < count; ++i) column.push_back(static_cast<int>(Unsigned(1)));
    return column;
  }
  bool at_end() const { return place_ == bytes_.size(); }

  std::uint64_t kind = 0;
  std::uint64_t version = 0;
  std::uint64_t reserved = 0;
  std::uint64_t count = 0;
  double utime = 0;
  double t_s = 0;

 private:
  std::uint64_t Unsigned(std::size_t size) {
    if (place_ + size > bytes_.size()) throw std::runtime_error("the frame is too short");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[place_ + i])) << (8 * i);
    }
    place_ += size;
    return value;
  }
  double Double() {
    const std::uint64_t bits = Unsigned(8);
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  std::string bytes_;
  std::size_t place_ = 0;
};

}  // namespace skein::bridge
