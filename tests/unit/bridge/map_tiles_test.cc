#include "bridge/map_tiles.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace skein::bridge {
namespace {

namespace fs = std::filesystem;

class MapTilesTest : public testing::Test {
 protected:
  MapTilesTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("skein_tiles_" + std::to_string(getpid()) + test->name());
    Write(map() / "3" / "6" / "3.png", "near");
    Write(map() / "12" / "3370" / "1552.png", "far");
    Write(folder_ / "outside.png", "outside");
  }
  ~MapTilesTest() override { fs::remove_all(folder_); }

  fs::path map() const { return folder_ / "map"; }
  static void Write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  std::string Content(std::string_view name) const {
    const auto tile = MapTiles(map()).Tile(name);
    return tile ? tile->content : "nothing";
  }
  static std::string Problem(const fs::path& path) {
    try {
      const MapTiles tiles(path);
      return "none";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  fs::path folder_;
};

TEST_F(MapTilesTest, GivesTheTilesOfAFolder) {
  EXPECT_EQ(Content("3/6/3.png"), "near");
  EXPECT_EQ(Content("12/3370/1552.png"), "far");
  EXPECT_EQ(Content("12/3370/1553.png"), "nothing");
  EXPECT_EQ(MapTiles(map()).Tile("3/6/3.png")->mime_type, "image/png");
}

TEST_F(MapTilesTest, DescribesAFolder) {
  Write(map() / "metadata.json", R"({"attribution": "© Survey"})");
  fs::create_directories(map() / "18");
  const Json description = MapTiles(map()).Description();
  EXPECT_EQ(description, Json({{"kind", "raster"},
                               {"url", "tiles/{z}/{x}/{y}.png"},
                               {"name", "map"},
                               {"min_zoom", 3},
                               {"max_zoom", 12},
                               {"attribution", "© Survey"}}));
  Write(map() / "metadata.json", "no JSON");
  EXPECT_EQ(MapTiles(map()).Description()["attribution"], "");
}

TEST_F(MapTilesTest, GivesNothingButTiles) {
  Write(map() / "secret.png", "secret");
  Write(map() / "3" / "6" / "x.png", "named");
  for (const char* name : {"", "/", "3/6/3", "3/6/3.jpg", "3/6/3.png.png", "secret.png", "3/6/x.png",
                           "3/6/../6/3.png", "../outside.png", "3/6/../../../outside.png",
                           "3/../../outside.png", "03/6/3.png", "+3/6/3.png", "-3/6/3.png", "3/6/3/3.png",
                           "3//3.png", "%33/6/3.png", "3/6/%2e%2e/3.png", "99999999999999999999/6/3.png"}) {
    EXPECT_EQ(Content(name), "nothing") << name;
  }
}

TEST_F(MapTilesTest, DoesNotFollowALinkOutOfItsFolder) {
  fs::create_symlink(folder_ / "outside.png", map() / "3" / "6" / "4.png");
  Write(folder_ / "other" / "1.png", "other");
  fs::create_directory_symlink(folder_ / "other", map() / "3" / "7");
  fs::create_symlink(map() / "3" / "6" / "3.png", map() / "3" / "6" / "5.png");
  EXPECT_EQ(Content("3/6/4.png"), "nothing");
  EXPECT_EQ(Content("3/7/1.png"), "nothing");
  EXPECT_EQ(Content("3/6/5.png"), "near");
}

TEST_F(MapTilesTest, ReadsPartsOfAnArchive) {
  const fs::path file = folder_ / "area.pmtiles";
  Write(file, "PMTiles\x03 and the rest");
  const MapTiles tiles(file);
  EXPECT_EQ(tiles.Description(),
            Json({{"kind", "pmtiles"}, {"url", "tiles.pmtiles"}, {"name", "area.pmtiles"}}));
  EXPECT_EQ(tiles.FindArchive().value().size, 21u);
  EXPECT_EQ(tiles.ReadArchive(9, 3), "and");
  EXPECT_EQ(tiles.ReadArchive(17, 100), "rest");
  EXPECT_EQ(tiles.ReadArchive(100, 1), "");
  EXPECT_FALSE(tiles.Tile("3/6/3.png"));
  fs::remove(file);
  EXPECT_FALSE(tiles.FindArchive());
  EXPECT_EQ(tiles.ReadArchive(0, 8), "");
}

TEST_F(MapTilesTest, SaysWhatIsWrong) {
  EXPECT_NE(Problem(folder_ / "nowhere").find("there is no such"), std::string::npos);
  EXPECT_NE(Problem(folder_ / "outside.png").find("is no PMTiles file of version 3"), std::string::npos);
  fs::create_directories(folder_ / "empty" / "3");
  EXPECT_NE(Problem(folder_ / "empty").find("holds no tiles {z}/{x}/{y}.png"), std::string::npos);
  Write(map() / "5" / "6" / "3.jpg", "another kind");
  EXPECT_NE(Problem(map()).find("one kind is needed"), std::string::npos);
}

}  // namespace
}  // namespace skein::bridge
