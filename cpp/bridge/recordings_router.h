#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bridge/http_types.h"
#include "bridge/recordings.h"

namespace skein::bridge {

/// The part of HttpRouter that is about recordings.
class RecordingsRouter {
 public:
  /// Makes an answer with all headers that every answer has.
  using Make =
      std::function<HttpResponse(boost::beast::http::status, std::string_view mime_type, std::string)>;
  /// Why who sends this may not operate, "" when he may.
  using WhyNot = std::function<std::string(const HttpHead&)>;
  using Tell = std::function<void(std::string code, std::string text)>;

  /// @param recordings null: there are none.
  RecordingsRouter(std::shared_ptr<const Recordings> recordings, Make make, WhyNot why_not, Tell tell)
      : recordings_(std::move(recordings)),
        make_(std::move(make)),
        why_not_(std::move(why_not)),
        tell_(std::move(tell)) {}

  /// Whether a request is about recordings, and so for Answer() or FindFile().
  bool Concerns(std::string_view target) const;
  /// Whether it is about what can be deleted.
  bool Deletes(std::string_view target) const;
  HttpResponse Answer(const HttpRequest& request) const;

  /// The recording that a WebSocket wants to see, "": the live flight.
  std::string Watched(std::string_view target) const;

  bool Has(const std::string& name) const { return recordings_ && recordings_->has(name); }

  /// A file to be sent in pieces.
  struct Download {
    HttpResponse head;  ///< with all headers, and no body
    std::filesystem::path file;
    std::uint64_t first = 0;
    std::uint64_t length = 0;
  };
  /// None when it is no request for one that is there.
  std::optional<Download> FindFile(const HttpRequest& request) const;

 private:
  HttpResponse Reply(const Recordings::Reply& reply) const;
  HttpResponse Sentence(boost::beast::http::status status, std::string text) const;
  HttpResponse History(std::string_view query) const;
  HttpResponse Delete(const HttpRequest& request, const std::string& name) const;

  std::shared_ptr<const Recordings> recordings_;
  Make make_;
  WhyNot why_not_;
  Tell tell_;
};

}  // namespace skein::bridge
