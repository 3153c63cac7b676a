#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "access/tokens.h"
#include "bridge_under_test.h"
#include "bus/channels.h"
#include "bus/command_inbox.h"
#include "bus/transport.h"
#include "live_client.h"
#include "raw_client.h"

namespace skein::bridge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kCut = R"({"channel":"CMD_LINK","body":{"vehicle_id":1,"mode":"silent"}})";

/// A bridge that demands tokens, and somebody of each kind who tries what can be tried.
class AccessTable : public testing::Test {
 protected:
  AccessTable() {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "index.html") << "the page";
    viewer_ = access::NewToken(tokens_, "Vera", access::Role::kViewer);
    other_ = access::NewToken(tokens_, "Otto", access::Role::kOperator);
    holder_ = access::NewToken(tokens_, "Hilde", access::Role::kOperator);
    BridgeOptions options;
    options.web_folder = folder_;
    options.tokens_file = tokens_;
    bridge_ = std::make_unique<BridgeUnderTest>(options);
    bridge_->OnBus([this](bus::Bus& other) {
      inbox_ = std::make_unique<bus::CommandInbox>(other);
      inbox_->Obey<link_command_t>(bus::channel::kCmdLink, [this](const link_command_t&) {
        ++heard_;
        return bus::Answer::Accepted();
      });
    });
  }
  ~AccessTable() override {
    page_.reset();
    bridge_->OnBus([this](bus::Bus&) { inbox_.reset(); });
    bridge_.reset();
    fs::remove_all(folder_);
  }

  std::uint16_t port() const { return bridge_->port(); }
  static std::string Bearer(const std::string& token) {
    return token.empty() ? "" : "Authorization: Bearer " + token + "\r\n";
  }
  RawResponse Send(const std::string& method, const std::string& target, const std::string& body,
                   const std::string& headers) const {
    RawClient client(port());
    client.Send(method + " " + target + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: " +
                std::to_string(body.size()) + "\r\n" + headers + "\r\n" + body);
    return client.Receive(method == "HEAD").value_or(RawResponse());
  }
  int Status(const std::string& method, const std::string& target, const std::string& body,
             const std::string& headers) const {
    return Send(method, target, body, headers).status;
  }
  std::unique_ptr<LiveClient> Live(const std::string& token) const {
    return std::make_unique<LiveClient>(port(), "", "/live", 0, token);
  }
  static json Ask(LiveClient& browser, const std::string& message) {
    browser.Send(message);
    json ack;
    do ack = browser.ReadText("ack");
    while (!ack.is_null() && ack["id"] != json::parse(message)["id"]);
    return ack;
  }
  /// Somebody at the page who holds control, and the header that says so.
  std::string TakeControl() {
    page_ = Live(holder_);
    // Waiting for the ack would pass over what comes before it.
    page_->Send(R"({"type":"control","id":"j","action":"join"})");
    json control;
    while (control.is_null() || control["you"] == 0) control = page_->ReadText("control");
    EXPECT_EQ(control["holder"], control["you"]);
    return "Control-Token: " + control["token"].get<std::string>() + "\r\n";
  }

  fs::path folder_ = fs::temp_directory_path() / ("skein_access_" + std::to_string(getpid()));
  fs::path tokens_ = folder_ / "tokens.json";
  std::string viewer_, other_, holder_;
  int heard_ = 0;  ///< commands on the bus; of its thread
  std::unique_ptr<bus::CommandInbox> inbox_;
  std::unique_ptr<BridgeUnderTest> bridge_;
  std::unique_ptr<LiveClient> page_;
};

struct Row {
  const char* method;
  const char* target;
  const char* body;
  /// Statuses for nobody, a viewer, an operator without control, and one who holds it.
  int none, viewer, other, holder;
};

