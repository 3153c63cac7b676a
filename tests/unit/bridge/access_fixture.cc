#include "access_fixture.h"

#include <unistd.h>

#include <fstream>
#include <regex>

#include "access/tokens.h"
#include "bus/channels.h"

namespace skein::bridge {

namespace fs = std::filesystem;
using nlohmann::json;

std::set<std::string> ChannelsOfCommands() {
  std::set<std::string> channels;
  for (const auto& [channel, body] : kCommands) channels.insert(channel);
  return channels;
}

std::set<std::string> NamedIn(const std::string& refusal, std::string_view before) {
  const std::size_t begin = refusal.find(before);
  if (begin == std::string::npos) return {};
  std::string list = refusal.substr(begin + before.size());
  list = list.substr(0, list.find(", is "));
  std::set<std::string> names;
  const std::regex word("\\w+");
  for (std::sregex_iterator found(list.begin(), list.end(), word), end; found != end; ++found)
    if (found->str() != "or") names.insert(found->str());
  return names;
}

AccessTest::AccessTest()
    : folder_(fs::temp_directory_path() / ("skein_access_" + std::to_string(getpid()))),
      tokens_(folder_ / "tokens.json") {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "index.html") << "the page";
  viewer_ = access::NewToken(tokens_, "Vera", access::Role::kViewer);
  other_ = access::NewToken(tokens_, "Otto", access::Role::kOperator);
  holder_ = access::NewToken(tokens_, "Hilde", access::Role::kOperator);
}

AccessTest::~AccessTest() {
  page_.reset();
  if (bridge_) bridge_->OnBus([this](bus::Bus&) { inbox_.reset(); });
  bridge_.reset();
  fs::remove_all(folder_);
}

void AccessTest::Start(BridgeOptions options) {
  options.web_folder = folder_;
  options.tokens_file = tokens_;
  bridge_ = std::make_unique<BridgeUnderTest>(options);
  bridge_->OnBus([this](bus::Bus& other) {
    namespace channel = bus::channel;
    inbox_ = std::make_unique<bus::CommandInbox>(other);
    const auto obey = [this](const char* name) {
      return [this, name](const auto&) {
        ++heard_[name];
        return bus::Answer::Accepted();
      };
    };
    inbox_->Obey<link_command_t>(channel::kCmdLink, obey(channel::kCmdLink));
    inbox_->Obey<payload_command_t>(channel::kCmdPayload, obey(channel::kCmdPayload));
    inbox_->Obey<formation_command_t>(channel::kCmdFormation, obey(channel::kCmdFormation));
    inbox_->Obey<path_command_t>(channel::kCmdPath, obey(channel::kCmdPath));
    inbox_->Obey<simulation_command_t>(channel::kCmdSimulation, obey(channel::kCmdSimulation));
    inbox_->Obey<alarm_command_t>(channel::kCmdAlarm, obey(channel::kCmdAlarm));
    inbox_->Obey<recording_command_t>(channel::kCmdRecording, obey(channel::kCmdRecording));
  });
}

RawResponse AccessTest::Send(const std::string& method, const std::string& target, const std::string& body,
                             const std::string& headers) const {
  RawClient client(port());
  client.Send(method + " " + target + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: " +
              std::to_string(body.size()) + "\r\n" + headers + "\r\n" + body);
  return client.Receive(method == "HEAD").value_or(RawResponse());
}

RawResponse AccessTest::Upgrade(const std::string& target, const std::string& headers) const {
  return RawClient(port())
      .Get(target,
           "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n" +
               headers)
      .value_or(RawResponse());
}

json AccessTest::Ask(LiveClient& browser, const std::string& message) {
  browser.Send(message);
  json ack;
  do ack = browser.ReadText("ack");
  while (!ack.is_null() && ack["id"] != json::parse(message)["id"]);
  return ack;
}

std::string AccessTest::TakeControl() {
  page_ = Live(holder_);
  // Waiting for the ack would pass over what comes before it.
  page_->Send(R"({"type":"control","id":"j","action":"join"})");
  json control;
  while (control.is_null() || control["you"] == 0) control = page_->ReadText("control");
  EXPECT_EQ(control["holder"], control["you"]);
  return "Control-Token: " + control["token"].get<std::string>() + "\r\n";
}

void AccessTest::Try(const Row& row, const std::string& control) {
  const auto status = [&](const std::string& headers) {
    return Status(row.method, row.target, row.body, headers);
  };
  const std::string what = row.method + " " + row.target + " " + row.body;
  EXPECT_EQ(status(""), row.none) << what << " by nobody";
  EXPECT_EQ(status(Bearer(viewer_)), row.viewer) << what << " by a viewer";
  EXPECT_EQ(status(Bearer(viewer_) + control), row.viewer) << what << " by a viewer with the holder's mark";
  EXPECT_EQ(status(Bearer(other_)), row.other) << what << " by another operator";
  EXPECT_EQ(status(Bearer(holder_) + control), row.holder) << what << " by who holds control";
  EXPECT_EQ(status(control), row.none) << what << " by nobody with the holder's mark";
  tried_.insert(row.method + " " + row.target.substr(0, row.target.find('?')));
}

void AccessTest::ExpectAllAllowedTried(const std::string& path, const std::string& control) {
  const auto refused = Send("BREW", path, "", Bearer(holder_) + control);
  ASSERT_TRUE(refused.headers.contains("allow")) << path << ": " << refused.status;
  const std::string allowed = refused.headers.at("allow");
  const std::regex word("\\w+");
  for (std::sregex_iterator method(allowed.begin(), allowed.end(), word), end; method != end; ++method)
    EXPECT_TRUE(tried_.contains(method->str() + " " + path)) << method->str() << " " << path;
}

}  // namespace skein::bridge
