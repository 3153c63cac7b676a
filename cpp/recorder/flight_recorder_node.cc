#include "recorder/flight_recorder_node.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <skein/event_t.hpp>
#include <system_error>
#include <thread>
#include <utility>

#include "bus/channels.h"
#include "bus/transport.h"

namespace skein::recorder {
namespace {

namespace fs = std::filesystem;

constexpr bus::Utime kLookPeriod = bus::kSecond / 10;
constexpr bus::Utime kTendPeriod = bus::kSecond;
// RECORDING comes once a second, so a file that lcm-logger writes grows.
constexpr bus::Utime kStall = 3 * bus::kSecond;
// One that ends sooner than this is started again with the next Tend().
constexpr bus::Utime kLivedLong = bus::kSecond;
// So that what is told last is in the recording: lcm-logger flushes its file every 100 ms.
constexpr bus::Utime kLastWords = 150'000;
constexpr int kTendsPerTidying = 10;
constexpr std::size_t kLongestMarker = 200;
constexpr const char* kInterrupted = "recording_interrupted";
constexpr const char* kDiskFull = "disk_full";

fs::path MakeLinkFolder() {
  std::string name = (fs::temp_directory_path() / "skein-recorder-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw bus::StartError("no folder for a symbolic link can be made in " +
                          fs::temp_directory_path().string());
  }
  return name;
}

std::string Megabytes(std::int64_t bytes) {
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) * 1e-6);
}
std::string Gigabytes(std::int64_t bytes) {
  return fmt::format("{:.3g} GB", static_cast<double>(bytes) * 1e-9);
}

std::size_t Characters(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }));
}

}  // namespace

FlightRecorderNode::FlightRecorderNode(bus::Bus& bus, bus::LiveExecutor& executor,
                                       FlightRecorderOptions options)
    : bus_(bus),
      executor_(executor),
      events_(bus),
      inbox_(bus),
      options_(std::move(options)),
      link_folder_(MakeLinkFolder()),
      scenario_(options_.scenario) {
  options_.folder = fs::absolute(options_.folder).lexically_normal();
  status_.session_id = bus_.session_id();
  status_.folder = options_.folder.string();
  bus_.Subscribe<fleet_roster_t>(bus::channel::kFleetRoster,
                                 [this](const fleet_roster_t& roster) { HearRoster(roster); });
  inbox_.Obey<recording_command_t>(bus::channel::kCmdRecording,
                                   [this](const recording_command_t& command) { return Obey(command); });
  Start();
  bus_.executor().Every(kLookPeriod, [this] { Look(); });
  bus_.executor().Every(kTendPeriod, [this, tends = 0]() mutable {
    if (++tends % kTendsPerTidying == 0) MakeRoomNow();
    Tend();
  });
}

FlightRecorderNode::~FlightRecorderNode() {
  if (logger_ && status_.state == recording_status_t::RECORDING) {
    TellEnd("flight-recorder ends");
    std::this_thread::sleep_for(std::chrono::microseconds(kLastWords));
    Publish();
  }
  logger_.reset();
  // What lcm-logger wrote last is to be on the card, too.
  if (recording_) recording_->Look();
  std::error_code ignored;
  fs::remove_all(link_folder_, ignored);
}

void FlightRecorderNode::HearRoster(const fleet_roster_t& roster) {
  // Of two fleets on one bus the one that began later counts, or each would be a new recording in turn.
  if (roster.session_id < fleet_session_) return;
  fleet_session_ = roster.session_id;
  fleet_scenario_ = roster.scenario;
}

bus::Answer FlightRecorderNode::Obey(const recording_command_t& command) {
  switch (command.action) {
    case recording_command_t::ACTION_START:
      return Start();
    case recording_command_t::ACTION_STOP:
      return Stop(command.operator_name);
    default:
      return Mark(command.text);
  }
}

bus::Answer FlightRecorderNode::Start() {
  if (wanted_) return bus::Answer::Accepted(status_.reason.empty() ? "it records already" : status_.reason);
  if (logger_) {
    start_when_ended_ = true;
    return bus::Answer::Accepted("it starts as soon as the last recording is ended");
  }
  wanted_ = true;
  told_begin_ = false;
  followed_.reset();
  status_.state = recording_status_t::INTERRUPTED;
  status_.reason = "starting";
  StartLogger();
  return bus::Answer::Accepted(interrupted_at_ != 0 ? status_.reason : "");
}

bus::Answer FlightRecorderNode::Stop(const std::string& by) {
  start_when_ended_ = false;
  if (!wanted_) return bus::Answer::Accepted("it was not recording");
  wanted_ = false;
  TellEnd(by.empty() ? "stopped by an operator" : "stopped by " + by);
  if (!logger_) {
    recording_.reset();
    return bus::Answer::Accepted();
  }
  grown_at_ = Now();
  bus_.executor().At(Now() + kLastWords, [this] {
    if (wanted_ || !logger_) return;
    Publish();
    logger_->End();
  });
  return bus::Answer::Accepted();
}

