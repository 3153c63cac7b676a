#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skein::bridge {

/// A file of the page, as it is sent.
struct StaticFile {
  std::string content;
  std::string_view mime_type;
  std::string_view cache_control;
  std::string etag;
};

/// The built web app in a folder. Read afresh each time, so that a new build shows without a restart.
class StaticFiles {
 public:
  explicit StaticFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The file for a request target ("/assets/app-1a2b.js?x"). Paths without an extension belong to the app
  /// itself and give index.html; when that has not been built, a page that says how to. Nothing outside of
  /// the folder is ever given, whatever "..", escapes and symbolic links a path holds; nor are files whose
  /// name begins with a dot.
  std::optional<StaticFile> Find(std::string_view target) const;

 private:
  std::filesystem::path folder_;
};

/// A file under a folder (both as they are on disk); none when it is missing, too large to be sent whole, or
/// a symbolic link leads out of the folder.
std::optional<StaticFile> ReadInside(const std::filesystem::path& folder, const std::filesystem::path& name,
                                     std::string_view cache_control);

/// Changes whenever the file does.
std::string EntityTag(const std::filesystem::path& file, std::uintmax_t size);

/// Where the built web app is: beside the build tree (build/bin/../../web/dist) or installed
/// (bin/../share/skein/web).
std::filesystem::path DefaultWebFolder(const std::filesystem::path& executable);

}  // namespace skein::bridge
