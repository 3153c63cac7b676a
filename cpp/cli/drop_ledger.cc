#include "cli/drop_ledger.h"

#include <algorithm>
#include <limits>

namespace skein::cli {

std::optional<double> DropRecord::detection_s() const {
  return found ? std::optional(bus::ToSeconds(*found - start)) : std::nullopt;
}

std::string DropRecord::Outcome(double limit_s, bus::Utime now) const {
  if (overlapped) return "overlapped";
  const bool is_short = bus::ToSeconds(end - start) < limit_s;
  if (found) return detection_s() <= limit_s || !drop.is_cut() ? "found" : is_short ? "short" : "late";
  if (now < end + DropLedger::kGrace) return "pending";
  if (!drop.is_cut()) return "degraded";
  if (!judged) return "not judged";
  return is_short ? "short" : "missed";
}

bool DropLedger::Covers(const DropRecord& record, bus::Utime utime) {
  return utime >= record.start && utime <= record.end + kGrace + bus::ToUtime(record.drop.delay_s);
}

void DropLedger::Begin(int number, int vehicle_id, const Drop& drop, bus::Utime start, bool judged) {
  DropRecord record{number, vehicle_id, drop, start, start + bus::ToUtime(drop.for_s), {}, {}, false, judged};
  const auto known = links_.find(vehicle_id);
  if (known != links_.end() && known->second != Link::kUp) record.overlapped = true;
  for (DropRecord& earlier : records_) {
    if (earlier.vehicle_id != vehicle_id || earlier.end < start) continue;
    record.overlapped = true;
    // A cut that is long enough to be found by itself counts; what is found of another one may be the later
    // one's.
    if (!earlier.found && (!earlier.drop.is_cut() || earlier.drop.for_s < limit_s_))
      earlier.overlapped = true;
  }
  records_.push_back(record);
}

void DropLedger::Stop(bus::Utime now) {
  // Those that have not begun never will.
  std::erase_if(records_, [now](const DropRecord& record) { return record.start > now; });
  for (DropRecord& record : records_) record.end = std::min(record.end, now);
}

void DropLedger::HearCut(int vehicle_id, bool cut, bus::Utime utime) {
  const bool is_ours = std::any_of(records_.begin(), records_.end(), [&](const DropRecord& record) {
    return record.vehicle_id == vehicle_id && Covers(record, utime);
  });
  if (cut && !is_ours) {
    cut_by_others_until_[vehicle_id] = std::numeric_limits<bus::Utime>::max();
  } else if (!cut && cut_by_others_until_.contains(vehicle_id)) {
    cut_by_others_until_[vehicle_id] = utime + kGrace;
  }
}

DropLedger::News DropLedger::Hear(int vehicle_id, Link link, bus::Utime utime) {
  News news;
  const auto [known, is_first] = links_.try_emplace(vehicle_id, link);
  const bool was_lost = !is_first && known->second == Link::kLost;
  known->second = link;
  if (link == Link::kUp) {
    for (DropRecord& record : records_) {
      if (record.vehicle_id != vehicle_id || record.back || utime < record.end) continue;
      record.back = utime;
      if (record.found) news.back = &record;
    }
  }
  // One that was lost before we came is nobody's.
  if (link != Link::kLost || was_lost || is_first) return news;
  bool is_covered = false;
  for (DropRecord& record : records_) {
    if (record.vehicle_id != vehicle_id || !Covers(record, utime)) continue;
    is_covered = true;
    if (record.found || record.overlapped || news.found != nullptr) continue;
    record.found = utime;
    news.found = &record;
  }
  const auto others = cut_by_others_until_.find(vehicle_id);
  if (is_covered || (others != cut_by_others_until_.end() && utime <= others->second)) return news;
  false_losses_.push_back({vehicle_id, utime});
  news.is_false = true;
  return news;
}

bool DropLedger::IsSettled(bus::Utime now) const {
  constexpr bus::Utime kBackWithin = 10 * bus::kSecond;
  return std::all_of(records_.begin(), records_.end(), [now](const DropRecord& record) {
    const bus::Utime over = record.end + kGrace + bus::ToUtime(record.drop.delay_s);
    return now > over && (record.back || !record.found || now > over + kBackWithin);
  });
}

}  // namespace skein::cli
