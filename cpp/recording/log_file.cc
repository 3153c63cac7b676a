#include "recording/log_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace skein::recording {
namespace {

// An event is: magic word, number (8), utime (8), length of the channel (4), length of the data (4), channel,
// data; all of it big endian.
constexpr std::array<unsigned char, 4> kMagic = {0xED, 0xA1, 0xDA, 0x01};
constexpr std::uint64_t kHeaderBytes = 28;
constexpr std::uint32_t kMaxChannelBytes = 999;         // as LCM's own reader
constexpr std::uint32_t kMaxDataBytes = 1U << 28;       // LCM carries no longer messages
constexpr std::uint64_t kWindowBytes = 256 * 1024;      // read at once
constexpr std::uint64_t kFirstWindowBytes = 16 * 1024;  // who wants one message alone has read enough
constexpr std::uint64_t kProbeBytes = 64ULL << 20;      // without an event in it a file is no log
constexpr std::uint64_t kMaxUnconfirmedBytes = 16ULL << 20;
constexpr std::size_t kMaxListedDamage = 1000;

[[noreturn]] void Fail(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + reason);
}

std::uint64_t BigEndian(const std::byte* bytes, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | static_cast<std::uint64_t>(bytes[i]);
  return value;
}

bool IsMagic(std::span<const std::byte> bytes) {
  return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

}  // namespace

LogFile::LogFile(std::filesystem::path file) : file_(std::move(file)) {
  // Without O_NONBLOCK a named pipe would wait for somebody to write.
  descriptor_ = open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) Fail(file_, std::string("cannot be opened: ") + std::strerror(errno));
  try {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) Fail(file_, std::strerror(errno));
    if (S_ISDIR(status.st_mode)) Fail(file_, "is a folder, not a log");
    if (!S_ISREG(status.st_mode)) Fail(file_, "is not a file");
    bytes_ = static_cast<std::uint64_t>(status.st_size);
    if (bytes_ == 0) Fail(file_, "is empty: nothing was recorded");
    LogReader probe(*this);
    probe.search_bytes_ = kProbeBytes;
    if (!probe.Next()) Fail(file_, "is not an LCM log: there is no event in it");
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

LogFile::~LogFile() { close(descriptor_); }

void LogFile::Refresh() {
  struct stat status {};
  if (fstat(descriptor_, &status) == 0) bytes_ = static_cast<std::uint64_t>(status.st_size);
}

std::uint64_t LogEvent::bytes() const { return kHeaderBytes + channel.size() + data.size(); }

struct LogReader::Header {
  std::uint64_t offset = 0;
  std::int64_t number = 0;
  bus::Utime utime = 0;
  std::uint64_t channel_bytes = 0;
  std::uint64_t data_bytes = 0;

  std::uint64_t end() const { return offset + kHeaderBytes + channel_bytes + data_bytes; }
};

LogReader::LogReader(const LogFile& log, std::uint64_t offset)
    : log_(log), offset_(offset), reports_(offset == 0) {}

/// The bytes from `offset` on, fewer than `size` where the file ends before.
std::span<const std::byte> LogReader::Window(std::uint64_t offset, std::uint64_t size) {
  if (offset < window_offset_ || offset + size > window_offset_ + window_bytes_) {
    const std::uint64_t left = offset < log_.bytes_ ? log_.bytes_ - offset : 0;
    const std::uint64_t usual = window_.empty() ? kFirstWindowBytes : kWindowBytes;
    const std::uint64_t wanted = std::min(std::max(size, usual), left);
    // A long event does not keep its memory once it is past.
    if (window_.size() < wanted || window_.size() > 4 * kMaxUnconfirmedBytes) {
      window_ = std::vector<std::byte>(std::max(wanted, usual));
    }
    window_offset_ = offset;
    window_bytes_ = 0;
    while (window_bytes_ < wanted) {
      const ssize_t got = pread(log_.descriptor_, window_.data() + window_bytes_, wanted - window_bytes_,
                                static_cast<off_t>(offset + window_bytes_));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;  // an unreadable disk, or cut short meanwhile: as if the file ended here
      window_bytes_ += static_cast<std::uint64_t>(got);
    }
  }
  const std::uint64_t start = offset - window_offset_;
  return {window_.data() + start, std::min(size, window_bytes_ - std::min(start, window_bytes_))};
}

/// None where no event can start. Its end may lie beyond the end of the file.
std::optional<LogReader::Header> LogReader::ReadHeader(std::uint64_t offset) {
  const auto bytes = Window(offset, kHeaderBytes);
  if (bytes.size() < kHeaderBytes || !IsMagic(bytes)) return std::nullopt;
  Header header;
  header.offset = offset;
  header.number = static_cast<std::int64_t>(BigEndian(bytes.data() + 4, 8));
  header.utime = static_cast<bus::Utime>(BigEndian(bytes.data() + 12, 8));
  header.channel_bytes = BigEndian(bytes.data() + 20, 4);
  header.data_bytes = BigEndian(bytes.data() + 24, 4);
  if (header.channel_bytes < 1 || header.channel_bytes > kMaxChannelBytes) return std::nullopt;
  if (header.data_bytes > kMaxDataBytes) return std::nullopt;
  return header;
}

/// Whether an event that ends here can be believed: another one begins, or the file ends.
bool LogReader::Follows(std::uint64_t end) {
  if (end >= log_.bytes_) return end == log_.bytes_;
  // Beside the window, which has the event in it.
  if (end >= window_offset_ && end + kMagic.size() <= window_offset_ + window_bytes_) {
    return IsMagic(Window(end, kMagic.size()));
  }
  std::array<std::byte, kMagic.size()> next{};
  const ssize_t got = pread(log_.descriptor_, next.data(), next.size(), static_cast<off_t>(end));
  if (got <= 0) return false;
  // What the end of the file leaves of a header is one, too.
  return std::memcmp(next.data(), kMagic.data(), static_cast<std::size_t>(got)) == 0;
}

