#include "recording/history.h"

#include <algorithm>
#include <cmath>

#include "core/frames.h"

namespace skein::recording {
namespace {

// The link watch calls a UAV late after so long; what is still shown of it then is old.
constexpr bus::Utime kOldAfter = 2 * bus::kSecond;

HistoryRow Row(std::int32_t id, const FleetRow& row, bus::Utime now) {
  HistoryRow result;
  result.id = id;
  auto& values = result.values;
  const bool lost = row.link && row.link->downlink == link_status_t::LINK_LOST;
  if (row.state && !lost && now - row.heard_at < kOldAfter) {
    result.flags |= HistoryRow::kHeard;
    values[0] = static_cast<float>(row.state->up_m);
    values[1] = static_cast<float>(row.state->speed_m_s);
    values[2] = static_cast<float>(WrapAngle(row.state->course_rad));
  }
  if (row.slot) {
    result.flags |= HistoryRow::kHasSlot;
    values[3] = static_cast<float>(row.slot->forward_error_m);
    values[4] = static_cast<float>(row.slot->left_error_m);
    values[5] = static_cast<float>(row.slot->up_error_m);
  }
  if (row.proximity) {
    values[6] = static_cast<float>(row.proximity->nearest_horizontal_m);
    values[7] = static_cast<float>(row.proximity->nearest_vertical_m);
    values[8] = static_cast<float>(row.proximity->tau_s);
  }
  return result;
}

}  // namespace

void History::Take(const FleetTable& fleet, double t_s, bus::Utime now) {
  if (t_s < 0 || fleet.rows().empty()) return;
  if (!samples_.empty()) {
    const double last_s = samples_.back()->t_s;
    if (t_s < last_s) Clear();
    // On a grid, so that a sample that is late does not put off the next.
    else if (std::floor(t_s / spacing_s_) <= std::floor(last_s / spacing_s_))
      return;
  }
  auto sample = std::make_shared<HistorySample>();
  sample->t_s = t_s;
  sample->rows.reserve(fleet.rows().size());
  for (const auto& [id, row] : fleet.rows()) sample->rows.push_back(Row(id, row, now));
  row_count_ += sample->rows.size();
  samples_.push_back(std::move(sample));
  while (samples_.size() > 2 && (samples_.size() > limits_.samples || row_count_ > limits_.rows)) ThinOut();
}

void History::Clear() {
  samples_.clear();
  row_count_ = 0;
  spacing_s_ = 1;
}

void History::ThinOut() {
  spacing_s_ *= 2;
  HistorySamples kept;
  row_count_ = 0;
  for (std::size_t i = 0; i < samples_.size(); i += 2) {
    row_count_ += samples_[i]->rows.size();
    kept.push_back(std::move(samples_[i]));
  }
  samples_ = std::move(kept);
}

}  // namespace skein::recording
