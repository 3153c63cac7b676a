// How people get in, and how guessing is limited.

#include <filesystem>
#include <functional>

#include "access/tokens.h"
#include "access_fixture.h"
#include "bus/transport.h"

namespace skein::bridge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kCut = R"({"channel":"CMD_LINK","body":{"vehicle_id":1,"mode":"silent"}})";

class SignInTest : public AccessTest {
 protected:
  SignInTest() { Start(); }

  static std::string From(const std::string& address) {
    return "X-Forwarded-For: 1.2.3.4, " + address + "\r\n";
  }
  /// Shows a token from an address in one of the ways that there are.
  struct Way {
    std::string name;
    std::function<RawResponse(const std::string& token, const std::string& from)> show;
    int success = 200;
  };
  const std::vector<Way> kWays{
      {"a header",
       [this](const std::string& token, const std::string& from) {
         return Send("GET", "/api/state", "", Bearer(token) + from);
       }},
      {"a cookie",
       [this](const std::string& token, const std::string& from) {
         return Send("GET", "/api/state", "", Cookie(token) + from);
       }},
      {"signing in",
       [this](const std::string& token, const std::string& from) {
         return Send("POST", "/api/session", json{{"token", token}}.dump(), from);
       }},
      {"a header at /live",
       [this](const std::string& token, const std::string& from) {
         return Upgrade("/live", Bearer(token) + from);
       },
       101},
      {"a cookie at /live",
       [this](const std::string& token, const std::string& from) {
         return Upgrade("/live", Cookie(token) + from);
       },
       101},
  };
};

TEST_F(SignInTest, ACookieOpensWhatItsTokenDoesUntilSigningOut) {
  const auto wrong = Send("POST", "/api/session", R"({"token":"skein_x"})", "");
  EXPECT_EQ(wrong.status, 401);
  EXPECT_FALSE(wrong.headers.contains("set-cookie"));
  const auto signed_in = Send("POST", "/api/session", json{{"token", viewer_}}.dump(), "");
  ASSERT_EQ(signed_in.status, 200);
  EXPECT_EQ(json::parse(signed_in.body), (json{{"signed_in", true}, {"name", "Vera"}, {"role", "viewer"}}));
  const std::string& cookie = signed_in.headers.at("set-cookie");
  for (const char* attribute : {"; HttpOnly", "; SameSite=Strict", "; Path=/", "; Max-Age=43200"})
    EXPECT_NE(cookie.find(attribute), std::string::npos) << attribute;
  EXPECT_EQ(cookie.find("Secure"), std::string::npos);
  const std::string shown = "Cookie: other=1; " + cookie.substr(0, cookie.find(';')) + "\r\n";
  EXPECT_EQ(Status("GET", "/api/state", "", shown), 200);
  EXPECT_EQ(Status("POST", "/api/command", kCut, shown), 403);
  const auto signed_out = Send("DELETE", "/api/session", "", shown);
  EXPECT_NE(signed_out.headers.at("set-cookie").find("; Max-Age=0"), std::string::npos);
  // A cookie that opens nothing is taken away, lest the browser goes on showing it.
  const auto stale =
      Send("GET", "/api/state", "", "Cookie: skein_" + std::to_string(port()) + "=skein_old\r\n");
  EXPECT_EQ(stale.status, 401);
  EXPECT_NE(stale.headers.at("set-cookie").find("; Max-Age=0"), std::string::npos);
  const auto behind_tls =
      Send("POST", "/api/session", json{{"token", viewer_}}.dump(), "X-Forwarded-Proto: https\r\n");
  EXPECT_NE(behind_tls.headers.at("set-cookie").find("; Secure"), std::string::npos);
}

TEST_F(SignInTest, WhoGuessesInWhateverWayIsNotHeardInAnyAndOthersAre) {
  int number = 0;
  for (const Way& guessing : kWays) {
    const std::string from = From("10.0.0." + std::to_string(++number));
    for (std::size_t i = 0; i < GuessLimit::kGuesses; ++i)
      EXPECT_EQ(guessing.show("skein_" + std::to_string(i), from).status, 401) << guessing.name;
    for (const Way& way : kWays) {
      const auto refused = way.show(viewer_, from);
      ASSERT_EQ(refused.status, 429) << way.name << " after guesses by " << guessing.name;
      EXPECT_GT(std::stoi(refused.headers.at("retry-after")), 0);
      EXPECT_LE(std::stoi(refused.headers.at("retry-after")), GuessLimit::kPeriod.count());
      EXPECT_EQ(way.show(viewer_, From("10.0.1.1")).status, way.success) << way.name;
    }
    EXPECT_EQ(Status("GET", "/", "", from), 200);
  }
}

TEST_F(SignInTest, GuessesInDifferentWaysAddUp) {
  const std::string from = From("10.0.0.9");
  for (std::size_t i = 0; i < GuessLimit::kGuesses; ++i) {
    const Way& way = kWays[i % kWays.size()];
    EXPECT_EQ(way.show("skein_" + std::to_string(i), from).status, 401) << way.name;
    // What is right in between makes up for nothing.
    if (i + 1 == GuessLimit::kGuesses) break;
    EXPECT_EQ(way.show(viewer_, from).status, way.success) << way.name;
  }
  for (const Way& way : kWays) EXPECT_EQ(way.show(viewer_, from).status, 429) << way.name;
}

TEST_F(SignInTest, WhoIsInStaysInWhenSomebodyAtHisAddressGuesses) {
  const auto viewer = Live(viewer_);
  for (std::size_t i = 0; i < GuessLimit::kGuesses; ++i) EXPECT_EQ(kWays[3].show("skein_x", "").status, 401);
  EXPECT_THROW(Live(viewer_), std::runtime_error);
  EXPECT_EQ(Ask(*viewer, R"({"type":"control","id":"j","action":"join"})")["accepted"], true);
}

TEST_F(SignInTest, ARevokedTokenCutsOffWhoCameWithItAndFreesControl) {
  const std::string control = TakeControl();
  const auto other = Live(other_);
  EXPECT_EQ(Ask(*other, R"({"type":"control","id":"j","action":"join"})")["accepted"], true);
  access::RevokeToken(tokens_, "Hilde");
  while (page_->Read()) {
  }
  EXPECT_THROW(Live(holder_), std::runtime_error);
  EXPECT_EQ(Status("POST", "/api/command", kCut, Bearer(holder_) + control), 401);
  EXPECT_EQ(Ask(*other, R"({"type":"control","id":"r","action":"rename","name":"Otto"})")["accepted"], true);
}

TEST_F(SignInTest, AFileThatOthersMayWriteOpensNothing) {
  const auto viewer = Live(viewer_);
  fs::permissions(tokens_, fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_write);
  while (viewer->Read()) {
  }
  EXPECT_EQ(Status("GET", "/api/state", "", Bearer(viewer_)), 401);
}

TEST(Access, ABridgeThatOthersReachDemandsTokens) {
  for (const char* address : {"0.0.0.0", "::", "192.0.2.1"}) {
    BridgeOptions options;
    options.listen = address;
    try {
      BridgeUnderTest bridge(options);
      FAIL() << "it listens on " << address;
    } catch (const bus::StartError& error) {
      EXPECT_NE(std::string(error.what()).find("skein token new"), std::string::npos) << error.what();
    }
  }
  for (const char* address : {"127.0.0.1", "127.0.0.9", "localhost"}) {
    BridgeOptions options;
    options.listen = address;
    EXPECT_NO_THROW(BridgeUnderTest bridge(options)) << address;
  }
}

}  // namespace
}  // namespace skein::bridge
