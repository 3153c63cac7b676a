#include "cli/drop_plan.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "config/readers.h"

namespace skein::cli {
namespace {

constexpr config::Range kDurationS{0.05, 1e6};

Drop ReadDrop(const config::Value& value) {
  const config::Object object(value, {"at_s", "uav", "direction", "for_s", "loss", "delay_s"});
  Drop drop;
  drop.at_s = object.Number("at_s", config::kSeconds);
  const config::Value vehicle = object.At("uav");
  drop.vehicle = vehicle.IsText() ? vehicle.Text() : std::to_string(vehicle.Integer(config::kIds));
  if (const auto direction = object.Find("direction")) {
    const std::string name = direction->Text();
    if (name != "up" && name != "down" && name != "both") {
      direction->Refuse(config::UnknownName("direction", name, {"up", "down", "both"}));
    }
    SetDirection(drop, name, "");
  }
  drop.for_s = object.Number("for_s", kDurationS);
  drop.delay_s = object.Number("delay_s", {0, 60}, 0);
  drop.loss = object.Number("loss", {0, 1}, drop.delay_s > 0 ? 0 : 1);
  return drop;
}

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t\r");
    const auto last = cell.find_last_not_of(" \t\r");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

/// A number where it is one, so that the reader for JSON refuses what isn't.
nlohmann::json ToJson(const std::string& cell) {
  double number = 0;
  const char* end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data(), end, number);
  if (error != std::errc() || stop != end) return cell;
  return number;
}

std::vector<Drop> ReadCsv(const std::filesystem::path& file) {
  std::istringstream stream(config::ReadTextFile(file, "a list of drops"));
  std::string line;
  std::getline(stream, line);
  const auto heading = Cells(line);
  std::vector<Drop> drops;
  for (int number = 2; std::getline(stream, line); ++number) {
    const auto cells = Cells(line);
    // Of an empty line of DOS, "\r" is left.
    if (std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); }))
      continue;
    if (cells.front().starts_with('#')) continue;
    const std::string place = file.string() + " line " + std::to_string(number);
    if (cells.size() > heading.size()) throw config::ConfigError(place + ": has more cells than the heading");
    nlohmann::json row = nlohmann::json::object();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!cells[i].empty()) row[heading[i]] = ToJson(cells[i]);
    }
    drops.push_back(ReadDrop(config::Value::FromJson(row, place)));
  }
  return drops;
}

}  // namespace

void SetDirection(Drop& drop, const std::string& direction, const std::string& place) {
  if (direction != "up" && direction != "down" && direction != "both") {
    throw config::ConfigError(place + ": " +
                              config::UnknownName("direction", direction, {"up", "down", "both"}));
  }
  drop.uplink = direction != "down";
  drop.downlink = direction != "up";
}

std::string Direction(const Drop& drop) {
  return drop.uplink && drop.downlink ? "both" : drop.uplink ? "up" : "down";
}

std::string Words(const Drop& drop) {
  const std::string direction = Direction(drop);
  const char* way = direction == "both" ? "both ways" : direction == "up" ? "upwards" : "downwards";
  if (drop.is_cut()) return fmt::format("cut {}", way);
  return fmt::format("made worse {} ({:g}% loss, {:g} s delay)", way, 100 * drop.loss, drop.delay_s);
}

std::vector<Drop> ReadDrops(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw config::ConfigError(file.string() + ": is a folder, not a list of drops");
  }
  std::vector<Drop> drops;
  if (file.extension() == ".json") {
    for (const config::Value& item : config::Value::FromFile(file).Items()) drops.push_back(ReadDrop(item));
  } else {
    drops = ReadCsv(file);
  }
  if (drops.empty()) throw config::ConfigError(file.string() + ": lists no drops");
  std::stable_sort(drops.begin(), drops.end(), [](const Drop& a, const Drop& b) { return a.at_s < b.at_s; });
  return drops;
}

std::string DropsAsCsv(const std::vector<Drop>& drops) {
  std::string text = "at_s,uav,direction,for_s,loss,delay_s\n";
  for (const Drop& drop : drops) {
    text += fmt::format("{},{},{},{},{},{}\n", drop.at_s, drop.vehicle, Direction(drop), drop.for_s,
                        drop.loss, drop.delay_s);
  }
  return text;
}

RandomPlan::RandomPlan(const RandomDrops& options, std::vector<int> vehicles)
    : options_(options),
      vehicles_(std::move(vehicles)),
      free_at_s_(vehicles_.size()),
      random_(options.seed) {}

double RandomPlan::Share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

Drop RandomPlan::Next() {
  now_s_ += -std::log(1 - Share()) * 60 / options_.per_minute;
  now_s_ = std::max(now_s_, *std::min_element(free_at_s_.begin(), free_at_s_.end()));
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    if (free_at_s_[i] <= now_s_) free.push_back(i);
  }
  const std::size_t chosen = free[static_cast<std::size_t>(Share() * static_cast<double>(free.size()))];
  Drop drop;
  drop.at_s = now_s_;
  drop.vehicle = std::to_string(vehicles_[chosen]);
  drop.for_s = options_.shortest_s + (options_.longest_s - options_.shortest_s) * Share();
  const double which = Share();
  const std::string drawn = which < 1.0 / 3 ? "up" : which < 2.0 / 3 ? "down" : "both";
  SetDirection(drop, options_.direction == "any" ? drawn : options_.direction, "--direction");
  free_at_s_[chosen] = now_s_ + drop.for_s + kRestS;
  return drop;
}

}  // namespace skein::cli
