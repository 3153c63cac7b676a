#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <skein/fleet_roster_t.hpp>
#include <skein/recording_command_t.hpp>
#include <skein/recording_status_t.hpp>
#include <string>

#include "bus/bus.h"
#include "bus/command_inbox.h"
#include "bus/events.h"
#include "bus/live_executor.h"
#include "recorder/logger_process.h"
#include "recorder/recording.h"
#include "recorder/recording_folder.h"

namespace skein::recorder {

struct FlightRecorderOptions {
  std::filesystem::path folder;            ///< for recordings
  std::string lcm_url;                     ///< of the bus, for lcm-logger
  std::int64_t split_bytes = 256'000'000;  ///< a part that is so long is followed by another one
  Room room;
  std::string scenario;  ///< its name before a roster is heard, "" when not known
  /// A scenario's name as the beginning of a file name.
  std::function<std::string(const std::string& scenario)> stem_of = FileStem;
};

/// Has lcm-logger record the bus, and says on it whether that goes well. Hears FLEET_ROSTER, CMD_RECORDING.
/// Sends RECORDING, EVENT, ACK.
///
/// It records from its start until an operator stops it. "Recording" means that the file grows: nothing else
/// is believed, not even that lcm-logger runs.
class FlightRecorderNode {
 public:
  FlightRecorderNode(bus::Bus& bus, bus::LiveExecutor& executor, FlightRecorderOptions options);
  ~FlightRecorderNode();
  FlightRecorderNode(const FlightRecorderNode&) = delete;
  FlightRecorderNode& operator=(const FlightRecorderNode&) = delete;

 private:
  void HearRoster(const fleet_roster_t& roster);
  bus::Answer Obey(const recording_command_t& command);
  bus::Answer Start();
  bus::Answer Stop(const std::string& by);
  bus::Answer Mark(const std::string& text);

  /// Ten times a second: whether what ought to be written is written.
  void Look();
  /// Once a second: whether there is room.
  void Tend();
  void Publish();

  void StartLogger();
  void LoggerEnded(const std::string& how);
  /// It ought to record and does not: says so, once for each code.
  void Interrupt(const std::string& code, const std::string& reason);
  /// lcm-logger has written into a part for the first time.
  void PartBegun();
  void NextPart();
  /// Names the recording after the fleet that is heard; another scenario is another recording.
  void FollowScenario();
  std::unique_ptr<Recording> NewRecording();
  /// @param why as people are told it.
  void TellEnd(const std::string& why);

  void MakeRoomNow();
  void TellOfRemoval(const Removal& removal);
  void TellWhenDiskIsLow();
  bool HasRoom(std::int64_t margin_bytes) const;
  std::string DiskFullText() const;

  bus::Utime Now() const { return bus_.executor().Now(); }

  bus::Bus& bus_;
  bus::LiveExecutor& executor_;
  bus::Events events_;
  bus::CommandInbox inbox_;
  FlightRecorderOptions options_;
  std::filesystem::path link_folder_;

  std::string scenario_;                       ///< for the name of the next recording
  std::int64_t fleet_session_ = 0;             ///< of the newest fleet that was heard
  std::optional<std::string> fleet_scenario_;  ///< and what it flies; none: no fleet yet
  std::optional<std::string> followed_;        ///< the same, as this recording has it

  bool wanted_ = false;            ///< by the operator
  bool start_when_ended_ = false;  ///< wanted again while lcm-logger still writes the last of a recording
  recording_status_t status_;
  std::unique_ptr<Recording> recording_;
  std::unique_ptr<Recording> last_recording_;  ///< until lcm-logger has let go of it
  std::unique_ptr<LoggerProcess> logger_;
  bus::Utime logger_started_ = 0;
  std::int64_t grown_to_ = 0;  ///< the part of the moment [B]
  bus::Utime grown_at_ = 0;
  bool told_begin_ = false;        ///< of this recording
  bus::Utime interrupted_at_ = 0;  ///< 0: it is not
  std::string interrupted_code_;   ///< "": nothing was told of it
  bool told_low_ = false;
  bool told_over_quota_ = false;
};

}  // namespace skein::recorder
