#include "recording/log_index.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "bus/channels.h"
#include "bus/chunks.h"
#include "bus/text.h"
#include "bus/validate.h"
#include "recording/held_messages.h"
#include "recording/log_clock.h"
#include "recording/message_types.h"

namespace skein::recording {
namespace {

namespace channel = bus::channel;

constexpr std::uint64_t kPointEveryBytes = 256 * 1024;
constexpr std::uint64_t kTellEveryBytes = 4u << 20;
constexpr std::size_t kMostChannels = 10'000;
constexpr std::size_t kLongestListed = 500;
constexpr bus::Utime kLookPeriod = bus::kSecond / 4;

std::string Listed(const std::string& text) { return bus::Shortened(text, kLongestListed); }

class Indexer {
 public:
  explicit Indexer(LogIndex& index);

  void Take(const LogEvent& event);
  void Finish(const LogReader& reader);

 private:
  /// Whether the message is a good one.
  using Handler = std::function<bool(const LogEvent&)>;

  template <typename Message>
  void Know(
      const char* name, std::function<void(const Message&)> handler = [](const Message&) {});
  template <typename Message>
  void KnowChunks(const char* name, std::function<void(const Message&)> handle_whole);
  void KnowAll();

  void Hear(const fleet_roster_t& roster);
  void Hear(const event_t& event);
  void Hear(const alarm_list_t& list);
  IndexedFlight& Flight();
  struct Channel {
    Handler handler{};                   ///< of one of Skein's own
    std::optional<std::size_t> place{};  ///< in the index, once there was a message on it
  };
  struct Hash : std::hash<std::string_view> {
    using is_transparent = void;
  };
  using Channels = std::unordered_map<std::string, Channel, Hash, std::equal_to<>>;
  Channels::value_type& Find(std::string_view name);
  /// What a message is good for, and hears it.
  struct Verdict {
    bool known = false;  ///< of a type of Skein's, or on a channel of its own
    bool good = true;    ///< as far as we know
  };
  static Verdict Judge(const LogEvent& event, const Channel& channel);
  void Count(const LogEvent& event);
  void TellDamage(std::uint64_t offset, std::uint64_t bytes, std::string reason, bus::Utime utime);

