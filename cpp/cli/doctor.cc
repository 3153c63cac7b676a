#include "cli/doctor.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <spdlog/fmt/fmt.h>
#include <sys/timex.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <skein/heartbeat_t.hpp>
#include <vector>

#include "bus/bus.h"
#include "bus/channels.h"
#include "bus/live_executor.h"
#include "bus/transport.h"

namespace skein::cli {
namespace {

constexpr std::int64_t kGoodBuffer = 4 * 1024 * 1024;
constexpr double kGoodClock_s = 0.5;
constexpr std::uintmax_t kGoodDisk = 2'000'000'000;

enum class Health { kGood, kCouldBeBetter, kBad };

struct Finding {
  std::string about;
  Health health;
  std::string text;
  std::string remedy{};  ///< "": none is needed
};

const char* Word(Health health) {
  switch (health) {
    case Health::kGood:
      return "good";
    case Health::kCouldBeBetter:
      return "could be better";
    default:
      return "BAD";
  }
}

/// "eth0 192.0.2.1" of every interface by which others reach this host.
std::vector<std::string> OutsideAddresses() {
  std::vector<std::string> found;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return found;
  for (const ifaddrs* one = list; one; one = one->ifa_next) {
    if (!one->ifa_addr || one->ifa_addr->sa_family != AF_INET) continue;
    if ((one->ifa_flags & IFF_LOOPBACK) != 0 || (one->ifa_flags & IFF_UP) == 0) continue;
    char text[INET_ADDRSTRLEN];
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    inet_ntop(AF_INET, &address->sin_addr, text, sizeof text);
    found.push_back(fmt::format("{} {}", one->ifa_name, text));
  }
  freeifaddrs(list);
  return found;
}

/// Whether deploy/nftables/skein.nft, or one made from it, keeps strangers from this port; only root can
/// tell.
bool HasRuleFor(int port) {
  // nft lists a single port as such, several in braces.
  const std::string look = fmt::format(
      "nft list chain inet skein input 2>/dev/null |"
      " grep -Eq '^[[:space:]]*udp dport ({0}|[{{]([^}}]*[ ,])?{0}[ ,][^}}]*[}}])( counter packets [0-9]+ "
      "bytes [0-9]+)? drop$'",
      port);
  return std::system(look.c_str()) == 0;
}

int PortOf(const std::string& udpm_url) {
  const std::size_t colon = udpm_url.find(':', std::string("udpm://").size());
  // As LCM reads it.
  return colon == std::string::npos ? 7667
                                    : static_cast<int>(std::strtol(udpm_url.c_str() + colon + 1, nullptr, 0));
}

Finding Exposure(const std::string& url) {
  const bool udp = url.starts_with("udpm://");
  if (!udp) return {"exposure", Health::kGood, "the bus is " + url + ": who reaches that reaches the bus"};
  const std::vector<std::string> addresses = OutsideAddresses();
  if (addresses.empty()) return {"exposure", Health::kGood, "nobody else reaches this host"};
  const int port = PortOf(url);
  if (HasRuleFor(port)) {
    return {"exposure", Health::kGood,
            fmt::format("the rule of deploy/nftables keeps the bus, port {}, to named hosts", port)};
  }
  return {"exposure", Health::kCouldBeBetter,
          fmt::format("LCM listens on all addresses ({}), and whoever reaches its port {} commands the fleet",
                      fmt::join(addresses, ", "), port),
          "deploy/README.md: a network of its own for one host, a firewall rule for several"};
}

Finding Buffer(const bus::Transport& transport) {
  const std::int64_t bytes = transport.receive_buffer_bytes;
  if (bytes == 0) return {"receive buffer", Health::kGood, "none is needed: the bus is no UDP"};
  const std::string text = fmt::format("{} kB, as the kernel counts", bytes / 1024);
  if (bytes >= kGoodBuffer) return {"receive buffer", Health::kGood, text};
  return {"receive buffer", Health::kCouldBeBetter,
          text + ": enough for some hundred UAVs on a machine that is not busy",
          "sysctl -w net.core.rmem_max=4194304"};
}

Finding OwnClock() {
  timex clock{};
  if (adjtimex(&clock) < 0 || (clock.status & STA_UNSYNC) == 0)
    return {"clock", Health::kGood, "synchronised, says the kernel"};
  return {"clock", Health::kCouldBeBetter,
          "not synchronised, says the kernel; that matters when other hosts are on the bus",
          "timedatectl set-ntp true, or chrony"};
}

Finding Disk(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder);
  while (!std::filesystem::exists(there, error) && there.has_relative_path()) there = there.parent_path();
  const auto space = std::filesystem::space(there, error);
  if (error) return {"disk", Health::kBad, folder.string() + ": " + error.message(), "name another --folder"};
  const std::string text = fmt::format("{:.1f} GB are free for recordings in {}",
                                       static_cast<double>(space.available) / 1e9, folder.string());
  if (space.available >= kGoodDisk) return {"disk", Health::kGood, text};
  return {"disk", Health::kCouldBeBetter, text, "make room, or record elsewhere: flight-recorder --folder"};
}

/// What is heard of each process.
struct Heard {
  heartbeat_t last;
  double clock_ahead_s = 0;  ///< of ours
};

std::map<std::string, Heard> Listen(const bus::Transport& transport, double seconds) {
  bus::LiveExecutor executor(transport.lcm);
  bus::Bus bus(transport.lcm, "skein", executor);
  std::map<std::string, Heard> heard;
  bus.Subscribe<heartbeat_t>(bus::channel::kHeartbeat, [&](const heartbeat_t& heartbeat) {
    heard[heartbeat.heartbeat_node] = {heartbeat, bus::ToSeconds(heartbeat.utime - executor.Now())};
  });
  executor.At(executor.Now() + bus::ToUtime(seconds), [&] { executor.Stop(); });
  executor.Run();
  return heard;
}

void JudgeNodes(const std::map<std::string, Heard>& heard, std::vector<Finding>& findings) {
  if (heard.empty()) findings.push_back({"processes", Health::kGood, "none is heard on this bus"});
  for (const auto& [node, one] : heard) {
    const auto add = [&findings, about = node](Health health, const std::string& text,
                                               const std::string& remedy) {
      findings.push_back({about, health, text, remedy});
    };
    const heartbeat_t& last = one.last;
    if (std::abs(one.clock_ahead_s) > kGoodClock_s)
      add(Health::kCouldBeBetter,
          fmt::format("its clock is {:.1f} s {} this one", std::abs(one.clock_ahead_s),
                      one.clock_ahead_s > 0 ? "ahead of" : "behind"),
          "synchronise the hosts' clocks: timedatectl set-ntp true, or chrony");
    if (last.version != SKEIN_VERSION)
      add(Health::kCouldBeBetter, fmt::format("is version {}, this is {}", last.version, SKEIN_VERSION),
          "install the same version everywhere");
    if (last.gaps > 0 || last.undecodable > 0 || last.handler_exceptions > 0)
      add(Health::kCouldBeBetter,
          fmt::format("has missed {} messages and refused {}; {} failed in it", last.gaps, last.undecodable,
                      last.handler_exceptions),
          "missed: a larger receive buffer, a less busy machine; refused: see what it logs");
    if (findings.back().about != node) add(Health::kGood, "heard, version " + last.version, "");
  }
}

void Print(const std::vector<Finding>& findings, std::ostream& out) {
  for (const Finding& finding : findings) {
    out << fmt::format("{:<16}{:<22}{}\n", Word(finding.health), finding.about, finding.text);
    if (!finding.remedy.empty()) out << fmt::format("{:<38}do: {}\n", "", finding.remedy);
  }
}

nlohmann::json ToJson(const std::vector<Finding>& findings) {
  nlohmann::json list = nlohmann::json::array();
  for (const Finding& finding : findings)
    list.push_back({{"about", finding.about},
                    {"health", Word(finding.health)},
                    {"text", finding.text},
                    {"do", finding.remedy}});
  return list;
}

}  // namespace

int Doctor(const DoctorOptions& options, std::ostream& out) {
  const std::string url = options.lcm_url.empty() ? bus::DefaultUrl() : options.lcm_url;
  std::vector<Finding> findings;
  try {
    const bus::Transport transport = bus::MakeTransport(url);
    findings.push_back({"bus", Health::kGood, url});
    findings.push_back(Buffer(transport));
    findings.push_back(Exposure(url));
    JudgeNodes(Listen(transport, options.listen_s), findings);
  } catch (const bus::StartError& error) {
    findings.push_back({"bus", Health::kBad, error.what()});
  }
  findings.push_back(OwnClock());
  findings.push_back(Disk(options.folder));
  if (options.json) {
    out << ToJson(findings).dump(1) << '\n';
  } else {
    Print(findings, out);
  }
  for (const Finding& finding : findings) {
    if (finding.health == Health::kBad) return 1;
  }
  return 0;
}

}  // namespace skein::cli
