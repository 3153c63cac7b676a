#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <skein/alarm_list_t.hpp>
#include <skein/fleet_roster_t.hpp>
#include <skein/fleet_state_t.hpp>
#include <skein/formation_status_t.hpp>
#include <skein/formation_t.hpp>
#include <skein/link_status_t.hpp>
#include <skein/path_t.hpp>
#include <skein/proximity_t.hpp>
#include <skein/recording_status_t.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.h"
#include "bus/command_outbox.h"

namespace skein::cli {

/// What the operator asked for cannot be had: refused, or nobody answers. what() is for the operator; exit
/// code 1.
class Failure : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The operator has ended it with Ctrl-C.
class Interrupted : public Failure {
  using Failure::Failure;
};

/// What is repeated at 1 Hz has come by then.
inline constexpr bus::Utime kLongestPeriod = 2'500'000;

inline constexpr const char* kSimulator = "fleet-simulator";

/// Tells what was done, and what the one who did it remarks.
void Done(std::ostream& out, const std::string& what, const std::string& remark);

/// Who commands, for people: "skein, ada".
std::string OperatorName();

/// What has been heard of the fleet since the start.
struct Picture {
  std::optional<fleet_roster_t> roster;
  std::optional<fleet_state_t> state;
  std::optional<proximity_t> proximity;
  std::optional<link_status_t> links;
  std::optional<alarm_list_t> alarms;
  std::optional<recording_status_t> recording;
  std::map<int, formation_t> formations;
  std::map<int, path_t> paths;
  std::map<int, formation_status_t> statuses;
};

/// The bus as one run of the skein command sees it: a picture of the fleet, and commands that wait for their
/// answer.
class Station {
 public:
  /// Runs the executor for a time. Returns false when the operator has ended it (SIGINT).
  using Run = std::function<bool(bus::Utime duration)>;

  Station(bus::Bus& bus, Run run);

  const Picture& picture() const { return picture_; }
  /// What its sender no longer repeats is unknown again, or gone; the roster stays.
  void ForgetWhatIsOld();
  bus::Bus& bus() { return bus_; }

  /// Runs until `seen` or until `limit` is over. Returns seen(). Throws Interrupted.
  bool WaitUntil(const std::function<bool()>& seen, bus::Utime limit);
  /// Throws Failure when no roster comes within its period and a margin.
  const fleet_roster_t& Roster();

  /// Sends a command until it is answered; again after one and two seconds, for a message may get lost.
  /// Returns the remark. Throws Failure when it is refused, or not answered within 3 s (`who` should have).
  template <typename Command>
  std::string Ask(const std::string& channel, Command command, const std::string& who) {
    answer_.reset();
    const auto keep = [this](const bus::Answer& answer) { answer_ = answer; };
    return WaitForAnswer(channel, outbox_.Send(channel, std::move(command), keep), who);
  }

  /// Sends commands that are to come into force together, without waiting for each answer before the next
  /// one. Nobody does one twice. Returns why those that were refused were, by their place. Throws Failure
  /// when one is not answered within 3 s.
  template <typename Command>
  std::map<std::size_t, std::string> AskAll(const std::string& channel, const std::vector<Command>& commands,
                                            const std::string& who) {
    const SendOne send = [&](std::size_t i, bus::CommandOutbox::Done done) {
      return outbox_.Send(channel, commands[i], std::move(done));
    };
    std::map<std::size_t, std::string> refusals;
    for (std::size_t begin = 0; begin < commands.size(); begin += kAtOnce) {
      WaitForAnswers({channel, who, send}, begin, std::min(begin + kAtOnce, commands.size()), refusals);
    }
    return refusals;
  }

 private:
  /// Whether a set of chunks of which some were lost is better than none.
  enum class Parts { kAll, kAny };
  template <typename Message>
  void KeepLast(const std::string& channel, std::optional<Message>& kept, Parts parts);
  template <typename Message>
  void Keep(std::map<int, Message>& kept, const Message& message);

  /// Well within what a receiver's buffer holds and CommandInbox remembers.
  static constexpr std::size_t kAtOnce = 50;

  /// Sends the command of that place. Returns the request_id.
  using SendOne = std::function<std::int64_t(std::size_t place, bus::CommandOutbox::Done done)>;
  struct Commands {
    const std::string& channel;
    const std::string& who;
    const SendOne& send;
  };
  void WaitForAnswers(const Commands& commands, std::size_t begin, std::size_t end,
                      std::map<std::size_t, std::string>& refusals);

  std::string WaitForAnswer(const std::string& channel, std::int64_t request_id, const std::string& who);

  bus::Bus& bus_;
  Run run_;
  Picture picture_;
  std::map<std::pair<const void*, int>, bus::Utime>
      heard_;  ///< when: a member of the picture, and of which formation
  bus::CommandOutbox outbox_;
  std::optional<bus::Answer> answer_;  ///< to the last command
};

}  // namespace skein::cli
