#include "recording/log_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstring>
#include <lcm/lcm-cpp.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "unit/recording/log_maker.h"

namespace skein::recording {
namespace {

struct Item {
  std::uint64_t offset;
  std::int64_t number;
  std::int64_t utime;
  std::string channel;
  std::string data;

  bool operator==(const Item&) const = default;
};

Item ItemOf(const LogEvent& event) {
  return {event.offset, event.number, event.utime, std::string(event.channel),
          std::string(reinterpret_cast<const char*>(event.data.data()), event.data.size())};
}

std::vector<Item> ReadAll(LogReader& reader) {
  std::vector<Item> items;
  while (const auto event = reader.Next()) items.push_back(ItemOf(*event));
  return items;
}

std::vector<Item> ReadAll(const std::filesystem::path& path) {
  const LogFile log(path);
  LogReader reader(log);
  return ReadAll(reader);
}

/// Events of many sizes; the i-th is numbered i.
std::vector<Item> SomeItems(int count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<Item> items;
  std::uint64_t offset = 0;
  for (int i = 0; i < count; ++i) {
    std::string data(random() % 3000, '\0');
    for (char& c : data) c = static_cast<char>(random());
    Item item{offset, i, 1'700'000'000'000'000 + i * 50'000, "CHANNEL_" + std::to_string(i % 7), data};
    offset += EventBytes(i, 0, item.channel, data).size();
    items.push_back(item);
  }
  return items;
}

std::string BytesOf(const std::vector<Item>& items) {
  std::string bytes;
  for (const Item& item : items) bytes += EventBytes(item.number, item.utime, item.channel, item.data);
  return bytes;
}

std::string ErrorOf(const std::filesystem::path& path) {
  try {
    const LogFile log(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(LogFile, ReadsWhatLcmWrites) {
  const LogBytes file("");
  lcm::LogFile writer(file.path().string(), "w");
  ASSERT_TRUE(writer.good());
  const auto items = SomeItems(500);
  for (const Item& item : items) {
    std::string data = item.data;
    lcm::LogEvent event{0, item.utime, item.channel, static_cast<std::int32_t>(data.size()), data.data()};
    ASSERT_EQ(writer.writeEvent(&event), 0);
  }
  ASSERT_EQ(std::fflush(writer.getFilePtr()), 0);
  EXPECT_EQ(ReadAll(file.path()), items);
}

TEST(LogFile, ReadsWhatLcmReads) {
  const LogBytes file(BytesOf(SomeItems(500)));
  const LogFile log(file.path());
  LogReader reader(log);
  lcm::LogFile other(file.path().string(), "r");
  while (const lcm::LogEvent* expected = other.readNextEvent()) {
    const auto event = reader.Next();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->number, expected->eventnum);
    EXPECT_EQ(event->utime, expected->timestamp);
    EXPECT_EQ(event->channel, expected->channel);
    ASSERT_EQ(event->data.size(), static_cast<std::size_t>(expected->datalen));
    EXPECT_EQ(std::memcmp(event->data.data(), expected->data, event->data.size()), 0);
  }
  EXPECT_FALSE(reader.Next());
  EXPECT_EQ(reader.damage_count(), 0U);
}

TEST(LogFile, SaysWhyAFileIsNoLog) {
  const LogBytes empty("");
  EXPECT_EQ(ErrorOf(empty.path()), empty.path().string() + ": is empty: nothing was recorded");
  const LogBytes text("t_s,vehicle_id\n0.00,1\n");
  EXPECT_EQ(ErrorOf(text.path()), text.path().string() + ": is not an LCM log: there is no event in it");
  const LogBytes start_of_a_log(BytesOf(SomeItems(1)).substr(0, 27));
  EXPECT_NE(ErrorOf(start_of_a_log.path()).find("no event in it"), std::string::npos);
  EXPECT_NE(ErrorOf(testing::TempDir()).find("is a folder"), std::string::npos);
  EXPECT_NE(ErrorOf("/nowhere.lcm").find("/nowhere.lcm: cannot be opened: No such file"), std::string::npos);
  const std::string pipe = empty.path().string() + ".pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(ErrorOf(pipe).find("is not a file"), std::string::npos);
  std::filesystem::remove(pipe);
}

TEST(LogFile, GivesUpOnAHugeSparseFileAtOnce) {
  const LogBytes file("");
  std::filesystem::resize_file(file.path(), 10ULL << 30);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(ErrorOf(file.path()).find("is not an LCM log"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST(LogFile, GivesUpOnNothingButMagicWordsSoon) {
  std::string bytes;
  for (int i = 0; i < 2'000'000; ++i) bytes += "\xED\xA1\xDA\x01";
  const LogBytes file(bytes);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(ErrorOf(file.path()), "");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(LogFile, JumpsOverAHugeHoleBetweenEvents) {
  const auto items = SomeItems(20);
  const std::string bytes = BytesOf(items);
  LogBytes file(bytes);
  std::filesystem::resize_file(file.path(), 10ULL << 30);
  file.Append(EventBytes(7, 8, "AFTER", "x"));
  const LogFile log(file.path());
  LogReader reader(log);
  const auto start = std::chrono::steady_clock::now();
  const auto read = ReadAll(reader);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  ASSERT_EQ(read.size(), 21U);
  EXPECT_EQ(read.back().channel, "AFTER");
  ASSERT_EQ(reader.damage().size(), 1U);
  EXPECT_EQ(reader.damage()[0].offset, bytes.size());
  EXPECT_EQ(reader.damage()[0].bytes, (10ULL << 30) - bytes.size());
  EXPECT_EQ(reader.damage()[0].last_utime, items.back().utime);
}

TEST(LogFile, ReadsAllThatComesBeforeATruncation) {
  const auto items = SomeItems(20);
  const std::string bytes = BytesOf(items);
  const LogBytes file(bytes);
  for (std::size_t size = bytes.size() - 1; size > items[17].offset; --size) {
    std::filesystem::resize_file(file.path(), size);
    const LogFile log(file.path());
    LogReader reader(log);
    const auto read = ReadAll(reader);
    const auto whole = std::count_if(items.begin(), items.end(), [&](const Item& item) {
      return item.offset + EventBytes(0, 0, item.channel, item.data).size() <= size;
    });
    ASSERT_EQ(read.size(), static_cast<std::size_t>(whole)) << size;
    const bool ends_between = whole < 20 && items[static_cast<std::size_t>(whole)].offset == size;
    ASSERT_EQ(reader.damage_count(), ends_between ? 0U : 1U) << size;
    if (!ends_between) {
      EXPECT_EQ(reader.damage()[0].reason, "the last event is cut short");
      EXPECT_EQ(reader.damage()[0].offset + reader.damaged_bytes(), size);
    }
  }
}

TEST(LogFile, GoesOnWhenTheFileHasGrown) {
  const auto items = SomeItems(3);
  const std::string bytes = BytesOf(items);
  LogBytes file(bytes.substr(0, items[2].offset + 40));
  LogFile log(file.path());
  LogReader reader(log);
  EXPECT_EQ(ReadAll(reader).size(), 2U);
  EXPECT_EQ(reader.damage_count(), 1U);
  file.Append(bytes.substr(items[2].offset + 40));
  EXPECT_FALSE(reader.Next());
  log.Refresh();
  const auto event = reader.Next();
  ASSERT_TRUE(event);
  EXPECT_EQ(ItemOf(*event), items[2]);
  EXPECT_EQ(reader.damage_count(), 0U);
}

TEST(LogFile, GoesOnAfterOverwrittenBytes) {
  const auto items = SomeItems(10);
  std::string bytes = BytesOf(items);
  bytes.replace(items[4].offset, 100, 100, '\xED');
  const LogBytes file(bytes);
  const LogFile log(file.path());
  LogReader reader(log);
  auto expected = items;
  expected.erase(expected.begin() + 4);
  EXPECT_EQ(ReadAll(reader), expected);
  ASSERT_EQ(reader.damage().size(), 1U);
  EXPECT_EQ(reader.damage()[0].offset, items[4].offset);
  EXPECT_EQ(reader.damage()[0].bytes, items[5].offset - items[4].offset);
  EXPECT_EQ(reader.damage()[0].last_utime, items[3].utime);
}

TEST(LogFile, BelievesNoLength) {
  const auto items = SomeItems(10);
  for (const std::uint32_t length : {0x7FFFFFFFU, 0xFFFFFFFFU, 0x0FFFFFFFU, 6000U, 0x80000000U}) {
    for (const std::size_t field : {20U, 24U}) {
      std::string bytes = BytesOf(items);
      for (std::size_t i = 0; i < 4; ++i) {
        bytes[items[4].offset + field + i] = static_cast<char>(length >> (24 - 8 * i));
      }
      const LogBytes file(bytes);
      auto expected = items;
      expected.erase(expected.begin() + 4);
      EXPECT_EQ(ReadAll(file.path()), expected) << length << " at " << field;
    }
  }
}

TEST(LogFile, KeepsEventsThatHoldALogThemselves) {
  const std::string inner = BytesOf(SomeItems(5));
  const LogBytes file(EventBytes(0, 1, "FILE", inner) + EventBytes(1, 2, "FILE", inner));
  const auto items = ReadAll(file.path());
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[1].data, inner);
}

TEST(LogFile, StartsAnywhereWithoutCallingItDamage) {
  const auto items = SomeItems(50);
  const LogBytes file(BytesOf(items));
  const LogFile log(file.path());
  for (const std::size_t i : {1U, 17U, 49U}) {
    for (const std::uint64_t before : {0U, 1U, 27U}) {
      LogReader reader(log, items[i].offset - before);
      const auto event = reader.Next();
      ASSERT_TRUE(event);
      EXPECT_EQ(ItemOf(*event), items[i]);
      EXPECT_EQ(reader.damage_count(), 0U);
    }
  }
}

TEST(LogFile, CountsMoreDamageThanItLists) {
  std::string bytes;
  for (int i = 0; i < 2500; ++i) bytes += EventBytes(i, i, "C", "data") + "junk";
  const LogBytes file(bytes);
  const LogFile log(file.path());
  LogReader reader(log);
  EXPECT_EQ(ReadAll(reader).size(), 2500U);
  EXPECT_EQ(reader.damage_count(), 2500U);
  EXPECT_EQ(reader.damaged_bytes(), 4U * 2500);
  EXPECT_EQ(reader.damage().size(), 1000U);
}

TEST(LogFile, LosesOnlyWhatIsDamaged) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int round = 0; round < 200; ++round) {
    const auto items = SomeItems(30, static_cast<unsigned>(random()));
    std::string bytes = BytesOf(items);
    const std::size_t start = random() % bytes.size();
    const std::size_t end = std::min(bytes.size(), start + 1 + random() % 5000);
    for (std::size_t i = start; i < end; ++i) bytes[i] = static_cast<char>(random());
    const LogBytes file(bytes);
    const auto read = ReadAll(file.path());
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::size_t item_end = i + 1 < items.size() ? items[i + 1].offset : bytes.size();
      if (item_end > start && items[i].offset < end) continue;
      EXPECT_TRUE(std::find(read.begin(), read.end(), items[i]) != read.end())
          << "round " << round << ": event " << i << " is lost";
    }
  }
}

}  // namespace
}  // namespace skein::recording
