#include "bridge/history.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/frames.h"

namespace skein::bridge {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

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

/// The rows of one UAV in one sample after the other: nearly always at the same place.
class RowFinder {
 public:
  explicit RowFinder(std::int32_t id) : id_(id) {}

  const HistoryRow& Find(const std::vector<HistoryRow>& rows) {
    if (place_ >= rows.size() || rows[place_].id != id_) {
      const auto row = std::ranges::lower_bound(rows, id_, {}, &HistoryRow::id);
      if (row == rows.end() || row->id != id_) return absent_;
      place_ = static_cast<std::size_t>(row - rows.begin());
    }
    return rows[place_];
  }

 private:
  const HistoryRow absent_;
  std::int32_t id_;
  std::size_t place_ = 0;
};

template <typename Number>
void Put(std::string& bytes, std::size_t place, Number number) {
  std::copy_n(reinterpret_cast<const char*>(&number), sizeof number,
              bytes.begin() + static_cast<std::ptrdiff_t>(place));
}

}  // namespace

void History::Take(const FleetTable& fleet, FrameTime time, bus::Utime now) {
  if (time.t_s < 0 || fleet.rows().empty()) return;
  if (!samples_.empty()) {
    const double last_s = samples_.back()->t_s;
    if (time.t_s < last_s) Clear();
    // On a grid, so that a sample that is late does not put off the next.
    else if (std::floor(time.t_s / spacing_s_) <= std::floor(last_s / spacing_s_))
      return;
  }
  auto sample = std::make_shared<HistorySample>();
  sample->t_s = time.t_s;
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

std::string EncodeHistory(const HistorySamples& samples, const HistoryQuery& query, bus::Utime start_utime) {
  const auto first =
      std::ranges::upper_bound(samples, query.since_s, {}, [](const auto& s) { return s->t_s; });
  const auto sample_count = static_cast<std::size_t>(samples.end() - first);
  const std::size_t id_count = query.ids.size();
  constexpr std::size_t kValues = std::tuple_size_v<decltype(HistoryRow::values)>;
  const std::size_t times_at = 24;
  const std::size_t ids_at = times_at + 8 * sample_count;
  const std::size_t values_at = ids_at + 4 * id_count;
  const std::size_t flags_at = values_at + 4 * id_count * kValues * sample_count;

  std::string bytes(flags_at + id_count * sample_count, '\0');
  Put(bytes, 0, kHistoryKind);
  Put(bytes, 1, std::uint8_t{1});
  Put(bytes, 4, static_cast<std::uint32_t>(id_count));
  Put(bytes, 8, static_cast<double>(start_utime));
  Put(bytes, 16, static_cast<std::uint32_t>(sample_count));
  for (std::size_t i = 0; i < sample_count; ++i) {
    Put(bytes, times_at + 8 * i, first[static_cast<std::ptrdiff_t>(i)]->t_s);
  }
  for (std::size_t k = 0; k < id_count; ++k) {
    Put(bytes, ids_at + 4 * k, query.ids[k]);
    RowFinder finder(query.ids[k]);
    for (std::size_t i = 0; i < sample_count; ++i) {
      const HistoryRow& row = finder.Find(first[static_cast<std::ptrdiff_t>(i)]->rows);
      for (std::size_t value = 0; value < kValues; ++value) {
        Put(bytes, values_at + 4 * ((k * kValues + value) * sample_count + i), row.values[value]);
      }
      Put(bytes, flags_at + k * sample_count + i, row.flags);
    }
  }
  return bytes;
}

}  // namespace skein::bridge
