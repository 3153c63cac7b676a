#include "cli/drops.h"

#include <spawn.h>
#include <spdlog/fmt/fmt.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <functional>
#include <set>
#include <skein/event_t.hpp>
#include <skein/link_command_t.hpp>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "cli/drop_report.h"
#include "cli/vehicles.h"
#include "config/scenario.h"

extern char** environ;  // NOLINT: of POSIX

namespace skein::cli {
namespace {

namespace channel = bus::channel;

constexpr const char* kSimulator = "fleet-simulator";
constexpr bus::Utime kLook = 20'000;
// Commands go ahead of their time, so that drops begin and end with the simulator's tick.
constexpr bus::Utime kLead = bus::kSecond;
constexpr bus::Utime kMonitorLimit = 3 * bus::kSecond;

/// The drops of a plan in order of time; none after the last.
using NextDrop = std::function<std::optional<Drop>()>;

NextDrop FromList(std::vector<Drop> drops, double repeat_s) {
  return [drops = std::move(drops), repeat_s, index = std::size_t{0},
          round = 0]() mutable -> std::optional<Drop> {
    if (index == drops.size()) {
      if (repeat_s <= 0) return std::nullopt;
      index = 0;
      ++round;
    }
    Drop drop = drops[index++];
    drop.at_s += round * repeat_s;
    return drop;
  };
}

NextDrop FromRandom(RandomPlan plan, int count) {
  return [plan = std::move(plan), count, made = 0]() mutable -> std::optional<Drop> {
    return count > 0 && made++ >= count ? std::nullopt : std::optional(plan.Next());
  };
}

void CallHook(const std::string& hook, const char* what, int number, const Drop& drop) {
  std::vector<std::string> words{hook,
                                 what,
                                 std::to_string(number),
                                 drop.vehicle,
                                 Direction(drop),
                                 fmt::format("{:g}", drop.loss),
                                 fmt::format("{:g}", drop.delay_s)};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t pid = 0;
  const int error = posix_spawnp(&pid, hook.c_str(), nullptr, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw Failure(hook + ": cannot be run: " + std::strerror(error));
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0) throw Failure(fmt::format("{} {} failed (status {:#x})", hook, what, status));
}

class DropRun {
 public:
  DropRun(Station& station, const DropsOptions& options, std::ostream& out)
      : station_(station),
        options_(options),
        out_(out),
        scenario_start_(station.Roster().start_utime),
        ledger_(options.limit_s) {
    bus::SubscribeChunks<link_status_t>(station.bus(), channel::kLinkStatus,
                                        [this](const link_status_t& status, int) { Hear(status); });
    station.bus().Subscribe<event_t>(channel::kEvent, [this](const event_t& event) { Hear(event); });
    if (!station.WaitUntil([this] { return heard_monitor_; }, kMonitorLimit)) {
      throw Failure("no LINK_STATUS was heard for 3 s: is collision-monitor running, and on this LCM URL?");
    }
  }

  void Run() {
    const NextDrop next_drop = MakePlan();
    const bool is_endless = options_.repeat_s > 0 || (options_.random && options_.count == 0);
    try {
      Go(next_drop);
    } catch (const Interrupted&) {
      Stop();
      Report();
      if (!is_endless) throw;
      return;
    } catch (...) {
      Stop();
      throw;
    }
    Report();
  }

 private:
  struct Active {
    int number = 0;
    Drop drop;
    bus::Utime start = 0;
    bus::Utime end = 0;
  };

  bus::Utime Now() const { return station_.bus().executor().Now(); }
  bool HasHook() const { return !options_.hook.empty(); }

