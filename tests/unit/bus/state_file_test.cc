#include "bus/state_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <vector>

#include "bus/channels.h"
#include "bus/saved_bytes.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"

namespace skein::bus {
namespace {

namespace fs = std::filesystem;

class StateFileTest : public testing::Test {
 protected:
  StateFileTest() {
    fs::create_directories(folder_);
    bus_.Subscribe<event_t>(channel::kEvent, [this](const event_t& event) { codes_.push_back(event.code); });
  }
  ~StateFileTest() override { fs::remove_all(folder_); }

  std::optional<std::string> Read(const std::string& kind = "kind") {
    StateFile file(file_, kind, events_);
    auto state = file.Read();
    executor_.Deliver();
    return state;
  }
  void Save(const std::string& state) { StateFile(file_, "kind", events_).Save(state); }
  std::string Bytes() const {
    std::ifstream stream(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void Put(const std::string& bytes) { std::ofstream(file_, std::ios::binary) << bytes; }

  fs::path folder_ = fs::temp_directory_path() / ("skein_state_file_" + std::to_string(getpid()));
  fs::path file_ = folder_ / "node.state";
  Transport transport_ = MakeTransport("memq://");
  SimulatedExecutor executor_{transport_.lcm};
  Bus bus_{transport_.lcm, "node", executor_};
  Events events_{bus_};
  std::vector<std::string> codes_;
};

TEST_F(StateFileTest, GivesBackWhatWasSavedLast) {
  EXPECT_FALSE(Read()) << "there is none";
  {
    StateFile file(file_, "kind", events_);
    for (int i = 0; i < 1000; ++i) file.Save("state " + std::to_string(i));
  }
  EXPECT_EQ(Read(), "state 999");
  StateFile file(file_, "kind", events_);
  file.SaveNow(std::string("\0x\n", 3));
  EXPECT_EQ(Read(), std::string("\0x\n", 3)) << "while the other still runs";
  EXPECT_TRUE(codes_.empty());
}

TEST_F(StateFileTest, SetsAsideWhatIsDamagedOrAnothers) {
  Save("a state of some length");
  const std::string good = Bytes();
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  std::vector<std::string> bad = {"", "x", good.substr(0, good.size() - 1), good + "x",
                                  std::string(100, '\0')};
  for (int i = 0; i < 50; ++i) {
    bad.push_back(good);
    bad.back()[random() % good.size()] ^= static_cast<char>(1 << random() % 8);
  }
  for (const std::string& bytes : bad) {
    Put(bytes);
    codes_.clear();
    EXPECT_FALSE(Read());
    EXPECT_EQ(codes_, std::vector<std::string>{"state_set_aside"});
    EXPECT_FALSE(fs::exists(file_));
    EXPECT_TRUE(fs::exists(file_.string() + ".damaged"));
  }
  Put(good);
  EXPECT_FALSE(Read("another kind"));
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(StateFileTest, TellsOnceThatItCannotBeWritten) {
  StateFile file("/dev/full/node.state", "kind", events_);
  for (int i = 0; i < 3; ++i) file.SaveNow("state");
  executor_.Deliver();
  EXPECT_EQ(codes_, std::vector<std::string>{"state_not_saved"});
}

TEST_F(StateFileTest, WithoutAFileKeepsNothing) {
  StateFile file("", "kind", events_);
  file.Save("state");
  file.SaveNow("state");
  EXPECT_FALSE(file.kept());
  EXPECT_FALSE(file.Read());
}

TEST(SavedBytes, AreReadInTheSameOrderAndNoFurther) {
  SavedBytes bytes;
  bytes.Add(std::int64_t{-7});
  bytes.Add(0.1);
  bytes.Add(std::string("text"));
  heartbeat_t heartbeat{};
  heartbeat.heartbeat_node = "node";
  bytes.Add(heartbeat);
  const std::string whole = bytes.Take();
  SavedReader reader(whole);
  EXPECT_EQ(reader.Number(), -7);
  EXPECT_EQ(reader.Real(), 0.1);
  EXPECT_EQ(reader.Text(), "text");
  EXPECT_EQ(reader.Take<heartbeat_t>().value().heartbeat_node, "node");
  EXPECT_FALSE(reader.Number());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    SavedReader part(std::string_view(whole).substr(0, size));
    EXPECT_FALSE(part.Number() && part.Real() && part.Text() && part.Take<heartbeat_t>()) << size;
  }
}

}  // namespace
}  // namespace skein::bus
