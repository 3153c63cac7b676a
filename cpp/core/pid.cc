#include "core/pid.h"

#include <cassert>
#include <cmath>
#include <stdexcept>

namespace skein {

void Check(const PidGains& gains) {
  const auto check = [](bool good, const char* problem) {
    if (!good) throw std::invalid_argument(problem);
  };
  check(gains.p >= 0 && std::isfinite(gains.p), "p must not be negative");
  check(gains.i >= 0 && std::isfinite(gains.i), "i must not be negative");
  check(gains.d >= 0 && std::isfinite(gains.d), "d must not be negative");
  check(gains.n > 0 && std::isfinite(gains.n), "n must be above 0");
}

Pid::Pid(const PidGains& gains) : gains_(gains) { Check(gains); }

double Pid::Update(double error, double dt_s, AtLimit response) {
  assert(dt_s > 0);
  if (started_ && !frozen_) {
    const double area = (error_ + error) / 2 * dt_s;
    const bool winds_up =
        (response == AtLimit::kUpper && area > 0) || (response == AtLimit::kLower && area < 0);
    if (!winds_up) integral_ += gains_.i * area;
    const double a = std::exp(-gains_.n * dt_s);
    derivative_ = a * derivative_ + gains_.d * (1 - a) / dt_s * (error - error_);
  }
  started_ = true;
  frozen_ = false;
  error_ = error;
  return gains_.p * error + integral_ + derivative_;
}

void Pid::Reset() { *this = Pid(gains_); }

}  // namespace skein
