// Writes a valid message of each type for the target `decode`, and a log of them for `log`.
//
//   make-seeds FOLDER
#include <filesystem>
#include <fstream>
#include <iostream>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "unit/bus/hostile/samples.h"

namespace {

using namespace skein;  // NOLINT: the main file of a program
using bus::testing::Encode;
using bus::testing::Sample;

struct Writer {
  std::filesystem::path folder;
  lcm::LogFile log;
  char choice = 0;

  template <typename Message>
  void Write() {
    const auto bytes = Encode(Sample<Message>());
    std::ofstream file(folder / "decode" / Message::getTypeName(), std::ios::binary);
    file << choice;
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    lcm::LogEvent event{};
    event.eventnum = choice;
    event.timestamp = 1'700'000'000'000'000 + choice;
    event.channel = Message::getTypeName();
    event.datalen = static_cast<int>(bytes.size());
    event.data = const_cast<std::uint8_t*>(bytes.data());
    log.writeEvent(&event);
    ++choice;
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make-seeds FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  for (const char* target : {"decode", "log"}) std::filesystem::create_directories(folder / target);
  Writer writer{folder, lcm::LogFile((folder / "log" / "samples.lcm").string(), "w")};
  // In the order of decode.cc.
  writer.Write<ack_t>();
  writer.Write<alarm_command_t>();
  writer.Write<alarm_list_t>();
  writer.Write<event_t>();
  writer.Write<fleet_command_t>();
  writer.Write<fleet_roster_t>();
  writer.Write<fleet_state_t>();
  writer.Write<formation_command_t>();
  writer.Write<formation_t>();
  writer.Write<formation_status_t>();
  writer.Write<heartbeat_t>();
  writer.Write<link_command_t>();
  writer.Write<link_status_t>();
  writer.Write<path_command_t>();
  writer.Write<path_t>();
  writer.Write<payload_command_t>();
  writer.Write<proximity_t>();
  writer.Write<recording_command_t>();
  writer.Write<recording_status_t>();
  writer.Write<simulation_command_t>();
  return 0;
}
