#include "bridge/history_answer.h"

#include <algorithm>
#include <bit>

#include "bridge/binary_frames.h"

namespace skein::bridge {
namespace {

using recording::HistoryRow;

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

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

std::string EncodeHistory(const recording::HistorySamples& samples, const HistoryQuery& query,
                          bus::Utime start_utime) {
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
