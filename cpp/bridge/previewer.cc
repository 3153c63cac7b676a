#include "bridge/previewer.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "bridge/command_parser.h"
#include "bridge/preview_messages.h"
#include "bus/validate.h"
#include "config/json_reader.h"

namespace skein::bridge {
namespace {

using Clock = std::chrono::steady_clock;

// What a person waits for. A flight of a large fleet ends there, wherever it is.
constexpr auto kMostComputing = std::chrono::seconds(5);
constexpr double kLongestTransition_s = 300;
constexpr double kLongestPath_s = 3600;

template <typename Message>
void CheckTexts(const Message& message) {
  if (!bus::Valid(message)) {
    throw config::ConfigError("preview: holds a text that is too long or has control characters");
  }
}

/// An answer with all fields, as when the controller refuses.
Json Refusal(const PreviewRequest& request, const std::string& why) {
  experiment::PathPreview refused;
  refused.flight.reason = why;
  const auto* path = std::get_if<PathPreviewRequest>(&request);
  return path ? ToJson(refused, false, path->geometry_only) : ToJson(refused.flight);
}

std::string Answer(const PreviewRequest& request, const experiment::FlightPicture& picture,
                   const std::function<bool()>& stop) {
  const auto start = Clock::now();
  const auto late = [&] { return stop() || Clock::now() - start > kMostComputing; };
  Json json;
  try {
    if (picture.utime == 0) throw std::runtime_error("no fleet is known yet: no FLEET_STATE has come");
    if (const auto* formation = std::get_if<formation_t>(&request)) {
      json = ToJson(experiment::PreviewFormation(picture, *formation, {kLongestTransition_s, late}));
    } else {
      const auto& [path, geometry_only] = std::get<PathPreviewRequest>(request);
      const experiment::PreviewOptions options{geometry_only ? 0 : kLongestPath_s, late};
      json = ToJson(experiment::PreviewPath(picture, path, options), path.waypoints.empty(), geometry_only);
    }
  } catch (const std::exception& error) {
    // A picture that no flight can be made of: a model that makes no sense, a path that is none.
    json = Refusal(request, error.what());
  }
  json["utime"] = picture.utime;
  json["computed_ms"] = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start).count();
  return Dump(json);
}

}  // namespace

PreviewRequest ParseFormationPreview(const nlohmann::json& body) {
  const config::Object object(config::Value::FromJson(body, "preview"), {"formation"});
  object.At("formation");
  formation_t formation =
      ParseFormationCommand({{"action", "apply"}, {"formation", body.at("formation")}}).formation;
  CheckTexts(formation);
  return formation;
}

PreviewRequest ParsePathPreview(const nlohmann::json& body) {
  const config::Object object(config::Value::FromJson(body, "preview"),
                              {"formation_id", "closed", "waypoints", "geometry_only"});
  PathPreviewRequest request;
  request.geometry_only = object.Boolean("geometry_only", false);
  nlohmann::json command = body;
  command.erase("geometry_only");
  request.path = ParsePathCommand(command);
  return request;
}

void Previewer::Fly(PreviewRequest request, experiment::FlightPicture picture, Gone gone, Done done) {
  const auto* path = std::get_if<PathPreviewRequest>(&request);
  JobThread& thread = path && path->geometry_only ? geometry_ : flights_;
  const bool taken = thread.Add([request = std::move(request), picture = std::move(picture), gone,
                                 done](const std::stop_token& stop) {
    if (*gone) return;
    const std::string json = Answer(request, picture, [&] { return stop.stop_requested() || gone->load(); });
    if (!stop.stop_requested()) done({false, json});
  });
  if (!taken) done({true, ""});
}

}  // namespace skein::bridge
