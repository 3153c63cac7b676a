#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "bridge/access_rules.h"
#include "bridge/backend.h"
#include "bridge/doorkeeper.h"
#include "bridge/http_types.h"
#include "bridge/map_tiles.h"
#include "bridge/recordings_router.h"
#include "bridge/sign_in.h"
#include "bridge/static_files.h"

namespace skein::bridge {

struct RouterOptions {
  std::filesystem::path web_folder;
  std::vector<std::string> allowed_hosts;
  std::string tile_url;                            ///< "": none
  std::optional<MapTiles> tiles;                   ///< the operator's own map
  std::shared_ptr<const Recordings> recordings{};  ///< null: none
  std::filesystem::path tokens_file{};             ///< "": none are demanded
};

/// Answers HTTP requests: the page, the JSON API, and why not.
class HttpRouter {
 public:
  /// @param why_not why who sends a request may not operate, "" when he may.
  HttpRouter(const RouterOptions& options, Backend backend, Doorkeeper& doorkeeper,
             RecordingsRouter::WhyNot why_not);

  /// An answer that turns a request away for who sends it or for where to, before its body is read.
  /// @param upgrade it wants to become a WebSocket.
  std::optional<HttpResponse> TurnAway(const HttpHead& head, const Caller& caller, bool upgrade) const;

  /// `respond` is called once, possibly at once. @param gone set by the caller when nobody waits any more:
  /// what takes long is given up then, and perhaps never answered.
  void Answer(const HttpRequest& request, const Caller& caller, const Previewer::Gone& gone,
              std::function<void(HttpResponse)> respond) const;

  const RecordingsRouter& recordings() const { return recordings_; }

  /// An answer with a sentence in it.
  HttpResponse Plain(boost::beast::http::status status, std::string text) const;

 private:
  std::optional<HttpResponse> TurnAwayStrangers(const HttpHead& head, const Caller& caller,
                                                bool upgrade) const;
  HttpResponse Make(boost::beast::http::status status, std::string_view mime_type, std::string body) const;
  HttpResponse File(const HttpRequest& request, std::optional<StaticFile> file) const;
  HttpResponse Tile(const HttpRequest& request) const;
  HttpResponse TileArchive(const HttpRequest& request) const;
  void History(const HttpRequest& request, std::function<void(HttpResponse)> respond) const;
  void Command(const HttpRequest& request, std::function<void(HttpResponse)> respond) const;
  void Preview(const HttpRequest& request, const Previewer::Gone& gone,
               std::function<void(HttpResponse)> respond) const;

  AccessRules access_;
  StaticFiles files_;
  std::optional<MapTiles> tiles_;
  std::string content_security_policy_;
  Backend backend_;
  Doorkeeper& doorkeeper_;
  SignIn sign_in_;
  RecordingsRouter::WhyNot why_not_;
  RecordingsRouter recordings_;
};

}  // namespace skein::bridge
