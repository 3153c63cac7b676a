#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "bridge_under_test.h"
#include "bus/channels.h"
#include "bus/command_inbox.h"
#include "bus/transport.h"
#include "raw_client.h"

namespace skein::bridge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class HttpTest : public testing::Test {
 protected:
  HttpTest() {
    fs::create_directories(web_ / "assets");
    std::ofstream(web_ / "index.html") << "the page";
    std::ofstream(web_ / "assets" / "big-1a2b.js") << std::string(3'000'000, 'x');
    BridgeOptions options;
    options.web_folder = web_;
    options.allowed_hosts = {"ground.example.org"};
    bridge_ = std::make_unique<BridgeUnderTest>(options);
  }
  ~HttpTest() override { fs::remove_all(web_); }

  std::uint16_t port() const { return bridge_->port(); }
  /// The status of one request, 0 when there is no answer; the whole request is given.
  int Status(std::string_view request) const {
    RawClient client(port());
    client.Send(request);
    const auto response = client.Receive();
    return response ? response->status : 0;
  }

  fs::path web_ = fs::temp_directory_path() / ("skein_http_" + std::to_string(getpid()));
  std::unique_ptr<BridgeUnderTest> bridge_;
};

TEST_F(HttpTest, ServesThePageWithHeadersThatKeepOthersOut) {
  RawClient client(port());
  const auto response = client.Get("/");
  ASSERT_TRUE(response);
  EXPECT_EQ(response->status, 200);
  EXPECT_EQ(response->body, "the page");
  EXPECT_EQ(response->headers.at("content-type"), "text/html; charset=utf-8");
  EXPECT_EQ(response->headers.at("cache-control"), "no-cache");
  EXPECT_EQ(response->headers.at("x-content-type-options"), "nosniff");
  EXPECT_EQ(
      response->headers.at("content-security-policy"),
      "default-src 'self'; img-src 'self' data:; object-src 'none'; base-uri 'none'; form-action 'none'; "
      "frame-ancestors 'none'");
}

TEST_F(HttpTest, ListsTheScenariosThatCanBeLoaded) {
  std::ofstream(web_ / "one.json") << R"({"name": "One", "description": "Alone", "duration_s": 60,
      "origin": {"latitude_deg": 0, "longitude_deg": 0},
      "vehicles": [{"id": 1, "east_m": 0, "north_m": 0, "up_m": 500, "speed_m_s": 50, "course_deg": 0}]})";
  std::ofstream(web_ / "broken.json") << "{";
  setenv("SKEIN_SCENARIOS", web_.c_str(), 1);
  RawClient client(port());
  const auto response = client.Get("/api/scenarios");
  unsetenv("SKEIN_SCENARIOS");
  ASSERT_TRUE(response);
  json one;
  json broken;
  for (const json& entry : json::parse(response->body)) {
    if (entry["name"] == "one") one = entry;
    if (entry["name"] == "broken") broken = entry;
  }
  EXPECT_EQ(one, (json{{"name", "one"},
                       {"title", "One"},
                       {"description", "Alone"},
                       {"vehicles", 1},
                       {"duration_s", 60},
                       {"problem", ""}}));
  EXPECT_NE(broken["problem"].get<std::string>().find("broken.json"), std::string::npos);
}

TEST_F(HttpTest, KeepsTheConnectionAndAnswersPipelinedRequestsInOrder) {
  RawClient client(port());
  std::string requests;
  for (const char* target : {"/", "/missing.png", "/assets/big-1a2b.js", "/api/vehicles", "/"}) {
    requests += "GET " + std::string(target) + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
  }
  client.Send(requests);
  EXPECT_EQ(client.Receive().value().body, "the page");
  EXPECT_EQ(client.Receive().value().status, 404);
  EXPECT_EQ(client.Receive().value().body.size(), 3'000'000u);
  EXPECT_TRUE(json::parse(client.Receive().value().body).contains("vehicles"));
  EXPECT_EQ(client.Receive().value().body, "the page");
}

