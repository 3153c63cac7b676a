#include "bridge/web_bridge.h"

#include <boost/asio/post.hpp>

#include "bridge/history_answer.h"
#include "bus/saved_bytes.h"

namespace skein::bridge {

WebBridge::WebBridge(bus::Bus& bus, bus::LiveExecutor& executor, const BridgeOptions& options)
    : executor_(executor),
      mirror_(bus, options.hello,
              [this](const LiveFrame& frame) {
                boost::asio::post(web_context_, [this, frame] { server_.hub().Broadcast(frame); });
              }),
      gateway_(bus),
      events_(bus),
      state_file_(options.state_file, "web-bridge 1", events_),
      server_(web_context_, options.listen, options.port,
              {options.web_folder, options.allowed_hosts, options.hello.tile_url, options.tiles,
               options.make_recordings ? options.make_recordings() : nullptr, options.tokens_file},
              MakeBackend(executor, options.hello.replay != nullptr)),
      port_(server_.port()) {
  holder_ = ReadHolder();
  if (holder_) server_.hub().WaitFor(*holder_);
  // Again and again, so that its age tells for how long the bridge was gone.
  executor.Every(bus::kSecond, [this] {
    if (holder_) SaveHolder();
  });
  web_thread_ = std::thread([this] { web_context_.run(); });
}

WebBridge::~WebBridge() {
  web_context_.stop();
  web_thread_.join();
}

std::optional<KeptHolder> WebBridge::ReadHolder() {
  const auto bytes = state_file_.Read();
  if (!bytes) return std::nullopt;
  bus::SavedReader reader(*bytes);
  const auto saved = reader.Number();
  const auto name = reader.Text();
  const auto token_sha256 = reader.Text();
  if (!saved || !name || !token_sha256 || (!name->empty() && !NameProblem(std::string(*name)).empty())) {
    state_file_.SetAside("it does not say who holds control");
    return std::nullopt;
  }
  const bus::Utime age = executor_.Now() - *saved;
  constexpr bus::Utime kGrace = std::chrono::microseconds(ControlDesk::kGrace).count();
  if (name->empty() || age < -bus::kSecond || age > kGrace) return std::nullopt;
  return KeptHolder{std::string(*name), std::string(*token_sha256)};
}

void WebBridge::SaveHolder() {
  if (!state_file_.kept()) return;
  const KeptHolder holder = holder_.value_or(KeptHolder{});
  bus::SavedBytes bytes;
  bytes.Add(executor_.Now());
  bytes.Add(holder.name);
  bytes.Add(holder.token_sha256);
  state_file_.Save(bytes.Take());
}

Backend WebBridge::MakeBackend(bus::LiveExecutor& executor, bool replay) {
  // Over to the bus's thread for the result, and back with it.
  const auto ask = [this, &executor](auto make_result) {
    return [this, &executor, make_result](auto reply) {
      executor.Post([this, make_result, reply] {
        boost::asio::post(web_context_, [reply, result = make_result()] { reply(result); });
      });
    };
  };
  Backend backend;
  if (replay) backend.why_no_command = "this is a replay: nothing can be commanded";
  backend.snapshot = ask([this] { return mirror_.Snapshot(); });
  backend.health = ask([this] { return Dump(mirror_.Health()); });
  backend.state = ask([this] { return Dump(mirror_.State()); });
  backend.vehicles = ask([this] { return Dump(mirror_.Vehicles()); });
  backend.history = [this, &executor](const HistoryQuery& query, const Backend::Reply<std::string>& reply) {
    executor.Post([this, query, reply] {
      // Only the list is copied here: samples never change, so they are encoded on the web's thread.
      boost::asio::post(web_context_,
                        [query, reply, samples = mirror_.FlightSoFar(), start_utime = mirror_.start_utime()] {
                          reply(EncodeHistory(samples, query, start_utime));
                        });
    });
  };
  backend.tell = [this, &executor](const std::string& code, const std::string& text) {
    executor.Post([this, code, text] { events_.Tell(event_t::INFO, code, text); });
  };
  backend.keep_holder = [this, &executor](const std::optional<KeptHolder>& holder) {
    executor.Post([this, holder] {
      holder_ = holder;
      SaveHolder();
    });
  };
  backend.command = [this, &executor](const std::string& channel, const nlohmann::json& body,
                                      const Backend::Reply<CommandResult>& reply) {
    executor.Post([this, channel, body, reply] {
      gateway_.Send(channel, body, [this, reply](const CommandResult& result) {
        boost::asio::post(web_context_, [reply, result] { reply(result); });
      });
    });
  };
  backend.preview = [this, &executor](const PreviewRequest& request, const Previewer::Gone& gone,
                                      const Backend::Reply<PreviewReply>& reply) {
    executor.Post([this, request, gone, reply] {
      previewer_.Fly(request, mirror_.Picture(), gone, [this, reply](const PreviewReply& result) {
        boost::asio::post(web_context_, [reply, result] { reply(result); });
      });
    });
  };
  return backend;
}

}  // namespace skein::bridge
