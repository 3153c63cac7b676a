#pragma once

#include <deque>

#include "core/path.h"

namespace skein {

/// The virtual leader: a reference that moves exactly along its path at the planned speed. Time is in seconds
/// on any one clock. Keeps some seconds of history, so that a UAV is compared with the leader at the UAV's
/// own time stamp.
class VirtualLeader {
 public:
  VirtualLeader(Path path, double arc_m, double time_s);

  /// Moves on to time_s; the same time again, or an earlier one, does nothing.
  void AdvanceTo(double time_s);

  /// Arc length at a time: within the history (10 s) and a little into the future as it was and will be flown
  /// on this path.
  double ArcAt(double time_s) const;

  double time_s() const { return history_.back().time_s; }
  double arc_m() const { return history_.back().arc_m; }
  const Path& path() const { return path_; }

  /// Replaces the path. Its points at arc_m() and behind must be those of the old one (as Join and Loiter
  /// give it).
  void SetPath(Path path) { path_ = std::move(path); }

 private:
  struct Moment {
    double time_s;
    double arc_m;
  };

  Path path_;
  std::deque<Moment> history_;  ///< rising, never empty, the last one is now
};

}  // namespace skein
