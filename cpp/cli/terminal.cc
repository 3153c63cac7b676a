#include "cli/terminal.h"

#include <spdlog/fmt/fmt.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <sstream>
#include <vector>

namespace skein::cli {

TerminalSize Terminal() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return {};
  // One that does not tell its size.
  if (size.ws_col == 0 || size.ws_row == 0) return {80, 24};
  return {size.ws_col, size.ws_row};
}

std::string Fitted(const std::string& text, const TerminalSize& terminal) {
  if (terminal.columns == 0) return text;
  std::istringstream lines(text);
  std::vector<std::string> kept;
  for (std::string line; std::getline(lines, line);) {
    // Never within a character of several bytes.
    std::size_t end = 0;
    for (std::size_t shown = 0; end < line.size(); ++end) {
      const bool begins = (static_cast<unsigned char>(line[end]) & 0xC0) != 0x80;
      if (begins && ++shown > terminal.columns) break;
    }
    kept.push_back(line.substr(0, end));
  }
  // The last row is the cursor's.
  const std::size_t rows = terminal.rows > 2 ? terminal.rows - 1 : terminal.rows;
  std::string fitted;
  const bool all = kept.size() <= rows;
  const std::size_t shown = all ? kept.size() : rows - 1;
  for (std::size_t i = 0; i < shown; ++i) fitted += kept[i] + '\n';
  if (!all) fitted += fmt::format("... and {} lines more", kept.size() - shown) + '\n';
  return fitted;
}

}  // namespace skein::cli
