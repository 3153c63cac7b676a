#include "experiment/csv_writer.h"

#include <spdlog/fmt/fmt.h>

#include <iterator>
#include <stdexcept>

namespace skein::experiment {
namespace {

void AppendRow(fmt::memory_buffer& out, const Tick& tick, const VehicleTick& vehicle) {
  const auto end = std::back_inserter(out);
  const VehicleState& state = vehicle.truth;
  fmt::format_to(end, "{:.2f},{},{:.3f},{:.3f},{:.3f},{:.4f},{:.6f},{:.6f},", tick.t_s, vehicle.id,
                 state.east_m, state.north_m, state.up_m, state.speed_m_s, state.course_rad, state.climb_rad);
  if (vehicle.slot) {
    fmt::format_to(end, "{:.3f},{:.3f},{:.3f},", vehicle.slot->forward_error_m, vehicle.slot->left_error_m,
                   vehicle.slot->up_error_m);
  } else {
    fmt::format_to(end, ",,,");
  }
  fmt::format_to(end, "{},{},{},", Name(vehicle.link()), vehicle.level(), vehicle.formation_id);
  if (vehicle.slot) {
    fmt::format_to(end, "{:.3f},{:.3f},{:.3f},{:d},", vehicle.slot->slot_east_m, vehicle.slot->slot_north_m,
                   vehicle.slot->slot_up_m, vehicle.slot->flown != 0);
  } else {
    fmt::format_to(end, ",,,,");
  }
  if (vehicle.heard_utime) fmt::format_to(end, "{:.3f}", bus::ToSeconds(tick.utime - *vehicle.heard_utime));
  if (const auto& command = vehicle.command) {
    fmt::format_to(end, ",{:.4f},{:.6f},{:.6f}", command->speed_input_m_s, command->course_input_rad,
                   command->climb_input_rad);
  } else {
    fmt::format_to(end, ",,,");
  }
  out.push_back('\n');
}

}  // namespace

std::string_view Name(Link link) {
  switch (link) {
    case Link::kUp:
      return "up";
    case Link::kLate:
      return "late";
    case Link::kLost:
      break;
  }
  return "lost";
}

std::string CsvWriter::Header() {
  return "t_s,vehicle_id,east_m,north_m,up_m,speed_m_s,course_rad,climb_rad,slot_forward_m,slot_left_m,slot_"
         "up_m,link,"
         "level,formation_id,slot_east_m,slot_north_m,slot_altitude_m,flown,telemetry_age_s,speed_input_m_s,"
         "course_input_rad,climb_input_rad";
}

CsvWriter::CsvWriter(const std::filesystem::path& file) : file_(file), stream_(file, std::ios::binary) {
  if (!stream_) throw std::runtime_error(file.string() + ": cannot be written");
  stream_ << Header() << '\n';
}

void CsvWriter::Add(const Tick& tick) {
  fmt::memory_buffer rows;
  for (const VehicleTick& vehicle : tick.vehicles) AppendRow(rows, tick, vehicle);
  stream_.write(rows.data(), static_cast<std::streamsize>(rows.size()));
}

void CsvWriter::Finish() {
  stream_.flush();
  if (!stream_) throw std::runtime_error(file_.string() + ": could not be written wholly");
}

}  // namespace skein::experiment
