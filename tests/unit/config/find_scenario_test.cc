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

TEST(FindNamedScenario, TakesABareNameAndNeverAPath) {
  setenv("SKEIN_SCENARIOS", SKEIN_SOURCE_DIR "/scripts/scenarios", 1);
  EXPECT_EQ(FindNamedScenario("triangle"), SKEIN_SOURCE_DIR "/scripts/scenarios/triangle.json");
  for (const char* name :
       {"", ".", "..", "../scenarios/triangle", "/etc/passwd", "triangle.json/", "tri angle"}) {
    EXPECT_THROW(FindNamedScenario(name), ConfigError) << name;
  }
  EXPECT_THROW(FindNamedScenario("no-such"), ConfigError);
}

TEST(FindNamedScenario, LooksBesideTheOwnFileFirst) {
  const ScenarioFile own("{}");
  EXPECT_EQ(FindNamedScenario(own.path().stem(), own.path()), own.path());
}

TEST(ReadScenarioOfFleet, FindsItByTheNameInTheFile) {
  setenv("SKEIN_SCENARIOS", SKEIN_SOURCE_DIR "/scripts/scenarios", 1);
  const std::filesystem::path own = SKEIN_SOURCE_DIR "/scripts/scenarios/turn.json";
  EXPECT_EQ(ReadScenarioOfFleet("Turn of 180 degrees", own)->vehicles.size(),
            LoadScenario(own).vehicles.size());
  EXPECT_EQ(ReadScenarioOfFleet("Two formations that meet", own)->file.stem(), "crossing");
  EXPECT_FALSE(ReadScenarioOfFleet("A fleet of somebody else", own));
}

TEST(BareNameOf, FindsTheFileOfATitle) {
  setenv("SKEIN_SCENARIOS", SKEIN_SOURCE_DIR "/scripts/scenarios", 1);
  EXPECT_EQ(BareNameOf("Triangle on a closed path"), "triangle");
  EXPECT_EQ(BareNameOf("triangle"), std::nullopt);
  EXPECT_EQ(BareNameOf(""), std::nullopt);
}

TEST(ListScenarios, DescribesThoseThatShip) {
  setenv("SKEIN_SCENARIOS", SKEIN_SOURCE_DIR "/scripts/scenarios", 1);
  bool hundred = false;
  for (const ScenarioEntry& entry : ListScenarios()) {
    EXPECT_EQ(entry.problem, "") << entry.bare_name;
    EXPECT_FALSE(entry.description.empty()) << entry.bare_name;
    hundred = hundred || (entry.bare_name == "hundred" && entry.vehicles == 100);
  }
  EXPECT_TRUE(hundred);
}

}  // namespace
}  // namespace skein::config
