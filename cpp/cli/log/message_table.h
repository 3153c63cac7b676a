#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skein::cli {

/// A message of any of Skein's types as rows of text, field by field as its .lcm file has them.
///
/// A field of a struct is named "formation.name". A list of structs makes a row for each of its items, named
/// "vehicles.id", with the other fields repeated; of several lists each item has a row of its own, in which
/// the cells of the other lists are empty. A list of numbers is one cell, with spaces between.
struct MessageTable {
  std::string_view type;  ///< "fleet_state_t"
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< at least one
};

/// None when the bytes are no good message of a type that Skein knows.
std::optional<MessageTable> ToTable(std::span<const std::byte> data);

}  // namespace skein::cli