TEST_F(AccessTable, EveryRequestIsAnsweredAsEachMay) {
  const std::string control = TakeControl();
  const Row rows[] = {
      {"GET", "/", "", 200, 200, 200, 200},
      {"HEAD", "/", "", 200, 200, 200, 200},
      {"GET", "/api/health", "", 200, 200, 200, 200},
      {"GET", "/api/session", "", 401, 200, 200, 200},
      {"GET", "/api/state", "", 401, 200, 200, 200},
      {"HEAD", "/api/state", "", 401, 200, 200, 200},
      {"GET", "/api/vehicles", "", 401, 200, 200, 200},
      {"GET", "/api/scenarios", "", 401, 200, 200, 200},
      {"GET", "/api/history?ids=1", "", 401, 200, 200, 200},
      {"GET", "/api/recordings", "", 401, 404, 404, 404},  // this bridge has none
      {"GET", "/api/recordings/x", "", 401, 404, 404, 404},
      {"GET", "/api/recordings/x/file", "", 401, 404, 404, 404},
      {"DELETE", "/api/recordings/x", "", 401, 403, 404, 404},
      {"GET", "/tiles/1/1/1.png", "", 401, 404, 404, 404},
      {"GET", "/tiles.pmtiles", "", 401, 404, 404, 404},
      {"GET", "/live", "", 426, 426, 426, 426},
      {"GET", "/api/none", "", 401, 404, 404, 404},
      {"POST", "/api/none", "", 401, 403, 405, 405},
      {"GET", "/api//state", "", 401, 404, 404, 404},
      {"GET", "/api/%73tate", "", 401, 404, 404, 404},
      {"GET", "//api/state", "", 200, 200, 200, 200},  // the page, as any path without an extension
      {"POST", "/api/command", kCut, 401, 403, 409, 200},
      {"PUT", "/api/command", kCut, 401, 403, 405, 405},
      {"OPTIONS", "/api/command", "", 401, 403, 405, 405},
      {"POST", "/api/preview/formation", "{}", 401, 403, 400, 400},
      {"POST", "/api/preview/path", "{}", 401, 403, 400, 400},
  };
  for (const Row& row : rows) {
    const auto status = [&](const std::string& headers) {
      return Status(row.method, row.target, row.body, headers);
    };
    const std::string what = std::string(row.method) + " " + row.target;
    EXPECT_EQ(status(""), row.none) << what << " by nobody";
    EXPECT_EQ(status(Bearer(viewer_)), row.viewer) << what << " by a viewer";
    EXPECT_EQ(status(Bearer(viewer_) + control), row.viewer) << what << " by a viewer with the holder's mark";
    EXPECT_EQ(status(Bearer(other_)), row.other) << what << " by another operator";
    EXPECT_EQ(status(Bearer(holder_) + control), row.holder) << what << " by who holds control";
    EXPECT_EQ(status(control), row.none) << what << " by nobody with the holder's mark";
  }
  bridge_->OnBus([this](bus::Bus&) { EXPECT_EQ(heard_, 1); });
}

TEST_F(AccessTable, EveryMessageIsAnsweredAsEachMay) {
  const std::string control = TakeControl();
  EXPECT_THROW(Live(""), std::runtime_error);
  EXPECT_THROW(Live("skein_wrong"), std::runtime_error);
  struct MessageRow {
    const char* message;
    bool viewer, other, holder;
  };
  const std::string command = std::string(R"({"type":"command","id":"c",)") + (kCut + 1);
  const MessageRow rows[] = {
      {R"({"type":"control","id":"2","action":"take"})", false, false, true},
      {R"({"type":"control","id":"3","action":"give","person":1})", false, false, false},
      {R"({"type":"control","id":"4","action":"refuse","person":1})", false, false, false},
      {R"({"type":"control","id":"5","action":"rename","name":"X"})", true, true, true},
      {R"({"type":"control","id":"6","action":"ask"})", false, true, true},
      {R"({"type":"control","id":"7","action":"withdraw"})", true, true, true},
      {R"({"type":"playback","id":"8","action":"play"})", false, false, false},
      {command.c_str(), false, false, true},
      {R"({"type":"control","id":"9","action":"release"})", false, false, true},
  };
  const auto viewer = Live(viewer_);
  const auto other = Live(other_);
  for (LiveClient* one : {viewer.get(), other.get()})
    EXPECT_EQ(Ask(*one, R"({"type":"control","id":"j","action":"join"})")["accepted"], true);
  for (const MessageRow& row : rows) {
    EXPECT_EQ(Ask(*viewer, row.message)["accepted"], row.viewer) << row.message << " by a viewer";
    EXPECT_EQ(Ask(*other, row.message)["accepted"], row.other) << row.message << " by another operator";
    EXPECT_EQ(Ask(*page_, row.message)["accepted"], row.holder) << row.message << " by who holds control";
  }
  bridge_->OnBus([this](bus::Bus&) { EXPECT_EQ(heard_, 1); });
}

TEST_F(AccessTable, ACookieOpensWhatItsTokenDoesUntilSigningOut) {
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

TEST_F(AccessTable, WhoGuessesIsNotHeardForAWhileAndOthersAre) {
  const auto from = [](const std::string& address) {
    return "X-Forwarded-For: 1.2.3.4, " + address + "\r\n";
  };
  for (std::size_t i = 0; i < GuessLimit::kGuesses; ++i)
    EXPECT_EQ(Status("GET", "/api/state", "", Bearer("skein_" + std::to_string(i)) + from("10.0.0.5")), 401);
  const auto refused = Send("GET", "/api/state", "", Bearer(viewer_) + from("10.0.0.5"));
  EXPECT_EQ(refused.status, 429);
  EXPECT_GT(std::stoi(refused.headers.at("retry-after")), 0);
  EXPECT_EQ(Status("POST", "/api/session", json{{"token", viewer_}}.dump(), from("10.0.0.5")), 429);
  EXPECT_EQ(Status("GET", "/api/state", "", Bearer(viewer_) + from("10.0.0.6")), 200);
  EXPECT_EQ(Status("GET", "/", "", from("10.0.0.5")), 200);
}

TEST_F(AccessTable, ARevokedTokenCutsOffWhoCameWithItAndFreesControl) {
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

TEST_F(AccessTable, AFileThatOthersMayWriteOpensNothing) {
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
