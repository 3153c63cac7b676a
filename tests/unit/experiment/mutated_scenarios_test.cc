// Scenario files with something wrong in them: each is refused with file, place and reason, or flown.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "system/process.h"

namespace skein::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kFiles = 200;

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  json Mutated(json scenario) {
    const int changes = 1 + Below(2);
    for (int i = 0; i < changes; ++i) Change(scenario);
    return scenario;
  }
  int Below(int number) { return static_cast<int>(random_() % static_cast<unsigned>(number)); }

 private:
  /// Walks down to some value and changes it, or what holds it.
  void Change(json& value) {
    if (!value.is_structured() || value.empty() || Below(5) == 0) {
      value = Odd(value);
      return;
    }
    auto chosen = std::next(value.begin(), Below(static_cast<int>(value.size())));
    switch (Below(8)) {
      case 0:
        value.erase(chosen);
        break;
      case 1:
        if (value.is_object()) {
          value[chosen.key() + "x"] = *chosen;
        } else {
          value.push_back(json(*chosen));  // a copy, for it grows
        }
        break;
      default:
        Change(*chosen);
    }
  }

  json Odd(const json& value) {
    const std::vector<json> odd = {nullptr,
                                   true,
                                   "",
                                   "x",
                                   -1,
                                   0,
                                   1e308,
                                   -1e308,
                                   1e-300,
                                   4294967296.5,
                                   json::array(),
                                   json::object(),
                                   "\xc3\xbc",
                                   std::string(2000, 'a')};
    if (value.is_number() && Below(2) == 0) return value.get<double>() * (Below(2) == 0 ? -3.0 : 1000.0);
    return odd[static_cast<std::size_t>(Below(static_cast<int>(odd.size())))];
  }

  std::mt19937 random_;
};

TEST(MutatedScenarios, AreRefusedWithFilePlaceAndReasonOrFlown) {
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  Mutator mutator(seed);
  std::vector<json> shipped;
  for (const auto& entry : fs::directory_iterator(SKEIN_SOURCE_DIR "/scripts/scenarios")) {
    if (entry.path().extension() == ".json") shipped.push_back(json::parse(std::ifstream(entry.path())));
  }
  const std::string folder = testing::FreshFolder("skein-mutated");
  const std::string file = folder + "/mutated.json";
  int refused = 0;
  int flown = 0;
  for (int i = 0; i < kFiles; ++i) {
    const std::string text =
        mutator.Mutated(shipped[static_cast<std::size_t>(mutator.Below(static_cast<int>(shipped.size())))])
            .dump();
    std::ofstream(file) << text;
    const auto done = testing::RunToEnd({SKEIN_BIN_DIR "/flight-experiment", file, "--duration", "1"});
    const std::string about = "of " + text.substr(0, 3000);
    if (done.exit_code == 0) {
      ++flown;
      EXPECT_EQ(done.output.find("nan"), std::string::npos) << done.output << about;
      continue;
    }
    ++refused;
    EXPECT_EQ(done.exit_code, 2) << done.output << about;
    // "FILE: /place: reason", or of the whole "FILE: reason".
    const std::size_t at = done.output.find(file + ": ");
    ASSERT_NE(at, std::string::npos) << done.output << about;
    EXPECT_GT(done.output.size() - at, file.size() + 10) << done.output << about;
  }
  std::cout << refused << " refused, " << flown << " flown\n";
  EXPECT_GT(refused, kFiles / 4);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace skein::experiment
