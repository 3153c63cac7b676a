// Hundreds of flights would bury a failure under what their nodes tell the operator.
#include <spdlog/spdlog.h>

namespace {
const bool kQuiet = (spdlog::set_level(spdlog::level::off), true);
}  // namespace
