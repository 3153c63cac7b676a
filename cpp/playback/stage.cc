#include "playback/stage.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "bus/channels.h"

namespace skein::playback {
namespace {

namespace channel = bus::channel;

/// How much of the time that is played counts at its end, for what is replaced again and again: a bit more
/// than the time from one to the next. In fast motion nobody could see the rest.
bus::Utime LastsFor(std::string_view name) {
  static const std::map<std::string_view, bus::Utime> kLasts = {
      {channel::kFleetState, bus::kSecond / 10},   {channel::kFormationStatus, bus::kSecond * 5 / 4},
      {channel::kProximity, bus::kSecond * 5 / 4}, {channel::kLinkStatus, bus::kSecond * 5 / 4},
      {channel::kHeartbeat, bus::kSecond * 5 / 4},
  };
  const auto known = kLasts.find(name);
  return known == kLasts.end() ? INT64_MAX : known->second;
}

// So much before a moment is looked at for it: what is repeated at all has come by then, and a node that has
// not is silent.
constexpr bus::Utime kLead = bus::kSecond * 7 / 2;
static_assert(kLead > bridge::BusMirror::kSilentAfter);

/// Nobody hears commands here, and CMD_FLEET is half of a log.
bool IsHeard(std::string_view name) { return !name.starts_with("CMD_"); }

}  // namespace

Stage::Stage(bus::Utime start, const bridge::HelloInfo& hello, bridge::BusMirror::Sink sink)
    : executor_(transport_, start),
      mirror_(bus_, hello, [this, sink = std::move(sink)](const bridge::LiveFrame& frame) {
        if (prepared_) sink(frame);
      }) {}

std::unique_ptr<Stage> Stage::At(const RecordedFlight& flight, bus::Utime utime,
                                 const bridge::HelloInfo& hello, bridge::BusMirror::Sink sink) {
  const bus::Utime from = std::max(flight.start(), utime - kLead);
  std::vector<RecordedFlight::Place> before = flight.EventsBefore(from, bridge::BusMirror::kMaxEvents);
  const auto held = flight.HeldAt(utime);
  before.insert(before.end(), held.begin(), held.end());
  std::ranges::stable_sort(before, {}, &RecordedFlight::Place::utime);
  const bus::Utime start = before.empty() ? from : std::min(from, before.front().utime);

  auto stage = std::make_unique<Stage>(start, hello, std::move(sink));
  auto place = before.begin();
  for (; place != before.end() && place->utime < from; ++place) stage->FeedFrom(flight, *place);
  stage->executor_.SkipTo(from);
  Cursor& cursor = stage->cursor_.emplace(flight, from);
  for (; cursor.current() && cursor.current()->utime <= utime; cursor.Advance()) {
    const TimedEvent& at = *cursor.current();
    for (; place != before.end() && place->utime <= at.utime; ++place) stage->FeedFrom(flight, *place);
    if (utime - at.utime > RecordedFlight::LeadOf(at.event.channel)) continue;
    stage->executor_.RunUntil(std::max(stage->now(), at.utime));
    stage->Feed(at.event);
  }
  for (; place != before.end(); ++place) stage->FeedFrom(flight, *place);
  stage->executor_.RunUntil(utime);
  stage->prepared_ = true;
  return stage;
}

void Stage::Feed(const recording::LogEvent& event) {
  if (!IsHeard(event.channel)) return;
  transport_->publish(std::string(event.channel), event.data.data(),
                      static_cast<unsigned>(event.data.size()));
}

void Stage::FeedFrom(const RecordedFlight& flight, const RecordedFlight::Place& place) {
  Cursor cursor(flight, place);
  for (int left = place.messages; left > 0 && cursor.current(); cursor.Advance()) {
    const TimedEvent& at = *cursor.current();
    // Chunks of a set come within moments; whatever the index says.
    if (at.utime > place.utime + bus::kSecond) break;
    if (at.event.channel != place.channel) continue;
    executor_.SkipTo(std::max(now(), at.utime));
    Feed(at.event);
    --left;
  }
  executor_.Deliver();
}

void Stage::PlayUntil(bus::Utime utime) {
  for (; cursor_ && cursor_->current() && cursor_->current()->utime <= utime; cursor_->Advance()) {
    const TimedEvent& at = *cursor_->current();
    if (utime - at.utime > LastsFor(at.event.channel)) continue;
    executor_.RunUntil(std::max(now(), at.utime));
    Feed(at.event);
  }
  executor_.RunUntil(std::max(now(), utime));
}

}  // namespace skein::playback
