#include "bridge/live_frame.h"

#include <boost/beast/zlib/deflate_stream.hpp>
#include <boost/beast/zlib/inflate_stream.hpp>
#include <cstring>
#include <stdexcept>

namespace skein::bridge {
namespace {

namespace zlib = boost::beast::zlib;

constexpr std::size_t kHeaderBytes = 8;
constexpr std::size_t kSizeAt = 4;
constexpr char kVersion = 1;
constexpr std::size_t kWord = 4;
// Of zlib's levels the fastest: level 6 makes frames of 1,000 UAVs 5% smaller for six times the time.
constexpr int kLevel = 1;
constexpr int kWindowBits = 15;
constexpr int kMemoryLevel = 8;

/// The bytes of one significance beside each other: neighbours in a column differ in the lower ones only.
std::string Sorted(const std::string& bytes) {
  std::string sorted;
  sorted.reserve(bytes.size());
  const std::size_t whole = bytes.size() / kWord * kWord;
  for (std::size_t first = 0; first < kWord; ++first) {
    for (std::size_t at = first; at < whole; at += kWord) sorted.push_back(bytes[at]);
  }
  sorted.append(bytes, whole);
  return sorted;
}

std::string Unsorted(const std::string& sorted) {
  std::string bytes = sorted;
  const std::size_t words = sorted.size() / kWord;
  for (std::size_t i = 0; i < words * kWord; ++i) bytes[i % words * kWord + i / words] = sorted[i];
  return bytes;
}

void Deflate(const std::string& from, std::string& to) {
  zlib::deflate_stream stream;
  stream.reset(kLevel, kWindowBits, kMemoryLevel, zlib::Strategy::normal);
  const std::size_t begin = to.size();
  to.resize(begin + stream.upper_bound(from.size()));
  zlib::z_params step{};
  step.next_in = from.data();
  step.avail_in = from.size();
  step.next_out = to.data() + begin;
  step.avail_out = to.size() - begin;
  boost::system::error_code error;
  stream.write(step, zlib::Flush::finish, error);
  if (error != zlib::error::end_of_stream) throw std::runtime_error("deflate: " + error.message());
  to.resize(begin + step.total_out);
}

std::shared_ptr<const std::string> Packed(const std::string& content, bool binary) {
  std::string packed(kHeaderBytes, '\0');
  packed[0] = kPackedKind;
  packed[1] = kVersion;
  packed[2] = binary ? 1 : 0;
  const auto size = static_cast<std::uint32_t>(content.size());
  std::memcpy(packed.data() + kSizeAt, &size, sizeof size);
  Deflate(binary ? Sorted(content) : content, packed);
  // It may wait for long, and its size is what is counted then.
  packed.shrink_to_fit();
  return std::make_shared<const std::string>(std::move(packed));
}

LiveFrame Frame(const std::string& content, bool binary, std::string key) {
  const bool large = content.size() >= kPackFrom;
  return {large ? Packed(content, binary) : std::make_shared<const std::string>(content), binary || large,
          std::move(key)};
}

}  // namespace

LiveFrame TextFrame(const std::string& text, std::string key) { return Frame(text, false, std::move(key)); }
LiveFrame BinaryFrame(const std::string& bytes, std::string key) {
  return Frame(bytes, true, std::move(key));
}

LiveFrame ResetFrame() {
  LiveFrame frame = TextFrame(R"({"type":"reset"})");
  frame.resets = true;
  return frame;
}

LiveFrame Unpacked(const LiveFrame& frame) {
  const std::string& bytes = *frame.bytes;
  if (!frame.binary || bytes.empty() || bytes[0] != kPackedKind) return frame;
  if (bytes.size() < kHeaderBytes || bytes[1] != kVersion)
    throw std::invalid_argument("packed frame: no header");
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + kSizeAt, sizeof size);
  std::string content(size, '\0');
  zlib::inflate_stream stream;
  zlib::z_params step{};
  step.next_in = bytes.data() + kHeaderBytes;
  step.avail_in = bytes.size() - kHeaderBytes;
  step.next_out = content.data();
  step.avail_out = content.size();
  boost::system::error_code error;
  stream.write(step, zlib::Flush::sync, error);
  // Beast's inflate does not always see the mark of the end, when nothing comes behind it.
  if ((error && error != zlib::error::end_of_stream) || step.total_out != size) {
    throw std::invalid_argument("packed frame: damaged");
  }
  LiveFrame unpacked = frame;
  unpacked.binary = bytes[2] == 1;
  unpacked.bytes = std::make_shared<const std::string>(unpacked.binary ? Unsorted(content) : content);
  return unpacked;
}

}  // namespace skein::bridge
