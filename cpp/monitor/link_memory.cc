#include "monitor/link_memory.h"

#include "bus/saved_bytes.h"

namespace skein::monitor {

LinkMemory::LinkMemory(std::string_view saved, bus::Utime now) {
  bus::SavedReader reader(saved);
  session_id_ = reader.Number().value_or(0);
  while (const auto id = reader.Number()) {
    const auto fresh_at = reader.Number();
    const auto commanding = reader.Number();
    const auto unobeyed_since = reader.Number();
    if (!unobeyed_since) return;
    if (*fresh_at <= now && *unobeyed_since <= now)
      links_[static_cast<int>(*id)] = {*fresh_at, *commanding, *unobeyed_since};
  }
}

std::optional<LinkWatch::Memory> LinkMemory::Take(std::int64_t session_id, int id) {
  if (session_id != session_id_) return std::nullopt;
  const auto link = links_.extract(id);
  if (!link) return std::nullopt;
  return link.mapped();
}

std::string LinkMemory::Encode(bus::Utime now, std::int64_t session_id,
                               const std::map<int, WatchedUav>& uavs) const {
  const bool same = session_id == 0 || session_id == session_id_;
  std::map<int, LinkWatch::Memory> links = same ? links_ : std::map<int, LinkWatch::Memory>();
  for (const auto& [id, uav] : uavs) {
    if (const auto memory = uav.watch().Remember(now)) links[id] = *memory;
  }
  bus::SavedBytes bytes;
  bytes.Add(same ? session_id_ : session_id);
  for (const auto& [id, link] : links) {
    for (const std::int64_t number : {std::int64_t{id}, link.fresh_at, link.session_id, link.unobeyed_since})
      bytes.Add(number);
  }
  return bytes.Take();
}

}  // namespace skein::monitor
