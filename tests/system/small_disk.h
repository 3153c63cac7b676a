#pragma once

#include <sys/mount.h>

#include <cerrno>
#include <string>

namespace skein::testing {

/// A disk that is soon full, mounted on a folder while this lives. For root alone.
class SmallDisk {
 public:
  /// @param size as mount takes it: "4m".
  SmallDisk(const std::string& folder, const std::string& size) : folder_(folder) {
    refused_ = mount("tmpfs", folder.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0 ? 0 : errno;
  }
  ~SmallDisk() {
    if (refused_ == 0) umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  int refused() const { return refused_; }  ///< errno

 private:
  std::string folder_;
  int refused_;
};

}  // namespace skein::testing
