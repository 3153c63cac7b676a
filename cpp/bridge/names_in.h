#pragma once

#include <string>

namespace skein::bridge {

/// "a, b or c": what a refusal says that there is. @param table of pairs, each a name and what it stands for.
template <typename Table>
std::string NamesIn(const Table& table) {
  std::string names;
  std::size_t left = table.size();
  for (const auto& entry : table) {
    names += entry.first;
    if (--left > 0) names += left == 1 ? " or " : ", ";
  }
  return names;
}

}  // namespace skein::bridge
