#pragma once

#include <cstddef>
#include <cstdint>
#include <future>
#include <span>
#include <vector>

namespace skein::recording {

/// The bytes of a file around the place where somebody reads. Of one thread; others may have windows of their
/// own on the same descriptor.
class FileWindow {
 public:
  /// @param descriptor of a regular file, open for reading for as long as the window lives.
  explicit FileWindow(int descriptor) : descriptor_(descriptor) {}

  /// Reads what comes after the window on another thread meanwhile: for who reads a long way from front to
  /// back.
  void ReadAhead() { reads_ahead_ = true; }

  /// The `size` bytes from `offset` on, fewer where the file ends before, or where it cannot be read. Good
  /// until the next call. @param file_bytes where the file ends.
  std::span<const std::byte> At(std::uint64_t offset, std::uint64_t size, std::uint64_t file_bytes);

  /// Whether At() need not read for them.
  bool Holds(std::uint64_t offset, std::uint64_t size) const;

 private:
  void Fill(std::uint64_t offset, std::uint64_t size, std::uint64_t file_bytes);
  bool TakeAhead(std::uint64_t offset, std::uint64_t size);
  void StartAhead(std::uint64_t file_bytes);

  int descriptor_;
  bool reads_ahead_ = false;
  std::vector<std::byte> buffer_;
  std::size_t start_ = 0;  ///< of the window, in the buffer
  std::uint64_t offset_ = 0;
  std::uint64_t bytes_ = 0;
  std::vector<std::byte> next_buffer_;
  std::future<std::uint64_t> next_bytes_;  ///< last: whoever fills next_buffer_ is waited for
};

}  // namespace skein::recording
