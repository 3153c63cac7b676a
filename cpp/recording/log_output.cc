#include "recording/log_output.h"

#include <string>

namespace skein::recording {
namespace {

void AppendBigEndian(std::string& bytes, std::uint64_t value, int count) {
  for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
}

}  // namespace

void LogOutput::Write(bus::Utime utime, std::string_view channel, std::span<const std::byte> data) {
  std::string head;
  AppendBigEndian(head, 0xEDA1DA01, 4);
  AppendBigEndian(head, static_cast<std::uint64_t>(number_++), 8);
  AppendBigEndian(head, static_cast<std::uint64_t>(utime), 8);
  AppendBigEndian(head, channel.size(), 4);
  AppendBigEndian(head, data.size(), 4);
  head += channel;
  stream_.write(head.data(), static_cast<std::streamsize>(head.size()));
  stream_.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
}

}  // namespace skein::recording
