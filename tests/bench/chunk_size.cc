// Measures how many messages are lost for each size of chunk: one process sends FLEET_STATE, one answers it
// with CMD_FLEET, two more listen, all over udpm. tests/bench/README.md has the results.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/live_executor.h"
#include "bus/transport.h"

namespace {

using namespace skein;  // NOLINT: a program of one file

constexpr bus::Utime kTick = 50'000;
// The kernel doubles it, to the 212992 B that it gives unasked.
constexpr int kDefaultBuffer = 106'496;

struct Options {
  std::string group = "239.255.76.67";
  int port = 7667;
  int vehicles = 1000;
  int seconds = 10;
  std::vector<int> chunk_bytes = {700, 1400, 2800, 5600, 7000, 8000, 16000, 24000, 32000, 60000};
};

/// What one process saw.
struct Count {
  long states_sent = 0, commands_sent = 0, states_received = 0, commands_received = 0;
  double cpu_s = 0;
};

fleet_state_t State(const Options& options, std::int64_t tick, bus::Utime utime) {
  fleet_state_t state;
  state.utime = utime;
  state.session_id = 1;
  state.tick = tick;
  state.vehicles.resize(static_cast<std::size_t>(options.vehicles));
  for (int i = 0; i < options.vehicles; ++i) state.vehicles[static_cast<std::size_t>(i)].id = i + 1;
  return state;
}

fleet_command_t CommandFor(const fleet_state_t& state) {
  fleet_command_t command;
  command.utime = state.utime;
  command.session_id = 2;
  command.state_tick = state.tick;
  command.commands.resize(state.vehicles.size());
  for (std::size_t i = 0; i < state.vehicles.size(); ++i) command.commands[i].id = state.vehicles[i].id;
  return command;
}

Count Play(const Options& options, int chunk_bytes, const std::string& role) {
  const auto transport = bus::MakeTransport("udpm://" + options.group + ":" + std::to_string(options.port) +
                                            "?ttl=0&recv_buf_size=" + std::to_string(kDefaultBuffer))
                             .lcm;
  bus::LiveExecutor executor(transport);
  bus::Bus node(transport, role, executor);
  Count count;
  bus::ChunkAssembler<fleet_state_t> assembler([&](const fleet_state_t& state, int) {
    if (role != "controller") return;
    const auto before = node.statistics().messages_out;
    bus::PublishChunks(node, bus::channel::kCmdFleet, CommandFor(state), chunk_bytes);
    count.commands_sent += node.statistics().messages_out - before;
  });
  node.Subscribe<fleet_state_t>(bus::channel::kFleetState, [&](const fleet_state_t& state) {
    ++count.states_received;
    assembler.Add(state);
  });
  node.Subscribe<fleet_command_t>(bus::channel::kCmdFleet,
                                  [&](const fleet_command_t&) { ++count.commands_received; });
  // By then the slowest process listens.
  const bus::Utime start = executor.Now() + 3 * bus::kSecond;
  const bus::Utime end = start + options.seconds * bus::kSecond;
  std::int64_t tick = 0;
  if (role == "simulator") {
    executor.Every(kTick, [&] {
      if (executor.Now() < start || executor.Now() > end) return;
      bus::PublishChunks(node, bus::channel::kFleetState, State(options, tick++, executor.Now()),
                         chunk_bytes);
      count.states_sent = node.statistics().messages_out;
    });
  }
  executor.At(end + 3 * bus::kSecond, [&] { executor.Stop(); });
  executor.Run();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  count.cpu_s = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  return count;
}

/// Plays a role in a process of its own; its Count comes through the returned pipe.
int StartRole(const Options& options, int chunk_bytes, const std::string& role) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("pipe");
  if (fork() == 0) {
    const Count count = Play(options, chunk_bytes, role);
    _exit(write(ends[1], &count, sizeof count) == sizeof count ? 0 : 1);
  }
  close(ends[1]);
  return ends[0];
}

/// Bytes of such datagrams that a socket of the group holds while nobody reads it.
long BufferHolds(const Options& options, int datagram_bytes) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(options.port));
  const int receiver = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0);
  const int yes = 1;
  setsockopt(receiver, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (bind(receiver, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("bind");
  inet_pton(AF_INET, options.group.c_str(), &address.sin_addr);
  const ip_mreq membership{address.sin_addr, {INADDR_ANY}};
  if (setsockopt(receiver, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0) {
    throw std::runtime_error("IP_ADD_MEMBERSHIP");
  }
  const int sender = socket(AF_INET, SOCK_DGRAM, 0);
  const unsigned char ttl = 0;
  setsockopt(sender, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  std::vector<char> datagram(static_cast<std::size_t>(datagram_bytes));
  for (int i = 0; i < 1000; ++i) {
    sendto(sender, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&address),
           sizeof address);
  }
  long bytes = 0;
  for (ssize_t got; (got = recv(receiver, datagram.data(), datagram.size(), 0)) > 0;) bytes += got;
  close(sender);
  close(receiver);
  return bytes;
}

double Percent(long lost, long all) {
  return all > 0 ? 100.0 * static_cast<double>(lost) / static_cast<double>(all) : 0;
}

void Measure(const Options& options, int chunk_bytes) {
  const long buffer_holds = BufferHolds(options, chunk_bytes);
  std::vector<int> pipes;
  for (const char* role : {"simulator", "controller", "monitor", "bridge"}) {
    pipes.push_back(StartRole(options, chunk_bytes, role));
  }
  Count sum;
  for (const int fd : pipes) {
    Count count;
    if (read(fd, &count, sizeof count) != sizeof count) throw std::runtime_error("a process has died");
    close(fd);
    sum.states_sent += count.states_sent;
    sum.commands_sent += count.commands_sent;
    sum.states_received += count.states_received;
    sum.commands_received += count.commands_received;
    sum.cpu_s += count.cpu_s;
  }
  while (wait(nullptr) > 0) {
  }
  // Everybody hears everything, the sender too.
  const long processes = static_cast<long>(pipes.size());
  const long states = processes * sum.states_sent;
  const long commands = processes * sum.commands_sent;
  std::printf("| %d | %ld | %ld | %ld (%.2f%%) | %ld (%.2f%%) | %.1f |\n", chunk_bytes, buffer_holds,
              sum.states_sent / (20L * options.seconds), states - sum.states_received,
              Percent(states - sum.states_received, states), commands - sum.commands_received,
              Percent(commands - sum.commands_received, commands),
              100 * sum.cpu_s / static_cast<double>(processes) / (options.seconds + 6));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Loss of FLEET_STATE and CMD_FLEET at 20 Hz for several sizes of chunk");
  app.add_option("--group", options.group);
  app.add_option("--port", options.port);
  app.add_option("--vehicles", options.vehicles);
  app.add_option("--seconds", options.seconds, "for each size");
  app.add_option("chunk_bytes", options.chunk_bytes);
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| chunk, B | buffer holds, B | chunks a tick | FLEET_STATE lost | CMD_FLEET lost | CPU a process, %% "
      "|\n|---|---|---|---|---|---|\n");
  std::fflush(stdout);
  for (const int bytes : options.chunk_bytes) Measure(options, bytes);
}
