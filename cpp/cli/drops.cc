#include "cli/drops.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <skein/event_t.hpp>
#include <skein/link_command_t.hpp>
#include <utility>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "cli/drop_commands.h"
#include "cli/drop_ledger.h"
#include "cli/drop_report.h"
#include "cli/drop_schedule.h"
#include "cli/vehicles.h"

namespace skein::cli {
namespace {

namespace channel = bus::channel;

constexpr bus::Utime kLook = 20'000;
constexpr bus::Utime kMonitorLimit = 3 * bus::kSecond;

/// Commands go ahead of their time, so that drops begin and end with the simulator's tick.
bus::Utime LeadOf(const fleet_roster_t& roster) {
  return bus::kSecond + 1'000 * static_cast<bus::Utime>(roster.vehicles.size());
}

class DropRun {
 public:
  DropRun(Station& station, const DropsOptions& options, std::ostream& out)
      : station_(station),
        options_(options),
        out_(out),
        scenario_start_(station.Roster().start_utime),
        lead_(options.hook.empty() ? LeadOf(station.Roster()) : 0),
        ledger_(options.limit_s) {
    bus::SubscribeChunks<link_status_t>(station.bus(), channel::kLinkStatus,
                                        [this](const link_status_t& status, int) { Hear(status); });
    station.bus().Subscribe<event_t>(channel::kEvent, [this](const event_t& event) { Hear(event); });
    if (!station.WaitUntil([this] { return heard_monitor_; }, kMonitorLimit)) {
      throw Failure("no LINK_STATUS was heard for 3 s: is collision-monitor running, and on this LCM URL?");
    }
  }

  void Run() {
    schedule_ = MakeSchedule(station_, options_, lead_);
    const bool is_endless = options_.repeat_s > 0 || (options_.random && options_.count == 0);
    try {
      Go();
    } catch (const Interrupted&) {
      Stop();
      Report();
      if (is_endless) return ThrowIfFailed();
      throw;
    } catch (...) {
      // What was found until then is worth as much.
      Stop();
      Report();
      throw;
    }
    Report();
    ThrowIfFailed();
  }

 private:
  struct Active {
    int number = 0;
    Drop drop;
    bus::Utime start = 0;
    bus::Utime end = 0;
    std::vector<int> ids{};  ///< of a hook's drop; none: nobody's link
  };

  bus::Utime Now() const { return station_.bus().executor().Now(); }
  bool HasHook() const { return !options_.hook.empty(); }

  void Go() {
    std::optional<Drop> next = schedule_.next();
    while (true) {
      while (next && schedule_.StartOf(*next) <= Now() + lead_) {
        Begin(*next);
        next = schedule_.next();
      }
      EndDue(Now() + lead_);
      SendQueued();
      if (!next && active_.empty() && manual_.empty() && ledger_.IsSettled(Now())) return;
      station_.WaitUntil([] { return false; }, kLook);
      if (restarted_) throw Failure("the fleet was started anew: the plan ends there");
    }
  }

  void Begin(const Drop& drop) {
    const int number = ++last_number_;
    const bus::Utime start = HasHook() ? Now() : schedule_.StartOf(drop);
    const bus::Utime end = start + bus::ToUtime(drop.for_s);
    const auto ids = VehiclesOf(station_, drop, options_);
    for (const int id : ids) {
      const bool judged = drop.downlink || !unjudged_.contains(id);
      ledger_.Begin(number, id, drop, start, judged);
    }
    Say(start,
        fmt::format("{} {}{} for {:g} s", ids.empty() ? drop.vehicle : Callsigns(station_.picture(), ids),
                    Words(drop), options_.random ? fmt::format(" (drop {})", number) : "", drop.for_s));
    if (HasHook()) {
      active_.push_back({number, drop, start, end, ids});
      CallHook(options_.hook, "begin", number, drop);
      return;
    }
    for (const int id : ids) {
      Drop of_one = drop;
      of_one.vehicle = std::to_string(id);
      const bool overlaps = std::any_of(active_.begin(), active_.end(), [&](const Active& other) {
        return other.drop.vehicle == of_one.vehicle && other.end >= start;
      });
      active_.push_back({number, of_one, start, end});
      if (overlaps) manual_.insert(id);
      if (overlaps || manual_.contains(id)) {
        QueueState(id, start);
      } else {
        queue_.push_back(LinkCommand(id, of_one.uplink, of_one.downlink, &of_one, start, drop.for_s));
      }
    }
  }

