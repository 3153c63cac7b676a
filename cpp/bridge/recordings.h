#pragma once

#include <boost/beast/http/status.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "bridge/history_query.h"
#include "bridge/live_frame.h"

namespace skein::bridge {

/// What the web server asks of recorded flights (cpp/playback is behind it), all on its own thread, and
/// nothing of it waits.
struct Recordings {
  struct Reply {
    boost::beast::http::status status = boost::beast::http::status::ok;
    std::string body;  ///< JSON, or a sentence
    bool is_sentence = false;
    bool is_binary = false;
  };

  /// GET /api/recordings, GET and DELETE of /api/recordings/NAME.
  std::function<Reply()> list;
  std::function<Reply(const std::string& name)> describe;
  std::function<Reply(const std::string& name)> remove;
  /// The curves of the flight that was on at `at_s`; none: of the first.
  std::function<Reply(const std::string& name, std::optional<double> at_s, const HistoryQuery&)> history;
  /// The file of a part, none when there is no such one.
  std::function<std::optional<std::filesystem::path>(const std::string& name, int part)> file;

  /// Takes the texts of one browser.
  using Hear = std::function<void(const std::string& text)>;
  /// Begins to play a recording to one browser; it ends with the last copy of what is returned. `send` is
  /// called on threads of others. Null when too many look on already.
  std::function<Hear(const std::string& name, std::function<void(const LiveFrame&)> send)> watch;
  std::function<bool(const std::string& name)> has;

  std::string only;      ///< name of the one that is shown at "/", "" when that is the live flight
  bool live_bus = true;  ///< there is a live flight beside them
};

}  // namespace skein::bridge
