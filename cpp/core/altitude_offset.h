#pragma once

namespace skein {

/// A height above the planned altitude and how it changes.
struct AltitudeOffset {
  double height_m = 0;
  double rate_m_s = 0;
  double acceleration_m_s2 = 0;
  bool operator==(const AltitudeOffset&) const = default;
};

struct AltitudeRampLimits {
  double rate_m_s = 10;          ///< > 0
  double acceleration_m_s2 = 2;  ///< > 0
};

/// Moves an altitude offset to a target: never faster nor harder than the limits, without overshoot.
/// The target may change at any time, in mid-climb too.
class AltitudeRamp {
 public:
  AltitudeRamp() = default;
  explicit AltitudeRamp(const AltitudeOffset& start, const AltitudeRampLimits& limits = {});

  void SetTarget(double height_m) { target_m_ = height_m; }
  double target_m() const { return target_m_; }
  const AltitudeOffset& now() const { return now_; }
  /// True when it stands at its target.
  bool settled() const;

  /// Moves on by step_s >= 0.
  void Advance(double step_s);

  /// Time until it stands at its target [s].
  double RemainingTime() const;

  const AltitudeRampLimits& limits() const { return limits_; }
  /// Holds from the next step on; a rate above it is brought down at the acceleration limit.
  void SetLimits(const AltitudeRampLimits& limits) { limits_ = limits; }

 private:
  void Step(double step_s);

  AltitudeRampLimits limits_;
  AltitudeOffset now_;
  double target_m_ = 0;
};

}  // namespace skein