std::optional<std::uint64_t> LogReader::FindMagic(std::uint64_t from, std::uint64_t end) {
  const std::uint64_t stop = std::min(end, log_.bytes_);
  while (from + kMagic.size() <= stop && search_bytes_ > 0) {
    // What is left of the window first: where magic words are dense, each would read it anew.
    const std::uint64_t window_end = window_offset_ + window_bytes_;
    const bool in_window = from >= window_offset_ && from + kMagic.size() <= window_end;
    if (!in_window) {
      // Zeros of a sparse file are not even read.
      const off_t data = lseek(log_.descriptor_, static_cast<off_t>(from), SEEK_DATA);
      if (data < 0 && errno == ENXIO) return std::nullopt;
      if (data > 0 && static_cast<std::uint64_t>(data) > from) {
        from = static_cast<std::uint64_t>(data);
        continue;
      }
    }
    const std::uint64_t left = in_window ? window_end - from : kWindowBytes;
    const auto bytes = Window(from, std::min(left, stop - from));
    if (bytes.size() < kMagic.size()) return std::nullopt;
    const void* found = memmem(bytes.data(), bytes.size(), kMagic.data(), kMagic.size());
    const std::uint64_t searched =
        found ? static_cast<std::uint64_t>(static_cast<const std::byte*>(found) - bytes.data())
              : bytes.size() - (kMagic.size() - 1);
    from += searched;
    search_bytes_ -= std::min(search_bytes_, found ? searched + 1 : searched);
    if (found) return from;
  }
  return std::nullopt;
}

/// The first event at or after `from` that another one or the end of the file follows.
std::optional<LogReader::Header> LogReader::FirstConfirmed(std::uint64_t from) {
  const bool is_known = confirmed_ && confirmed_->log_bytes == log_.bytes_ && from >= confirmed_->from &&
                        (!confirmed_->offset || *confirmed_->offset >= from);
  if (!is_known) {
    confirmed_ = Confirmed{from, log_.bytes_, std::nullopt};
    for (auto at = FindMagic(from, log_.bytes_); at; at = FindMagic(*at + 1, log_.bytes_)) {
      const auto header = ReadHeader(*at);
      if (!header || !Follows(header->end())) continue;
      confirmed_->offset = at;
      break;
    }
  }
  return confirmed_->offset ? ReadHeader(*confirmed_->offset) : std::nullopt;
}

/// The first event at or after `from` that is confirmed, or lies wholly before that one.
std::optional<LogReader::Header> LogReader::FirstBelievable(std::uint64_t from) {
  const auto confirmed = FirstConfirmed(from);
  const std::uint64_t limit = confirmed ? confirmed->offset : log_.bytes_;
  for (auto at = FindMagic(from, limit); at; at = FindMagic(*at + 1, limit)) {
    const auto header = ReadHeader(*at);
    if (!header) continue;
    if (header->end() <= limit && header->end() - header->offset <= kMaxUnconfirmedBytes) return header;
  }
  return confirmed;
}

std::optional<LogEvent> LogReader::Take(const Header& header) {
  const auto bytes = Window(header.offset, header.end() - header.offset);
  if (bytes.size() < header.end() - header.offset) {
    Report(header.offset, log_.bytes_ - header.offset, "bytes that could not be read");
    offset_ = log_.bytes_;
    return std::nullopt;
  }
  LogEvent event;
  event.offset = header.offset;
  event.number = header.number;
  event.utime = header.utime;
  event.channel = {reinterpret_cast<const char*>(bytes.data()) + kHeaderBytes, header.channel_bytes};
  event.data = bytes.subspan(kHeaderBytes + header.channel_bytes);
  offset_ = header.end();
  last_utime_ = header.utime;
  reports_ = true;
  return event;
}

void LogReader::Report(std::uint64_t offset, std::uint64_t bytes, std::string reason) {
  if (!reports_) return;
  ++damage_count_;
  damaged_bytes_ += bytes;
  if (damage_.size() < kMaxListedDamage) damage_.push_back({offset, bytes, std::move(reason), last_utime_});
}

std::optional<LogEvent> LogReader::Next() {
  tail_.reset();
  if (offset_ >= log_.bytes_) return std::nullopt;
  const auto header = ReadHeader(offset_);
  if (header && Follows(header->end())) return Take(*header);

  // Either this event is damaged or the one after it.
  if (const auto next = FirstBelievable(offset_)) {
    if (next->offset > offset_) {
      Report(offset_, next->offset - offset_,
             header ? "an event whose length is wrong" : "bytes that are no event");
    }
    return Take(*next);
  }
  // What the end of the file may have cut short stays, should the file grow.
  const std::uint64_t left = log_.bytes_ - offset_;
  const bool is_cut_short = header || (left < kHeaderBytes && Follows(offset_));
  if (is_cut_short && reports_) tail_ = Damage{offset_, left, "the last event is cut short", last_utime_};
  if (!is_cut_short) {
    Report(offset_, left, "bytes that are no event");
    offset_ = log_.bytes_;
  }
  return std::nullopt;
}

std::vector<Damage> LogReader::damage() const {
  std::vector<Damage> all = damage_;
  if (tail_) all.push_back(*tail_);
  return all;
}

}  // namespace skein::recording
