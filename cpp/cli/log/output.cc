#include "cli/log/output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "config/scenario.h"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void RefuseToReplace(const std::string& file) {
  throw config::ConfigError(file + ": exists already; --force replaces it");
}

}  // namespace

Output::Output(const OutputOptions& options, std::ostream& standard_output,
               const std::vector<std::filesystem::path>& inputs)
    : options_(options), standard_output_(standard_output) {
  if (options.file.empty()) return;
  std::error_code error;
  const fs::file_status status = fs::status(options.file, error);
  if (fs::is_directory(status)) throw config::ConfigError(options.file + ": is a folder");
  for (const fs::path& input : inputs) {
    if (fs::equivalent(input, options.file, error))
      throw config::ConfigError(options.file + ": is what is read; write into another file");
  }
  if (fs::is_regular_file(status) && !options.force) RefuseToReplace(options.file);
  // Into a pipe or a device there is nothing to replace.
  const bool is_plain = !fs::exists(status) || fs::is_regular_file(status);
  if (is_plain) part_ = options.file + ".part-" + std::to_string(getpid());
  errno = 0;
  stream_.open(is_plain ? part_ : fs::path(options.file), std::ios::binary);
  if (!stream_) {
    throw config::ConfigError(options.file + ": cannot be written: " + std::strerror(errno));
  }
}

Output::~Output() {
  std::error_code error;
  if (!part_.empty()) fs::remove(part_, error);
}

std::ostream& Output::stream() { return options_.file.empty() ? standard_output_ : stream_; }

void Output::Finish() {
  errno = 0;
  stream().flush();
  if (!stream()) {
    const std::string name = options_.file.empty() ? "standard output" : options_.file;
    throw std::runtime_error(name + ": could not be written wholly" +
                             (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
  }
  if (part_.empty()) return;
  stream_.close();
  // Somebody may have made the file meanwhile.
  const unsigned flags = options_.force ? 0 : RENAME_NOREPLACE;
  if (renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, options_.file.c_str(), flags) != 0) {
    if (errno == EEXIST) RefuseToReplace(options_.file);
    if (errno != EINVAL) throw std::runtime_error(options_.file + ": " + std::strerror(errno));
    fs::rename(part_, options_.file);  // a file system that does not know of flags
  }
  part_.clear();
}

}  // namespace skein::cli
