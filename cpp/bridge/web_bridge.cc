#include "bridge/web_bridge.h"

#include <boost/asio/post.hpp>

#include "bridge/history_answer.h"

namespace skein::bridge {

WebBridge::WebBridge(bus::Bus& bus, bus::LiveExecutor& executor, const BridgeOptions& options)
    : mirror_(bus, options.hello,
              [this](const LiveFrame& frame) {
                boost::asio::post(web_context_, [this, frame] { server_.hub().Broadcast(frame); });
              }),
      gateway_(bus),
      events_(bus),
      server_(web_context_, options.listen, options.port,
              {options.web_folder, options.allowed_hosts, options.hello.tile_url, options.tiles,
               options.make_recordings ? options.make_recordings() : nullptr, options.tokens_file},
              MakeBackend(executor, options.hello.replay != nullptr)),
      port_(server_.port()),
      web_thread_([this] { web_context_.run(); }) {}

WebBridge::~WebBridge() {
  web_context_.stop();
  web_thread_.join();
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