TEST_F(HttpTest, AnswersHeadWithTheLengthAndNoBody) {
  RawClient client(port());
  client.Send("HEAD /assets/big-1a2b.js HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto head = client.Receive(true);
  ASSERT_TRUE(head);
  EXPECT_EQ(head->status, 200);
  EXPECT_EQ(head->headers.at("content-length"), "3000000");
  EXPECT_EQ(client.Get("/").value().body, "the page");
}

TEST_F(HttpTest, ClosesWhenAskedToAndAfterHttp10) {
  RawClient asked(port());
  EXPECT_EQ(asked.Get("/", "Connection: close\r\n").value().headers.at("connection"), "close");
  EXPECT_TRUE(asked.IsClosed());
  RawClient old(port());
  old.Send("GET / HTTP/1.0\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(old.Receive().value().body, "the page");
  EXPECT_TRUE(old.IsClosed());
}

TEST_F(HttpTest, SaysThatAFileHasNotChanged) {
  RawClient client(port());
  const std::string etag = client.Get("/").value().headers.at("etag");
  const auto again = client.Get("/", "If-None-Match: " + etag + "\r\n");
  EXPECT_EQ(again.value().status, 304);
  EXPECT_EQ(again.value().body, "");
  EXPECT_EQ(client.Get("/", "If-None-Match: \"other\"\r\n").value().status, 200);
}

TEST_F(HttpTest, RefusesTraversalOverTheWire) {
  RawClient client(port());
  for (const char* target : {"/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc%2fpasswd.txt",
                             "/%252e%252e/%252e%252e/etc/passwd.txt", "/..%252f..%252fetc%252fpasswd.txt"}) {
    EXPECT_EQ(client.Get(target).value().status, 404) << target;
  }
}

TEST_F(HttpTest, GivesTheFlightSoFarOrSaysWhatIsWrongWithTheRequest) {
  bridge_->OnBus(SendTwoVehicles);
  RawClient client(port());
  std::string bytes;
  // The bridge looks at the fleet four times a second.
  for (int tries = 0; tries < 100'000 && bytes.size() < 24 + 8 + 4 + 37; ++tries) {
    const auto response = client.Get("/api/history?ids=2");
    ASSERT_EQ(response.value().status, 200);
    EXPECT_EQ(response->headers.at("content-type"), "application/octet-stream");
    bytes = response->body;
  }
  EXPECT_EQ(bytes.size(), 24u + 8u + 4u + 37u);
  EXPECT_EQ(client.Get("/api/history").value().status, 400);
  EXPECT_EQ(client.Get("/api/history?ids=two").value().status, 400);
}

TEST_F(HttpTest, GivesStateAndVehiclesAsJson) {
  bridge_->OnBus(SendTwoVehicles);
  RawClient client(port());
  json vehicles;
  // The messages are on their way to the bridge's handlers.
  for (int tries = 0; tries < 1000 && vehicles["vehicles"].size() < 2; ++tries) {
    vehicles = json::parse(client.Get("/api/vehicles").value().body);
  }
  ASSERT_EQ(vehicles["vehicles"].size(), 2u);
  EXPECT_EQ(vehicles["vehicles"][1]["callsign"], "UAV2");
  const auto response = client.Get("/api/state?x=1").value();
  EXPECT_EQ(response.headers.at("content-type"), "application/json");
  const json state = json::parse(response.body);
  EXPECT_EQ(state["hello"]["type"], "hello");
  EXPECT_EQ(state["roster"]["scenario"], "Two");
  EXPECT_EQ(client.Get("/api/nothing").value().status, 404);
}

TEST(Replay, RefusesCommandsAndChangesFlownAheadAndSaysSoInHello) {
  BridgeOptions options;
  options.hello.replay = {{"kind", "player"}, {"name", "triangle"}, {"speed", 2}};
  BridgeUnderTest bridge(options);
  int heard = 0;
  bridge.OnBus([&](bus::Bus& other) {
    other.Subscribe<link_command_t>(bus::channel::kCmdLink, [&](const link_command_t&) { ++heard; });
  });
  RawClient client(bridge.port());
  const auto command =
      client.Post("/api/command", R"({"channel":"CMD_LINK","body":{"vehicle_id":3,"mode":"silent"}})");
  EXPECT_EQ(command.value().status, 409);
  EXPECT_EQ(json::parse(command->body),
            (json{{"accepted", false}, {"reason", "this is a replay: nothing can be commanded"}}));
  const auto preview = client.Post("/api/preview/path", "{}");
  EXPECT_EQ(preview.value().status, 409);
  EXPECT_EQ(json::parse(preview->body)["reason"], "this is a replay: nothing can be commanded");
  const json state = json::parse(client.Get("/api/state").value().body);
  EXPECT_EQ(state["hello"]["replay"], (json{{"kind", "player"}, {"name", "triangle"}, {"speed", 2}}));
  bridge.OnBus([&](bus::Bus&) { EXPECT_EQ(heard, 0); });
}

TEST_F(HttpTest, PassesCommandsOnAndTellsTheAnswer) {
  std::unique_ptr<bus::CommandInbox> inbox;
  bridge_->OnBus([&](bus::Bus& other) {
    inbox = std::make_unique<bus::CommandInbox>(other);
    inbox->Obey<link_command_t>(bus::channel::kCmdLink, [](const link_command_t& command) {
      return command.vehicle_id == 3 ? bus::Answer::Accepted() : bus::Answer::Refused("there is no such UAV");
    });
  });
  RawClient client(port());
  const auto accepted =
      client.Post("/api/command", R"({"channel":"CMD_LINK","body":{"vehicle_id":3,"mode":"silent"}})");
  EXPECT_EQ(accepted.value().status, 200);
  EXPECT_EQ(json::parse(accepted->body), (json{{"accepted", true}, {"reason", ""}}));
  const auto refused =
      client.Post("/api/command", R"({"channel":"CMD_LINK","body":{"vehicle_id":4,"mode":"up"}})");
  EXPECT_EQ(refused.value().status, 409);
  EXPECT_EQ(json::parse(refused->body)["reason"], "there is no such UAV");
  const auto wrong =
      client.Post("/api/command", R"({"channel":"CMD_LINK","body":{"vehicle_id":"x","mode":"up"}})");
  EXPECT_EQ(wrong.value().status, 400);
  EXPECT_EQ(json::parse(wrong->body)["reason"], "CMD_LINK: /vehicle_id: must be a whole number, is a text");
  const auto unanswered =
      client.Post("/api/command", R"({"channel":"CMD_PAYLOAD","body":{"vehicle_ids":[1],"on":true}})");
  EXPECT_EQ(unanswered.value().status, 504);
  EXPECT_EQ(json::parse(unanswered->body)["accepted"], false);
}

TEST_F(HttpTest, RefusesWhatIsNoCommand) {
  RawClient client(port());
  for (const char* body :
       {"", "not json", "[]", "{}", R"({"channel":1,"body":{}})", R"({"channel":"CMD_LINK"})",
        R"({"channel":"CMD_LINK","body":{},"more":1})", R"({"channel":"CMD_FLEET","body":{}})",
        R"({"channel":"CMD_LINK","body":null})", "\xff\xfe"}) {
    const auto response = client.Post("/api/command", body);
    ASSERT_TRUE(response) << body;
    EXPECT_EQ(response->status, 400) << body;
    EXPECT_FALSE(json::parse(response->body)["reason"].get<std::string>().empty());
  }
  const std::string deep(200'000, '[');
  EXPECT_EQ(client.Post("/api/command", deep).value().status, 400);
  const std::string whole = deep + std::string(deep.size(), ']');
  EXPECT_EQ(client.Post("/api/command", R"({"channel":"CMD_LINK","body":)" + whole + "}").value().status,
            400);
}

TEST_F(HttpTest, TakesOnlyTheMethodsThatMakeSense) {
  EXPECT_EQ(Status("GET /api/command HTTP/1.1\r\nHost: localhost\r\n\r\n"), 405);
  EXPECT_EQ(Status("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n"), 405);
  EXPECT_EQ(Status("DELETE /api/state HTTP/1.1\r\nHost: localhost\r\n\r\n"), 405);
  EXPECT_EQ(Status("OPTIONS /api/command HTTP/1.1\r\nHost: localhost\r\n\r\n"), 405);
  EXPECT_EQ(Status("GET /live HTTP/1.1\r\nHost: localhost\r\n\r\n"), 426);
}

TEST_F(HttpTest, IsCalledByItsOwnNamesOnly) {
  const std::string port_text = std::to_string(port());
  EXPECT_EQ(Status("GET / HTTP/1.1\r\nHost: 127.0.0.1:" + port_text + "\r\n\r\n"), 200);
  EXPECT_EQ(Status("GET / HTTP/1.1\r\nHost: ground.example.org\r\n\r\n"), 200);
  EXPECT_EQ(Status("GET /api/state HTTP/1.1\r\nHost: evil.example:" + port_text + "\r\n\r\n"), 403);
  EXPECT_EQ(Status("GET / HTTP/1.1\r\n\r\n"), 400);
  EXPECT_EQ(Status("GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n\r\n"), 400);
}

TEST_F(HttpTest, TakesCommandsFromItsOwnPageOnly) {
  const char* body = R"({"channel":"CMD_FLEET","body":{}})";
  const auto status = [&](const char* origin) {
    return RawClient(port())
        .Post("/api/command", body, std::string("Origin: ") + origin + "\r\n")
        .value()
        .status;
  };
  EXPECT_EQ(status("http://localhost"), 400);  // its own: it gets as far as the body
  EXPECT_EQ(status("http://evil.example"), 403);
  EXPECT_EQ(status("http://localhost:1"), 403);
  EXPECT_EQ(status("null"), 403);
}

TEST_F(HttpTest, RefusesHugeHeadersAndBodies) {
  EXPECT_EQ(Status("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(20'000, 'x') + "\r\n\r\n"), 431);
  EXPECT_EQ(Status("GET /" + std::string(20'000, 'x') + " HTTP/1.1\r\nHost: localhost\r\n\r\n"), 431);
  EXPECT_EQ(Status("POST /api/command HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2000000\r\n\r\n"), 413);
  std::string chunks = "POST /api/command HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
  for (int i = 0; i < 40; ++i) chunks += "8000\r\n" + std::string(0x8000, 'x') + "\r\n";
  EXPECT_EQ(Status(chunks), 413);
}

TEST_F(HttpTest, ClosesAfterABodyThatItDidNotRead) {
  RawClient client(port());
  client.Send(
      "POST /nowhere HTTP/1.1\r\nHost: localhost\r\nContent-Length: 43\r\n\r\n"
      "GET /api/state HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto response = client.Receive();
  EXPECT_EQ(response.value().status, 405);
  EXPECT_EQ(response->headers.at("connection"), "close");
  EXPECT_TRUE(client.IsClosed());
}

TEST_F(HttpTest, RefusesARequestWithTwoLengths) {
  EXPECT_EQ(Status("POST /api/command HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\nContent-Length: "
                   "6\r\n\r\n12345"),
            400);
  EXPECT_EQ(Status("POST /api/command HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n"
                   "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n"),
            400);
}

TEST_F(HttpTest, TellsAClientThatAsksToGoOn) {
  RawClient client(port());
  client.Send(
      "POST /api/command HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\n");
  EXPECT_EQ(client.Receive(true).value().status, 100);
  client.Send("{}");
  EXPECT_EQ(client.Receive().value().status, 400);
}

TEST_F(HttpTest, LivesThroughGarbageAndHalfRequests) {
  EXPECT_EQ(Status("\x16\x03\x01 this is no HTTP\r\n\r\n"), 400);
  EXPECT_EQ(Status(std::string("\0\0\0\0\r\n\r\n", 8)), 400);
  RawClient half(port());
  half.Send("GET / HT");
  half.EndSending();
  EXPECT_TRUE(half.IsClosed());
  RawClient silent(port());
  silent.EndSending();
  EXPECT_TRUE(silent.IsClosed());
  {
    RawClient gone(port());
    gone.Send("POST /api/command HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10\r\n\r\n123");
  }
  RawClient good(port());
  EXPECT_EQ(good.Get("/").value().status, 200);
}

TEST_F(HttpTest, ServesOthersWhileConnectionsStandIdleOrTakeNothing) {
  std::vector<std::unique_ptr<RawClient>> idle;
  for (int i = 0; i < 50; ++i) idle.push_back(std::make_unique<RawClient>(port()));
  RawClient slow(port());
  for (int i = 0; i < 10; ++i) slow.Send("GET /assets/big-1a2b.js HTTP/1.1\r\nHost: localhost\r\n\r\n");
  RawClient good(port());
  EXPECT_EQ(good.Get("/").value().status, 200);
  EXPECT_EQ(slow.Receive().value().body.size(), 3'000'000u);
}

TEST_F(HttpTest, IsThereForANewcomerHoweverManySayNothing) {
  std::vector<std::unique_ptr<RawClient>> idle;
  for (int i = 0; i < WebServer::kMaxConnections + 50; ++i) {
    idle.push_back(std::make_unique<RawClient>(port()));
    if (i % 2 == 1) idle.back()->Send("GET / HTTP/1.1\r\nHost:");
  }
  EXPECT_EQ(RawClient(port()).Get("/").value().status, 200);
  EXPECT_TRUE(idle.front()->IsClosed());
}

TEST_F(HttpTest, IsThereForANewcomerHoweverManySendHalfABody) {
  std::vector<std::unique_ptr<RawClient>> half;
  for (int i = 0; i < WebServer::kMaxConnections + 50; ++i) {
    half.push_back(std::make_unique<RawClient>(port()));
    half.back()->Send("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10\r\n\r\n12345");
  }
  EXPECT_EQ(RawClient(port()).Get("/").value().status, 200);
}

TEST_F(HttpTest, SaysWhichPortIsTakenAndHowToChooseAnother) {
  boost::asio::io_context context;
  try {
    WebServer(context, "127.0.0.1", port(), {}, {});
    FAIL() << "listened on a port that is taken";
  } catch (const bus::StartError& error) {
    EXPECT_EQ(std::string(error.what()),
              "port " + std::to_string(port()) +
                  " on 127.0.0.1 is taken by another program: choose another one with --port N");
  }
  EXPECT_THROW(WebServer(context, "here", 0, {}, {}), bus::StartError);
  EXPECT_THROW(WebServer(context, "192.0.2.1", 0, {}, {}), bus::StartError);
}

}  // namespace
}  // namespace skein::bridge
