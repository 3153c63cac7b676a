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

/// Gives a file to whoever has the one that it replaces: root changes tokens that web-bridge's own user
/// reads.
bool GiveToOwnerOf(const std::filesystem::path& old, int descriptor) {
  struct stat owner {};
  if (stat(old.c_str(), &owner) != 0) return true;  // there is none yet
  struct stat own {};
  if (fstat(descriptor, &own) != 0) return false;
  if (own.st_uid == owner.st_uid && own.st_gid == owner.st_gid) return true;
  // Only root may; for others it becomes their own, as ever.
  return fchown(descriptor, owner.st_uid, owner.st_gid) == 0 || errno == EPERM;
}

bool WriteThrough(const std::filesystem::path& file, const std::filesystem::path& replaced,
                  std::string_view bytes, mode_t mode) {
  const Descriptor fresh(file, O_WRONLY | O_CREAT | O_TRUNC, mode);
  return fresh.ok() && fchmod(fresh.number(), mode) == 0 && GiveToOwnerOf(replaced, fresh.number()) &&
         WriteAll(fresh.number(), bytes) && fsync(fresh.number()) == 0;
}

}  // namespace

void WriteAtomically(const std::filesystem::path& file, std::string_view bytes, mode_t mode) {
  // A name of its own for each process: two that write at once do not write into one another's.
  const std::filesystem::path fresh = file.string() + ".new-" + std::to_string(getpid());
  if (!WriteThrough(fresh, file, bytes, mode) || std::rename(fresh.c_str(), file.c_str()) != 0) {
    const int error = errno;
    unlink(fresh.c_str());
    throw std::system_error(error, std::generic_category(), file.string() + ": cannot be written");
  }
  // The new name is on the disk only when its folder is.
  const Descriptor folder(file.has_parent_path() ? file.parent_path() : ".", O_RDONLY | O_DIRECTORY);
  if (folder.ok()) fsync(folder.number());
}

}  // namespace skein::files
