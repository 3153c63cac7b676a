#include "simulator/vehicle_link.h"

namespace skein::simulator {

bool LinkSetting::operator==(const LinkSetting& other) const {
  return mode == other.mode && quality.delay_s == other.quality.delay_s &&
         quality.jitter_s == other.quality.jitter_s && quality.loss == other.quality.loss;
}

double LinkRandom::Next() {
  state_ += 0x9E3779B97F4A7C15;
  std::uint64_t mixed = state_;
  mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9;
  mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EB;
  mixed ^= mixed >> 31;
  return static_cast<double>(mixed >> 11) * 0x1p-53;
}

}  // namespace skein::simulator
