#pragma once

#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <memory>

#include "bus/executor.h"

namespace skein::bus {

/// Writes everything that goes over a transport to an LCM log that lcm-logplayer plays, stamped with the
/// executor's time: the log of a simulated flight has simulated time stamps, and is the same on every run.
class LogWriter {
 public:
  /// Throws std::runtime_error when the file cannot be made.
  LogWriter(std::shared_ptr<lcm::LCM> transport, const Executor& executor, const std::filesystem::path& file);
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Writes what is still in buffers. Throws std::runtime_error when something could not be written.
  void Flush();

 private:
  void OnMessage(const lcm::ReceiveBuffer* buffer, const std::string& channel);

  std::shared_ptr<lcm::LCM> transport_;
  const Executor& executor_;
  std::filesystem::path file_;
  lcm::LogFile log_;
  lcm::Subscription* subscription_ = nullptr;
  bool failed_ = false;
};

}  // namespace skein::bus
