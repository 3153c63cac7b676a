#include "recording/index_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "recording/archive.h"

namespace skein::recording {
namespace {

// Raise it whenever what an index holds, or how it is found, changes.
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kMagic = 0x58444E49;  // "INDX"

}  // namespace

// Found by their arguments, so not within the unnamed namespace.
template <typename Archive>
void Describe(Archive& archive, SeekPoint& point) {
  archive(point.utime, point.offset, point.shift);
}

template <typename Archive>
void Describe(Archive& archive, ChannelCount& count) {
  archive(count.name, count.count, count.bytes, count.undecodable, count.known, count.first, count.last);
}

template <typename Archive>
void Describe(Archive& archive, ToldEvent& event) {
  archive(event.utime, event.offset, event.severity, event.code, event.text);
}

template <typename Archive>
void Describe(Archive& archive, RaisedAlarm& alarm) {
  archive(alarm.utime, alarm.session_id, alarm.id, alarm.severity, alarm.condition, alarm.text);
}

template <typename Archive>
void Describe(Archive& archive, HeldMessage& message) {
  archive(message.stream, message.messages, message.utime, message.offset);
}

template <typename Archive>
void Describe(Archive& archive, HistoryRow& row) {
  archive(row.id, row.flags);
  for (float& value : row.values) archive(value);
}

template <typename Archive>
void Describe(Archive& archive, std::shared_ptr<const HistorySample>& shared) {
  HistorySample sample = shared ? *shared : HistorySample{};
  archive(sample.t_s, sample.rows);
  if (!shared) shared = std::make_shared<const HistorySample>(std::move(sample));
}

template <typename Archive>
void Describe(Archive& archive, IndexedFlight& flight) {
  archive(flight.utime, flight.start_utime, flight.scenario, flight.vehicles, flight.samples);
}

template <typename Archive>
void Describe(Archive& archive, IndexedDamage& damage) {
  archive(damage.utime, damage.offset, damage.bytes, damage.reason);
}

template <typename Archive>
void Describe(Archive& archive, LogIndex& index) {
  archive(index.bytes, index.events, index.first, index.last, index.points, index.channels, index.told,
          index.alarms, index.streams, index.held, index.flights, index.damage, index.damaged_bytes);
}

/// Tells one state of a log from another.
struct Stamp {
  std::uint32_t magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint64_t bytes = 0;
  std::int64_t changed_ns = 0;

  bool operator==(const Stamp&) const = default;
};

template <typename Archive>
void Describe(Archive& archive, Stamp& stamp) {
  archive(stamp.magic, stamp.version, stamp.bytes, stamp.changed_ns);
}

namespace {

// One of this log has its stamp, and still may be of any size when it is damaged.
constexpr std::uintmax_t kLargestIndexBytes = 256 << 20;

std::string EncodedStamp(Stamp stamp) {
  ArchiveWriter archive;
  archive(stamp);
  return std::string(archive.bytes());
}

std::optional<Stamp> StampOf(const std::filesystem::path& log) {
  struct stat status {};
  if (stat(log.c_str(), &status) != 0) return std::nullopt;
  Stamp stamp;
  stamp.bytes = static_cast<std::uint64_t>(status.st_size);
  stamp.changed_ns = status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec;
  return stamp;
}

bool Sane(const LogIndex& index) {
  const auto in_log = [&](const auto& item) { return item.offset < index.bytes; };
  return !index.points.empty() && index.first <= index.last && std::ranges::all_of(index.points, in_log) &&
         std::ranges::all_of(index.held, in_log) && std::ranges::all_of(index.told, in_log) &&
         std::ranges::all_of(index.held,
                             [&](const auto& held) { return held.stream < index.streams.size(); });
}

bool WriteAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

std::filesystem::path IndexFileOf(const std::filesystem::path& log) {
  std::filesystem::path file = log;
  return file += kIndexExtension;
}

std::optional<LogIndex> LoadIndex(const std::filesystem::path& log) {
  const auto stamp = StampOf(log);
  std::ifstream stream(IndexFileOf(log), std::ios::binary);
  if (!stamp || !stream) return std::nullopt;
  try {
    // Not the whole of what may be anybody's file before it is known to be ours.
    Stamp saved;
    std::string bytes = EncodedStamp(saved);
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) return std::nullopt;
    ArchiveReader beginning(bytes);
    beginning(saved);
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(IndexFileOf(log), error);
    if (saved != *stamp || error || size > kLargestIndexBytes) return std::nullopt;
    bytes.resize(size);
    stream.seekg(0);
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    ArchiveReader archive(bytes);
    archive(saved);
    LogIndex index;
    archive(index);
    if (!archive.at_end() || !Sane(index)) return std::nullopt;
    return index;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::string SaveIndex(const std::filesystem::path& log, const LogIndex& index) {
  auto stamp = StampOf(log);
  if (!stamp || stamp->bytes != index.bytes) return "the log has changed meanwhile";
  ArchiveWriter archive;
  LogIndex copy = index;  // an archive describes both ways
  archive(*stamp, copy);
  // Another process may be about to do the same.
  std::string unfinished = IndexFileOf(log).string() + ".XXXXXX";
  const int descriptor = mkostemp(unfinished.data(), O_CLOEXEC);
  if (descriptor < 0) return std::strerror(errno);
  fchmod(descriptor, 0644);
  const bool written = WriteAll(descriptor, archive.bytes());
  const int error = errno;
  if (close(descriptor) == 0 && written && rename(unfinished.c_str(), IndexFileOf(log).c_str()) == 0)
    return "";
  unlink(unfinished.c_str());
  return std::strerror(written ? errno : error);
}

}  // namespace skein::recording
