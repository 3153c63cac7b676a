#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skein::cli {

/// Rows of cells, all of one length; the first is the heading.
using Table = std::vector<std::vector<std::string>>;

/// Columns as wide as their widest cell; the first `left` of them flush left, the others flush right.
std::string Aligned(const Table& table, std::size_t left);

}  // namespace skein::cli
