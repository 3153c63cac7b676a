#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "experiment/tick.h"

namespace skein::experiment {

/// A row per UAV and control step. README.md tells the columns.
class CsvWriter {
 public:
  static std::string Header();

  /// Throws std::runtime_error when the file cannot be made.
  explicit CsvWriter(const std::filesystem::path& file);

  void Add(const Tick& tick);

  /// Throws std::runtime_error when not everything could be written.
  void Finish();

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
};

}  // namespace skein::experiment
