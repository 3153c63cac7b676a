#include "cli/drop_commands.h"

#include <spawn.h>
#include <spdlog/fmt/fmt.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <vector>

#include "cli/station.h"

extern char** environ;  // NOLINT: of POSIX

namespace skein::cli {

link_command_t LinkCommand(int id, bool uplink, bool downlink, const Drop* drop, bus::Utime at,
                           double for_s) {
  link_command_t command{};
  command.vehicle_id = id;
  command.uplink = uplink;
  command.downlink = downlink;
  command.mode = drop == nullptr  ? link_command_t::MODE_RESTORED
                 : drop->is_cut() ? link_command_t::MODE_SILENT
                                  : link_command_t::MODE_UP;
  if (drop != nullptr && !drop->is_cut()) {
    command.loss = drop->loss;
    command.delay_s = drop->delay_s;
  }
  command.start_utime = at;
  command.duration_s = for_s;
  return command;
}

void CallHook(const std::string& hook, const char* what, int number, const Drop& drop) {
  std::vector<std::string> words{hook,
                                 what,
                                 std::to_string(number),
                                 drop.vehicle,
                                 Direction(drop),
                                 fmt::format("{:g}", drop.loss),
                                 fmt::format("{:g}", drop.delay_s)};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t pid = 0;
  const int error = posix_spawnp(&pid, hook.c_str(), nullptr, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw Failure(hook + ": cannot be run: " + std::strerror(error));
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0) throw Failure(fmt::format("{} {} failed (status {:#x})", hook, what, status));
}

}  // namespace skein::cli
