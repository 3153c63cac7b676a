#pragma once

#include <cstdint>
#include <string>

#include "bus/bus.h"

namespace skein::bus {

/// Tells operators what they must know: on EVENT and in the log.
class Events {
 public:
  explicit Events(Bus& bus) : bus_(bus) {}

  /// Whom an event is about; 0: nobody in particular.
  struct About {
    int vehicle_id = 0;
    int formation_id = 0;
  };

  /// @param severity a constant of event_t. @param code lower_snake_case, listed in lcmtypes/README.md.
  void Tell(std::int8_t severity, const std::string& code, const std::string& text, About about);
  void Tell(std::int8_t severity, const std::string& code, const std::string& text) {
    Tell(severity, code, text, {});
  }

 private:
  Bus& bus_;
};

}  // namespace skein::bus
