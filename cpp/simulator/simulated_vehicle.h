#pragma once

#include <cstdint>
#include <optional>
#include <skein/vehicle_state_t.hpp>
#include <string>
#include <variant>

#include "bus/executor.h"
#include "config/scenario.h"
#include "core/vehicle.h"
#include "simulator/vehicle_link.h"

namespace skein::simulator {

/// What CMD_FLEET has for one UAV.
struct FlightCommand {
  std::int64_t session_id = 0;
  std::int64_t sequence = 0;
  AutopilotInput input;
};

/// What CMD_PAYLOAD has for one UAV.
struct PayloadSwitch {
  bool on = false;
};

/// One UAV with its autopilot, its payload and both directions of its data link. It hears nothing but what
/// comes over its uplink, and is heard only over its downlink. Before the first command it holds course,
/// speed and altitude.
class SimulatedVehicle {
 public:
  using UplinkMessage = std::variant<FlightCommand, PayloadSwitch>;

  /// @param start time of config.start. @param seed of the losses and delays of its links.
  SimulatedVehicle(const config::VehicleConfig& config, bus::Utime start, std::uint64_t seed);

  int id() const { return id_; }
  const std::string& callsign() const { return callsign_; }
  bool has_payload() const { return has_payload_; }

  /// The truth, which no link has touched.
  const VehicleState& state() const { return state_; }
  bus::Utime utime() const { return utime_; }
  const AutopilotInput& input() const { return input_; }
  const VehicleModel& model() const { return model_; }  ///< as it really is
  bool payload_on() const { return payload_on_; }

  const LinkSetting& uplink() const { return uplink_.setting(); }
  const LinkSetting& downlink() const { return downlink_.setting(); }
  void SetUplink(const LinkSetting& setting) { uplink_.Set(setting); }
  void SetDownlink(const LinkSetting& setting) { downlink_.Set(setting); }

  /// What must not be lost when the simulator is killed.
  struct Memory {
    vehicle_state_t report;
    AutopilotInput input;
    std::optional<bus::Utime> commanded;
  };
  Memory Remember() const { return {Report(), input_, commanded_}; }
  void Recall(const Memory& memory);

  /// The station sends something to it.
  void Send(bus::Utime now, const UplinkMessage& message) { uplink_.Send(now, message); }

  /// Before a step to `utime`: what arrives during the step counts from its beginning.
  void Hear(bus::Utime utime);
  /// After it. A fleet is moved all together (core/fleet_motion.h), so that is not done here.
  void ArriveAt(bus::Utime utime, const VehicleState& state);

  /// It sends its state; returns what the station hears from it at this moment, the newest if it hears
  /// several.
  std::optional<vehicle_state_t> Telemetry();

 private:
  void Obey(bus::Utime arrival, const FlightCommand& command);
  void Hold();
  vehicle_state_t Report() const;

  int id_;
  std::string callsign_;
  bool has_payload_;
  VehicleModel model_;  ///< as it really is
  config::UplinkLoss uplink_loss_;

  VehicleState state_;
  bus::Utime utime_;
  AutopilotInput input_;
  std::int64_t session_id_ = 0;          ///< of the last command obeyed
  std::int64_t sequence_ = 0;            ///< of the last command obeyed
  std::optional<bus::Utime> commanded_;  ///< when that arrived; empty while it holds on its own
  bool payload_on_ = false;

  VehicleLink<UplinkMessage> uplink_;
  VehicleLink<vehicle_state_t> downlink_;
  std::optional<vehicle_state_t> last_heard_;
};

}  // namespace skein::simulator