  NextDrop MakePlan() {
    base_ = Now() + (HasHook() ? 0 : kLead);
    if (options_.random) {
      std::vector<int> vehicles = FindVehicles(station_, options_.vehicles);
      if (vehicles.empty()) vehicles = AllVehicles();
      if (vehicles.empty()) throw Failure("there are no UAVs");
      return FromRandom(RandomPlan(options_.random_drops, std::move(vehicles)), options_.count);
    }
    std::vector<Drop> drops;
    if (!options_.file.empty()) {
      drops = ReadDrops(options_.file);
      if (!options_.from_now) base_ = scenario_start_;
    } else {
      if (options_.at_s >= 0) base_ = scenario_start_;
      for (const std::string& vehicle : options_.vehicles) {
        Drop drop{.at_s = std::max(0.0, options_.at_s), .vehicle = vehicle, .for_s = options_.for_s};
        SetDirection(drop, options_.direction, "--direction");
        drop.delay_s = options_.delay_s;
        drop.loss = options_.loss >= 0 ? options_.loss : options_.delay_s > 0 ? 0 : 1;
        drops.push_back(drop);
      }
    }
    for (const Drop& drop : drops) VehiclesOf(drop);
    if (StartOf(drops.front()) < Now()) {
      throw Failure(fmt::format("{:g} s of the scenario have passed: it is {:.0f} s{}", drops.front().at_s,
                                bus::ToSeconds(Now() - scenario_start_),
                                options_.file.empty() ? "" : "; --from-now counts from now"));
    }
    return FromList(std::move(drops), options_.repeat_s);
  }

  std::vector<int> AllVehicles() {
    std::vector<int> ids;
    for (const auto& vehicle : station_.Roster().vehicles) ids.push_back(vehicle.id);
    return ids;
  }

  std::vector<int> VehiclesOf(const Drop& drop) {
    if (drop.vehicle == "all") return AllVehicles();
    if (drop.vehicle == "none" && HasHook()) return {};
    return FindVehicles(station_, {drop.vehicle});
  }

  bus::Utime StartOf(const Drop& drop) const { return base_ + bus::ToUtime(drop.at_s); }

  void Go(const NextDrop& next_drop) {
    const bus::Utime lead = HasHook() ? 0 : kLead;
    std::optional<Drop> next = next_drop();
    while (true) {
      while (next && StartOf(*next) <= Now() + lead) {
        Begin(*next);
        next = next_drop();
      }
      EndDue(Now() + lead);
      if (!next && active_.empty() && manual_.empty() && ledger_.IsSettled(Now())) return;
      station_.WaitUntil([] { return false; }, kLook);
      if (restarted_) throw Failure("the fleet was started anew: the plan ends there");
    }
  }

  void Begin(const Drop& drop) {
    const int number = ++last_number_;
    const bus::Utime start = HasHook() ? Now() : StartOf(drop);
    const bus::Utime end = start + bus::ToUtime(drop.for_s);
    const auto ids = VehiclesOf(drop);
    for (const int id : ids) {
      const bool judged = drop.downlink || !unjudged_.contains(id);
      ledger_.Begin(number, id, drop, start, judged);
    }
    Say(start, fmt::format("{} {}{} for {:g} s", ids.empty() ? drop.vehicle : Names(ids), Words(drop),
                           options_.random ? fmt::format(" (drop {})", number) : "", drop.for_s));
    if (HasHook()) {
      active_.push_back({number, drop, start, end});
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
        SendState(id, start);
      } else {
        Send(id, of_one.uplink, of_one.downlink, &of_one, start, drop.for_s);
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
      active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(i));
      if (HasHook()) {
        CallHook(options_.hook, "end", active.number, active.drop);
        continue;
      }
      const int id = std::stoi(active.drop.vehicle);
      if (!manual_.contains(id)) continue;
      SendState(id, active.end);
      const bool goes_on = std::any_of(active_.begin(), active_.end(), [&](const Active& other) {
        return other.drop.vehicle == active.drop.vehicle;
      });
      if (!goes_on) manual_.erase(id);
    }
  }

  /// What several drops make of a link together, from a moment on. The simulator's own going back after a
  /// time would go back to the wrong one of them.
  void SendState(int id, bus::Utime at) {
    for (const bool is_up : {true, false}) {
      std::optional<Drop> worst;
      for (const Active& active : active_) {
        if (active.drop.vehicle != std::to_string(id) || active.start > at || active.end <= at) continue;
        if (is_up ? !active.drop.uplink : !active.drop.downlink) continue;
        if (!worst) worst = active.drop;
        worst->loss = std::max(worst->loss, active.drop.loss);
        worst->delay_s = std::max(worst->delay_s, active.drop.delay_s);
      }
      Send(id, is_up, !is_up, worst ? &*worst : nullptr, at, 0);
    }
  }

