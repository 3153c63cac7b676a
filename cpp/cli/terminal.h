#pragma once

#include <cstddef>
#include <string>

namespace skein::cli {

inline constexpr const char* kClearScreen = "\x1b[H\x1b[J";

struct TerminalSize {
  std::size_t columns = 0;
  std::size_t rows = 0;
};

/// Of the terminal that standard output is; all 0 when it is none.
TerminalSize Terminal();

/// What of a text fits onto a terminal, and how much does not; the whole text when it is none. Long lines are
/// cut off.
std::string Fitted(const std::string& text, const TerminalSize& terminal);

}  // namespace skein::cli
