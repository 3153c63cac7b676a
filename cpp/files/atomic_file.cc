#include "files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

namespace skein::files {
namespace {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags, mode_t mode = 0)
      : number_(open(path.c_str(), flags | O_CLOEXEC, mode)) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  bool ok() const { return number_ >= 0; }

 private:
  int number_;
};

bool WriteAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool WriteThrough(const std::filesystem::path& file, std::string_view bytes, mode_t mode) {
  const Descriptor fresh(file, O_WRONLY | O_CREAT | O_TRUNC, mode);
  return fresh.ok() && fchmod(fresh.number(), mode) == 0 && WriteAll(fresh.number(), bytes) &&
         fsync(fresh.number()) == 0;
}

}  // namespace

void WriteAtomically(const std::filesystem::path& file, std::string_view bytes, mode_t mode) {
  // A name of its own for each process: two that write at once do not write into one another's.
  const std::filesystem::path fresh = file.string() + ".new-" + std::to_string(getpid());
  if (!WriteThrough(fresh, bytes, mode) || std::rename(fresh.c_str(), file.c_str()) != 0) {
    const int error = errno;
    unlink(fresh.c_str());
    throw std::system_error(error, std::generic_category(), file.string() + ": cannot be written");
  }
  // The new name is on the disk only when its folder is.
  const Descriptor folder(file.has_parent_path() ? file.parent_path() : ".", O_RDONLY | O_DIRECTORY);
  if (folder.ok()) fsync(folder.number());
}

}  // namespace skein::files
