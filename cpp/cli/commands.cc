#include "cli/commands.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <skein/formation_command_t.hpp>
#include <skein/link_command_t.hpp>
#include <skein/path_command_t.hpp>
#include <skein/payload_command_t.hpp>
#include <skein/simulation_command_t.hpp>

#include "bus/channels.h"
#include "bus/conversions.h"
#include "cli/formation_file.h"
#include "cli/geojson.h"
#include "cli/status.h"
#include "cli/terminal.h"
#include "cli/vehicles.h"
#include "core/path_line.h"

namespace skein::cli {
namespace {

namespace channel = bus::channel;

constexpr const char* kController = "formation-controller";
constexpr bus::Utime kWatchPeriod = bus::kSecond;

config::Origin OriginOf(const fleet_roster_t& roster) {
  return {roster.origin_latitude_deg, roster.origin_longitude_deg, roster.origin_altitude_m};
}

/// @return utime at which a time of the scenario comes.
bus::Utime ScenarioTime(Station& station, double at_s) {
  const fleet_roster_t& roster = station.Roster();
  const bus::Utime when = roster.start_utime + bus::ToUtime(at_s);
  if (when < roster.utime) {
    throw Failure(fmt::format("{:g} s of the scenario have passed: it is {:.0f} s", at_s,
                              bus::ToSeconds(roster.utime - roster.start_utime)));
  }
  return when;
}

void SetLinks(Station& station, const LinkOptions& options, std::int8_t mode, const char* what,
              std::ostream& out) {
  link_command_t command;
  command.uplink = !options.down_only;
  command.downlink = !options.up_only;
  command.mode = mode;
  command.duration_s = options.for_s;
  if (options.at_s >= 0) command.start_utime = ScenarioTime(station, options.at_s);
  for (const int id : FindVehicles(station, options.vehicles)) {
    command.vehicle_id = id;
    const std::string remark = station.Ask(channel::kCmdLink, command, kSimulator);
    std::string text = fmt::format("{} {} of {}", what,
                                   options.up_only     ? "uplink"
                                   : options.down_only ? "downlink"
                                                       : "link",
                                   Callsign(station.picture(), id));
    if (options.at_s >= 0) text += fmt::format(" at {:g} s", options.at_s);
    if (options.for_s > 0) text += fmt::format(" for {:g} s", options.for_s);
    Done(out, text, remark);
  }
}

/// Waits until all that is repeated at 1 Hz can have come.
void HearAll(Station& station) {
  station.WaitUntil([] { return false; }, kLongestPeriod);
}

std::string IdsOf(const auto& by_id) {
  std::string ids;
  for (const auto& [id, unused] : by_id) ids += (ids.empty() ? "" : ", ") + std::to_string(id);
  return ids.empty() ? "none" : ids;
}

/// The entry of `id`, or the only one when id is 0.
template <typename Map>
typename Map::const_iterator Choose(Station& station, const Map& by_id, int id, const char* what) {
  if (id > 0) {
    station.WaitUntil([&] { return by_id.contains(id); }, kLongestPeriod);
  } else {
    HearAll(station);
  }
  if (by_id.empty()) {
    throw Failure(
        fmt::format("no {} was heard for 2.5 s: is {} running, and on this LCM URL?", what, kController));
  }
  if (id == 0 && by_id.size() > 1) {
    throw Failure(fmt::format("there is more than one {} ({}): say which", what, IdsOf(by_id)));
  }
  const auto found = id == 0 ? by_id.begin() : by_id.find(id);
  if (found == by_id.end())
    throw Failure(fmt::format("there is no {} {}; there are {}", what, id, IdsOf(by_id)));
  return found;
}

void CommandFormation(Station& station, std::int8_t action, int id, const char* done, std::ostream& out) {
  formation_command_t command;
  command.action = action;
  command.formation.formation_id = id;
  Done(out, fmt::format("formation {} {}", id, done),
       station.Ask(channel::kCmdFormation, command, kController));
}

// Home and clear to the end: no flicker.

void Print(const Picture& picture, const StatusOptions& options, std::ostream& out) {
  if (options.json) {
    out << StatusJson(picture) << '\n';
  } else {
    if (!picture.formations.empty()) out << FormationTable(picture) << '\n';
    out << StatusTable(picture);
  }
  out.flush();
}

}  // namespace

void CutLink(Station& station, const LinkOptions& options, std::ostream& out) {
  SetLinks(station, options, options.frozen ? link_command_t::MODE_FROZEN : link_command_t::MODE_SILENT,
           options.frozen ? "froze" : "cut", out);
}

void RestoreLink(Station& station, const LinkOptions& options, std::ostream& out) {
  SetLinks(station, options, link_command_t::MODE_RESTORED, "restored", out);
}

void SwitchPayload(Station& station, const std::vector<std::string>& vehicles, bool on, std::ostream& out) {
  payload_command_t command;
  command.on = on;
  command.vehicle_ids = FindVehicles(station, vehicles);
  command.num_vehicle_ids = static_cast<int>(command.vehicle_ids.size());
  const std::string remark = station.Ask(channel::kCmdPayload, command, kSimulator);
  std::string names;
  for (const int id : command.vehicle_ids) names += " " + Callsign(station.picture(), id);
  Done(out, fmt::format("payload {}:{}", on ? "on" : "off", names), remark);
}

void ShowFormation(Station& station, int id, bool json, std::ostream& out) {
  if (id > 0 || json) {
    out << WriteFormation(Choose(station, station.picture().formations, id, "formation")->second) << '\n';
    return;
  }
  HearAll(station);
  if (station.picture().formations.empty()) {
    throw Failure(
        fmt::format("no formation was heard for 2.5 s: is {} running, and on this LCM URL?", kController));
  }
  out << FormationTable(station.picture());
}

void ApplyFormation(Station& station, const std::string& file, std::ostream& out) {
  formation_command_t command;
  command.action = formation_command_t::ACTION_APPLY;
  command.formation = ReadFormationFile(file);
  command.formation.utime = station.bus().executor().Now();
  Done(out, fmt::format("formation {} applied", command.formation.formation_id),
       station.Ask(channel::kCmdFormation, command, kController));
}

void HoldFormation(Station& station, int id, std::ostream& out) {
  CommandFormation(station, formation_command_t::ACTION_HOLD, id, "holds", out);
}

void ResumeFormation(Station& station, int id, std::ostream& out) {
  CommandFormation(station, formation_command_t::ACTION_RESUME, id, "goes on", out);
}

void RemoveFormation(Station& station, int id, std::ostream& out) {
  CommandFormation(station, formation_command_t::ACTION_REMOVE, id, "removed", out);
}

void ShowPath(Station& station, int id, std::ostream& out) {
  const config::Origin origin = OriginOf(station.Roster());
  const path_t& message = Choose(station, station.picture().paths, id, "path")->second;
  const PathFile path{message.loop_start_m != -1, bus::ToWaypoints(message)};
  const Path flown = bus::ToPath(message);
  out << WritePath(path, SampleLine(flown, flown.start_arc_m(), flown.end_arc_m()), origin) << '\n';
}

void UploadPath(Station& station, const PathOptions& options, std::ostream& out) {
  const PathFile path = ReadPathFile(options.file, OriginOf(station.Roster()));
  path_command_t command;
  command.formation_id = options.formation_id;
  if (command.formation_id == 0) {
    command.formation_id = Choose(station, station.picture().formations, 0, "formation")->first;
  }
  command.closed = path.closed || options.closed;
  bus::SetWaypoints(command, path.waypoints);
  Done(out,
       fmt::format("formation {} flies {} waypoints{}", command.formation_id, command.num_waypoints,
                   command.closed ? ", round and round" : ""),
       station.Ask(channel::kCmdPath, command, kController));
}

void ClearPath(Station& station, int id, std::ostream& out) {
  path_command_t command;
  command.formation_id = id;
  Done(out, fmt::format("formation {} flies straight on", id),
       station.Ask(channel::kCmdPath, command, kController));
}

void ListScenarios(std::ostream& out) {
  for (const config::ScenarioEntry& entry : config::ListScenarios()) {
    if (entry.problem.empty()) {
      out << fmt::format("{:<20} {:>5} UAVs  {}\n", entry.bare_name, entry.vehicles, entry.name);
    } else {
      out << fmt::format("{:<20} cannot be flown: {}\n", entry.bare_name, entry.problem);
    }
  }
}

void StartScenario(Station& station, const std::optional<std::string>& name, std::ostream& out) {
  const bus::Utime before = station.Roster().start_utime;
  simulation_command_t command;
  command.action = name ? simulation_command_t::ACTION_LOAD : simulation_command_t::ACTION_RESTART;
  command.scenario = name.value_or("");
  command.seed = 0;
  const std::string remark = station.Ask(channel::kCmdSimulation, command, kSimulator);
  const auto started = [&] { return station.picture().roster->start_utime != before; };
  if (!station.WaitUntil(started, kLongestPeriod)) {
    throw Failure("accepted, but no fleet was heard to start anew for 2.5 s");
  }
  const fleet_roster_t& roster = *station.picture().roster;
  Done(out, fmt::format("{} starts anew with {} UAVs", roster.scenario, roster.vehicles.size()), remark);
}

void ShowStatus(Station& station, const StatusOptions& options, std::ostream& out) {
  const Picture& picture = station.picture();
  station.Roster();
  // At 5 Hz or more, or 1 Hz: what has not come by then is shown as unknown.
  station.WaitUntil(
      [&] { return picture.state && picture.proximity && picture.links && !picture.statuses.empty(); },
      kLongestPeriod);
  if (!options.watch) return Print(picture, options, out);
  try {
    while (true) {
      if (!options.json) out << kClearScreen;
      Print(picture, options, out);
      station.WaitUntil([] { return false; }, kWatchPeriod);
      station.ForgetWhatIsOld();
    }
  } catch (const Interrupted&) {  // the way to end it
  }
}

}  // namespace skein::cli
