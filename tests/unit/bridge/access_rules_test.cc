#include "bridge/access_rules.h"

#include <gtest/gtest.h>

namespace skein::bridge {
namespace {

TEST(HostName, LeavesOutThePortAndCase) {
  EXPECT_EQ(HostName("Example.org:8080"), "example.org");
  EXPECT_EQ(HostName("localhost"), "localhost");
  EXPECT_EQ(HostName("[::1]:8080"), "::1");
  EXPECT_EQ(HostName("[::1]"), "::1");
}

TEST(HostName, IsEmptyForWhatIsNoHost) {
  for (const char* host : {"", ":8080", "[::1", "[::1]x", "a:b", "a:80:90", "localhost:80@evil.example"}) {
    EXPECT_EQ(HostName(host), "") << host;
  }
}

TEST(AccessRules, KnowsItsOwnNamesOnly) {
  const AccessRules rules({"Ground.example.org"});
  EXPECT_TRUE(rules.HostIsOurs("127.0.0.1:8080", "127.0.0.1"));
  EXPECT_TRUE(rules.HostIsOurs("localhost:9000", "127.0.0.1"));
  EXPECT_TRUE(rules.HostIsOurs("192.168.1.5", "192.168.1.5"));
  EXPECT_TRUE(rules.HostIsOurs("[::1]:8080", "::1"));
  EXPECT_TRUE(rules.HostIsOurs("ground.EXAMPLE.org:8080", "192.168.1.5"));
  EXPECT_FALSE(rules.HostIsOurs("evil.example:8080", "127.0.0.1"));
  EXPECT_FALSE(rules.HostIsOurs("192.168.1.6", "192.168.1.5"));
  EXPECT_FALSE(rules.HostIsOurs("localhost.evil.example", "127.0.0.1"));
  EXPECT_FALSE(rules.HostIsOurs("", ""));
}

TEST(AccessRules, TakesAPageForItsOwnOnlyWithTheSameHostAndPort) {
  EXPECT_TRUE(AccessRules::SameOrigin("http://localhost:8080", "localhost:8080"));
  EXPECT_TRUE(AccessRules::SameOrigin("https://Ground.example.org", "ground.example.org"));
  EXPECT_FALSE(AccessRules::SameOrigin("http://localhost:8081", "localhost:8080"));
  EXPECT_FALSE(AccessRules::SameOrigin("http://evil.example", "localhost:8080"));
  EXPECT_FALSE(AccessRules::SameOrigin("null", "localhost:8080"));
  EXPECT_FALSE(AccessRules::SameOrigin("", ""));
  EXPECT_FALSE(AccessRules::SameOrigin("file://localhost:8080", "localhost:8080"));
}

TEST(ContentSecurityPolicy, AllowsTheTileServerAndNobodyElse) {
  EXPECT_EQ(ContentSecurityPolicy("").find("http"), std::string::npos);
  EXPECT_NE(ContentSecurityPolicy("https://tile.example.org:8443/a/{z}/{x}/{y}.png")
                .find("img-src 'self' data: https://tile.example.org:8443;"),
            std::string::npos);
  EXPECT_NE(ContentSecurityPolicy("https://{s}.example.org/{z}/{x}/{y}.png").find(" https://*.example.org;"),
            std::string::npos);
}

TEST(TileUrl, IsRefusedWithTheReason) {
  EXPECT_EQ(TileUrlProblem("https://tile.openstreetmap.org/{z}/{x}/{y}.png"), "");
  EXPECT_EQ(TileUrlProblem("http://{s}.tiles.example.org:8000/{z}/{x}/{y}"), "");
  EXPECT_NE(TileUrlProblem("ftp://tiles/{z}/{x}/{y}"), "");
  EXPECT_NE(TileUrlProblem("https:///{z}/{x}/{y}"), "");
  EXPECT_NE(TileUrlProblem("https://tiles; script-src */{z}/{x}/{y}"), "");
  EXPECT_EQ(TileUrlProblem("https://tiles/{z}/{x}.png"), "lacks {y}");
}

}  // namespace
}  // namespace skein::bridge
