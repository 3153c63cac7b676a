#pragma once

#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <string>

#include "cli/station.h"

namespace skein::cli {

struct SpyOptions {
  std::string channel{};  ///< "": a table of all
  std::string where{};    ///< FIELD=VALUE: only such messages of the channel; "": chunk 0 of those in chunks
  double for_s = 0;       ///< ends by itself after so long; 0: goes on until Ctrl-C
  bool once = false;      ///< one table, or one message, and ends
  bool json = false;
};

/// Shows what goes on on the bus, or the messages of one channel field by field. Throws Failure when nothing
/// is heard.
void Spy(Station& station, const SpyOptions& options, std::ostream& out);

/// A message for people, a line for each field, and a table for each list. @param width of the terminal
/// [characters], 0: as wide as it needs to be.
std::string MessageText(const nlohmann::ordered_json& fields, std::size_t width);

}  // namespace skein::cli
