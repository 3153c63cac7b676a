#include "cli/station.h"

#include <cstdlib>
#include <memory>
#include <set>

#include "bus/channels.h"
#include "bus/chunks.h"

namespace skein::cli {
namespace {

namespace channel = bus::channel;

constexpr bus::Utime kLook = 20'000;  // how often a wait looks at what has come
constexpr bus::Utime kRepeat = bus::kSecond;
constexpr int kTries = 3;
// Of many commands, so that one that was lost still comes before its time.
constexpr bus::Utime kRepeatOfMany = 3 * bus::kSecond / 10;
constexpr int kTriesOfMany = 10;
constexpr bus::Utime kRosterLimit = 3 * bus::kSecond;

Failure NotAnswered(const std::string& channel, const std::string& who) {
  return Failure("nobody answered " + channel + " for 3 s: is " + who + " running, and on this LCM URL?");
}

}  // namespace

void Done(std::ostream& out, const std::string& what, const std::string& remark) {
  out << what << (remark.empty() ? "" : ": " + remark) << '\n';
}

std::string OperatorName() {
  const char* user = std::getenv("USER");
  return user && *user ? std::string("skein, ") + user : "skein";
}

Station::Station(bus::Bus& bus, Run run) : bus_(bus), run_(std::move(run)), outbox_(bus) {
  KeepLast<fleet_roster_t>(channel::kFleetRoster, picture_.roster, Parts::kAll);
  KeepLast<fleet_state_t>(channel::kFleetState, picture_.state, Parts::kAny);
  KeepLast<proximity_t>(channel::kProximity, picture_.proximity, Parts::kAny);
  KeepLast<link_status_t>(channel::kLinkStatus, picture_.links, Parts::kAny);
  KeepLast<alarm_list_t>(channel::kAlarms, picture_.alarms, Parts::kAll);
  bus::SubscribeChunks<formation_status_t>(
      bus, channel::kFormationStatus,
      [this](const formation_status_t& status, int) { Keep(picture_.statuses, status); });
  bus.Subscribe<formation_t>(channel::kFormation,
                             [this](const formation_t& formation) { Keep(picture_.formations, formation); });
  bus.Subscribe<path_t>(channel::kPath, [this](const path_t& path) { Keep(picture_.paths, path); });
  bus.Subscribe<recording_status_t>(channel::kRecording, [this](const recording_status_t& status) {
    picture_.recording = status;
    heard_[{&picture_.recording, 0}] = bus_.executor().Now();
  });
}

template <typename Message>
void Station::KeepLast(const std::string& channel, std::optional<Message>& kept, Parts parts) {
  bus::SubscribeChunks<Message>(bus_, channel, [this, &kept, parts](const Message& message, int missing) {
    if (missing > 0 && parts == Parts::kAll) return;
    kept = message;
    heard_[{&kept, 0}] = bus_.executor().Now();
  });
}

template <typename Message>
void Station::Keep(std::map<int, Message>& kept, const Message& message) {
  kept[message.formation_id] = message;
  heard_[{&kept, message.formation_id}] = bus_.executor().Now();
}

void Station::ForgetWhatIsOld() {
  const auto is_old = [&](const void* what, int formation_id) {
    const auto heard = heard_.find({what, formation_id});
    return heard == heard_.end() || bus_.executor().Now() - heard->second > kLongestPeriod;
  };
  const auto forget = [&](auto& kept) {
    if (is_old(&kept, 0)) kept.reset();
  };
  const auto forget_each = [&](auto& kept) {
    std::erase_if(kept, [&](const auto& entry) { return is_old(&kept, entry.first); });
  };
  forget(picture_.state);
  forget(picture_.proximity);
  forget(picture_.links);
  forget(picture_.alarms);
  forget(picture_.recording);
  forget_each(picture_.formations);
  forget_each(picture_.paths);
  forget_each(picture_.statuses);
  std::erase_if(heard_, [&](const auto& entry) { return is_old(entry.first.first, entry.first.second); });
}

bool Station::WaitUntil(const std::function<bool()>& seen, bus::Utime limit) {
  const bus::Utime end = bus_.executor().Now() + limit;
  while (!seen() && bus_.executor().Now() < end) {
    if (!run_(kLook)) throw Interrupted("interrupted");
  }
  return seen();
}

const fleet_roster_t& Station::Roster() {
  if (!WaitUntil([this] { return picture_.roster.has_value(); }, kRosterLimit)) {
    throw Failure("no fleet was heard for 3 s: is fleet-simulator running, and on this LCM URL?");
  }
  return *picture_.roster;
}

void Station::WaitForAnswers(const Commands& commands, std::size_t begin, std::size_t end,
                             std::map<std::size_t, std::string>& refusals) {
  // Shared with who may answer later, when this was interrupted.
  const auto answers = std::make_shared<std::map<std::size_t, bus::Answer>>();
  std::map<std::size_t, std::int64_t> request_ids;
  std::set<std::size_t> repeated;
  const auto send = [&](std::size_t i) {
    request_ids[i] =
        commands.send(i, [answers, i](const bus::Answer& answer) { answers->insert_or_assign(i, answer); });
  };
  for (std::size_t i = begin; i < end; ++i) send(i);
  bool is_over = false;
  for (int tries = 1; !is_over; ++tries) {
    is_over = WaitUntil([&] { return answers->size() == end - begin; }, kRepeatOfMany);
    if (!is_over && tries >= kTriesOfMany) break;
    for (std::size_t i = begin; i < end; ++i) {
      const auto answer = answers->find(i);
      if (answer == answers->end()) {
        outbox_.Repeat(request_ids[i]);
        repeated.insert(i);
      } else if (!answer->second.accepted && repeated.erase(i) > 0) {
        // One that was lost on its way is too old once others of the session were obeyed: under this number
        // it never will be.
        answers->erase(answer);
        send(i);
        is_over = false;
      }
    }
  }
  for (const auto& [i, request_id] : request_ids) outbox_.Forget(request_id);
  if (!is_over) throw NotAnswered(commands.channel, commands.who);
  for (const auto& [i, answer] : *answers) {
    if (!answer.accepted) refusals[i] = answer.reason;
  }
}

std::string Station::WaitForAnswer(const std::string& channel, std::int64_t request_id,
                                   const std::string& who) {
  const auto answered = [this] { return answer_.has_value(); };
  for (int tries = 1; !WaitUntil(answered, kRepeat) && tries < kTries; ++tries) outbox_.Repeat(request_id);
  if (!answered()) {
    outbox_.Forget(request_id);
    throw NotAnswered(channel, who);
  }
  if (!answer_->accepted) throw Failure("refused: " + answer_->reason);
  return answer_->reason;
}

}  // namespace skein::cli
