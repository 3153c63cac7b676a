#include "bridge/static_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace skein::bridge {
namespace {

namespace fs = std::filesystem;

class StaticFilesTest : public testing::Test {
 protected:
  StaticFilesTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("skein_" + std::to_string(getpid()) + test->name());
    fs::create_directories(web() / "assets");
    Write(web() / "index.html", "the page");
    Write(web() / "assets" / "app-1a2b.js", "the app");
    Write(web() / ".secret", "hidden");
    Write(folder_ / "outside.txt", "outside");
  }
  ~StaticFilesTest() override { fs::remove_all(folder_); }

  fs::path web() const { return folder_ / "web"; }
  static void Write(const fs::path& file, const char* text) { std::ofstream(file) << text; }

  std::string Content(std::string_view target) const {
    const auto file = StaticFiles(web()).Find(target);
    return file ? file->content : "nothing";
  }

  fs::path folder_;
};

TEST_F(StaticFilesTest, GivesFilesWithTypeAndHowLongTheyKeep) {
  const auto page = StaticFiles(web()).Find("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->content, "the page");
  EXPECT_EQ(page->mime_type, "text/html; charset=utf-8");
  EXPECT_EQ(page->cache_control, "no-cache");
  const auto app = StaticFiles(web()).Find("/assets/app-1a2b.js?x=1");
  ASSERT_TRUE(app);
  EXPECT_EQ(app->content, "the app");
  EXPECT_EQ(app->mime_type, "text/javascript; charset=utf-8");
  EXPECT_EQ(app->cache_control, "public, max-age=31536000, immutable");
  EXPECT_NE(app->etag, page->etag);
}

TEST_F(StaticFilesTest, GivesThePageForPathsOfTheAppButNotForFilesThatAreMissing) {
  EXPECT_EQ(Content("/plan/3"), "the page");
  EXPECT_EQ(Content("/assets/app-0000.js"), "nothing");
  EXPECT_EQ(Content("/missing.png"), "nothing");
}

TEST_F(StaticFilesTest, NeverLeavesItsFolder) {
  for (const char* target : {"/../outside.txt",
                             "/assets/../../outside.txt",
                             "/%2e%2e/outside.txt",
                             "/..%2foutside.txt",
                             "/%2E%2E%2Foutside.txt",
                             "//../outside.txt",
                             "/..\\outside.txt",
                             "/assets/..%5c..%5coutside.txt",
                             "../outside.txt",
                             "outside.txt",
                             "/%00/../outside.txt",
                             "/index.html%00.txt",
                             "/.secret",
                             "/%2esecret",
                             "/%2",
                             "/%",
                             "/%zz.txt",
                             "",
                             "*",
                             "/%252e%252e/outside.txt",
                             "/..%252foutside.txt",
                             "/%252e%252e%252foutside.txt"}) {
    EXPECT_EQ(Content(target), "nothing") << target;
  }
  EXPECT_EQ(Content((folder_ / "outside.txt").string()), "nothing");
  EXPECT_EQ(Content("/" + (folder_ / "outside.txt").string()), "nothing");
}

TEST_F(StaticFilesTest, DoesNotFollowALinkOutOfItsFolder) {
  fs::create_symlink(folder_ / "outside.txt", web() / "link.txt");
  fs::create_directory_symlink(folder_, web() / "up");
  fs::create_symlink(web() / "index.html", web() / "inside.html");
  EXPECT_EQ(Content("/link.txt"), "nothing");
  EXPECT_EQ(Content("/up/outside.txt"), "nothing");
  EXPECT_EQ(Content("/inside.html"), "the page");
}

TEST_F(StaticFilesTest, ANeighbourFolderWithTheSameBeginningIsOutside) {
  fs::create_directories(folder_ / "web2");
  Write(folder_ / "web2" / "index.txt", "neighbour");
  fs::create_symlink(folder_ / "web2" / "index.txt", web() / "neighbour.txt");
  EXPECT_EQ(Content("/neighbour.txt"), "nothing");
}

TEST_F(StaticFilesTest, SaysHowToBuildThePageWhenThereIsNone) {
  fs::remove(web() / "index.html");
  EXPECT_NE(Content("/").find("npm run build"), std::string::npos);
  EXPECT_NE(StaticFiles(folder_ / "nowhere").Find("/")->content.find("npm run build"), std::string::npos);
  Write(web() / "index.html", "built now");
  EXPECT_EQ(Content("/"), "built now");
}

TEST_F(StaticFilesTest, FindsThePageBesideTheBuildTreeOrInstalled) {
  const fs::path executable = folder_ / "build" / "bin" / "web-bridge";
  const fs::path built = folder_ / "web" / "dist";
  const fs::path installed = folder_ / "build" / "share" / "skein" / "web";
  fs::create_directories(executable.parent_path());
  EXPECT_EQ(fs::weakly_canonical(DefaultWebFolder(executable)), built);
  fs::create_directories(installed);
  Write(installed / "index.html", "installed");
  EXPECT_EQ(fs::weakly_canonical(DefaultWebFolder(executable)), installed);
  fs::create_directories(built);
  Write(built / "index.html", "built");
  EXPECT_EQ(fs::weakly_canonical(DefaultWebFolder(executable)), built);
}

}  // namespace
}  // namespace skein::bridge
