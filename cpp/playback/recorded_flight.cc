#include "playback/recorded_flight.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <set>
#include <utility>

#include "bus/channels.h"

namespace skein::playback {

using recording::HeldMessage;
using recording::IndexedFlight;
using recording::LogClock;
using recording::RaisedAlarm;
using recording::SeekPoint;
using recording::ToldEvent;

RecordedFlight::RecordedFlight(std::vector<Part> parts, std::vector<std::string> problems)
    : parts_(std::move(parts)), problems_(std::move(problems)) {
  assert(!parts_.empty());
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const bus::Utime before = parts_[i - 1].index->last + parts_[i - 1].shift;
    parts_[i].shift = std::max<bus::Utime>(0, before - parts_[i].index->first);
  }
}

bus::Utime RecordedFlight::start() const { return parts_.front().index->first + parts_.front().shift; }
bus::Utime RecordedFlight::end() const { return parts_.back().index->last + parts_.back().shift; }

std::vector<RecordedFlight::Place> RecordedFlight::HeldAt(bus::Utime utime) const {
  std::map<std::string, Place> last;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto& index = *parts_[i].index;
    for (const HeldMessage& held : index.held) {
      const bus::Utime at = held.utime + parts_[i].shift;
      if (at > utime) break;
      const std::string& stream = index.streams[held.stream];
      std::string channel = stream.substr(0, stream.find('/'));
      if (utime - at <= LeadOf(channel)) continue;
      last[stream] = {i, held.offset, at, held.messages, std::move(channel)};
    }
  }
  std::vector<Place> places;
  for (auto& [stream, place] : last) places.push_back(std::move(place));
  std::ranges::sort(places, {}, [](const Place& place) { return std::pair(place.part, place.offset); });
  // Many UAVs that were last heard in the same message.
  const auto same = [](const Place& a, const Place& b) { return a.part == b.part && a.offset == b.offset; };
  places.erase(std::unique(places.begin(), places.end(), same), places.end());
  return places;
}

std::vector<RecordedFlight::Place> RecordedFlight::EventsBefore(bus::Utime utime, std::size_t most) const {
  std::vector<Place> places;
  for (std::size_t i = parts_.size(); i-- > 0 && places.size() < most;) {
    const auto& told = parts_[i].index->told;
    auto event = std::ranges::lower_bound(told, utime - parts_[i].shift, {}, &ToldEvent::utime);
    while (event != told.begin() && places.size() < most) {
      --event;
      places.push_back({i, event->offset, event->utime + parts_[i].shift, 1, bus::channel::kEvent});
    }
  }
  std::ranges::reverse(places);
  return places;
}

std::vector<RaisedAlarm> RecordedFlight::Alarms() const {
  std::vector<RaisedAlarm> alarms;
  std::set<std::pair<std::int64_t, std::int64_t>> known;  // they are on in several parts
  for (const Part& part : parts_) {
    for (RaisedAlarm alarm : part.index->alarms) {
      alarm.utime += part.shift;
      if (known.emplace(alarm.session_id, alarm.id).second) alarms.push_back(std::move(alarm));
    }
  }
  return alarms;
}

const IndexedFlight* RecordedFlight::FlightAt(bus::Utime utime) const {
  const IndexedFlight* found = nullptr;
  for (const Part& part : parts_) {
    for (const IndexedFlight& flight : part.index->flights) {
      if (!found || flight.utime + part.shift <= utime) found = &flight;
    }
  }
  return found;
}

Cursor::Cursor(const RecordedFlight& flight, bus::Utime utime) : flight_(&flight) {
  const auto& parts = flight.parts();
  std::size_t part = 0;
  while (part + 1 < parts.size() && parts[part + 1].index->first + parts[part + 1].shift <= utime) ++part;
  const auto& points = parts[part].index->points;
  // The last one before; several may have the same time.
  const auto after = std::ranges::lower_bound(points, utime - parts[part].shift, {}, &SeekPoint::utime);
  const SeekPoint& point = after == points.begin() ? *after : *std::prev(after);
  Enter(part, point.offset, LogClock(point.utime, point.shift));
  while (current_ && current_->utime < utime) Advance();
}

Cursor::Cursor(const RecordedFlight& flight, const RecordedFlight::Place& place) : flight_(&flight) {
  const auto& part = flight.parts()[place.part];
  const auto& points = part.index->points;
  const auto after = std::ranges::upper_bound(points, place.offset, {}, &SeekPoint::offset);
  const SeekPoint& point = after == points.begin() ? points.front() : *std::prev(after);
  Enter(place.part, place.offset, LogClock(place.utime - part.shift, point.shift));
}

void Cursor::Enter(std::size_t part, std::uint64_t offset, LogClock clock) {
  part_ = part;
  reader_.emplace(*flight_->parts()[part].log, offset);
  clock_ = clock;
  Advance();
}

void Cursor::Advance() {
  current_.reset();
  if (auto event = reader_->Next()) {
    current_ = TimedEvent{clock_.Read(event->utime) + flight_->parts()[part_].shift, *event};
  } else if (part_ + 1 < flight_->parts().size()) {
    Enter(part_ + 1, 0, LogClock());
  }
}

}  // namespace skein::playback