bus::Answer FlightRecorderNode::Mark(const std::string& text) {
  std::string line = text;
  std::ranges::replace_if(
      line, [](char letter) { return letter == '\n' || letter == '\t'; }, ' ');
  line.erase(0, line.find_first_not_of(' '));
  if (line.empty()) return bus::Answer::Refused("a marker needs a text");
  if (Characters(line) > kLongestMarker) {
    return bus::Answer::Refused(fmt::format("a marker is at most {} characters long", kLongestMarker));
  }
  events_.Tell(event_t::INFO, "marker", line);
  if (status_.state == recording_status_t::RECORDING) return bus::Answer::Accepted();
  return bus::Answer::Accepted("told to everybody, but nothing is recorded now: " + status_.reason);
}

void FlightRecorderNode::TellEnd(const std::string& why) {
  if (recording_ && told_begin_) {
    events_.Tell(event_t::INFO, "recording_stopped",
                 fmt::format("{}: {}, {}", why, recording_->name(), Megabytes(recording_->bytes())));
  }
  interrupted_at_ = 0;
  interrupted_code_.clear();
  status_.state = recording_status_t::STOPPED;
  status_.reason = why;
  Publish();
}

void FlightRecorderNode::StartLogger() {
  std::error_code error;
  fs::create_directories(options_.folder, error);
  if (error && error != std::errc::no_space_on_device) {
    return Interrupt(kInterrupted, "there is no folder " + options_.folder.string() +
                                       ", and it cannot be made: " + error.message());
  }
  MakeRoomNow();
  // At the start, anything above what is to be kept free will do.
  if (!HasRoom(interrupted_at_ != 0 ? RoomToBegin(options_.folder) : 0)) {
    Interrupt(kDiskFull, DiskFullText());
    return;
  }
  logger_started_ = Now();
  try {
    if (!recording_) recording_ = NewRecording();
    recording_->NextPart();
    grown_to_ = 0;
    grown_at_ = Now();
    logger_ = std::make_unique<LoggerProcess>(executor_, options_.lcm_url, recording_->way_in(),
                                              [this](const std::string& how) { LoggerEnded(how); });
  } catch (const std::system_error& error) {
    Interrupt(error.code() == std::errc::no_space_on_device ? kDiskFull : kInterrupted, error.what());
  }
}

std::unique_ptr<Recording> FlightRecorderNode::NewRecording() {
  return std::make_unique<Recording>(options_.folder, options_.stem_of(scenario_),
                                     Card{scenario_, Now(), options_.lcm_url, {}}, link_folder_ / "now.lcm");
}

void FlightRecorderNode::LoggerEnded(const std::string& how) {
  logger_.reset();
  last_recording_.reset();
  recording_->Look();
  if (!wanted_) {
    Publish();
    recording_.reset();
    if (std::exchange(start_when_ended_, false)) Start();
    return;
  }
  // It may have failed before the very last byte of the disk was taken.
  if (interrupted_code_ == kDiskFull || !HasRoom(RoomToBegin(options_.folder))) {
    Interrupt(kDiskFull, DiskFullText());
    return;
  }
  Interrupt(kInterrupted, "lcm-logger " + how);
  if (Now() - logger_started_ >= kLivedLong) StartLogger();
}

void FlightRecorderNode::Interrupt(const std::string& code, const std::string& reason) {
  if (interrupted_at_ == 0) interrupted_at_ = Now();
  if (interrupted_code_ != code) events_.Tell(event_t::CAUTION, code, "not recording: " + reason);
  interrupted_code_ = code;
  status_.state = recording_status_t::INTERRUPTED;
  status_.reason = reason;
  Publish();
}

void FlightRecorderNode::Look() {
  if (!recording_ || !logger_) return;
  recording_->Look();
  if (recording_->part_bytes() > grown_to_) {
    const bool begun = grown_to_ == 0;
    grown_to_ = recording_->part_bytes();
    grown_at_ = Now();
    if (begun && wanted_) PartBegun();
  } else if (Now() - grown_at_ > kStall) {
    if (wanted_) Interrupt(kInterrupted, "lcm-logger has written nothing for 3 s");
    grown_at_ = Now();
    logger_->Kill();
    return;
  }
  if (!wanted_) return;
  if (status_.state != recording_status_t::RECORDING) {
    Publish();  // something to write, so that it is known soon whether it is written
  } else if (grown_to_ > 0) {
    FollowScenario();
    if (recording_->part_bytes() >= options_.split_bytes) NextPart();
  }
}

