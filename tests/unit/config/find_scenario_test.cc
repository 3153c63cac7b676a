#include "config/scenario.h"
#include "scenario_file.h"

namespace skein::config {
namespace {

TEST(FindScenario, TakesAFileAsItIs) {
  const ScenarioFile file("{}");
  EXPECT_EQ(FindScenario(file.path().string()), file.path());
}

TEST(FindScenario, FindsAShippedOneByItsBareName) {
  setenv("SKEIN_SCENARIOS", SKEIN_SOURCE_DIR "/scripts/scenarios", 1);
  const std::filesystem::path expected = SKEIN_SOURCE_DIR "/scripts/scenarios/paper-assembly.json";
  EXPECT_EQ(FindScenario("paper-assembly"), expected);
  EXPECT_EQ(FindScenario("paper-assembly.json"), expected);
}

TEST(FindScenario, NamesTheFoldersThatItSearched) {
  setenv("SKEIN_SCENARIOS", "/first/folder", 1);
  try {
    FindScenario("no-such-scenario");
    FAIL() << "must be refused";
  } catch (const ConfigError& error) {
    const std::string message = error.what();
    EXPECT_NE(
        message.find("no-such-scenario: there is no such file, nor a scenario of that name in /first/folder"),
        std::string::npos)
        << message;
  }
}

TEST(FindScenario, RefusesAPathThatLeadsNowhere) {
  EXPECT_THROW(FindScenario("nowhere/triangle.json"), ConfigError);
  EXPECT_THROW(FindScenario(""), ConfigError);
  EXPECT_THROW(FindScenario("/"), ConfigError);
}

}  // namespace
}  // namespace skein::config
