#include "recording/log_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <skein/event_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/heartbeat_t.hpp>
#include <string>
#include <vector>

#include "log_maker.h"
#include "recording/index_file.h"
#include "recording/log_clock.h"

namespace skein::recording {
namespace {

namespace fs = std::filesystem;

constexpr bus::Utime kStart = 1'577'836'800'000'000;

template <typename Message>
std::string Encoded(const Message& message) {
  std::string bytes(static_cast<std::size_t>(message.getEncodedSize()), '\0');
  message.encode(bytes.data(), 0, message.getEncodedSize());
  return bytes;
}

std::string Heartbeat(double t_s, const std::string& node) {
  heartbeat_t heartbeat{};
  heartbeat.utime = kStart + bus::ToUtime(t_s);
  heartbeat.heartbeat_node = node;
  heartbeat.version = "1";
  return EventBytes(0, heartbeat.utime, "HEARTBEAT", Encoded(heartbeat));
}

std::string Told(double t_s, const std::string& code, std::int8_t severity = event_t::INFO) {
  event_t event{};
  event.utime = kStart + bus::ToUtime(t_s);
  event.event_node = "somebody";
  event.event_sequence = 1;
  event.severity = severity;
  event.code = code;
  event.text = "text of " + code;
  return EventBytes(0, event.utime, "EVENT", Encoded(event));
}

LogIndex Index(const fs::path& path) {
  const LogFile log(path);
  return IndexLog(log, [](double) { return true; }).value();
}

const ChannelCount& Channel(const LogIndex& index, const std::string& name) {
  return *std::ranges::find(index.channels, name, &ChannelCount::name);
}

TEST(LogIndex, CountsOursOthersAndWhatCannotBeDecoded) {
  const LogBytes log(Heartbeat(0, "a") + EventBytes(0, kStart + 1, "STRANGER", "hello") +
                     EventBytes(0, kStart + 2, "EVENT", "no event") + Told(1, "marker"));
  const LogIndex index = Index(log.path());
  EXPECT_EQ(index.events, 4);
  EXPECT_EQ(index.last - index.first, bus::kSecond);
  EXPECT_TRUE(Channel(index, "EVENT").known);
  EXPECT_EQ(Channel(index, "EVENT").count, 2);
  EXPECT_EQ(Channel(index, "EVENT").undecodable, 1);
  EXPECT_FALSE(Channel(index, "STRANGER").known);
  EXPECT_EQ(Channel(index, "STRANGER").bytes, 5);
  EXPECT_EQ(Channel(index, "STRANGER").undecodable, 0);
  ASSERT_EQ(index.told.size(), 1U);
  EXPECT_EQ(index.told[0].code, kMarkerCode);
}

TEST(LogIndex, HoldsWhatWasSaidLastBeforeAPauseAndAtTheEnd) {
  std::string bytes;
  for (const double t_s : {0., 1., 2., 8., 9.}) bytes += Heartbeat(t_s, "a");
  const LogIndex index = Index(LogBytes(bytes).path());
  ASSERT_EQ(index.streams, std::vector<std::string>{"HEARTBEAT/a"});
  ASSERT_EQ(index.held.size(), 2U);
  EXPECT_EQ(index.held[0].utime, kStart + 2 * bus::kSecond);
  EXPECT_EQ(index.held[1].utime, kStart + 9 * bus::kSecond);
}

TEST(LogIndex, TellsDamageWithItsTime) {
  const LogBytes log(Told(0, "one") + Told(5, "two") + std::string(100, 'x') + Told(9, "three") +
                     Told(10, "four").substr(0, 50));
  const LogIndex index = Index(log.path());
  EXPECT_EQ(index.told.size(), 3U);
  ASSERT_EQ(index.damage.size(), 2U);
  EXPECT_EQ(index.damage[0].bytes, 100U);
  EXPECT_EQ(index.damage[0].utime, kStart + 5 * bus::kSecond);
  EXPECT_EQ(index.damage[1].bytes, 50U);
  EXPECT_EQ(index.damage[1].utime, kStart + 9 * bus::kSecond);
  EXPECT_EQ(index.damaged_bytes, 150U);
}

TEST(LogIndex, GoesOnWhereTheClockWasSetBack) {
  const LogBytes log(Told(100, "one") + Told(101, "two") + Told(-3600, "three") + Told(-3598, "four"));
  const LogIndex index = Index(log.path());
  std::vector<double> times;
  for (const ToldEvent& event : index.told) times.push_back(bus::ToSeconds(event.utime - index.first));
  EXPECT_EQ(times, (std::vector<double>{0, 1, 1, 3}));
  ASSERT_EQ(index.damage.size(), 1U);
  EXPECT_EQ(index.damage[0].reason, "the clock leaps here");
}

TEST(LogIndex, IsNotLedAstrayByOneStampThatIsNonsense) {
  const LogBytes log(Told(0, "one") + EventBytes(0, INT64_MAX, "X", "") + EventBytes(0, INT64_MIN, "X", "") +
                     Told(2, "two"));
  const LogIndex index = Index(log.path());
  EXPECT_LT(index.last - index.first, 10 * bus::kSecond);
  EXPECT_EQ(index.told.size(), 2U);
}

TEST(LogIndex, StopsWhenItIsToldTo) {
  const LogFile log(LogBytes(Told(0, "one")).path());
  EXPECT_FALSE(IndexLog(log, [](double) { return false; }));
}

TEST(LogIndex, CutsLongTextsBetweenCharacters) {
  const LogIndex index = Index(
      LogBytes(Told(0, std::string(400, 'x') + "\u00e4\u00e4\u00e4" + std::string(95, 'y') + "\u00e4\u00e4"))
          .path());
  ASSERT_EQ(index.told.size(), 1U);
  EXPECT_LE(index.told[0].code.size(), 500U);
  EXPECT_NE(static_cast<unsigned char>(index.told[0].code.back()) & 0xC0, 0xC0);
}

class IndexFile : public testing::Test {
 protected:
  ~IndexFile() override { fs::remove(IndexFileOf(log_.path())); }
  const LogBytes log_{Heartbeat(0, "a") + Told(1, "one", event_t::WARNING) + Told(2, "marker")};
};

TEST_F(IndexFile, GivesBackWhatWasSaved) {
  const LogIndex index = Index(log_.path());
  ASSERT_EQ(SaveIndex(log_.path(), index), "");
  const auto loaded = LoadIndex(log_.path());
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->bytes, index.bytes);
  EXPECT_EQ(loaded->events, 3);
  EXPECT_EQ(loaded->last, index.last);
  ASSERT_EQ(loaded->told.size(), 2U);
  EXPECT_EQ(loaded->told[0].text, "text of one");
  EXPECT_EQ(loaded->told[0].severity, event_t::WARNING);
  EXPECT_EQ(loaded->streams, index.streams);
  EXPECT_EQ(loaded->held.size(), index.held.size());
  EXPECT_EQ(loaded->points.size(), index.points.size());
  EXPECT_EQ(Channel(*loaded, "EVENT").count, 2);
}

TEST_F(IndexFile, IsOfNoUseWhenTheLogHasChanged) {
  ASSERT_EQ(SaveIndex(log_.path(), Index(log_.path())), "");
  std::ofstream(log_.path(), std::ios::app) << Told(3, "more");
  EXPECT_FALSE(LoadIndex(log_.path()));
}

TEST_F(IndexFile, IsOfNoUseWhenItIsDamagedAnywhere) {
  ASSERT_EQ(SaveIndex(log_.path(), Index(log_.path())), "");
  std::ifstream stream(IndexFileOf(log_.path()), std::ios::binary);
  const std::string good(std::istreambuf_iterator<char>(stream), {});
  const auto write = [&](const std::string& bytes) {
    std::ofstream(IndexFileOf(log_.path()), std::ios::binary) << bytes;
  };
  for (std::size_t size = 0; size < good.size(); ++size) {
    write(good.substr(0, size));
    EXPECT_FALSE(LoadIndex(log_.path())) << "cut to " << size;
  }
  // Whatever byte is wrong, it is refused, or gives an index that does no harm: never a crash.
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(~bad[at]);
    write(bad);
    LoadIndex(log_.path());
  }
}

TEST_F(IndexFile, IsNotReadWholeBeforeItIsKnownToBeOurs) {
  ASSERT_EQ(SaveIndex(log_.path(), Index(log_.path())), "");
  // A hole of 100 GB behind it, then nothing but the hole.
  fs::resize_file(IndexFileOf(log_.path()), 100'000'000'000);
  EXPECT_FALSE(LoadIndex(log_.path()));
  fs::resize_file(IndexFileOf(log_.path()), 0);
  fs::resize_file(IndexFileOf(log_.path()), 100'000'000'000);
  EXPECT_FALSE(LoadIndex(log_.path()));
}

TEST_F(IndexFile, IsNotKeptInAFolderThatCannotBeWritten) {
  const LogIndex index = Index(log_.path());
  EXPECT_NE(SaveIndex("/proc/self/status", index), "");
}

}  // namespace
}  // namespace skein::recording
