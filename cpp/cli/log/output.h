#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

namespace skein::cli {

struct OutputOptions {
  std::string file;    ///< "": standard output
  bool force = false;  ///< replace a file that exists
};

/// Where a command writes to: standard output, or a file that appears only once it is whole.
class Output {
 public:
  /// @param inputs what is read meanwhile: never replaced. Throws config::ConfigError when the file cannot be
  /// made, or exists and is not to be replaced.
  Output(const OutputOptions& options, std::ostream& standard_output,
         const std::vector<std::filesystem::path>& inputs);
  /// Without Finish() no file is left behind.
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  std::ostream& stream();

  /// Throws std::runtime_error when not all could be written.
  void Finish();

 private:
  OutputOptions options_;
  std::ostream& standard_output_;
  std::filesystem::path part_;  ///< what becomes the file
  std::ofstream stream_;
};

}  // namespace skein::cli
