#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <skein/formation_t.hpp>
#include <skein/path_command_t.hpp>
#include <string>
#include <variant>

#include "bridge/job_thread.h"
#include "experiment/preview.h"

namespace skein::bridge {

/// What a browser wants flown ahead.
struct PathPreviewRequest {
  path_command_t path;
  bool geometry_only = false;
};
using PreviewRequest = std::variant<formation_t, PathPreviewRequest>;

/// The bodies of POST /api/preview/formation and /api/preview/path (README.md). Throws config::ConfigError,
/// as for the commands that they stand for.
PreviewRequest ParseFormationPreview(const nlohmann::json& body);
PreviewRequest ParsePathPreview(const nlohmann::json& body);

struct PreviewReply {
  bool busy = false;  ///< too many wait; there is no answer
  std::string json;
};

/// Flies changes ahead on threads of its own: one for flights, and one for what a person who drags a waypoint
/// waits for.
class Previewer {
 public:
  /// Set when nobody waits for the answer any more.
  using Gone = std::shared_ptr<std::atomic<bool>>;
  /// Called on some thread, once; never when the previewer ends first.
  using Done = std::function<void(const PreviewReply&)>;

  void Fly(PreviewRequest request, experiment::FlightPicture picture, Gone gone, Done done);

  static constexpr std::size_t kMostWaiting = 3;

 private:
  JobThread geometry_{kMostWaiting};
  JobThread flights_{kMostWaiting};
};

}  // namespace skein::bridge
