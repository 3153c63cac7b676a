#pragma once

#include <cstdint>

namespace skein {

inline constexpr double kStep = 0.05;               ///< the controller's tick [s]
inline constexpr std::int64_t kSecond = 1'000'000;  ///< [us]

}  // namespace skein
