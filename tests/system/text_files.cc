#include "system/text_files.h"

#include <fstream>
#include <iterator>
#include <sstream>

namespace skein::testing {

std::string Content(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> IndentedBlocks(const std::string& markdown) {
  const std::string indent = "    ";
  std::vector<std::string> blocks;
  bool goes_on = false;
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) {
    const bool indented = line.starts_with(indent);
    // Between the sections of a file there is an empty line.
    if (!indented && !line.empty()) goes_on = false;
    if (!indented && !goes_on) continue;
    if (!goes_on) blocks.emplace_back();
    goes_on = true;
    blocks.back() += (indented ? line.substr(indent.size()) : line) + "\n";
  }
  return blocks;
}

}  // namespace skein::testing
