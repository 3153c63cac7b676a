#include "bridge/recordings_router.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "bridge/byte_range.h"
#include "bridge/static_files.h"
#include "bridge/url.h"

namespace skein::bridge {
namespace {

namespace http = boost::beast::http;
using http::field;
using http::status;

constexpr std::string_view kList = "/api/recordings";
constexpr std::string_view kOne = "/api/recordings/";
constexpr std::string_view kFile = "/file";
constexpr std::string_view kHistory = "/api/history";

/// NAME of "/api/recordings/NAME" or "/api/recordings/NAME/file"; names have no slash.
struct Target {
  std::string name;
  bool file = false;
};

std::optional<Target> ParseTarget(std::string_view target) {
  std::string_view path = PathOf(target);
  if (!path.starts_with(kOne)) return std::nullopt;
  path.remove_prefix(kOne.size());
  const std::size_t slash = path.find('/');
  const bool file = slash != std::string_view::npos && path.substr(slash) == kFile;
  if (slash != std::string_view::npos && !file) return std::nullopt;
  auto name = PercentDecoded(path.substr(0, slash));
  if (!name || name->empty()) return std::nullopt;
  return Target{std::move(*name), file};
}

}  // namespace

bool RecordingsRouter::Concerns(std::string_view target) const {
  const std::string_view path = PathOf(target);
  return path == kList || path.starts_with(kOne) ||
         (path == kHistory && QueryValue(QueryOf(target), "recording"));
}

bool RecordingsRouter::Deletes(std::string_view target) const {
  const auto parsed = ParseTarget(target);
  return parsed && !parsed->file;
}

std::string RecordingsRouter::Watched(std::string_view target) const {
  const std::string_view query = QueryOf(target);
  if (const auto named = QueryValue(query, "recording")) return *named;
  // Who asks for a recording by a name that can't be read must not be shown the live bus instead.
  if (QueryWithout(query, {"recording"}).size() != query.size()) return "/";
  return recordings_ ? recordings_->only : "";
}

HttpResponse RecordingsRouter::Answer(const HttpRequest& request) const {
  if (!recordings_) {
    return Sentence(status::not_found, "This web-bridge was started without --logs and --log.");
  }
  const std::string_view target = View(request.target());
  if (PathOf(target) == kHistory) return History(QueryOf(target));
  if (PathOf(target) == kList) return Reply(recordings_->list());
  const auto parsed = ParseTarget(target);
  if (!parsed || parsed->file)
    return Sentence(status::not_found, "There is no such recording, or part of it.");
  if (request.method() == http::verb::delete_) return Delete(request, parsed->name);
  return Reply(recordings_->describe(parsed->name));
}

HttpResponse RecordingsRouter::History(std::string_view query) const {
  const auto at = QueryValue(query, "at");
  const auto at_s = at ? ParseNumber<double>(*at) : std::nullopt;
  if (at && !at_s)
    return Sentence(status::bad_request, "at: must be seconds since the recording's first event.");
  const auto parsed = ParseHistoryQuery(QueryWithout(query, {"recording", "at"}));
  if (const auto* problem = std::get_if<std::string>(&parsed)) return Sentence(status::bad_request, *problem);
  return Reply(recordings_->history(*QueryValue(query, "recording"), at_s, std::get<HistoryQuery>(parsed)));
}

HttpResponse RecordingsRouter::Delete(const HttpRequest& request, const std::string& name) const {
  const std::string why_not = why_not_(request);
  if (!why_not.empty()) {
    return make_(status::forbidden, kJson, nlohmann::json{{"deleted", false}, {"reason", why_not}}.dump());
  }
  const Recordings::Reply reply = recordings_->remove(name);
  if (reply.status == status::ok) tell_("recording_deleted", "the recording " + name + " was deleted");
  return Reply(reply);
}

HttpResponse RecordingsRouter::Reply(const Recordings::Reply& reply) const {
  if (reply.is_sentence) return Sentence(reply.status, reply.body);
  return make_(reply.status, reply.is_binary ? "application/octet-stream" : kJson, reply.body);
}

HttpResponse RecordingsRouter::Sentence(status status, std::string text) const {
  return make_(status, "text/plain; charset=utf-8", std::move(text) + "\n");
}

std::optional<RecordingsRouter::Download> RecordingsRouter::FindFile(const HttpRequest& request) const {
  const std::string_view target = View(request.target());
  const auto parsed = recordings_ ? ParseTarget(target) : std::nullopt;
  if (!parsed || !parsed->file) return std::nullopt;
  const auto part = QueryValue(QueryOf(target), "part");
  const auto file = recordings_->file(parsed->name, part ? ParseNumber<int>(*part).value_or(-1) : 0);
  std::error_code error;
  const std::uint64_t size = file ? std::filesystem::file_size(*file, error) : 0;
  if (!file || error) return std::nullopt;

  const std::string etag = EntityTag(*file, size);
  const std::string_view if_range = View(request[field::if_range]);
  const bool same_version = if_range.empty() || if_range == etag;
  const ByteRange range = ParseByteRange(same_version ? View(request[field::range]) : "", size);
  Download download;
  download.file = *file;
  download.length = size;
  status result = status::ok;
  std::string content_range;
  if (range.kind == ByteRange::Kind::kBeyond) {
    result = status::range_not_satisfiable;
    content_range = "bytes */" + std::to_string(size);
    download.length = 0;
  } else if (range.kind == ByteRange::Kind::kPart) {
    result = status::partial_content;
    download.first = range.first;
    download.length = range.length;
    content_range = "bytes " + std::to_string(range.first) + "-" +
                    std::to_string(range.first + range.length - 1) + "/" + std::to_string(size);
  }
  download.head = make_(result, "application/octet-stream", "");
  download.head.content_length(download.length);
  download.head.set(field::accept_ranges, "bytes");
  download.head.set(field::etag, etag);
  if (!content_range.empty()) download.head.set(field::content_range, content_range);
  // The name as the page knows it, in the form that any character can have.
  download.head.set(field::content_disposition,
                    "attachment; filename*=UTF-8''" + PercentEncoded(file->filename().string()));
  return download;
}

}  // namespace skein::bridge
