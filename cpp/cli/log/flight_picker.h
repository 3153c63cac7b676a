#pragma once

#include <cstdint>
#include <skein/fleet_roster_t.hpp>

#include "bus/executor.h"

namespace skein::cli {

/// Tells one flight of a recording from the others: with each new start of a scenario another one begins.
class FlightPicker {
 public:
  /// @param wanted 1 for the first.
  explicit FlightPicker(int wanted) : wanted_(wanted) {}

  /// Whether it is of the wanted flight.
  bool Take(const fleet_roster_t& roster) {
    if (flights_ == 0 || roster.session_id != session_id_) ++flights_;
    session_id_ = roster.session_id;
    if (!is_wanted()) return false;
    start_utime_ = roster.start_utime;
    return true;
  }

  /// Whether the wanted flight is under way.
  bool is_wanted() const { return flights_ == wanted_; }
  /// Whether a state is part of it.
  bool Holds(std::int64_t session_id) const { return is_wanted() && session_id == session_id_; }
  /// Seconds of its scenario; of what a roster has been taken for.
  double TimeOf(bus::Utime utime) const { return bus::ToSeconds(utime - start_utime_); }

  int wanted() const { return wanted_; }
  int flights() const { return flights_; }  ///< begun so far

 private:
  int wanted_;
  int flights_ = 0;
  std::int64_t session_id_ = 0;
  bus::Utime start_utime_ = 0;
};

}  // namespace skein::cli
