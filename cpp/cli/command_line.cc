#include "cli/command_line.h"

#include <utility>

#include "bus/number_checks.h"
#include "bus/transport.h"
#include "cli/recording.h"

namespace skein::cli {
namespace {

constexpr const char* kVehiclesHelp = "UAVs, by id or callsign";

CLI::App* Group(CLI::App& app, const char* name, const char* description) {
  CLI::App* group = app.add_subcommand(name, description);
  group->require_subcommand(1);
  return group;
}

CLI::Option* AddId(CLI::App* command, int& id) {
  return command->add_option("id", id, "Number of the formation")->check(bus::Positive());
}

}  // namespace

CommandLine::CommandLine() : app_("Commands a fleet from the shell and waits for the answer.", "skein") {
  app_.set_version_flag("--version", "skein " SKEIN_VERSION);
  app_.add_option("--lcm-url", lcm_url_,
                  "LCM URL (default: LCM_DEFAULT_URL, or " + std::string(bus::kDefaultUrl) + ")");
  app_.require_subcommand(1);
  app_.fallthrough();
  app_.footer(
      "Exit codes: 0 accepted, 1 refused or not answered, 2 wrong usage or a file that cannot be used.");
  AddLink();
  AddFormation();
  AddPath();
  AddPayload();
  AddScenario();
  AddStatus();
  AddAlarms();
  AddRecord();
  log_.Add(app_, [this](LogCommandLine::Command command) { offline_command_ = std::move(command); });
  AddSpy();
  AddDrops();
  AddDoctor();
  token_.Add(app_, [this](TokenCommandLine::Command command) { offline_command_ = std::move(command); });
}

void CommandLine::AddLink() {
  CLI::App* group = Group(app_, "link", "Data links of simulated UAVs");
  const auto add_options = [this](CLI::App* command) {
    command->add_option("vehicle", link_.vehicles, kVehiclesHelp)->required();
    command->add_option("--at", link_.at_s, "When, in seconds of the scenario (default: now)")
        ->check(bus::NotNegative());
    auto* up = command->add_flag("--up-only", link_.up_only, "The uplink alone (station to UAV)");
    command->add_flag("--down-only", link_.down_only, "The downlink alone (UAV to station)")->excludes(up);
  };
  CLI::App* cut = group->add_subcommand("cut", "Cut a link");
  add_options(cut);
  cut->add_option("--for", link_.for_s, "For so many seconds (default: until restored)")
      ->check(bus::Positive());
  cut->add_flag("--frozen", link_.frozen, "Repeat the last state instead of falling silent");
  cut->callback(
      [this] { command_ = [this](Station& station, std::ostream& out) { CutLink(station, link_, out); }; });
  CLI::App* restore = group->add_subcommand("restore", "Restore a link");
  add_options(restore);
  restore->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { RestoreLink(station, link_, out); };
  });
}

void CommandLine::AddFormation() {
  CLI::App* group = Group(app_, "formation", "Formations");
  CLI::App* show = group->add_subcommand("show", "All formations, or one as JSON that `apply` takes");
  AddId(show, id_);
  show->add_flag("--json", json_, "As JSON, also when there is only one and no id is given");
  show->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { ShowFormation(station, id_, json_, out); };
  });
  CLI::App* apply = group->add_subcommand("apply", "Fly the formation of a JSON file");
  apply->add_option("file", file_, "Named as a formation of a scenario")
      ->required()
      ->check(CLI::ExistingFile);
  apply->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { ApplyFormation(station, file_, out); };
  });
  const auto add = [&](const char* name, const char* description, void (*run)(Station&, int, std::ostream&)) {
    CLI::App* command = group->add_subcommand(name, description);
    AddId(command, id_)->required();
    command->callback([this, run] {
      command_ = [this, run](Station& station, std::ostream& out) { run(station, id_, out); };
    });
  };
  add("hold", "Loiter where the formation is", HoldFormation);
  add("resume", "Go on along the path", ResumeFormation);
  add("remove", "Dissolve the formation; its UAVs hold course, speed and altitude", RemoveFormation);
}

void CommandLine::AddPath() {
  CLI::App* group = Group(app_, "path", "Paths of formations");
  CLI::App* show = group->add_subcommand("show", "Print a path as GeoJSON that `upload` takes");
  AddId(show, id_);
  show->callback(
      [this] { command_ = [this](Station& station, std::ostream& out) { ShowPath(station, id_, out); }; });
  CLI::App* upload = group->add_subcommand("upload", "Fly the path of a GeoJSON file");
  upload
      ->add_option("file", path_.file,
                   "A LineString or Points, altitude as third coordinate; properties altitude_m, speed_m_s, "
                   "turn_radius_m")
      ->required()
      ->check(CLI::ExistingFile);
  upload->add_option("--formation", path_.formation_id, "Number of the formation (default: the only one)")
      ->check(bus::Positive());
  upload->add_flag("--closed", path_.closed, "Fly it round and round");
  upload->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { UploadPath(station, path_, out); };
  });
  CLI::App* clear = group->add_subcommand("clear", "Take the path away: straight on");
  AddId(clear, id_)->required();
  clear->callback(
      [this] { command_ = [this](Station& station, std::ostream& out) { ClearPath(station, id_, out); }; });
}

