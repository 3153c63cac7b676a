#include "bridge/static_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>

namespace skein::bridge {
namespace {

namespace fs = std::filesystem;

// The largest file of the page is the base map, some MB.
constexpr std::uintmax_t kMaxBytes = 64u << 20;

constexpr std::string_view kNotBuiltPage = R"(<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Skein</title>
<body><h1>Skein: the web app is not built</h1>
<p>web-bridge runs, but there is no page to serve. Build it in the project's folder with</p>
<pre>scripts/setup
cd web &amp;&amp; npm ci &amp;&amp; npm run build</pre>
<p>and load this page again, or name the folder of a built one with <code>web-bridge --web DIR</code>.
The state of the fleet is at <a href="/api/state">/api/state</a>.</p></body></html>
)";

constexpr std::array<std::pair<std::string_view, std::string_view>, 17> kMimeTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".geojson", "application/geo+json"},
    {".webmanifest", "application/manifest+json"},
    {".map", "application/json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".jpeg", "image/jpeg"},
    {".webp", "image/webp"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
}};

std::string_view MimeType(const fs::path& file) {
  const std::string extension = file.extension().string();
  const auto* entry = std::ranges::find(kMimeTypes, extension, [](const auto& pair) { return pair.first; });
  return entry == kMimeTypes.end() ? "application/octet-stream" : entry->second;
}

/// The path of a target with its %XX put right; none when it is malformed or could leave the folder.
std::optional<std::string> DecodedPath(std::string_view target) {
  target = target.substr(0, target.find_first_of("?#"));
  std::string path;
  for (std::size_t i = 0; i < target.size(); ++i) {
    char c = target[i];
    if (c == '%') {
      unsigned value = 0;
      const char* end = target.data() + std::min(i + 3, target.size());
      const auto parsed = std::from_chars(target.data() + i + 1, end, value, 16);
      if (i + 3 > target.size() || parsed.ptr != end) return std::nullopt;
      c = static_cast<char>(value);
      i += 2;
    }
    // No name of ours holds these; ".." and hidden files begin with a dot.
    if (static_cast<unsigned char>(c) < 0x20 || c == '\\' || (c == '.' && path.ends_with('/')))
      return std::nullopt;
    path += c;
  }
  if (!path.starts_with('/')) return std::nullopt;
  return path.substr(1);
}

}  // namespace

std::string EntityTag(const fs::path& file, std::uintmax_t size) {
  std::error_code error;
  const auto changed = fs::last_write_time(file, error).time_since_epoch().count();
  return "\"" + std::to_string(size) + "-" + std::to_string(changed) + "\"";
}

std::optional<StaticFile> ReadInside(const fs::path& folder, const fs::path& name,
                                     std::string_view cache_control) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  const fs::path file = error ? fs::path() : fs::canonical(root / name, error);
  if (error || !fs::is_regular_file(file, error)) return std::nullopt;
  // A symbolic link may have led out of the folder.
  if (std::ranges::mismatch(root, file).in1 != root.end()) return std::nullopt;
  const std::uintmax_t size = fs::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || size > kMaxBytes || !stream) return std::nullopt;
  std::string content(size, '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  content.resize(static_cast<std::size_t>(stream.gcount()));
  return StaticFile{std::move(content), MimeType(file), cache_control, EntityTag(file, size)};
}

std::optional<StaticFile> StaticFiles::Find(std::string_view target) const {
  auto path = DecodedPath(target);
  if (!path) return std::nullopt;
  if (!fs::path(*path).has_extension()) path = "index.html";
  // The build gives files in assets/ a name with a hash of what they hold.
  const bool hashed = path->starts_with("assets/");
  auto file = ReadInside(folder_, *path, hashed ? "public, max-age=31536000, immutable" : "no-cache");
  std::error_code error;
  if (!file && *path == "index.html" && !fs::exists(folder_ / *path, error))
    return StaticFile{std::string(kNotBuiltPage), "text/html; charset=utf-8", "no-store", "\"not-built\""};
  return file;
}

std::filesystem::path DefaultWebFolder(const std::filesystem::path& executable) {
  const fs::path folder = executable.parent_path();
  const fs::path built = folder / ".." / ".." / "web" / "dist";
  const fs::path installed = folder / ".." / "share" / "skein" / "web";
  std::error_code error;
  return fs::exists(installed / "index.html", error) && !fs::exists(built / "index.html", error) ? installed
                                                                                                 : built;
}

}  // namespace skein::bridge
