#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "bus/executor.h"

/// How `skein log` writes things.
namespace skein::cli {

/// By event_t's and alarm_t's severity.
inline constexpr std::array<const char*, 4> kSeverities = {"info", "advisory", "caution", "warning"};

/// "2026-11-25T14:30:46.050Z". Years past 9999 and before 1970 are cut off there.
std::string IsoTime(bus::Utime utime);

/// "512 B", "12.3 kB", "2.1 GB".
std::string ByteText(std::uint64_t bytes);

/// "1 h 05 min 09 s", "35.2 s".
std::string DurationText(double duration_s);

/// Without control characters and what is no UTF-8, each of which becomes "?": others choose the names of
/// their channels, and a terminal obeys some of them.
std::string Printable(std::string_view text);

/// As a cell of a CSV file (RFC 4180): in quotes where need be.
std::string CsvCell(const std::string& text);

}  // namespace skein::cli
