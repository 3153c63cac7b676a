#include "bridge/map_tiles.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace skein::bridge {
namespace {

namespace fs = std::filesystem;

// Tile numbers fit 32 bits far beyond what anybody draws.
constexpr int kMaxZoom = 24;
constexpr std::array<std::string_view, 4> kExtensions{".png", ".jpg", ".jpeg", ".webp"};
// What converters leave beside the tiles is a few kB.
constexpr std::uintmax_t kMaxMetadataBytes = 1u << 20;

[[noreturn]] void Refuse(const fs::path& path, const std::string& why) {
  throw std::runtime_error("--tiles " + path.string() + ": " + why);
}

/// A number as tiles are named: digits without zeros before it.
std::optional<int> TileNumber(std::string_view text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  const bool plain = parsed.ec == std::errc() && parsed.ptr == end && value >= 0;
  return plain && std::to_string(value) == text ? std::optional(value) : std::nullopt;
}

bool IsTile(const fs::path& file) {
  return TileNumber(file.stem().string()) &&
         std::ranges::find(kExtensions, file.extension().string()) != kExtensions.end();
}

/// The extension of the first tile of a zoom level; "" when there is none.
std::string ExtensionOf(const fs::path& level) {
  std::error_code error;
  for (const auto& column : fs::directory_iterator(level, error)) {
    if (!TileNumber(column.path().filename().string()) || !column.is_directory(error)) continue;
    for (const auto& tile : fs::directory_iterator(column, error)) {
      if (IsTile(tile.path())) return tile.path().extension().string();
    }
  }
  return "";
}

/// Who made the tiles, from the metadata.json that mb-util and tippecanoe write beside them; "" when none.
std::string Attribution(const fs::path& folder) {
  const fs::path file = folder / "metadata.json";
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > kMaxMetadataBytes) return "";
  std::ifstream stream(file);
  const Json metadata = Json::parse(stream, nullptr, false);
  const auto known = metadata.is_object() ? metadata.find("attribution") : metadata.end();
  return known != metadata.end() && known->is_string() ? known->get<std::string>() : "";
}

}  // namespace

MapTiles::MapTiles(const fs::path& path) {
  std::error_code error;
  path_ = fs::canonical(path, error);
  if (error) Refuse(path, "there is no such folder or file");
  if (fs::is_directory(path_, error)) {
    LookAtFolder();
  } else {
    LookAtArchive();
  }
}

void MapTiles::LookAtFolder() {
  min_zoom_ = std::numeric_limits<int>::max();
  std::error_code error;
  for (const auto& level : fs::directory_iterator(path_, error)) {
    const auto zoom = TileNumber(level.path().filename().string());
    if (!zoom || *zoom > kMaxZoom || !level.is_directory(error)) continue;
    const std::string extension = ExtensionOf(level.path());
    if (extension.empty()) continue;
    if (!extension_.empty() && extension != extension_)
      Refuse(path_, "holds " + extension_ + " and " + extension + " tiles: one kind is needed");
    extension_ = extension;
    min_zoom_ = std::min(min_zoom_, *zoom);
    max_zoom_ = std::max(max_zoom_, *zoom);
  }
  if (extension_.empty())
    Refuse(path_, "holds no tiles {z}/{x}/{y}.png (or .jpg, .jpeg, .webp); a PMTiles file is named itself");
  attribution_ = Attribution(path_);
}

void MapTiles::LookAtArchive() const {
  // The PMTiles specification, version 3: magic number and version come first.
  if (ReadArchive(0, 8) != "PMTiles\x03") Refuse(path_, "is no PMTiles file of version 3");
}

Json MapTiles::Description() const {
  const std::string name = path_.filename().string();
  if (extension_.empty()) return {{"kind", "pmtiles"}, {"url", "tiles.pmtiles"}, {"name", name}};
  return {{"kind", "raster"},      {"url", "tiles/{z}/{x}/{y}" + extension_},
          {"name", name},          {"min_zoom", min_zoom_},
          {"max_zoom", max_zoom_}, {"attribution", attribution_}};
}

std::optional<StaticFile> MapTiles::Tile(std::string_view name) const {
  if (extension_.empty() || !name.ends_with(extension_)) return std::nullopt;
  std::string_view rest = name.substr(0, name.size() - extension_.size());
  // Three plain numbers: no name made of them can lead out of the folder.
  for (int part = 0; part < 3; ++part) {
    const auto slash = part < 2 ? rest.find('/') : rest.size();
    if (slash == std::string_view::npos || !TileNumber(rest.substr(0, slash))) return std::nullopt;
    rest.remove_prefix(std::min(slash + 1, rest.size()));
  }
  return ReadInside(path_, fs::path(name), "max-age=60");
}

std::optional<MapTiles::Archive> MapTiles::FindArchive() const {
  std::error_code error;
  if (!extension_.empty() || !fs::is_regular_file(path_, error)) return std::nullopt;
  const std::uintmax_t size = fs::file_size(path_, error);
  if (error) return std::nullopt;
  return Archive{size, EntityTag(path_, size)};
}

std::string MapTiles::ReadArchive(std::uint64_t first, std::uint64_t length) const {
  std::error_code error;
  std::ifstream stream;
  // Opening a pipe would wait for whoever writes to it.
  if (fs::is_regular_file(path_, error)) stream.open(path_, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(first));
  std::string bytes(length, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(length));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

}  // namespace skein::bridge