  /// @param drop null: as at the start of the scenario. @param for_s 0: until changed
  void Send(int id, bool uplink, bool downlink, const Drop* drop, bus::Utime at, double for_s) {
    link_command_t command{};
    command.vehicle_id = id;
    command.uplink = uplink;
    command.downlink = downlink;
    command.mode = drop == nullptr  ? link_command_t::MODE_RESTORED
                   : drop->is_cut() ? link_command_t::MODE_SILENT
                                    : link_command_t::MODE_UP;
    if (drop != nullptr && !drop->is_cut()) {
      command.loss = drop->loss;
      command.delay_s = drop->delay_s;
    }
    command.start_utime = at;
    command.duration_s = for_s;
    station_.Ask(channel::kCmdLink, command, kSimulator);
  }

  /// All links as they were; those that are still to be cut right after that.
  void Stop() {
    const bus::Utime now = Now();
    ledger_.Stop(now);
    std::set<int> ids;
    bus::Utime at = now;
    for (const Active& active : active_) {
      if (HasHook()) {
        CallHook(options_.hook, "end", active.number, active.drop);
      } else {
        ids.insert(std::stoi(active.drop.vehicle));
        at = std::max(at, active.start + 100'000);
      }
    }
    ids.insert(manual_.begin(), manual_.end());
    for (const int id : ids) {
      try {
        Send(id, true, true, nullptr, at, 0);
      } catch (const Failure& failure) {
        Problem(Callsign(station_.picture(), id) + ": its link could not be restored: " + failure.what());
      }
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

  std::string Names(const std::vector<int>& ids) const {
    if (ids.size() > 5) return fmt::format("{} UAVs", ids.size());
    std::string names;
    for (const int id : ids) names += (names.empty() ? "" : ", ") + Callsign(station_.picture(), id);
    return names;
  }

  static std::string Words(const Drop& drop) {
    const std::string direction = Direction(drop);
    const char* way = direction == "both" ? "both ways" : direction == "up" ? "upwards" : "downwards";
    if (drop.is_cut()) return fmt::format("cut {}", way);
    return fmt::format("made worse {} ({:g}% loss, {:g} s delay)", way, 100 * drop.loss, drop.delay_s);
  }

  void Say(bus::Utime utime, const std::string& text) {
    if (!options_.json)
      out_ << fmt::format("{:9.2f} s  {}\n", bus::ToSeconds(utime - scenario_start_), text) << std::flush;
  }

  /// Not on standard output, which may be the report as JSON.
  static void Problem(const std::string& text) { fmt::print(stderr, "skein: {}\n", text); }

  void Report() {
    const DropReport report{ledger_, options_.limit_s, Now(), scenario_start_,
                            [this](int id) { return Callsign(station_.picture(), id); }};
    out_ << (options_.json ? DropsAsJson(report) : DropSummary(report)) << std::flush;
    if (const int failures = Failures(report); failures > 0) {
      throw Failure(fmt::format("{} drop{} missed or found after more than {:g} s", failures,
                                failures == 1 ? " was" : "s were", options_.limit_s));
    }
  }

  Station& station_;
  const DropsOptions& options_;
  std::ostream& out_;
  bus::Utime scenario_start_;
  bus::Utime base_ = 0;  ///< of the plan's times
  DropLedger ledger_;
  std::vector<Active> active_;  ///< begun or announced, not over
  std::set<int> manual_;        ///< UAVs with drops that overlap: every change is sent by itself
  std::set<int> unjudged_;      ///< UAVs whose uplink the monitor does not judge
  int last_number_ = 0;
  bool heard_monitor_ = false;
  bool restarted_ = false;
};

}  // namespace

void RunDrops(Station& station, const DropsOptions& options, std::ostream& out) {
  DropRun(station, options, out).Run();
}

}  // namespace skein::cli
