#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <ostream>
#include <string>

#include "cli/alarms.h"
#include "cli/commands.h"
#include "cli/doctor.h"
#include "cli/drops.h"
#include "cli/log/log_command_line.h"
#include "cli/spy.h"
#include "cli/token_command_line.h"

namespace skein::cli {

/// The options of `skein`. After parse(), command() is what was asked for, or offline_command() when that
/// needs no bus.
class CommandLine {
 public:
  CommandLine();

  CLI::App& app() { return app_; }
  const std::string& lcm_url() const { return lcm_url_; }

  using Command = std::function<void(Station& station, std::ostream& out)>;
  const Command& command() const { return command_; }
  const LogCommandLine::Command& offline_command() const { return offline_command_; }

 private:
  void AddLink();
  void AddFormation();
  void AddPath();
  void AddPayload();
  void AddScenario();
  void AddStatus();
  void AddAlarms();
  void AddRecord();
  void AddSpy();
  void AddDrops();
  void AddDoctor();

  CLI::App app_;
  std::string lcm_url_;
  Command command_;
  LogCommandLine::Command offline_command_;
  LogCommandLine log_;
  TokenCommandLine token_;
  LinkOptions link_;
  PathOptions path_;
  StatusOptions status_;
  AlarmsOptions alarms_;
  SpyOptions spy_;
  DropsOptions drops_;
  DoctorOptions doctor_;
  std::vector<std::string> alarm_ids_;
  double shelve_s_ = 60;
  std::vector<std::string> vehicles_;
  std::string file_;
  std::string scenario_;
  std::string marker_;
  int id_ = 0;
  bool json_ = false;
};

}  // namespace skein::cli
