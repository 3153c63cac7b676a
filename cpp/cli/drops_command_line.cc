#include "cli/command_line.h"

#include "bus/number_checks.h"

namespace skein::cli {

void CommandLine::AddDrops() {
  CLI::App* drops =
      app_.add_subcommand("drops", "Cut data links by a plan, and report what the monitor finds of it");
  drops->add_option("vehicle", drops_.vehicles,
                    "UAVs, by id or callsign, or all; with --random: whose links are hit (default: all)");
  auto* list =
      drops
          ->add_option(
              "--list", drops_.file,
              "CSV with a heading, or JSON: at_s, uav, for_s and, where wanted, direction, loss, delay_s")
          ->type_name("FILE");
  auto* random =
      drops->add_flag("--random", drops_.random, "Random drops, until stopped or --count")->excludes(list);
  drops->add_option("--at", drops_.at_s, "When, in seconds of the scenario (default: now)")
      ->check(bus::NotNegative())
      ->excludes(list)
      ->excludes(random);
  drops->add_option("--for", drops_.for_s, "For so many seconds")
      ->check(bus::Between(0.05, 1e6))
      ->capture_default_str()
      ->excludes(list)
      ->excludes(random);
  drops
      ->add_option("--direction", drops_.direction,
                   "up, down or both; with --random any, too (default: both)")
      ->check(CLI::IsMember({"up", "down", "both", "any"}))
      ->excludes(list);
  drops->add_option("--loss", drops_.loss, "Worse instead of cut: probability 0 .. 1 that a message is lost")
      ->check(bus::Between(0.0, 1.0))
      ->excludes(list)
      ->excludes(random);
  drops->add_option("--delay", drops_.delay_s, "Worse instead of cut: so many seconds late, 0 .. 60")
      ->check(bus::Between(0.0, 60.0))
      ->excludes(list)
      ->excludes(random);
  drops
      ->add_flag("--from-now", drops_.from_now,
                 "Times of the list count from now (default: from the scenario's start)")
      ->needs(list);
  drops
      ->add_flag(
          "--check", drops_.check,
          "Only see whether the list can be read, and write it as CSV in order of time; needs no fleet")
      ->needs(list);
  drops->add_option("--repeat", drops_.repeat_s, "Begin again every so many seconds, until Ctrl-C")
      ->check(bus::Positive())
      ->excludes(random);
  drops->add_option("--count", drops_.count, "So many random drops (default: until Ctrl-C)")
      ->check(bus::Positive())
      ->needs(random);
  drops->add_option("--seed", drops_.random_drops.seed, "Of random drops")
      ->capture_default_str()
      ->needs(random);
  drops
      ->add_option("--rate", drops_.random_drops.per_minute,
                   "Random drops a minute, of the whole fleet on average")
      ->check(bus::Between(0.01, 6000.0))
      ->capture_default_str()
      ->needs(random);
  drops->add_option("--shortest", drops_.random_drops.shortest_s, "Of random drops, seconds")
      ->check(bus::Between(0.05, 1e5))
      ->capture_default_str()
      ->needs(random);
  drops->add_option("--longest", drops_.random_drops.longest_s, "Of random drops, seconds")
      ->check(bus::Between(0.05, 1e5))
      ->capture_default_str()
      ->needs(random);
  drops->add_option("--limit", drops_.limit_s, "A cut is to be found within so many seconds")
      ->check(bus::Positive())
      ->capture_default_str();
  drops
      ->add_option(
          "--hook", drops_.hook,
          "Instead of CMD_LINK call this program: begin|end NUMBER UAV DIRECTION LOSS DELAY_S; UAV "
          "may be none, too: nobody's link is to suffer. After the end of one, begin comes again for "
          "others of the UAV that go on")
      ->type_name("PROGRAM");
  drops->add_flag("--json", drops_.json, "The report as JSON, at the end");
  drops->footer(
      "Exit code 1 when a cut was missed or found later than --limit. Cuts that are over before that, "
      "overlap with\n"
      "another one of the UAV, or make a link worse only, are told but not held against the monitor.");
  drops->callback([this] {
    if (drops_.vehicles.empty() && drops_.file.empty() && !drops_.random) {
      throw CLI::ValidationError("drops", "name a UAV, or give --list or --random");
    }
    if (!drops_.file.empty() && !drops_.vehicles.empty()) {
      throw CLI::ValidationError("drops", "give UAVs or --list, not both: the list says which UAVs");
    }
    if (drops_.random_drops.shortest_s > drops_.random_drops.longest_s) {
      throw CLI::ValidationError("--shortest", "must not be above --longest");
    }
    if (drops_.direction == "any" && !drops_.random) {
      throw CLI::ValidationError("--direction", "any goes with --random");
    }
    drops_.random_drops.direction = drops_.direction;
    if (drops_.check) {
      offline_command_ = [this](std::ostream& out) {
        out << DropsAsCsv(ReadDrops(drops_.file));
        return 0;
      };
      return;
    }
    command_ = [this](Station& station, std::ostream& out) {
      // What is wrong with it needs no fleet to be told.
      if (!drops_.file.empty()) drops_.list = ReadDrops(drops_.file);
      RunDrops(station, drops_, out);
    };
  });
}

}  // namespace skein::cli
