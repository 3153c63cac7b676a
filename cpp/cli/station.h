#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
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
  bus::Bus& bus() { return bus_; }

  /// Runs until `seen` or until `limit` is over. Returns seen(). Throws Interrupted.
  bool WaitUntil(const std::function<bool()>& seen, bus::Utime limit);
  /// Throws Failure when no roster comes within its period and a margin.
  const fleet_roster_t& Roster();

  /// Sends a command until it is answered; again after one and two seconds, for a message may get lost.
  /// Returns the remark. Throws Failure when it is refused, or not answered within 3 s (`who` should have).
  template <typename Command>
  std::string Ask(const std::string& channel, Command command, const std::string& who) {
    const bus::Answer answer = AnswerTo(channel, std::move(command), who);
    if (!answer.accepted) throw Failure("refused: " + answer.reason);
    return answer.reason;
  }

  /// Sends commands that are to come into force together, without waiting for each answer before the next
  /// one. Doing one of them twice must do no harm. Returns why those that were refused were, by their place.
  /// Throws Failure when one is not answered within 3 s.
  template <typename Command>
  std::map<std::size_t, std::string> AskAll(const std::string& channel, const std::vector<Command>& commands,
                                            const std::string& who) {
    std::map<std::size_t, std::string> refusals;
    for (std::size_t begin = 0; begin < commands.size(); begin += kAtOnce) {
      const std::size_t end = std::min(begin + kAtOnce, commands.size());
      const auto accepted = std::make_shared<std::map<std::size_t, bool>>();
      std::vector<std::int64_t> request_ids;
      for (std::size_t i = begin; i < end; ++i) {
        request_ids.push_back(outbox_.Send(channel, commands[i], [accepted, i](const bus::Answer& answer) {
          (*accepted)[i] = answer.accepted;
        }));
      }
      WaitUntil([&] { return accepted->size() == end - begin; }, kRepeat);
      for (const std::int64_t request_id : request_ids) outbox_.Forget(request_id);
      // The number of one that was lost is too old by now, so it needs another one; and those behind it are
      // to come after it.
      std::size_t first = begin;
      while (first < end && (*accepted)[first]) ++first;
      for (std::size_t i = first; i < end; ++i) {
        const bus::Answer answer = AnswerTo(channel, commands[i], who);
        if (!answer.accepted) refusals[i] = answer.reason;
      }
    }
    return refusals;
  }

 private:
  /// Well within what a receiver's buffer holds and CommandInbox remembers.
  static constexpr std::size_t kAtOnce = 50;
  static constexpr bus::Utime kRepeat = bus::kSecond;

  template <typename Command>
  bus::Answer AnswerTo(const std::string& channel, Command command, const std::string& who) {
    answer_.reset();
    const auto keep = [this](const bus::Answer& answer) { answer_ = answer; };
    return WaitForAnswer(channel, outbox_.Send(channel, std::move(command), keep), who);
  }
  bus::Answer WaitForAnswer(const std::string& channel, std::int64_t request_id, const std::string& who);

  bus::Bus& bus_;
  Run run_;
  Picture picture_;
  bus::CommandOutbox outbox_;
  std::optional<bus::Answer> answer_;  ///< to the last command
};

}  // namespace skein::cli
