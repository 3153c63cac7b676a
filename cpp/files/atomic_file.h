#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

namespace skein::files {

/// Puts `bytes` in the place of a file, so that whatever happens, loss of power included, there is the old
/// content or the new one, never half of one. Returns when it is on the disk, which may take tens of
/// milliseconds. Throws std::system_error with the file and why; the old content is then still there.
/// @param mode of the file, whatever the process's umask.
void WriteAtomically(const std::filesystem::path& file, std::string_view bytes, mode_t mode = 0644);

}  // namespace skein::files
