#pragma once

#include <map>
#include <skein/fleet_roster_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/path_t.hpp>
#include <string>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "experiment/experiment.h"
#include "experiment/preview.h"

namespace skein::experiment {

/// A flight that goes on, and what it says on its bus that a picture is made of.
class CapturedFlight {
 public:
  explicit CapturedFlight(const std::string& scenario)
      : experiment_(config::LoadScenario(SKEIN_SOURCE_DIR "/scripts/scenarios/" + scenario), {}) {
    bus::Bus& bus = experiment_.operator_bus();
    bus::SubscribeChunks<fleet_roster_t>(bus, bus::channel::kFleetRoster,
                                         [this](const auto& message, int) { roster = message; });
    bus.Subscribe<formation_t>(bus::channel::kFormation, [this](const auto& message) {
      flights[message.formation_id].formation = message;
    });
    bus.Subscribe<path_t>(bus::channel::kPath,
                          [this](const auto& message) { flights[message.formation_id].path = message; });
  }

  const Tick& FlyUntil(double t_s) {
    do {
      tick = &experiment_.Step();
    } while (tick->t_s < t_s - 1e-6);
    for (const auto& [id, status] : tick->formations) flights[id].status = status;
    return *tick;
  }

  FlightPicture Picture() const {
    FlightPicture picture;
    picture.utime = tick->utime;
    for (std::size_t i = 0; i < roster.vehicles.size(); ++i) {
      picture.vehicles.push_back({roster.vehicles[i], tick->vehicles[i].truth, false});
    }
    for (const auto& [id, flight] : flights) picture.formations.push_back(flight);
    return picture;
  }

  template <typename Command>
  void Send(const std::string& channel, Command command) {
    bus::Bus& bus = experiment_.operator_bus();
    command.utime = tick->utime;
    command.session_id = bus.session_id();
    command.request_id = 1;
    command.to_session_id = command.session_id;  // the nodes of an experiment start at the same moment
    bus.Publish(channel, command);
  }

  const controller::FormationControllerNode& controller() const { return experiment_.controller(); }

  fleet_roster_t roster{};
  std::map<int, controller::FormationState> flights;
  const Tick* tick = nullptr;

 private:
  Experiment experiment_;
};

}  // namespace skein::experiment
