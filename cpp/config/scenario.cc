#include "config/scenario.h"

#include <algorithm>

#include "config/readers.h"

namespace skein::config {
namespace {

Origin ReadOrigin(const Value& value) {
  const Object object(value, {"latitude_deg", "longitude_deg", "altitude_m"});
  return {.latitude_deg = object.Number("latitude_deg", {-89, 89}),
          .longitude_deg = object.Number("longitude_deg", {-180, 180}),
          .altitude_m = object.Number("altitude_m", {-1000, 10e3}, 0)};
}

Defaults ReadDefaults(const Object& root) {
  Defaults defaults;
  if (const auto control = root.Find("control")) defaults.control = ReadControl(*control);
  if (const auto models = root.Find("models")) defaults.models = ReadModels(*models);
  if (const auto uplink_loss = root.Find("uplink_loss")) defaults.uplink_loss = ReadUplinkLoss(*uplink_loss);
  defaults.autopilot_scale = root.Number("autopilot_scale", {0.1, 10}, 1);
  if (const auto link = root.Find("link")) {
    const Object directions(*link, {"up", "down"});
    if (const auto up = directions.Find("up")) defaults.uplink = ReadLinkQuality(*up, {});
    if (const auto down = directions.Find("down")) defaults.downlink = ReadLinkQuality(*down, {});
  }
  return defaults;
}

// Where in the file every UAV, formation and slot came from, to refuse a second one of the same id.
class UniqueIds {
 public:
  explicit UniqueIds(std::string what) : what_(std::move(what)) {}

  void Add(int id, const Value& value) {
    const auto [first, is_new] = places_.emplace(id, value.pointer());
    if (!is_new) value.Refuse(what_ + " " + std::to_string(id) + " is there already, at " + first->second);
  }
  bool Has(int id) const { return places_.contains(id); }

 private:
  std::string what_;
  std::map<int, std::string> places_;
};

class ScenarioReader {
 public:
  explicit ScenarioReader(const std::filesystem::path& file)
      : root_(Value::FromFile(file),
              {"name", "description", "duration_s", "origin", "ceiling_m", "control", "strangers", "link",
               "uplink_loss", "autopilot_scale", "models", "formations", "vehicles", "fleet", "timeline",
               "timeline_repeat_s", "vary"}),
        defaults_(ReadDefaults(root_)) {
    scenario_.file = file;
  }

  Scenario Read() {
    scenario_.name = root_.At("name").Text();
    if (const auto description = root_.Find("description")) scenario_.description = description->Text();
    scenario_.duration_s = root_.Number("duration_s", {0.05, 1e6}, scenario_.duration_s);
    scenario_.origin = ReadOrigin(root_.At("origin"));
    scenario_.ceiling_m = root_.Number("ceiling_m", kUpM, scenario_.ceiling_m);
    if (const auto strangers = root_.Find("strangers")) {
      scenario_.strangers = ReadProximity(*strangers, scenario_.strangers);
    }
    if (!root_.Has("vehicles") && !root_.Has("fleet")) root_.At("vehicles");
    ReadVehicles();
    ReadFormations();
    ReadTimeline();
    if (const auto vary = root_.Find("vary")) scenario_.vary = ReadVariation(*vary, scenario_);
    return std::move(scenario_);
  }

 private:
  void ReadVehicles() {
    for (const Value& item : root_.Items("vehicles")) {
      scenario_.vehicles.push_back(ReadVehicle(item, defaults_));
      vehicles_.Add(scenario_.vehicles.back().id, Object(item).At("id"));
      RefuseSecond(scenario_.vehicles.back(), item);
    }
    if (const auto fleet = root_.Find("fleet")) {
      GeneratedFleet generated = ReadFleet(*fleet, defaults_);
      for (VehicleConfig& vehicle : generated.vehicles) {
        vehicles_.Add(vehicle.id, *fleet);
        RefuseSecond(vehicle, *fleet);
        scenario_.vehicles.push_back(std::move(vehicle));
      }
      for (FormationConfig& formation : generated.formations) {
        formations_.Add(formation.id, *fleet);
        for (const Slot& slot : formation.slots) members_.Add(slot.vehicle_id, *fleet);
        scenario_.formations.push_back(std::move(formation));
      }
    }
  }

  // Operators know UAVs by their callsigns.
  void RefuseSecond(const VehicleConfig& vehicle, const Value& item) {
    const auto [first, is_new] = callsigns_.emplace(vehicle.callsign, vehicle.id);
    if (is_new) return;
    Object(item)
        .Find("callsign")
        .value_or(item)
        .Refuse("UAV " + std::to_string(first->second) + " has the callsign \"" + vehicle.callsign +
                "\" already");
  }

  void ReadFormations() {
    for (const Value& item : root_.Items("formations")) {
      scenario_.formations.push_back(ReadFormation(item, defaults_));
      formations_.Add(scenario_.formations.back().id, Object(item).At("id"));
      CheckMembers(Object(item));
    }
  }

  void CheckMembers(const Object& formation) {
    const auto check = [this](const Value& id) {
      RefuseStranger(id);
      members_.Add(id.Integer(kIds), id);
    };
    for (const Value& slot : formation.Items("slots")) check(Object(slot).At("vehicle"));
    for (const Value& id : formation.Items("vehicles")) check(id);
  }

  void ReadTimeline() {
    double last_s = 0;
    for (const Value& item : root_.Items("timeline")) {
      scenario_.timeline.push_back(ReadTimelineEntry(item));
      const Object entry(item);
      for (const std::string_view key : {"cut_link", "restore_link", "set_link"}) {
        if (const auto id = entry.Find(key)) RefuseStranger(*id);
      }
      const auto* cut = std::get_if<CutLink>(&scenario_.timeline.back().action);
      last_s = std::max(last_s, scenario_.timeline.back().at_s + (cut && cut->for_s ? *cut->for_s : 0));
    }
    std::stable_sort(scenario_.timeline.begin(), scenario_.timeline.end(),
                     [](const TimelineEntry& a, const TimelineEntry& b) { return a.at_s < b.at_s; });
    scenario_.timeline_repeat_s = root_.Number("timeline_repeat_s", {1, 1e6}, 0);
    if (root_.Has("timeline_repeat_s") && scenario_.timeline_repeat_s <= last_s) {
      root_.At("timeline_repeat_s").Refuse("must be later than the end of the last entry of the timeline");
    }
  }

  void RefuseStranger(const Value& id) const {
    if (!vehicles_.Has(id.Integer(kIds))) {
      id.Refuse("there is no UAV " + std::to_string(id.Integer(kIds)) + " in this scenario");
    }
  }

  Object root_;
  Defaults defaults_;
  Scenario scenario_;
  std::map<std::string, int> callsigns_;
  UniqueIds vehicles_{"UAV"};
  UniqueIds formations_{"formation"};
  UniqueIds members_{"the slot of UAV"};
};

}  // namespace

Scenario LoadScenario(const std::filesystem::path& file) { return ScenarioReader(file).Read(); }

}  // namespace skein::config
