#include "cli/vehicles.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace skein::cli {
namespace {

// Enough to see what callsigns look like.
constexpr std::size_t kCallsignsListed = 12;
constexpr std::size_t kCallsignsInLine = 5;

std::optional<int> ReadId(const std::string& text) {
  int id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  return error == std::errc() && end == text.data() + text.size() && id >= 1 ? std::optional(id)
                                                                             : std::nullopt;
}

bool SameLetters(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

int FindCallsign(const fleet_roster_t& roster, const std::string& name) {
  for (const auto& vehicle : roster.vehicles) {
    if (SameLetters(vehicle.callsign, name)) return vehicle.id;
  }
  std::string known;
  for (std::size_t i = 0; i < std::min(roster.vehicles.size(), kCallsignsListed); ++i) {
    known += (i > 0 ? ", " : "") + roster.vehicles[i].callsign;
  }
  if (roster.vehicles.size() > kCallsignsListed) known += ", ...";
  throw Failure("there is no UAV \"" + name + "\" in this fleet; there are " +
                (known.empty() ? "none" : known));
}

}  // namespace

std::vector<int> FindVehicles(Station& station, const std::vector<std::string>& names) {
  std::vector<int> ids;
  for (const std::string& name : names) {
    const auto id = ReadId(name);
    ids.push_back(id ? *id : FindCallsign(station.Roster(), name));
  }
  return ids;
}

std::string Callsign(const Picture& picture, int vehicle_id) {
  if (picture.roster) {
    for (const auto& vehicle : picture.roster->vehicles) {
      if (vehicle.id == vehicle_id) return vehicle.callsign;
    }
  }
  return std::to_string(vehicle_id);
}

std::string Callsigns(const Picture& picture, const std::vector<int>& vehicle_ids) {
  if (vehicle_ids.size() > kCallsignsInLine) return std::to_string(vehicle_ids.size()) + " UAVs";
  std::string names;
  for (const int id : vehicle_ids) names += (names.empty() ? "" : ", ") + Callsign(picture, id);
  return names;
}

}  // namespace skein::cli