void FlightRecorderNode::PartBegun() {
  last_recording_.reset();
  if (!told_begin_) {
    events_.Tell(event_t::INFO, "recording_started", "recording to " + recording_->name());
  } else if (interrupted_at_ != 0) {
    events_.Tell(event_t::INFO, "recording_resumed",
                 fmt::format("recording again, to {}, after {:.1f} s", recording_->part(),
                             bus::ToSeconds(Now() - interrupted_at_)));
  }
  told_begin_ = true;
  interrupted_at_ = 0;
  interrupted_code_.clear();
  status_.state = recording_status_t::RECORDING;
  status_.reason.clear();
  Publish();
}

void FlightRecorderNode::NextPart() {
  grown_to_ = 0;
  grown_at_ = Now();
  try {
    recording_->NextPart();
  } catch (const std::system_error& error) {
    spdlog::error("the next part cannot be begun: {}", error.what());  // nothing grows: it is started anew
  }
  logger_->OpenAgain();
  Publish();  // lcm-logger goes on to the new part with the next message
  MakeRoomNow();
}

void FlightRecorderNode::FollowScenario() {
  if (!fleet_scenario_ || fleet_scenario_ == followed_) return;
  const bool first_fleet = !std::exchange(followed_, fleet_scenario_);
  scenario_ = *fleet_scenario_;
  try {
    if (!first_fleet) {
      auto next = NewRecording();
      last_recording_ = std::exchange(recording_, std::move(next));
      told_begin_ = false;
      NextPart();
    } else if (recording_->card().scenario != scenario_) {
      recording_->Rename(options_.stem_of(scenario_), scenario_);
      Publish();
    }
  } catch (const std::system_error& error) {
    spdlog::error("the recording cannot be named after {}: {}", scenario_, error.what());
  }
}

void FlightRecorderNode::Tend() {
  if (wanted_ && !logger_) {
    StartLogger();
  } else if (status_.state == recording_status_t::RECORDING) {
    if (!HasRoom(0)) MakeRoomNow();
    if (!HasRoom(0)) {
      Interrupt(kDiskFull, DiskFullText());
      logger_->End();
    }
    TellWhenDiskIsLow();
  }
  Publish();
}

void FlightRecorderNode::Publish() {
  status_.utime = Now();
  if (recording_) {
    status_.recording = recording_->name();
    status_.part = recording_->part();
    status_.started_utime = recording_->card().start_utime;
    status_.parts = recording_->parts();
    status_.bytes = recording_->bytes();
  }
  status_.free_bytes = FreeBytes(options_.folder).value_or(-1);
  bus_.Publish(bus::channel::kRecording, status_);
}

bool FlightRecorderNode::HasRoom(std::int64_t margin_bytes) const {
  const auto free_bytes = FreeBytes(options_.folder);
  return !free_bytes || *free_bytes > options_.room.keep_free_bytes + margin_bytes;
}

std::string FlightRecorderNode::DiskFullText() const {
  return fmt::format("disk full: {} are free for {}, and {} are kept free",
                     Gigabytes(FreeBytes(options_.folder).value_or(0)), options_.folder.string(),
                     Gigabytes(options_.room.keep_free_bytes));
}

void FlightRecorderNode::TellWhenDiskIsLow() {
  const std::int64_t keep_free = options_.room.keep_free_bytes;
  const std::int64_t free_bytes = FreeBytes(options_.folder).value_or(2 * keep_free);
  if (free_bytes < 2 * keep_free && !told_low_) {
    events_.Tell(event_t::ADVISORY, "disk_low",
                 fmt::format("{} are free for {}; recording ends when {} are left", Gigabytes(free_bytes),
                             options_.folder.string(), Gigabytes(keep_free)));
    told_low_ = true;
  }
  // Not again and again when it goes up and down a little.
  if (free_bytes > 2 * keep_free + RoomToBegin(options_.folder)) told_low_ = false;
}

void FlightRecorderNode::MakeRoomNow() {
  Room room = options_.room;
  if (interrupted_at_ != 0) room.keep_free_bytes += RoomToBegin(options_.folder);
  const Removal removal = MakeRoom(options_.folder, room);
  TellOfRemoval(removal);
}

void FlightRecorderNode::TellOfRemoval(const Removal& removal) {
  if (!removal.files.empty()) {
    std::string text = fmt::format("removed the oldest recordings to make room: {} files, {}: {}",
                                   removal.files.size(), Megabytes(removal.bytes), removal.files.front());
    if (removal.files.size() > 1) text += " to " + removal.files.back();
    events_.Tell(event_t::INFO, "recordings_removed", text);
  }
  if (removal.over_quota && !told_over_quota_) {
    events_.Tell(event_t::ADVISORY, "recordings_over_quota",
                 fmt::format("the running recording alone is larger than the quota of {}; it goes on",
                             Gigabytes(options_.room.quota_bytes)));
  }
  told_over_quota_ = removal.over_quota;
}

}  // namespace skein::recorder
