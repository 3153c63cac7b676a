#pragma once

#include <cstdint>

#include "bus/executor.h"

namespace skein::bus {

/// Which set a chunk belongs to.
struct SetStamp {
  std::int64_t session_id = 0;
  Utime utime = 0;
  std::int64_t set = 0;

  bool operator==(const SetStamp&) const = default;
};

/// Decides in which order the sets of one source are taken. A later session replaces an earlier one at once,
/// and so does a later set 0: a type without a session shows by it that its sender was started anew. Within a
/// session time and set number must rise. What does not fit is late or false, until three sets in a row come
/// from the same other source with rising stamps and nothing from the present one: then its clock was set, or
/// it was started anew with an earlier clock, and it is taken again.
class SetOrder {
 public:
  enum class Verdict {
    kSame,        ///< the set that is being assembled
    kNext,        ///< a later one
    kNewSource,   ///< the first one of a later session, of a later start, or of all
    kTakenAgain,  ///< time has jumped, and this is the third rising stamp
    kLate,        ///< to be ignored: networks double and overtake, and a source begins anew unheard
    kFalse,       ///< to be ignored: of an earlier session, or of a time that cannot be
  };

  Verdict Judge(const SetStamp& stamp);

  /// The last set that was taken.
  const SetStamp& current() const { return current_; }

 private:
  bool FitsCurrent(const SetStamp& stamp) const;
  bool StartsAnew(const SetStamp& stamp) const;
  bool ThirdInARow(const SetStamp& stamp);
  bool IsLate(const SetStamp& stamp) const;

  bool started_ = false;
  SetStamp current_;
  SetStamp candidate_;
  int candidate_stamps_ = 0;
};

}  // namespace skein::bus
