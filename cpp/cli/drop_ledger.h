#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bus/executor.h"
#include "cli/drop_plan.h"

namespace skein::cli {

/// What became of one drop of one UAV.
struct DropRecord {
  int number = 0;  ///< of the drop, from 1; drops of several UAVs have a record each
  int vehicle_id = 0;
  Drop drop;
  bus::Utime start = 0;
  bus::Utime end = 0;               ///< when it is over; sooner when everything was stopped
  std::optional<bus::Utime> found;  ///< the monitor tells the link lost
  std::optional<bus::Utime> back;   ///< both directions up again after its end
  bool overlapped =
      false;  ///< the UAV's link was not up when it began, or was cut once more before it was seen up
  bool judged = true;  ///< false: an uplink over which nobody sends commands

  /// "found", "late", "missed", "short" (over before the limit, not found by then), "degraded" (not cut, not
  /// found), "overlapped" or "not judged"; "pending" while it can still be found.
  std::string Outcome(double limit_s, bus::Utime now) const;
  std::optional<double> detection_s() const;
};

/// A link that the monitor told lost though neither we nor anybody else had cut it.
struct FalseLoss {
  int vehicle_id = 0;
  bus::Utime utime = 0;
};

/// Keeps account of drops and of what the monitor finds.
class DropLedger {
 public:
  /// A link that is back may still be told lost for so long: what was under way was too old.
  static constexpr bus::Utime kGrace = bus::kSecond;

  enum class Link { kUp, kLate, kLost };

  /// @param limit_s a cut is to be found within this
  explicit DropLedger(double limit_s) : limit_s_(limit_s) {}

  void Begin(int number, int vehicle_id, const Drop& drop, bus::Utime start, bool judged);
  /// Everything that still goes on ends now.
  void Stop(bus::Utime now);
  /// The simulator tells that a link was cut, or is up again: by whomever.
  void HearCut(int vehicle_id, bool cut, bus::Utime utime);

  struct News {
    const DropRecord* found = nullptr;
    const DropRecord* back = nullptr;
    bool is_false = false;
  };
  /// The monitor's word on a UAV. @param link the worse of both directions
  News Hear(int vehicle_id, Link link, bus::Utime utime);

  const std::vector<DropRecord>& records() const { return records_; }
  const std::vector<FalseLoss>& false_losses() const { return false_losses_; }
  /// Whether nothing more can be learned of any drop, but for links that should be up again and are not.
  bool IsSettled(bus::Utime now) const;

 private:
  static bool Covers(const DropRecord& record, bus::Utime utime);

  double limit_s_;
  std::vector<DropRecord> records_;
  std::vector<FalseLoss> false_losses_;
  std::map<int, Link> links_;
  std::map<int, bus::Utime> cut_by_others_until_;
};

}  // namespace skein::cli