  LogIndex& index_;
  HeldMessages held_;
  LogClock clock_;
  bus::Utime now_ = 0;
  std::uint64_t offset_ = 0;  ///< of the event that is being read
  Channels channels_;
  FleetTable fleet_;
  History history_;
  std::int64_t roster_session_ = 0;
  bus::Utime state_utime_ = 0;
  bus::Utime next_look_ = 0;
  std::set<std::pair<std::int64_t, std::int64_t>> alarms_;  ///< session and id
};

Indexer::Indexer(LogIndex& index) : index_(index), held_(index) { KnowAll(); }

template <typename Message>
void Indexer::Know(const char* name, std::function<void(const Message&)> handler) {
  channels_[name].handler = [handler = std::move(handler),
                             message = Message{}](const LogEvent& event) mutable {
    if (!bus::DecodeInto(message, event.data.data(), event.data.size())) return false;
    if (!bus::Valid(message)) return false;
    handler(message);
    return true;
  };
}

template <typename Message>
void Indexer::KnowChunks(const char* name, std::function<void(const Message&)> handle_whole) {
  auto assembler =
      std::make_shared<bus::ChunkAssembler<Message>>([handle_whole](const auto& whole, int missing) {
        if (missing == 0) handle_whole(whole);
      });
  const auto held = std::make_shared<HeldMessages::Channel>(HeldMessages::Channel{name});
  Know<Message>(name, [this, held, assembler](const Message& message) {
    held_.SeeChunk(*held, message, now_, offset_);
    assembler->Add(message);
  });
}

void Indexer::KnowAll() {
  KnowChunks<fleet_roster_t>(channel::kFleetRoster, [this](const auto& roster) { Hear(roster); });
  Know<fleet_state_t>(channel::kFleetState, [this](const fleet_state_t& state) {
    held_.See(state, now_, offset_);
    state_utime_ = state.utime;
    fleet_.Take(state, now_);
  });
  KnowChunks<formation_status_t>(channel::kFormationStatus, [this](const auto& status) {
    fleet_.Take(status.formation_id, status.slots);
  });
  KnowChunks<proximity_t>(channel::kProximity, [this](const auto& proximity) { fleet_.Take(proximity); });
  KnowChunks<link_status_t>(channel::kLinkStatus, [this](const auto& links) { fleet_.Take(links); });
  KnowChunks<alarm_list_t>(channel::kAlarms, [this](const auto& list) { Hear(list); });
  Know<formation_t>(channel::kFormation, [this](const formation_t& formation) {
    held_.See(channel::kFormation, std::to_string(formation.formation_id), now_, offset_);
  });
  Know<path_t>(channel::kPath, [this](const path_t& path) {
    held_.See(channel::kPath, std::to_string(path.formation_id), now_, offset_);
  });
  Know<heartbeat_t>(channel::kHeartbeat, [this](const heartbeat_t& heartbeat) {
    held_.See(channel::kHeartbeat, heartbeat.heartbeat_node, now_, offset_);
  });
  Know<event_t>(channel::kEvent, [this](const event_t& event) { Hear(event); });
}

IndexedFlight& Indexer::Flight() {
  if (index_.flights.empty()) index_.flights.push_back({.utime = now_});
  return index_.flights.back();
}

void Indexer::Hear(const fleet_roster_t& roster) {
  if (!index_.flights.empty() && index_.flights.back().start_utime != roster.start_utime) {
    Flight().samples = history_.samples();
    history_.Clear();
    index_.flights.push_back({.utime = now_});
  }
  IndexedFlight& flight = Flight();
  flight.start_utime = roster.start_utime;
  flight.scenario = Listed(roster.scenario);
  flight.vehicles = std::max(flight.vehicles, roster.num_vehicles);
  if (roster.session_id != roster_session_) fleet_.StartAnew();
  roster_session_ = roster.session_id;
  fleet_.Take(roster.vehicles);
}

void Indexer::Hear(const event_t& event) {
  if (index_.told.size() >= LogIndex::kMostListed) return;
  index_.told.push_back({now_, offset_, event.severity, Listed(event.code), Listed(event.text)});
}

void Indexer::Hear(const alarm_list_t& list) {
  for (const alarm_t& alarm : list.alarms) {
    if (alarm.state == alarm_t::OVER || alarms_.size() >= LogIndex::kMostListed) continue;
    if (!alarms_.emplace(list.session_id, alarm.id).second) continue;
    index_.alarms.push_back(
        {now_, list.session_id, alarm.id, alarm.severity, Listed(alarm.condition), Listed(alarm.text)});
  }
}

Indexer::Verdict Indexer::Judge(const LogEvent& event, const Channel& channel) {
  if (channel.handler) return {true, channel.handler(event)};
  const MessageType* type = TypeOf(event.data);
  return {type != nullptr, !type || type->is_good(event.data)};
}

Indexer::Channels::value_type& Indexer::Find(std::string_view name) {
  const auto known = channels_.find(name);
  if (known != channels_.end()) return *known;
  return *channels_.try_emplace(channels_.size() < kMostChannels ? std::string(name) : "(others)").first;
}

void Indexer::Count(const LogEvent& event) {
  auto& [name, channel] = Find(event.channel);
  const Verdict verdict = Judge(event, channel);
  if (!channel.place) {
    channel.place = index_.channels.size();
    index_.channels.push_back({.name = name, .first = now_});
  }
  ChannelCount& count = index_.channels[*channel.place];
  ++count.count;
  count.bytes += static_cast<std::int64_t>(event.data.size());
  count.undecodable += verdict.good ? 0 : 1;
  count.known |= verdict.known;
  count.last = now_;
}

void Indexer::TellDamage(std::uint64_t offset, std::uint64_t bytes, std::string reason, bus::Utime utime) {
  if (index_.damage.size() < LogIndex::kMostListed) {
    index_.damage.push_back({utime, offset, bytes, std::move(reason)});
  }
}

void Indexer::Take(const LogEvent& event) {
  const bus::Utime shift = clock_.shift();
  now_ = clock_.Read(event.utime);
  offset_ = event.offset;
  if (index_.points.empty() || offset_ >= index_.points.back().offset + kPointEveryBytes) {
    index_.points.push_back({now_, offset_, clock_.shift()});
  }
  if (index_.events++ == 0) index_.first = now_;
  index_.last = now_;
  if (clock_.shift() != shift) TellDamage(offset_, 0, "the clock leaps here", now_);
  Count(event);
  if (now_ < next_look_) return;
  next_look_ = now_ + kLookPeriod;
  const bus::Utime start = index_.flights.empty() ? 0 : index_.flights.back().start_utime;
  if (start > 0 && state_utime_ >= start) history_.Take(fleet_, bus::ToSeconds(state_utime_ - start), now_);
}

void Indexer::Finish(const LogReader& reader) {
  held_.Finish();
  if (!index_.flights.empty()) Flight().samples = history_.samples();
  // Damage has the raw time of the event before it; where that lies is known better.
  for (const Damage& damage : reader.damage()) {
    const auto after = std::ranges::upper_bound(index_.points, damage.offset, {}, &SeekPoint::offset);
    const bus::Utime raw = damage.last_utime.value_or(index_.first);
    const bus::Utime utime = raw + (after == index_.points.begin() ? 0 : std::prev(after)->shift);
    TellDamage(damage.offset, damage.bytes, damage.reason, std::clamp(utime, index_.first, index_.last));
  }
  std::ranges::stable_sort(index_.damage, {}, &IndexedDamage::utime);
  index_.damaged_bytes = reader.damaged_bytes();
  const auto tell_if = [&](bool more, const char* what) {
    if (more) index_.damage.push_back({index_.last, 0, 0, what});
  };
  tell_if(index_.told.size() >= LogIndex::kMostListed, "there are more EVENTs than are listed");
  tell_if(index_.alarms.size() >= LogIndex::kMostListed, "there are more alarms than are listed");
  tell_if(reader.damage_count() > reader.damage().size(), "there is more damage than is listed");
}

}  // namespace

std::optional<LogIndex> IndexLog(const LogFile& log, const std::function<bool(double)>& go_on) {
  LogIndex index;
  index.bytes = log.bytes();
  Indexer indexer(index);
  LogReader reader(log);
  std::uint64_t tell_at = 0;
  while (const auto event = reader.Next()) {
    indexer.Take(*event);
    if (event->offset < tell_at) continue;
    tell_at = event->offset + kTellEveryBytes;
    if (!go_on(static_cast<double>(event->offset) / static_cast<double>(log.bytes()))) return std::nullopt;
  }
  indexer.Finish(reader);
  return index;
}

}  // namespace skein::recording
