#pragma once

#include <deque>

#include "core/path.h"

namespace skein {

/// The virtual leader: a reference that moves exactly along its path at the planned speed. Time is in seconds on any one clock.
/// Keeps some seconds of history, so that a UAV is compared with the leader at the UAV's own time stamp.
class VirtualLeader {
 public:
  VirtualLeader(Path path, double arc_m, double time_s);

  /// Moves on to time_s (not earlier than before; the same time again does nothing).
  void AdvanceTo(double time_s);

  /// Arc length at a time; within the history (10 s) exact, a little into the future by the planned speed.
  double ArcAt(double time_s) const;

  double time_s() const;
  double arc_m() const;
  const Path& path() const;

  /// Replaces the path. Its points at arc_m() and behind must be those of the old one (as Join and Loiter give it).
  void SetPath(Path path);
};

}  // namespace skein
