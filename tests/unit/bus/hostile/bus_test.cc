#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <random>
#include <string>
#include <vector>

#include "bus/bus.h"
#include "bus/live_executor.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"
#include "unit/bus/hostile/samples.h"
#include "unit/bus/hostile/schema.h"

namespace skein::bus::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Every truncation and every hostile length of a type.
template <typename Message>
std::vector<Bytes> Hostile() {
  static const Schema schema(SKEIN_SOURCE_DIR "/lcmtypes");
  const Bytes good = Encode(Sample<Message>());
  std::vector<Bytes> hostile;
  for (std::size_t size = 0; size < good.size(); ++size) {
    hostile.emplace_back(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
  }
  for (const Place& place : schema.Places(Message::getTypeName(), good)) {
    if (place.kind != Place::Kind::kArrayLength && place.kind != Place::Kind::kStringLength) continue;
    for (const std::int64_t length :
         {std::int64_t{-1}, std::int64_t{0x7FFFFFFF}, std::int64_t{0x10000000}, place.too_large}) {
      hostile.push_back(good);
      WriteInt32(hostile.back(), place.offset, static_cast<std::int32_t>(length));
    }
  }
  return hostile;
}

/// Calls `visit` with the hostile messages and a good one of each type.
template <typename Visit>
void ForEveryType(Visit visit) {
  visit.template operator()<ack_t>();
  visit.template operator()<alarm_command_t>();
  visit.template operator()<alarm_list_t>();
  visit.template operator()<event_t>();
  visit.template operator()<fleet_command_t>();
  visit.template operator()<fleet_roster_t>();
  visit.template operator()<fleet_state_t>();
  visit.template operator()<formation_command_t>();
  visit.template operator()<formation_status_t>();
  visit.template operator()<formation_t>();
  visit.template operator()<heartbeat_t>();
  visit.template operator()<link_command_t>();
  visit.template operator()<link_status_t>();
  visit.template operator()<path_command_t>();
  visit.template operator()<path_t>();
  visit.template operator()<payload_command_t>();
  visit.template operator()<recording_command_t>();
  visit.template operator()<recording_status_t>();
  visit.template operator()<simulation_command_t>();
  visit.template operator()<proximity_t>();
}

TEST(HostileMessages, AreRefusedOverMemqAndLoseNothing) {
  const auto transport = MakeTransport("memq://").lcm;
  SimulatedExecutor executor(transport);
  ForEveryType([&]<typename Message>() {
    Bus bus(transport, "node", executor);
    int handled = 0;
    bus.Subscribe<Message>("CHANNEL", [&](const Message&) { ++handled; });
    const auto hostile = Hostile<Message>();
    for (const Bytes& bytes : hostile) {
      transport->publish("CHANNEL", bytes.data(), static_cast<unsigned>(bytes.size()));
      bus.Publish("CHANNEL", Sample<Message>());
    }
    executor.Deliver();
    EXPECT_EQ(handled, static_cast<int>(hostile.size())) << Message::getTypeName();
    EXPECT_EQ(bus.statistics().undecodable, static_cast<int>(hostile.size())) << Message::getTypeName();
    EXPECT_EQ(bus.statistics().handler_exceptions, 0);
  });
}

class UdpTest : public ::testing::Test {
 protected:
  UdpTest() {
    socket_ = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in any{};
    any.sin_family = AF_INET;
    socklen_t length = sizeof any;
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&any), sizeof any), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&any), &length), 0);
    // A port near that of a socket of ours is one that nobody else uses.
    port_ = ntohs(any.sin_port) ^ 1;
    const std::string url = "udpm://239.255.76.67:" + std::to_string(port_) + "?ttl=0";
    sender_ = MakeTransport(url).lcm;
    receiver_ = MakeTransport(url).lcm;
    executor_ = std::make_unique<LiveExecutor>(receiver_);
  }
  ~UdpTest() override { close(socket_); }

  /// Sends bytes to the port just as they are.
  void SendDatagram(const std::string& bytes) const {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port_);
    to.sin_addr.s_addr = inet_addr("127.0.0.1");
    sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }

  /// Runs until so many messages have been handled or refused, or for ten seconds.
  void RunUntilSeen(const Bus& bus, std::int64_t count) {
    const auto seen = [&] { return bus.statistics().messages_in + bus.statistics().undecodable; };
    bool late = false;
    executor_->At(executor_->Now() + 10 * kSecond, [&] { late = true; });
    while (seen() < count && !late) {
      executor_->At(executor_->Now() + 1000, [&] { executor_->Stop(); });
      executor_->Run();
    }
    ASSERT_EQ(seen(), count);
  }

  int socket_ = -1;
  std::uint16_t port_ = 0;
  std::shared_ptr<lcm::LCM> sender_;
  std::shared_ptr<lcm::LCM> receiver_;
  std::unique_ptr<LiveExecutor> executor_;
};

TEST_F(UdpTest, HostileMessagesAreRefusedAndLoseNothing) {
  constexpr std::size_t kBatch = 50;  // fits into any receive buffer
  ForEveryType([&]<typename Message>() {
    Bus bus(receiver_, "node", *executor_);
    int handled = 0;
    const std::string channel = Message::getTypeName();
    bus.Subscribe<Message>(channel, [&](const Message&) { ++handled; });
    const Bytes good = Encode(Sample<Message>());
    std::int64_t sent = 0;
    std::int64_t good_sent = 0;
    const auto hostile = Hostile<Message>();
    for (std::size_t i = 0; i < hostile.size(); ++i) {
      sender_->publish(channel, hostile[i].data(), static_cast<unsigned>(hostile[i].size()));
      ++sent;
      if ((i + 1) % kBatch != 0 && i + 1 != hostile.size()) continue;
      sender_->publish(channel, good.data(), static_cast<unsigned>(good.size()));
      ++sent;
      ++good_sent;
      RunUntilSeen(bus, sent);
    }
    EXPECT_EQ(handled, good_sent) << channel;
    EXPECT_EQ(bus.statistics().handler_exceptions, 0);
  });
}

TEST_F(UdpTest, GarbageDatagramsLoseNothing) {
  Bus bus(receiver_, "node", *executor_);
  int handled = 0;
  bus.Subscribe<event_t>("EVENT", [&](const event_t&) { ++handled; });
  const Bytes good = Encode(Sample<event_t>());
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const std::string magic = "LC02";
  int good_sent = 0;
  for (int round = 0; round < 100; ++round) {
    SendDatagram("");
    SendDatagram("x");
    SendDatagram(magic);
    SendDatagram(magic + std::string(4, '\0'));  // a header and nothing else: 4294967282 bytes for LCM
    SendDatagram(magic + std::string(4, '\0') + "EVENT");  // a channel that does not end
    SendDatagram(magic + std::string(4, '\0') + "EVENT" + std::string(1, '\0') + "short");
    std::string noise(1 + random() % 1400, '\0');
    for (char& letter : noise) letter = static_cast<char>(random());
    SendDatagram(noise);
    SendDatagram(magic + std::string(4, '\0') + "EVENT" + std::string(1, '\0') + noise);
    sender_->publish("EVENT", good.data(), static_cast<unsigned>(good.size()));
    ++good_sent;
    const Utime deadline = executor_->Now() + 10 * kSecond;
    while (handled < good_sent && executor_->Now() < deadline) {
      executor_->At(executor_->Now() + 1000, [&] { executor_->Stop(); });
      executor_->Run();
    }
    ASSERT_EQ(handled, good_sent);
  }
  EXPECT_GT(bus.statistics().undecodable, 0);
}

}  // namespace
}  // namespace skein::bus::testing
