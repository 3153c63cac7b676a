# Heavy headers are parsed once for all files instead of once for each. Every source still
# includes what it uses: clang-tidy (scripts/test) reads them without this. CMAKE_DISABLE_PRECOMPILE_HEADERS switches it off.
set(SKEIN_STANDARD_HEADERS <algorithm> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <optional> <set>
    <sstream> <stdexcept> <string> <thread> <utility> <vector>)
set(SKEIN_BUS_HEADERS ${SKEIN_STANDARD_HEADERS} <Eigen/Core> <lcm/lcm-cpp.hpp> <nlohmann/json.hpp> <spdlog/fmt/fmt.h> <spdlog/spdlog.h>)

# skein_share_headers(TARGET...): what links skein_bus is compiled with the same flags, and can use its headers.
function(skein_share_headers)
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM skein_bus)
  endforeach()
endfunction()
