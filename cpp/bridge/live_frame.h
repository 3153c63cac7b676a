#pragma once

#include <memory>
#include <string>

namespace skein::bridge {

/// Something for the browsers, encoded once for all of them.
struct LiveFrame {
  std::shared_ptr<const std::string> bytes;
  bool binary = false;
  std::string key;      ///< a newer frame of the same key replaces one that still waits; "": must not be lost
  bool resets = false;  ///< what was sent before counts no more, but for answers
  bool answer = false;  ///< to one request of this browser
};

inline LiveFrame TextFrame(std::string text, std::string key = "") {
  return {std::make_shared<const std::string>(std::move(text)), false, std::move(key)};
}

inline LiveFrame BinaryFrame(std::string bytes, std::string key) {
  return {std::make_shared<const std::string>(std::move(bytes)), true, std::move(key)};
}

/// Time has jumped (only in recordings): the page empties its picture.
inline LiveFrame ResetFrame() {
  LiveFrame frame = TextFrame(R"({"type":"reset"})");
  frame.resets = true;
  return frame;
}

}  // namespace skein::bridge
