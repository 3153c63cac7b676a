#include "playback/recordings.h"

#include <algorithm>
#include <atomic>
#include <list>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "bridge/history_answer.h"
#include "playback/recordings_json.h"
#include "playback/viewer.h"

namespace skein::playback {
namespace {

using boost::beast::http::status;
using Reply = bridge::Recordings::Reply;

/// The threads of those who look on. Belongs to one thread.
class Audience {
 public:
  explicit Audience(std::shared_ptr<RecordingLibrary> library) : library_(std::move(library)) {}

  bridge::Recordings::Hear Seat(const std::string& name, const bridge::HelloInfo& hello,
                                const Viewer::Send& send) {
    // Those who have left may take a moment to end; nobody waits for them.
    std::erase_if(threads_, [](const Thread& thread) { return thread.ended->load(); });
    if (threads_.size() >= kMostViewers) return nullptr;
    const auto viewer = std::make_shared<Viewer>(*library_, name, hello, send);
    const auto ended = std::make_shared<std::atomic<bool>>(false);
    threads_.push_back({std::jthread([viewer, ended](const std::stop_token& stop) {
                          viewer->Run(stop);
                          *ended = true;
                        }),
                        ended});
    // Ends the thread with the last copy of the function below.
    const std::shared_ptr<void> leave(
        nullptr, [stop = threads_.back().thread.get_stop_source()](void*) mutable { stop.request_stop(); });
    return [viewer, leave](const std::string& text) { viewer->Hear(text); };
  }

 private:
  struct Thread {
    std::jthread thread;
    std::shared_ptr<std::atomic<bool>> ended;
  };
  std::shared_ptr<RecordingLibrary> library_;
  std::list<Thread> threads_;
};

Reply Sentence(status status, std::string text) { return {status, std::move(text), true, false}; }
Reply JsonReply(status status, const bridge::Json& json) {
  return {status, bridge::Dump(json), false, false};
}

constexpr const char* kNoSuch = "There is no such recording.";

/// The flight, or the answer that says why not (yet).
std::variant<std::shared_ptr<const RecordedFlight>, Reply> Look(RecordingLibrary& library,
                                                                const std::string& name) {
  const auto opened = library.Open(name);
  if (!opened) return Sentence(status::not_found, kNoSuch);
  if (!opened->problem.empty()) return Sentence(status::unprocessable_entity, opened->problem);
  if (!opened->flight) return JsonReply(status::accepted, {{"progress", opened->progress}});
  return opened->flight;
}

/// The curves of one flight, which may go on over several parts.
recording::HistorySamples SamplesOf(const RecordedFlight& flight, bus::Utime start_utime) {
  recording::HistorySamples samples;
  for (const auto& part : flight.parts()) {
    for (const auto& one : part.index->flights) {
      if (one.start_utime != start_utime) continue;
      for (const auto& sample : one.samples) {
        if (samples.empty() || sample->t_s > samples.back()->t_s) samples.push_back(sample);
      }
    }
  }
  return samples;
}

Reply History(RecordingLibrary& library, const std::string& name, std::optional<double> at_s,
              const bridge::HistoryQuery& query) {
  const auto looked = Look(library, name);
  if (const auto* reply = std::get_if<Reply>(&looked)) return *reply;
  const RecordedFlight& flight = *std::get<std::shared_ptr<const RecordedFlight>>(looked);
  const auto* one = flight.FlightAt(flight.start() + bus::ToUtime(at_s.value_or(0)));
  const bus::Utime start_utime = one ? one->start_utime : 0;
  return {status::ok, bridge::EncodeHistory(SamplesOf(flight, start_utime), query, start_utime), false, true};
}

Reply Remove(RecordingLibrary& library, const std::string& name) {
  const auto files = library.Find(name);
  if (!files) return Sentence(status::not_found, kNoSuch);
  const std::string problem = library.Remove(name);
  return JsonReply(problem.empty() ? status::ok : status::conflict,
                   {{"deleted", problem.empty()}, {"reason", problem}});
}

}  // namespace

bridge::Recordings MakeRecordings(std::shared_ptr<RecordingLibrary> library, const bridge::HelloInfo& hello,
                                  bool live_bus) {
  bridge::Recordings recordings;
  recordings.only = library->only();
  recordings.live_bus = live_bus;
  recordings.list = [library, live_bus] {
    return JsonReply(status::ok, ListJson(*library, library->List(), live_bus));
  };
  recordings.describe = [library](const std::string& name) {
    const auto looked = Look(*library, name);
    if (const auto* reply = std::get_if<Reply>(&looked)) return *reply;
    const auto files = library->Find(name);
    if (!files) return Sentence(status::not_found, kNoSuch);
    return JsonReply(status::ok,
                     RecordingJson(*files, *std::get<std::shared_ptr<const RecordedFlight>>(looked)));
  };
  recordings.remove = [library](const std::string& name) { return Remove(*library, name); };
  recordings.history = [library](const std::string& name, std::optional<double> at_s,
                                 const bridge::HistoryQuery& query) {
    return History(*library, name, at_s, query);
  };
  recordings.file = [library](const std::string& name, int part) -> std::optional<std::filesystem::path> {
    const auto files = library->Find(name);
    if (!files || part < 0 || static_cast<std::size_t>(part) >= files->parts.size()) return std::nullopt;
    return files->parts[static_cast<std::size_t>(part)];
  };
  recordings.has = [library](const std::string& name) { return library->Find(name).has_value(); };
  const auto audience = std::make_shared<Audience>(library);
  recordings.watch = [audience, hello](const std::string& name, const Viewer::Send& send) {
    bridge::HelloInfo of_recording = hello;
    of_recording.replay = {{"kind", "log"}, {"name", name}};
    return audience->Seat(name, of_recording, send);
  };
  return recordings;
}

}  // namespace skein::playback