  void EndDue(bus::Utime until) {
    for (std::size_t i = 0; i < active_.size();) {
      const Active active = active_[i];
      if (active.end > until) {
        ++i;
        continue;
      }
      // One that fails is still under way, so that Stop() tries once more.
      if (HasHook()) CallHook(options_.hook, "end", active.number, active.drop);
      active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(i));
      if (HasHook()) {
        BeginAgainBeside(active, until);
        continue;
      }
      const int id = std::stoi(active.drop.vehicle);
      if (!manual_.contains(id)) continue;
      QueueState(id, active.end);
      const bool goes_on = std::any_of(active_.begin(), active_.end(), [&](const Active& other) {
        return other.drop.vehicle == active.drop.vehicle;
      });
      if (!goes_on) manual_.erase(id);
    }
  }

  /// The end of one drop lifted those that share its wire, too: a hook knows of one at a time.
  void BeginAgainBeside(const Active& ended, bus::Utime until) {
    for (const Active& active : active_) {
      const bool shares = std::ranges::find_first_of(active.ids, ended.ids) != active.ids.end() ||
                          (active.ids.empty() && ended.ids.empty());
      if (shares && active.end > until) CallHook(options_.hook, "begin", active.number, active.drop);
    }
  }

  /// What several drops make of a link together, from a moment on. The simulator's own going back after a
  /// time would go back to the wrong one of them.
  void QueueState(int id, bus::Utime at) {
    for (const bool is_up : {true, false}) {
      std::optional<Drop> worst;
      for (const Active& active : active_) {
        if (active.drop.vehicle != std::to_string(id) || active.start > at || active.end <= at) continue;
        if (is_up ? !active.drop.uplink : !active.drop.downlink) continue;
        if (!worst) worst = active.drop;
        worst->loss = std::max(worst->loss, active.drop.loss);
        worst->delay_s = std::max(worst->delay_s, active.drop.delay_s);
      }
      queue_.push_back(LinkCommand(id, is_up, !is_up, worst ? &*worst : nullptr, at, 0));
    }
  }

  /// All at once: one answer after the other would take longer than the lead of a large fleet.
  void SendQueued() {
    const auto commands = std::exchange(queue_, {});
    const auto refusals = station_.AskAll(channel::kCmdLink, commands, kSimulator);
    if (refusals.empty()) return;
    const auto& [first, reason] = *refusals.begin();
    throw Failure(
        fmt::format("{}: refused: {}", Callsign(station_.picture(), commands[first].vehicle_id), reason));
  }

