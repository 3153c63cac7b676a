#include "simulator/simulated_vehicle.h"

#include "bus/conversions.h"

namespace skein::simulator {
namespace {

/// A UAV that holds when its uplink is lost does so this long after its last command.
constexpr bus::Utime kHoldAfter = 1 * bus::kSecond;

/// A later controller is obeyed, and a sequence that has jumped is believed, when so long nothing fitting has
/// come: one false message neither takes a UAV over nor makes it deaf for what is true.
constexpr bus::Utime kSilence = bus::kSecond / 2;
constexpr std::int64_t kMostAhead = 100;

/// Seeds of different links must not be neighbours: they would draw the same numbers, shifted.
std::uint64_t LinkSeed(std::uint64_t seed, int vehicle_id, int direction) {
  LinkRandom random(seed ^ (static_cast<std::uint64_t>(vehicle_id) << 32) ^
                    static_cast<std::uint64_t>(direction));
  return static_cast<std::uint64_t>(random.Next() * 0x1p53) << 11;
}

VehicleModel ActualModel(const config::VehicleConfig& config) {
  VehicleModel model = config.model;
  if (config.actual) model.gains = *config.actual;
  return model;
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(const config::VehicleConfig& config, bus::Utime start, std::uint64_t seed)
    : id_(config.id),
      callsign_(config.callsign),
      has_payload_(config.has_payload),
      model_(ActualModel(config)),
      uplink_loss_(config.uplink_loss),
      state_(config.start),
      utime_(start),
      uplink_({LinkMode::kUp, config.uplink}, LinkSeed(seed, config.id, 0)),
      downlink_({LinkMode::kUp, config.downlink}, LinkSeed(seed, config.id, 1)) {
  Check(model_);
  Hold();
}

void SimulatedVehicle::Recall(const Memory& memory) {
  const vehicle_state_t& report = memory.report;
  state_ = bus::ToVehicleState(report);
  utime_ = report.utime;
  session_id_ = report.command_session_id;
  sequence_ = report.command_sequence;
  payload_on_ = report.payload_on != 0;
  input_ = memory.input;
  commanded_ = memory.commanded;
}

void SimulatedVehicle::Hear(bus::Utime utime) {
  uplink_.Receive(utime - 1, [this](bus::Utime arrival, const UplinkMessage& message) {
    if (const auto* command = std::get_if<FlightCommand>(&message)) {
      Obey(arrival, *command);
    } else {
      payload_on_ = std::get<PayloadSwitch>(message).on;
    }
  });
  if (uplink_loss_ == config::UplinkLoss::kHoldLevelAfterOneSecond && commanded_ &&
      utime_ - *commanded_ >= kHoldAfter) {
    Hold();
  }
}

void SimulatedVehicle::ArriveAt(bus::Utime utime, const VehicleState& state) {
  state_ = state;
  utime_ = utime;
}

void SimulatedVehicle::Obey(bus::Utime arrival, const FlightCommand& command) {
  const bool silence = !commanded_ || arrival - *commanded_ >= kSilence;
  if (command.session_id != session_id_) {
    if (command.session_id < session_id_ || !silence) return;
  } else if (command.sequence <= sequence_ || (command.sequence - sequence_ > kMostAhead && !silence)) {
    return;
  }
  session_id_ = command.session_id;
  sequence_ = command.sequence;
  input_ = command.input;
  commanded_ = arrival;
}

void SimulatedVehicle::Hold() {
  input_ = {state_.speed_m_s, state_.course_rad, 0};
  commanded_.reset();
}

std::optional<vehicle_state_t> SimulatedVehicle::Telemetry() {
  if (downlink_.setting().mode == LinkMode::kFrozen) return last_heard_;
  downlink_.Send(utime_, Report());
  std::optional<vehicle_state_t> heard;
  downlink_.Receive(utime_, [&heard](bus::Utime, const vehicle_state_t& report) {
    if (!heard || report.utime > heard->utime) heard = report;
  });
  if (heard) last_heard_ = heard;
  return heard;
}

vehicle_state_t SimulatedVehicle::Report() const {
  vehicle_state_t report = bus::ToMessage(state_);
  report.utime = utime_;
  report.id = id_;
  report.command_session_id = session_id_;
  report.command_sequence = sequence_;
  report.payload_on = payload_on_;
  return report;
}

}  // namespace skein::simulator
