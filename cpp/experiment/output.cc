#include "experiment/output.h"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "config/scenario.h"

namespace skein::experiment {

void CheckWritable(const std::filesystem::path& file) {
  if (file.empty()) return;
  errno = 0;
  if (!std::ofstream(file, std::ios::app)) {
    throw config::ConfigError(file.string() + ": cannot be written: " + std::strerror(errno));
  }
}

void WriteFile(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.flush();
  if (!stream) throw std::runtime_error(file.string() + ": could not be written wholly");
}

Progress::Progress(double total, std::string unit)
    : total_(total), unit_(std::move(unit)), shown_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (wrote_) fmt::print(stderr, "\r\033[K");
}

void Progress::Show(double done) {
  const auto now = Clock::now();
  if (!shown_ || done <= 0 || now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  wrote_ = true;
  const std::chrono::duration<double> took = now - start_;
  fmt::print(stderr, "\r{:.0f} of {:.0f} {} ({:.0f}%), {:.0f} s left\033[K", done, total_, unit_,
             100 * done / total_, took.count() * (total_ - done) / done);
  std::fflush(stderr);
}

}  // namespace skein::experiment
