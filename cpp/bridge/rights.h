#pragma once

namespace skein::bridge {

/// What somebody may do.
struct Rights {
  bool look = true;     ///< see the fleet and the recordings
  bool operate = true;  ///< hold control, and so command; delete recordings

  bool operator==(const Rights&) const = default;
};

}  // namespace skein::bridge
