#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "bridge_under_test.h"
#include "raw_client.h"

namespace skein::bridge {
namespace {

namespace fs = std::filesystem;

class MapTilesHttpTest : public testing::Test {
 protected:
  MapTilesHttpTest() {
    fs::create_directories(folder_ / "map" / "3" / "6");
    std::ofstream(folder_ / "map" / "3" / "6" / "3.png") << "a tile";
    std::ofstream(folder_ / "outside.png") << "outside";
    std::ofstream(archive_) << "PMTiles\x03" << std::string(92, 'x');
  }
  ~MapTilesHttpTest() override { fs::remove_all(folder_); }

  static BridgeOptions With(const fs::path& path) {
    BridgeOptions options;
    options.tiles.emplace(path);
    return options;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("skein_tiles_http_" + std::to_string(getpid()));
  const fs::path archive_ = folder_ / "area.pmtiles";
};

TEST_F(MapTilesHttpTest, ServesTilesAndSaysCalmlyWhereThereIsNone) {
  const BridgeUnderTest bridge(With(folder_ / "map"));
  RawClient client(bridge.port());
  const auto tile = client.Get("/tiles/3/6/3.png");
  ASSERT_TRUE(tile);
  EXPECT_EQ(tile->status, 200);
  EXPECT_EQ(tile->body, "a tile");
  EXPECT_EQ(tile->headers.at("content-type"), "image/png");
  const std::string etag = tile->headers.at("etag");
  EXPECT_EQ(client.Get("/tiles/3/6/3.png", "If-None-Match: " + etag + "\r\n").value().status, 304);
  for (const char* target :
       {"/tiles/3/6/4.png", "/tiles/../outside.png", "/tiles/3/6/%2e%2e/%2e%2e/outside.png",
        "/tiles/3/6/../../../outside.png", "/tiles/"}) {
    const auto none = client.Get(target);
    ASSERT_TRUE(none) << target;
    EXPECT_EQ(none->status, 204) << target;
    EXPECT_EQ(none->body, "") << target;
  }
  EXPECT_EQ(client.Get("/tiles.pmtiles").value().status, 404);
}

TEST_F(MapTilesHttpTest, ServesPartsOfAnArchive) {
  const BridgeUnderTest bridge(With(archive_));
  RawClient client(bridge.port());
  const auto part = client.Get("/tiles.pmtiles", "Range: bytes=0-6\r\n");
  ASSERT_TRUE(part);
  EXPECT_EQ(part->status, 206);
  EXPECT_EQ(part->body, "PMTiles");
  EXPECT_EQ(part->headers.at("content-range"), "bytes 0-6/100");
  EXPECT_EQ(part->headers.at("content-length"), "7");
  EXPECT_EQ(part->headers.at("accept-ranges"), "bytes");
  const auto end = client.Get("/tiles.pmtiles", "Range: bytes=90-16383\r\n");
  EXPECT_EQ(end.value().headers.at("content-range"), "bytes 90-99/100");
  const auto beyond = client.Get("/tiles.pmtiles", "Range: bytes=100-\r\n");
  EXPECT_EQ(beyond.value().status, 416);
  EXPECT_EQ(beyond->headers.at("content-range"), "bytes */100");
  const auto whole = client.Get("/tiles.pmtiles");
  EXPECT_EQ(whole.value().status, 200);
  EXPECT_EQ(whole->body.size(), 100u);
  EXPECT_EQ(client.Get("/tiles/3/6/3.png").value().status, 204);
}

TEST_F(MapTilesHttpTest, SendsNoPartOfAnotherVersionThanWasAskedFor) {
  const BridgeUnderTest bridge(With(archive_));
  RawClient client(bridge.port());
  const auto known = client.Get("/tiles.pmtiles", "Range: bytes=0-6\r\n");
  const std::string condition = "If-Range: " + known.value().headers.at("etag") + "\r\nRange: bytes=0-6\r\n";
  EXPECT_EQ(client.Get("/tiles.pmtiles", condition).value().status, 206);
  std::ofstream(archive_) << "PMTiles\x03" << std::string(93, 'y');
  const auto changed = client.Get("/tiles.pmtiles", condition);
  EXPECT_EQ(changed.value().status, 200);
  EXPECT_EQ(changed->body.size(), 101u);
}

TEST_F(MapTilesHttpTest, NeverSendsMuchAtOnce) {
  fs::resize_file(archive_, 5'000'000'000);  // takes no room: it is a hole
  const BridgeUnderTest bridge(With(archive_));
  RawClient client(bridge.port());
  const auto part = client.Get("/tiles.pmtiles", "Range: bytes=0-4999999999\r\n");
  EXPECT_EQ(part.value().status, 206);
  EXPECT_EQ(part->headers.at("content-range"), "bytes 0-4194303/5000000000");
  const auto far = client.Get("/tiles.pmtiles", "Range: bytes=4999999990-\r\n");
  EXPECT_EQ(far.value().headers.at("content-range"), "bytes 4999999990-4999999999/5000000000");
  EXPECT_EQ(client.Get("/tiles.pmtiles").value().status, 400);
}

TEST_F(MapTilesHttpTest, SaysThatThereAreNone) {
  const BridgeUnderTest bridge;
  RawClient client(bridge.port());
  EXPECT_EQ(client.Get("/tiles/3/6/3.png").value().status, 404);
  EXPECT_EQ(client.Get("/tiles.pmtiles", "Range: bytes=0-6\r\n").value().status, 404);
}

}  // namespace
}  // namespace skein::bridge
