#pragma once

#include <memory>

#include "bridge/bus_mirror.h"
#include "bus/bus.h"
#include "bus/memory_transport.h"
#include "bus/simulated_executor.h"
#include "playback/recorded_flight.h"

namespace skein::playback {

/// Where a recorded flight is shown: a bus of its own within the process, at the time of the recording, and
/// the very mirror that shows live flights. Time runs forwards only; a jump needs another stage.
class Stage {
 public:
  /// The flight as it was at `utime`: what had been said just before, what was still held of earlier, and the
  /// last EVENTs. Messages are read by `Cursor`, so `flight` outlives it. `sink` hears what is new after.
  static std::unique_ptr<Stage> At(const RecordedFlight& flight, bus::Utime utime,
                                   const bridge::HelloInfo& hello, bridge::BusMirror::Sink sink);

  /// With nothing on it.
  Stage(bus::Utime start, const bridge::HelloInfo& hello, bridge::BusMirror::Sink sink);

  /// Plays up to `utime`, that moment included. Of what is soon replaced by newer news only as much is taken
  /// as still counts at the end.
  void PlayUntil(bus::Utime utime);

  const bridge::BusMirror& mirror() const { return mirror_; }
  bus::Utime now() const { return executor_.Now(); }

 private:
  void Feed(const recording::LogEvent& event);
  void FeedFrom(const RecordedFlight& flight, const RecordedFlight::Place& place);

  std::shared_ptr<lcm::LCM> transport_ = bus::MemoryTransport();
  bus::SimulatedExecutor executor_;
  bus::Bus bus_{transport_, "web-bridge", executor_};
  bool prepared_ = false;  ///< what came before has been taken in
  bridge::BusMirror mirror_;
  std::optional<Cursor> cursor_;
};

}  // namespace skein::playback