void CommandLine::AddPayload() {
  CLI::App* group = Group(app_, "payload", "Payloads");
  for (const bool on : {true, false}) {
    CLI::App* command =
        group->add_subcommand(on ? "on" : "off", on ? "Switch payloads on" : "Switch payloads off");
    command->add_option("vehicle", vehicles_, kVehiclesHelp)->required();
    command->callback([this, on] {
      command_ = [this, on](Station& station, std::ostream& out) {
        SwitchPayload(station, vehicles_, on, out);
      };
    });
  }
}

void CommandLine::AddScenario() {
  CLI::App* group = Group(app_, "scenario", "Scenarios of the simulated fleet");
  group->add_subcommand("list", "Those that this machine finds by name")->callback([this] {
    command_ = [](Station&, std::ostream& out) { ListScenarios(out); };
  });
  CLI::App* load = group->add_subcommand("load", "Fly another scenario, from its start");
  load->add_option("name", scenario_, "As `list` names it, never a path")->required();
  load->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { StartScenario(station, scenario_, out); };
  });
  CLI::App* restart = group->add_subcommand("restart", "Fly the same scenario again, from its start");
  restart->callback([this] {
    command_ = [](Station& station, std::ostream& out) { StartScenario(station, std::nullopt, out); };
  });
}

void CommandLine::AddStatus() {
  CLI::App* status = app_.add_subcommand("status", "A row for each UAV");
  status->add_flag("--watch", status_.watch, "Again every second, until Ctrl-C");
  status->add_flag("--json", status_.json, "As JSON");
  status->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { ShowStatus(station, status_, out); };
  });
}

void CommandLine::AddAlarms() {
  CLI::App* alarms = app_.add_subcommand("alarms", "What must be looked after, the most urgent first");
  alarms->add_flag("--history", alarms_.history, "Those that are over, too");
  alarms->add_flag("--json", alarms_.json, "As JSON");
  alarms->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { ShowAlarms(station, alarms_, out); };
  });

  CLI::App* group = Group(app_, "alarm", "What an operator does about alarms");
  CLI::App* ack = group->add_subcommand("ack", "Acknowledge alarms");
  ack->add_option("id", alarm_ids_, "Numbers as `skein alarms` lists them, or all")->required();
  ack->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { AcknowledgeAlarms(station, alarm_ids_, out); };
  });
  CLI::App* shelve = group->add_subcommand("shelve", "Put alarms away for a time");
  shelve->add_option("id", alarm_ids_, "Numbers as `skein alarms` lists them")->required();
  shelve->add_option("--for", shelve_s_, "For so many seconds, 1 to 3600")
      ->check(bus::Between(1, 3600))
      ->capture_default_str();
  shelve->callback([this] {
    command_ = [this](Station& station, std::ostream& out) {
      ShelveAlarms(station, alarm_ids_, shelve_s_, out);
    };
  });
  CLI::App* unshelve = group->add_subcommand("unshelve", "Take alarms off the shelf");
  unshelve->add_option("id", alarm_ids_, "Numbers as `skein alarms` lists them")->required();
  unshelve->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { UnshelveAlarms(station, alarm_ids_, out); };
  });
}

void CommandLine::AddRecord() {
  CLI::App* group = Group(app_, "record", "The recording of the flight");
  const auto add = [&](const char* name, const char* description, auto run) {
    CLI::App* command = group->add_subcommand(name, description);
    command->callback([this, run] { command_ = run; });
    return command;
  };
  add("start", "Begin a recording", StartRecording);
  add("stop", "End the recording", StopRecording);
  CLI::App* marker = group->add_subcommand("marker", "Put a note into the recording, for all to see");
  marker->add_option("text", marker_, "What is to be noted")->required();
  marker->callback([this] {
    command_ = [this](Station& station, std::ostream& out) { PutMarker(station, marker_, out); };
  });
  add("status", "Whether the flight is recorded, and where", [this](Station& station, std::ostream& out) {
    ShowRecording(station, json_, out);
  })->add_flag("--json", json_, "As JSON");
}

void CommandLine::AddSpy() {
  CLI::App* spy = app_.add_subcommand(
      "spy",
      "What goes on on the bus: every channel's rate, bandwidth, losses; or one channel, field by field");
  auto* channel =
      spy->add_option("channel", spy_.channel, "Show the messages of this channel (default: a table of all)");
  spy->add_option("--where", spy_.where,
                  "FIELD=VALUE: only such messages, as formation_id=2 (default: chunk=0 where messages come "
                  "in chunks)")
      ->needs(channel);
  spy->add_option("--for", spy_.for_s, "End after so many seconds (default: Ctrl-C ends it)")
      ->check(bus::Positive());
  spy->add_flag("--once", spy_.once, "One table after 2.5 s (or --for), or the next message, and end");
  spy->add_flag("--json", spy_.json, "As JSON, a line for each table or message");
  spy->callback(
      [this] { command_ = [this](Station& station, std::ostream& out) { Spy(station, spy_, out); }; });
}

void CommandLine::AddDoctor() {
  CLI::App* doctor = app_.add_subcommand(
      "doctor", "What of this machine and of the bus will make trouble, and what to do about it");
  doctor->add_option("--folder", doctor_.folder, "Where recordings go")->capture_default_str();
  doctor->add_flag("--json", doctor_.json, "As JSON");
  doctor->callback([this] {
    offline_command_ = [this](std::ostream& out) {
      doctor_.lcm_url = lcm_url_;
      return Doctor(doctor_, out);
    };
  });
}

}  // namespace skein::cli
