#include "bus/text.h"

#include <string_view>

namespace skein::bus {

std::string Shortened(std::string text, std::size_t most) {
  constexpr std::string_view kEllipsis = "\u2026";
  if (text.size() <= most) return text;
  std::size_t end = most - kEllipsis.size();
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  text.resize(end);
  return text.append(kEllipsis);
}

}  // namespace skein::bus
