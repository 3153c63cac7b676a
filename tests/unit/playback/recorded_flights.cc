#include "playback/recorded_flights.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <skein/event_t.hpp>
#include <skein/heartbeat_t.hpp>
#include <utility>

#include "bus/channels.h"
#include "config/scenario.h"
#include "experiment/experiment.h"

namespace skein::playback {
namespace {

namespace fs = std::filesystem;

void SayMore(bus::Bus& bus) {
  bus::Executor& executor = bus.executor();
  const bus::Utime start = executor.Now();
  executor.Every(bus::kSecond, [&bus, start] {
    if (bus.executor().Now() - start > bus::ToUtime(kControllerGone_s)) return;
    heartbeat_t heartbeat{};
    heartbeat.utime = bus.executor().Now();
    heartbeat.heartbeat_node = "formation-controller";
    heartbeat.version = "1";
    bus.Publish(bus::channel::kHeartbeat, heartbeat);
  });
  executor.At(start + bus::ToUtime(kNote_s), [&bus] {
    event_t note{};
    note.utime = bus.executor().Now();
    note.event_node = "flight-recorder";
    note.event_sequence = 1;
    note.code = "marker";
    note.text = "look at this";
    bus.Publish(bus::channel::kEvent, note);
    const std::string foreign = "anything";
    for (int i = 0; i < 3; ++i) bus.transport().publish("STRANGER", foreign.data(), foreign.size());
    bus.transport().publish(bus::channel::kFleetState, foreign.data(), foreign.size());
  });
}

}  // namespace

FreshFolder::FreshFolder() {
  std::string name = testing::TempDir() + "skein-playback-XXXXXX";
  if (!mkdtemp(name.data())) throw std::runtime_error("no folder can be made in " + testing::TempDir());
  path_ = name;
}

FreshFolder::~FreshFolder() { fs::remove_all(path_); }

const fs::path& LinkDropLog() {
  static const FreshFolder folder;
  static const fs::path file = [] {
    experiment::ExperimentOptions options;
    options.log = folder.path() / "link-drop.lcm";
    options.logs = false;
    options.on_start = SayMore;
    experiment::RunExperiment(
        config::LoadScenario(SKEIN_SOURCE_DIR "/scripts/scenarios/paper-link-drop.json"), options);
    return options.log;
  }();
  return file;
}

std::shared_ptr<const RecordedFlight> Open(const fs::path& file) {
  auto log = std::make_shared<const recording::LogFile>(file);
  auto index = recording::IndexLog(*log, [](double) { return true; });
  return std::make_shared<const RecordedFlight>(std::vector<RecordedFlight::Part>{
      {log, std::make_shared<const recording::LogIndex>(std::move(*index))}});
}

}  // namespace skein::playback
