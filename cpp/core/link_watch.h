#pragma once

#include <cstdint>
#include <optional>

#include "core/vehicle.h"

namespace skein {

/// The numbers are those of LINK_STATUS.
enum class LinkState { kUp = 0, kLate = 1, kLost = 2, kUnknown = 3 };

/// When a link is what [us]. Lost, plus a check every 100 ms, plus the delay of the link is below the
/// promised 5 s.
struct LinkTimes {
  std::int64_t late_us = 2'000'000;     ///< > 0
  std::int64_t lost_us = 4'000'000;     ///< > late_us
  std::int64_t unknown_us = 5'000'000;  ///< a link that has never proved itself is lost after this, > 0
  std::int64_t return_us = 3'000'000;   ///< of proofs that a lost link needs, > 0
  /// A watch that is started anew listens so long before it finds a loss: a link in order proves itself in
  /// that time, also when telemetry comes at 1 Hz, and with it a loss is found in time. > 0, < lost_us
  std::int64_t listen_us = 2'500'000;
};
/// Throws std::invalid_argument naming the field and the reason.
void Check(const LinkTimes& times);

/// One direction of a data link: for how long has it failed to prove that it works?
///
///   kUnknown --(proof)--> kUp          kUnknown --(age >= 5 s)--> kLost
///   kUp      --(age >= 2 s)--> kLate --(age >= 4 s)--> kLost
///   kLate    --(proof)--> kUp
///   kLost    --(3 s of proofs, no two of them 2 s apart)--> kUp
///   kUp, kLate --(Forget: it is not used)--> kUnknown
///
/// One that had proved itself before its watch was started anew (Recall) is kUnknown, and lost after 4 s.
///
/// Not thread-safe. Has no clock: the caller says what time it is, which never goes back.
class LinkDirection {
 public:
  explicit LinkDirection(const LinkTimes& times = {});

  /// It has proved itself.
  void Prove(std::int64_t now);
  /// To be called often. @param age_us for how long it has failed to prove itself while it should have.
  void Check(std::int64_t age_us);
  void Forget();
  /// It had proved itself before. Only at the start.
  void Recall() { recalled_ = true; }

  LinkState state() const { return state_; }

 private:
  LinkTimes times_;
  bool recalled_ = false;
  LinkState state_ = LinkState::kUnknown;
  std::int64_t run_start_ = 0;  ///< of the proofs that followed each other closely
  std::optional<std::int64_t> last_proof_;
};

/// What a UAV said of itself.
struct Telemetry {
  std::int64_t utime = 0;  ///< when it was in this state, by its own clock [us]
  VehicleState state;
  std::int64_t command_session_id = 0;  ///< of the last command it obeyed, 0: none
  std::int64_t command_sequence = 0;
};

/// Watches the data link of one UAV, both directions.
///
/// Downlink: proved by fresh telemetry. Fresh is a newer time stamp and a position that has moved as the
/// speed says it must; a link that repeats its last state is broken too, also when it stamps it anew. (Below
/// 2 m/s the stamp alone counts.) The very first telemetry proves nothing: it may be such a repetition.
///
/// Uplink: proved when the sequence that the UAV says it obeyed goes up within the commanding session. Its
/// age is the span over which commands were sent since, so that it grows only while there is something to
/// obey, and a round trip much below 2 s never shows. Without a downlink nothing proves the uplink: it is
/// lost with it.
class LinkWatch {
 public:
  /// @param now when the watch begins [us].
  explicit LinkWatch(std::int64_t now, const LinkTimes& times = {});

  enum class Heard { kFresh, kStale, kClockJumped };
  /// Telemetry has arrived. A clock that has gone back (by more than 2 s) is taken again after three rising
  /// stamps.
  Heard Hear(std::int64_t now, const Telemetry& telemetry);
  /// A command has been sent to it. Sessions smaller than one heard before are nobody's any more.
  void Command(std::int64_t now, std::int64_t session_id);
  /// To be called often: states change with time alone.
  void Check(std::int64_t now);

  /// What a watch that is started anew must know to find a loss as early as this one would have.
  struct Memory {
    std::int64_t fresh_at = 0;        ///< last fresh telemetry
    std::int64_t session_id = 0;      ///< the commanding one, 0: none
    std::int64_t unobeyed_since = 0;  ///< until then it had obeyed
  };
  /// None: there was no fresh telemetry yet.
  std::optional<Memory> Remember(std::int64_t now) const;
  /// Only at the start. Nobody has listened meanwhile: lost is a link listen_us from now at the earliest.
  void Recall(std::int64_t now, const Memory& memory);

  LinkState downlink() const { return downlink_.state(); }
  LinkState uplink() const { return uplink_.state(); }
  /// Either direction.
  bool lost() const { return downlink() == LinkState::kLost || uplink() == LinkState::kLost; }

  /// Since the last fresh telemetry [us]; none: there was none yet.
  std::optional<std::int64_t> downlink_age_us(std::int64_t now) const;
  /// For how long it has disobeyed [us]; none: not judged.
  std::optional<std::int64_t> uplink_age_us() const;

  /// The last state that can be believed; none: never heard.
  const std::optional<Telemetry>& last() const { return last_; }
  /// How old that is [us]: by its own stamp, which knows the link's delay; by its arrival when the stamp
  /// cannot be right.
  std::int64_t last_age_us(std::int64_t now) const;

 private:
  bool ClockJumped(const Telemetry& telemetry);
  std::int64_t Disobeyed() const;
  void HearObedience(std::int64_t now, const Telemetry& telemetry);

  LinkTimes times_;
  std::int64_t since_;  ///< when the watch began; from then a downlink is unknown
  LinkDirection downlink_;
  LinkDirection uplink_;

  std::optional<Telemetry> last_;
  std::int64_t last_arrival_ = 0;
  std::optional<Telemetry> newest_;        ///< by stamp, moved or not: what the next one is compared with
  std::optional<std::int64_t> fresh_at_;   ///< arrival of the last fresh telemetry
  std::optional<std::int64_t> old_stamp_;  ///< of the last telemetry whose stamp had gone back
  int old_stamps_rising_ = 0;

  std::int64_t session_id_ = 0;                 ///< the commanding one
  std::optional<std::int64_t> unobeyed_since_;  ///< first command sent since it last obeyed
  std::int64_t last_command_ = 0;
};

}  // namespace skein
