#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "bridge/json_messages.h"
#include "bridge/static_files.h"

namespace skein::bridge {

/// The operator's own map: a folder of raster tiles {z}/{x}/{y}.png (or .jpg, .jpeg, .webp), or one PMTiles
/// file. Only this folder or file is ever read, and nothing of it is held in memory.
class MapTiles {
 public:
  /// Throws std::runtime_error, saying what to do, when there is no map at `path`.
  explicit MapTiles(const std::filesystem::path& path);

  /// What the page is told: {kind: "raster" or "pmtiles", url, name, min_zoom, max_zoom, attribution}. A
  /// PMTiles file says the last three itself, to whoever reads it.
  Json Description() const;

  /// The tile of a folder for "12/3370/1552.png". None when the folder has no such tile, and for anything
  /// that isn't three numbers and the extension of its tiles.
  std::optional<StaticFile> Tile(std::string_view name) const;

  /// The PMTiles file as it is now; none when this is a folder, or the file is gone.
  struct Archive {
    std::uint64_t size = 0;
    std::string etag;
  };
  std::optional<Archive> FindArchive() const;
  /// `length` bytes of it; fewer when it has become shorter.
  std::string ReadArchive(std::uint64_t first, std::uint64_t length) const;

 private:
  void LookAtFolder();
  void LookAtArchive() const;

  std::filesystem::path path_;  ///< canonical
  std::string extension_;       ///< of the folder's tiles, "": this is an archive
  int min_zoom_ = 0;
  int max_zoom_ = 0;
  std::string attribution_;
};

}  // namespace skein::bridge
