#pragma once

namespace skein {

/// Factors of eq. (8) of [1]; defaults do nothing.
struct PidGains {
  double p = 0;  ///< k_P, >= 0
  double i = 0;  ///< k_I [1/s], >= 0
  double d = 0;  ///< k_D [s], >= 0
  double n = 1;  ///< k_N, corner of the derivative's filter [1/s], > 0
};
/// Throws std::invalid_argument naming the factor that makes no sense.
void Check(const PidGains& gains);

/// Where a response stands against its limits.
enum class AtLimit { kNone, kUpper, kLower };

/// PID with a filtered derivative, eq. (8) of [1]: P + I/s + D N / (1 + N/s).
///
/// Discretised for an error that runs straight from one sample to the next, for which it is exact: the
/// integral by the trapezoidal rule, the filtered derivative by d' = a d + D (1 - a) / dt (e' - e) with a =
/// exp(-N dt), which is stable for any N and dt. The first sample counts as having stood there for ever: it
/// gives neither an integral nor a derivative.
///
/// Anti-windup: the integral stands still while the response is at a limit and the error drives it further
/// out.
class Pid {
 public:
  explicit Pid(const PidGains& gains);

  /// @param dt_s since the last call, > 0. @param response how the controlled loop stands now.
  double Update(double error, double dt_s, AtLimit response = AtLimit::kNone);

  /// Holds integral and derivative until the next Update(), which goes on from them however long it takes:
  /// the same error gives the same output again, and the way the error took meanwhile counts for nothing.
  void Freeze() { frozen_ = true; }

  /// As new.
  void Reset();

 private:
  PidGains gains_;
  bool started_ = false;
  bool frozen_ = false;
  double error_ = 0;
  double integral_ = 0;
  double derivative_ = 0;
};

}  // namespace skein
