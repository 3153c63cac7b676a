#include "bus/transport.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace skein::bus {
namespace {

std::string RefusalOf(const std::string& url) {
  try {
    MakeTransport(url);
  } catch (const StartError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(MakeTransport, SaysWhatIsWrongWithAnUrl) {
  EXPECT_EQ(RefusalOf("udpm://10.0.0.1:7667"),
            "udpm://10.0.0.1:7667: 10.0.0.1 is not a multicast address (224.0.0.0 to 239.255.255.255)");
  EXPECT_EQ(RefusalOf("udpm://239.255.76.67:70000"),
            "udpm://239.255.76.67:70000: the port must be 1 to 65535");
  EXPECT_EQ(RefusalOf("nonsense://x"),
            "nonsense://x: LCM cannot open this URL: is it udpm://, tcpq://, memq:// or file://?");
}

TEST(MakeTransport, HasNoReceiveBufferOverMemq) {
  const auto transport = MakeTransport("memq://");
  EXPECT_TRUE(transport.lcm->good());
  EXPECT_EQ(transport.receive_buffer_bytes, 0);
}

TEST(WithReceiveBuffer, AsksForOneWhereTheUrlSaysNothing) {
  EXPECT_EQ(WithReceiveBuffer("udpm://239.255.76.67:7667?ttl=0"),
            "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304");
  EXPECT_EQ(WithReceiveBuffer("udpm://"), "udpm://?recv_buf_size=4194304");
  for (const std::string url : {"udpm://?recv_buf_size=1000", "tcpq://", "memq://", "file:///tmp/a.lcm"}) {
    EXPECT_EQ(WithReceiveBuffer(url), url);
  }
}

TEST(DefaultUrl, ComesFromTheEnvironment) {
  setenv("LCM_DEFAULT_URL", "memq://", 1);
  EXPECT_EQ(DefaultUrl(), "memq://");
  setenv("LCM_DEFAULT_URL", "", 1);
  EXPECT_EQ(DefaultUrl(), kDefaultUrl);
  unsetenv("LCM_DEFAULT_URL");
  EXPECT_EQ(DefaultUrl(), kDefaultUrl);
}

}  // namespace
}  // namespace skein::bus
