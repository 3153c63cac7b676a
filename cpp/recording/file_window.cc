#include "recording/file_window.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace skein::recording {
namespace {

constexpr std::uint64_t kFirstBytes = 16 * 1024;  // who wants one message alone has read enough
constexpr std::uint64_t kUsualBytes = 256 * 1024;
constexpr std::uint64_t kMostKeptBytes = 64ULL
                                         << 20;  // a long event does not keep its memory once it is past
constexpr std::uint64_t kAheadBytes = 1 << 20;
constexpr std::uint64_t kCarriedBytes =
    64 * 1024;  // room before what was read ahead, for the event that began earlier

/// How many of the bytes there were: all but at the end of the file, on an unreadable disk, or where it was
/// cut short meanwhile, which are one.
std::uint64_t Read(int descriptor, std::byte* bytes, std::uint64_t wanted, std::uint64_t offset) {
  std::uint64_t done = 0;
  while (done < wanted) {
    const ssize_t got = pread(descriptor, bytes + done, wanted - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::uint64_t>(got);
  }
  return done;
}

}  // namespace

bool FileWindow::Holds(std::uint64_t offset, std::uint64_t size) const {
  return offset >= offset_ && offset + size <= offset_ + bytes_;
}

std::span<const std::byte> FileWindow::At(std::uint64_t offset, std::uint64_t size,
                                          std::uint64_t file_bytes) {
  if (!Holds(offset, size)) {
    const bool follows = offset >= offset_ && offset <= offset_ + bytes_;
    if (!TakeAhead(offset, size)) Fill(offset, size, file_bytes);
    if (reads_ahead_ && follows) StartAhead(file_bytes);
  }
  const std::uint64_t skipped = offset - offset_;
  return {buffer_.data() + start_ + skipped, std::min(size, bytes_ - std::min(skipped, bytes_))};
}

void FileWindow::Fill(std::uint64_t offset, std::uint64_t size, std::uint64_t file_bytes) {
  const std::uint64_t left = offset < file_bytes ? file_bytes - offset : 0;
  const std::uint64_t usual = buffer_.empty() ? kFirstBytes : kUsualBytes;
  const std::uint64_t wanted = std::min(std::max(size, usual), left);
  if (buffer_.size() < wanted || buffer_.size() > kMostKeptBytes) {
    buffer_ = std::vector<std::byte>(std::max(wanted, usual));
  }
  start_ = 0;
  offset_ = offset;
  bytes_ = Read(descriptor_, buffer_.data(), wanted, offset);
}

/// Makes what was read ahead the window. False if that is not what is wanted.
bool FileWindow::TakeAhead(std::uint64_t offset, std::uint64_t size) {
  if (!next_bytes_.valid()) return false;
  const std::uint64_t got = next_bytes_.get();
  const std::uint64_t end = offset_ + bytes_;
  if (offset < offset_ || offset > end || end - offset > kCarriedBytes || offset + size > end + got)
    return false;
  const std::uint64_t carried = end - offset;
  std::memcpy(next_buffer_.data() + kCarriedBytes - carried, buffer_.data() + start_ + (offset - offset_),
              carried);
  std::swap(buffer_, next_buffer_);
  start_ = kCarriedBytes - carried;
  offset_ = offset;
  bytes_ = carried + got;
  return true;
}

void FileWindow::StartAhead(std::uint64_t file_bytes) {
  const std::uint64_t from = offset_ + bytes_;
  if (from >= file_bytes) return;
  if (next_buffer_.size() != kCarriedBytes + kAheadBytes) {
    next_buffer_ = std::vector<std::byte>(kCarriedBytes + kAheadBytes);
  }
  // The default policy: where no thread can be had, get() reads.
  next_bytes_ = std::async(Read, descriptor_, next_buffer_.data() + kCarriedBytes,
                           std::min(kAheadBytes, file_bytes - from), from);
}

}  // namespace skein::recording
