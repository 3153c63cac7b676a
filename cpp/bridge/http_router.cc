#include "bridge/http_router.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bridge/byte_range.h"
#include "bridge/history_query.h"
#include "bridge/json_messages.h"
#include "bridge/url.h"
#include "config/json_reader.h"

namespace skein::bridge {
namespace {

namespace http = boost::beast::http;
using http::field;
using http::status;

constexpr std::string_view kHealth = "/api/health";
constexpr std::string_view kCommand = "/api/command";
constexpr std::string_view kFormationPreview = "/api/preview/formation";
constexpr std::string_view kPathPreview = "/api/preview/path";
constexpr std::string_view kTiles = "/tiles/";
constexpr std::string_view kTileArchive = "/tiles.pmtiles";

// A reader of PMTiles asks for kilobytes; more than this is sent to nobody at once.
constexpr std::uint64_t kMaxPartBytes = 4u << 20;

std::string_view Path(const HttpHead& head) { return PathOf(View(head.target())); }

bool Reads(const HttpHead& head) {
  return head.method() == http::verb::get || head.method() == http::verb::head;
}

status StatusOf(CommandResult::Outcome outcome) {
  switch (outcome) {
    case CommandResult::Outcome::kAccepted:
      return status::ok;
    case CommandResult::Outcome::kRefused:
      return status::conflict;
    case CommandResult::Outcome::kMalformed:
      return status::bad_request;
    case CommandResult::Outcome::kBusy:
      return status::service_unavailable;
    case CommandResult::Outcome::kNoAnswer:
      break;
  }
  return status::gateway_timeout;
}

std::string ResultJson(const CommandResult& result) {
  return nlohmann::json{{"accepted", result.accepted()}, {"reason", result.reason}}.dump();
}

std::string ScenariosJson() {
  Json list = Json::array();
  for (const config::ScenarioEntry& entry : config::ListScenarios()) {
    list.push_back({{"name", entry.bare_name},
                    {"title", entry.name},
                    {"description", entry.description},
                    {"vehicles", entry.vehicles},
                    {"duration_s", entry.duration_s},
                    {"problem", entry.problem}});
  }
  return Dump(list);
}

}  // namespace

HttpRouter::HttpRouter(const RouterOptions& options, Backend backend, Doorkeeper& doorkeeper,
                       RecordingsRouter::WhyNot why_not)
    : access_(options.allowed_hosts),
      files_(options.web_folder),
      tiles_(options.tiles),
      content_security_policy_(ContentSecurityPolicy(options.tile_url)),
      backend_(std::move(backend)),
      doorkeeper_(doorkeeper),
      sign_in_(doorkeeper, [this](status status, std::string_view mime_type,
                                  std::string body) { return Make(status, mime_type, std::move(body)); }),
      why_not_(std::move(why_not)),
      recordings_(
          options.recordings,
          [this](status status, std::string_view mime_type, std::string body) {
            return Make(status, mime_type, std::move(body));
          },
          why_not_, backend_.tell) {}

std::optional<HttpResponse> HttpRouter::TurnAwayStrangers(const HttpHead& head, const Caller& caller,
                                                          bool upgrade) const {
  const std::string_view path = Path(head);
  // The page itself is no secret, and somebody has to ask for the token. Who watches over processes needs
  // none.
  const bool open =
      !upgrade && ((!path.starts_with("/api/") && !path.starts_with("/tiles")) || path == kHealth);
  const bool signs_in_or_out = path == SignIn::kPath && !Reads(head);
  if (open || signs_in_or_out) return std::nullopt;
  const std::string address = AddressOf(head, caller.remote_address);
  const auto visitor = doorkeeper_.Admit(doorkeeper_.SecretOf(head, caller.local_port), address);
  if (!visitor) return sign_in_.TooMany(doorkeeper_.Wait(address));
  if (!visitor->rights.look) return sign_in_.Unknown(head, caller.local_port);
  if (!upgrade && !Reads(head) && !visitor->rights.operate)
    return Plain(status::forbidden, "This token is a viewer's: it may only look.");
  return std::nullopt;
}

std::optional<HttpResponse> HttpRouter::TurnAway(const HttpHead& head, const Caller& caller,
                                                 bool upgrade) const {
  if (head.count(field::host) != 1) return Plain(status::bad_request, "One Host header is needed.");
  const std::string_view host = View(head[field::host]);
  if (!access_.HostIsOurs(host, caller.local_address)) {
    return Plain(
        status::forbidden,
        "This web-bridge is not called by that name. If it should be, start it with --allow-host NAME.");
  }
  // Programs send no Origin. Browsers send it with whatever could do something, and it cannot be forged
  // there.
  const bool foreign =
      head.count(field::origin) > 1 ||
      (head.count(field::origin) == 1 && !AccessRules::SameOrigin(View(head[field::origin]), host));
  if (foreign && (upgrade || !Reads(head))) {
    return Plain(status::forbidden, "Only the page that this web-bridge serves may do that.");
  }
  if (auto response = TurnAwayStrangers(head, caller, upgrade)) return response;
  const std::string_view path = Path(head);
  if (upgrade != (path == "/live")) {
    if (upgrade) return Plain(status::not_found, "The WebSocket is at /live.");
    HttpResponse response = Plain(status::upgrade_required, "This is a WebSocket.");
    response.set(field::upgrade, "websocket");
    return response;
  }
  if (upgrade) {
    const std::string watched = recordings_.Watched(View(head.target()));
    if (watched.empty() || recordings_.Has(watched)) return std::nullopt;
    return Plain(status::not_found, "There is no such recording.");
  }
  const bool posts = path == kCommand || path == kFormationPreview || path == kPathPreview;
  const bool signs = path == SignIn::kPath;
  const bool deletes = signs || recordings_.Deletes(View(head.target()));
  const bool fits = posts ? head.method() == http::verb::post
                          : Reads(head) || (deletes && head.method() == http::verb::delete_) ||
                                (signs && head.method() == http::verb::post);
  if (!fits) {
    HttpResponse response = Plain(status::method_not_allowed, "Not with this method.");
    response.set(field::allow, posts     ? "POST"
                               : signs   ? "GET, HEAD, POST, DELETE"
                               : deletes ? "GET, HEAD, DELETE"
                                         : "GET, HEAD");
    return response;
  }
  return std::nullopt;
}

void HttpRouter::Answer(const HttpRequest& request, const Caller& caller, const Previewer::Gone& gone,
                        std::function<void(HttpResponse)> respond) const {
  const std::string_view path = Path(request);
  const auto respond_json = [this, respond](const std::string& json) {
    respond(Make(status::ok, kJson, json));
  };
  if (path == SignIn::kPath) {
    respond(sign_in_.Answer(request, caller.local_port, AddressOf(request, caller.remote_address)));
  } else if (recordings_.Concerns(View(request.target()))) {
    respond(recordings_.Answer(request));
  } else if (path == kHealth) {
    backend_.health(respond_json);
  } else if (path == "/api/state") {
    backend_.state(respond_json);
  } else if (path == "/api/vehicles") {
    backend_.vehicles(respond_json);
  } else if (path == "/api/scenarios") {
    respond_json(ScenariosJson());
  } else if (path == "/api/history") {
    History(request, std::move(respond));
  } else if (path == kCommand) {
    Command(request, std::move(respond));
  } else if (path == kFormationPreview || path == kPathPreview) {
    Preview(request, gone, std::move(respond));
  } else if (path.starts_with("/api/")) {
    respond(Plain(
        status::not_found,
        "The API has /api/health, /api/state, /api/vehicles, /api/history, /api/scenarios, /api/recordings, "
        "/api/session, /api/command, /api/preview/formation and /api/preview/path."));
  } else if (path.starts_with(kTiles)) {
    respond(Tile(request));
  } else if (path == kTileArchive) {
    respond(TileArchive(request));
  } else {
    respond(File(request, files_.Find(View(request.target()))));
  }
}

HttpResponse HttpRouter::Plain(status status, std::string text) const {
  return Make(status, "text/plain; charset=utf-8", std::move(text) + "\n");
}

HttpResponse HttpRouter::Make(status status, std::string_view mime_type, std::string body) const {
  HttpResponse response(status, 11, std::move(body));
  const auto set = [&](auto name, std::string_view value) {
    response.set(name, {value.data(), value.size()});
  };
  set(field::server, "web-bridge");
  set(field::content_type, mime_type);
  set(field::cache_control, "no-store");
  set("Content-Security-Policy", content_security_policy_);
  set("X-Content-Type-Options", "nosniff");
  set("Cross-Origin-Resource-Policy", "same-origin");
  response.content_length(response.body().size());
  return response;
}

HttpResponse HttpRouter::File(const HttpRequest& request, std::optional<StaticFile> file) const {
  if (!file) return Plain(status::not_found, "There is no such file.");
  const bool known = View(request[field::if_none_match]) == file->etag;
  HttpResponse response = Make(known ? status::not_modified : status::ok, file->mime_type,
                               known ? std::string() : std::move(file->content));
  response.set(field::cache_control, {file->cache_control.data(), file->cache_control.size()});
  response.set(field::etag, file->etag);
  if (known) response.erase(field::content_length);
  return response;
}

HttpResponse HttpRouter::Tile(const HttpRequest& request) const {
  if (!tiles_) return Plain(status::not_found, "This web-bridge was started without --tiles.");
  auto tile = tiles_->Tile(Path(request).substr(kTiles.size()));
  if (tile) return File(request, std::move(tile));
  // A map has edges and holes: no fault, and nothing that a browser should complain of.
  HttpResponse response = Plain(status::no_content, "");
  response.body().clear();
  response.erase(field::content_length);
  return response;
}

HttpResponse HttpRouter::TileArchive(const HttpRequest& request) const {
  const auto archive = tiles_ ? tiles_->FindArchive() : std::nullopt;
  if (!archive) return Plain(status::not_found, "This web-bridge serves no PMTiles file.");
  // A range of another version than the one that is here now is no use to anybody.
  const std::string_view if_range = View(request[field::if_range]);
  const bool same_version = if_range.empty() || if_range == archive->etag;
  ByteRange range = ParseByteRange(same_version ? View(request[field::range]) : "", archive->size);
  const auto finish = [&](HttpResponse response) {
    response.set(field::accept_ranges, "bytes");
    response.set(field::etag, archive->etag);
    return response;
  };
  const std::string size = std::to_string(archive->size);
  if (range.kind == ByteRange::Kind::kBeyond) {
    HttpResponse response = Plain(status::range_not_satisfiable, "The file has " + size + " bytes.");
    response.set(field::content_range, "bytes */" + size);
    return finish(std::move(response));
  }
  const bool part = range.kind == ByteRange::Kind::kPart;
  if (!part) range.length = archive->size;
  if (!part && range.length > kMaxPartBytes)
    return finish(Plain(status::bad_request, "It is large: ask for parts of it, with a Range header."));
  // RFC 9110, 14.2: a server may send the beginning of the part, and wait to be asked for the rest.
  std::string bytes = tiles_->ReadArchive(range.first, std::min(range.length, kMaxPartBytes));
  if (part && bytes.empty()) return Plain(status::not_found, "The file has just become shorter.");
  const std::string last = std::to_string(range.first + bytes.size() - 1);
  HttpResponse response =
      Make(part ? status::partial_content : status::ok, "application/vnd.pmtiles", std::move(bytes));
  if (part)
    response.set(field::content_range, "bytes " + std::to_string(range.first) + "-" + last + "/" + size);
  return finish(std::move(response));
}

void HttpRouter::History(const HttpRequest& request, std::function<void(HttpResponse)> respond) const {
  const auto parsed = ParseHistoryQuery(QueryOf(View(request.target())));
  if (const auto* problem = std::get_if<std::string>(&parsed)) {
    return respond(Plain(status::bad_request, *problem));
  }
  backend_.history(std::get<HistoryQuery>(parsed), [this, respond](const std::string& bytes) {
    respond(Make(status::ok, "application/octet-stream", bytes));
  });
}

void HttpRouter::Command(const HttpRequest& request, std::function<void(HttpResponse)> respond) const {
  const auto finish = [this, respond](const CommandResult& result) {
    respond(Make(StatusOf(result.outcome), kJson, ResultJson(result)));
  };
  if (!backend_.why_no_command.empty())
    return finish({CommandResult::Outcome::kRefused, backend_.why_no_command});
  // Where no token is demanded this host's programs may command at any time: they could on the bus, too.
  if (const std::string reason = doorkeeper_.demands_tokens() ? why_not_(request) : ""; !reason.empty())
    return finish({CommandResult::Outcome::kRefused, reason});
  auto command = config::ParseJson(request.body());
  const auto refuse = [&](const char* reason) { finish({CommandResult::Outcome::kMalformed, reason}); };
  if (!command.is_object()) return refuse("the request is no JSON object");
  if (!command.contains("channel") || !command["channel"].is_string())
    return refuse("channel: must be a text");
  if (!command.contains("body")) return refuse("body: is missing");
  if (command.size() != 2) return refuse("only channel and body belong in the request");
  backend_.command(command["channel"], std::move(command["body"]), finish);
}

void HttpRouter::Preview(const HttpRequest& request, const Previewer::Gone& gone,
                         std::function<void(HttpResponse)> respond) const {
  const auto refuse = [&](status status, const std::string& reason) {
    respond(Make(status, kJson, nlohmann::json{{"ok", false}, {"reason", reason}}.dump()));
  };
  if (!backend_.why_no_command.empty()) return refuse(status::conflict, backend_.why_no_command);
  const auto body = config::ParseJson(request.body());
  if (!body.is_object()) return refuse(status::bad_request, "the request is no JSON object");
  PreviewRequest wanted;
  try {
    wanted = Path(request) == kPathPreview ? ParsePathPreview(body) : ParseFormationPreview(body);
  } catch (const config::ConfigError& error) {
    return refuse(status::bad_request, error.what());
  }
  backend_.preview(std::move(wanted), gone, [this, respond](const PreviewReply& reply) {
    if (reply.busy) {
      respond(
          Make(status::service_unavailable, kJson,
               R"({"ok":false,"reason":"other changes are being flown ahead: try again in some seconds"})"));
    } else {
      respond(Make(status::ok, kJson, reply.json));
    }
  });
}

}  // namespace skein::bridge