  /// All links as they were; those that are still to be cut right after that.
  void Stop() {
    const bus::Utime now = Now();
    ledger_.Stop(now);
    std::set<int> ids;
    bus::Utime at = now;
    for (const Active& active : active_) {
      if (HasHook()) {
        EndWhatever(active);
      } else {
        ids.insert(std::stoi(active.drop.vehicle));
        at = std::max(at, active.start + 100'000);
      }
    }
    ids.insert(manual_.begin(), manual_.end());
    std::vector<link_command_t> commands;
    for (const int id : ids) commands.push_back(LinkCommand(id, true, true, nullptr, at, 0));
    try {
      for (const auto& [i, reason] : station_.AskAll(channel::kCmdLink, commands, kSimulator)) {
        Problem(Callsign(station_.picture(), commands[i].vehicle_id) +
                ": its link could not be restored: " + reason);
      }
    } catch (const std::exception& error) {
      Problem(fmt::format("not all links could be restored: {}", error.what()));
    }
  }

  /// That one wire cannot be restored hinders no other, nor hides why everything is stopped.
  void EndWhatever(const Active& active) {
    try {
      CallHook(options_.hook, "end", active.number, active.drop);
    } catch (const Failure& failure) {
      Problem(failure.what());
    }
  }

  void Hear(const link_status_t& status) {
    using Link = DropLedger::Link;
    heard_monitor_ = true;
    for (const auto& link : status.links) {
      if (link.uplink == link_status_t::LINK_UNKNOWN) {
        unjudged_.insert(link.id);
      } else {
        unjudged_.erase(link.id);
      }
      const auto is = [&](std::int8_t state) { return link.downlink == state || link.uplink == state; };
      const Link worst = is(link_status_t::LINK_LOST) || link.downlink == link_status_t::LINK_UNKNOWN
                             ? Link::kLost
                         : is(link_status_t::LINK_LATE) ? Link::kLate
                                                        : Link::kUp;
      const auto news = ledger_.Hear(link.id, worst, status.utime);
      const std::string name = Callsign(station_.picture(), link.id);
      if (news.found != nullptr) {
        Say(status.utime, fmt::format("{} found lost after {:.2f} s", name, *news.found->detection_s()));
      } else if (news.is_false) {
        Say(status.utime, name + " told lost, but nobody has cut its link");
      }
      if (news.back != nullptr) {
        Say(status.utime, fmt::format("{} up again {:.2f} s after its link came back", name,
                                      bus::ToSeconds(status.utime - news.back->end)));
      }
    }
  }

  void Hear(const event_t& event) {
    if (event.event_node != kSimulator) return;
    if (event.code == "simulation_started") restarted_ = true;
    if (event.code == "link_cut") ledger_.HearCut(event.vehicle_id, true, event.utime);
    if (event.code == "link_cut_ended") ledger_.HearCut(event.vehicle_id, false, event.utime);
  }

  void Say(bus::Utime utime, const std::string& text) {
    if (!options_.json)
      out_ << fmt::format("{:9.2f} s  {}\n", bus::ToSeconds(utime - scenario_start_), text) << std::flush;
  }

  /// Not on standard output, which may be the report as JSON.
  void Problem(const std::string& text) {
    fmt::print(stderr, "skein: {}\n", text);
    restored_ = false;
  }

  DropReport MakeReport() const {
    return {ledger_, options_.limit_s, Now(), scenario_start_,
            [this](int id) { return Callsign(station_.picture(), id); }};
  }

  void Report() {
    const DropReport report = MakeReport();
    out_ << (options_.json ? DropsAsJson(report) : DropSummary(report)) << std::flush;
  }

  void ThrowIfFailed() const {
    if (const int failures = Failures(MakeReport()); failures > 0) {
      throw Failure(fmt::format("{} drop{} missed or found after more than {:g} s", failures,
                                failures == 1 ? " was" : "s were", options_.limit_s));
    }
    if (!restored_) throw Failure("not all links are as they were");
  }

  Station& station_;
  const DropsOptions& options_;
  std::ostream& out_;
  bus::Utime scenario_start_;
  bus::Utime lead_;  ///< of commands; hooks have none
  DropSchedule schedule_;
  DropLedger ledger_;
  std::vector<Active> active_;  ///< begun or announced, not over
  std::set<int> manual_;        ///< UAVs with drops that overlap: every change is sent by itself
  std::set<int> unjudged_;      ///< UAVs whose uplink the monitor does not judge
  std::vector<link_command_t> queue_;
  int last_number_ = 0;
  bool heard_monitor_ = false;
  bool restarted_ = false;
  bool restored_ = true;  ///< everything, or nothing was to be
};

}  // namespace

void RunDrops(Station& station, const DropsOptions& options, std::ostream& out) {
  DropRun(station, options, out).Run();
}

}  // namespace skein::cli
