#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein::testing {

/// All that a file holds; nothing when it cannot be read.
std::string Content(const std::filesystem::path& file);

/// The indented blocks of a text in Markdown: what a reader is told to type, or to put into a file.
std::vector<std::string> IndentedBlocks(const std::string& markdown);

}  // namespace skein::testing
