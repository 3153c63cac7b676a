#include "cli/drop_plan.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

#include "config/scenario.h"

namespace skein::cli {
namespace {

class DropFile {
 public:
  DropFile(const std::string& name, const std::string& text)
      : path_(testing::TempDir() + "/skein-drops-" + name) {
    std::ofstream(path_) << text;
  }
  ~DropFile() { std::filesystem::remove(path_); }
  DropFile(const DropFile&) = delete;
  DropFile& operator=(const DropFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string Refusal(const std::string& name, const std::string& text) {
  const DropFile file(name, text);
  try {
    ReadDrops(file.path());
  } catch (const config::ConfigError& error) {
    const std::string message = error.what();
    return message.substr(message.find(name));
  }
  return "";
}

void ExpectTheThree(const std::vector<Drop>& drops) {
  ASSERT_EQ(drops.size(), 3u);
  EXPECT_EQ(drops[0].vehicle, "UAV2");
  EXPECT_EQ(drops[0].at_s, 5.5);
  EXPECT_EQ(Direction(drops[0]), "up");
  EXPECT_TRUE(drops[0].is_cut());
  EXPECT_EQ(drops[1].vehicle, "3");
  EXPECT_EQ(drops[1].for_s, 10);
  EXPECT_EQ(Direction(drops[1]), "both");
  EXPECT_EQ(drops[1].loss, 0.3);
  EXPECT_EQ(drops[2].delay_s, 2);
  EXPECT_FALSE(drops[2].is_cut()) << "late, not lost";
}

TEST(DropList, IsReadFromCsvInOrderOfTime) {
  const DropFile file(
      "a.csv",
      "uav, at_s, direction, for_s, loss, delay_s\r\n# a remark\n3,20,,10,0.3,\n\nUAV2,5.5,up,7\n"
      "all,30,down,10,,2\n");
  ExpectTheThree(ReadDrops(file.path()));
}

TEST(DropList, IsReadFromJson) {
  const DropFile file(
      "a.json",
      R"([{"at_s": 20, "uav": 3, "for_s": 10, "loss": 0.3}, {"at_s": 5.5, "uav": "UAV2", "direction": "up",
      "for_s": 7}, {"at_s": 30, "uav": "all", "direction": "down", "for_s": 10, "delay_s": 2}])");
  ExpectTheThree(ReadDrops(file.path()));
}

TEST(DropList, MayHaveEmptyLinesOfAnySystem) {
  const DropFile file("c.csv", "at_s,uav,for_s\r\n1,2,3\r\n\r\n,,\r\n \t\r\n4,5,6\r\n\r\n");
  const auto drops = ReadDrops(file.path());
  ASSERT_EQ(drops.size(), 2u);
  EXPECT_EQ(drops[1].for_s, 6);
}

TEST(DropList, IsRefusedWithThePlaceOfWhatIsWrong) {
  EXPECT_EQ(Refusal("b.csv", "at_s,uav,for_s\n1,2,3\n4,5,soon\n"),
            "b.csv line 3: /for_s: must be a number, is a text");
  EXPECT_EQ(Refusal("b.csv", "at_s,uav\n1,2\n"), "b.csv line 2: the key \"for_s\" is missing");
  EXPECT_EQ(Refusal("b.csv", "at_s,uav,for_s\n1,2,3,4\n"), "b.csv line 2: has more cells than the heading");
  EXPECT_EQ(Refusal("b.csv", "at_s,uav,for_s,directoin\n1,2,3,up\n"),
            "b.csv line 2: /directoin: unknown key; did you mean \"direction\"?");
  EXPECT_EQ(Refusal("b.csv", "at_s,uav,for_s\n"), "b.csv: lists no drops");
  EXPECT_EQ(Refusal("b.csv", ""), "b.csv: is empty");
  EXPECT_EQ(Refusal("b.csv", std::string("at_s\0uav", 8)), "b.csv: is no text file");
  EXPECT_THROW(ReadDrops("/there/is/none.csv"), config::ConfigError);
  EXPECT_EQ(Refusal("b.json", R"([{"at_s": 1, "uav": 2, "for_s": 3, "loss": 2}])"),
            "b.json: /0/loss: must be 0 .. 1, is 2");
  EXPECT_THROW(ReadDrops("/"), config::ConfigError);
}

TEST(RandomPlan, IsTheSameForOneSeedAndNeverDropsALinkTwiceAtOnce) {
  RandomDrops options{.seed = 7, .per_minute = 30, .shortest_s = 6, .longest_s = 20};
  RandomPlan plan(options, {1, 2, 3, 4, 5});
  RandomPlan same(options, {1, 2, 3, 4, 5});
  options.seed = 8;
  RandomPlan other(options, {1, 2, 3, 4, 5});
  std::map<std::string, double> free_at_s;
  std::set<std::string> directions;
  double last_s = 0;
  bool differs = false;
  for (int i = 0; i < 500; ++i) {
    const Drop drop = plan.Next();
    const Drop again = same.Next();
    EXPECT_EQ(drop.at_s, again.at_s);
    EXPECT_EQ(drop.vehicle, again.vehicle);
    differs = differs || other.Next().vehicle != drop.vehicle;
    EXPECT_GE(drop.at_s, last_s);
    EXPECT_GE(drop.at_s, free_at_s[drop.vehicle]) << "UAV " << drop.vehicle << ", drop " << i;
    EXPECT_GE(drop.for_s, 6);
    EXPECT_LE(drop.for_s, 20);
    free_at_s[drop.vehicle] = drop.at_s + drop.for_s + RandomPlan::kRestS;
    directions.insert(Direction(drop));
    last_s = drop.at_s;
  }
  EXPECT_TRUE(differs);
  EXPECT_EQ(free_at_s.size(), 5u);
  EXPECT_EQ(directions, (std::set<std::string>{"both", "down", "up"}));
}

TEST(RandomPlan, KeepsItsRate) {
  RandomPlan plan({.seed = 3, .per_minute = 6, .shortest_s = 1, .longest_s = 2},
                  {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  double last_s = 0;
  for (int i = 0; i < 1000; ++i) last_s = plan.Next().at_s;
  EXPECT_NEAR(last_s, 10000, 1000);
}

}  // namespace
}  // namespace skein::cli
