#include "config/readers.h"

namespace skein::config {
namespace {

CutLink ReadCut(const Object& object) {
  CutLink cut;
  cut.vehicle_id = object.At("cut_link").Integer(kIds);
  if (const auto direction = object.Find("direction")) {
    const std::string name = direction->Text();
    if (name != "up" && name != "down" && name != "both") {
      direction->Refuse(UnknownName("direction", name, {"up", "down", "both"}));
    }
    cut.uplink = name != "down";
    cut.downlink = name != "up";
  }
  cut.frozen = object.Boolean("frozen", false);
  if (cut.frozen && !cut.downlink) object.At("frozen").Refuse("goes with the downlink only");
  if (const auto for_s = object.Find("for_s")) cut.for_s = for_s->Number({0.05, 1e6});
  return cut;
}

SetLink ReadSet(const Object& object) {
  SetLink set;
  set.vehicle_id = object.At("set_link").Integer(kIds);
  if (const auto up = object.Find("up")) set.uplink = ReadLinkQuality(*up, {});
  if (const auto down = object.Find("down")) set.downlink = ReadLinkQuality(*down, {});
  if (!set.uplink && !set.downlink) object.value().Refuse("set_link needs up or down or both");
  return set;
}

}  // namespace

TimelineEntry ReadTimelineEntry(const Value& value) {
  const Object any(
      value, {"at_s", "cut_link", "restore_link", "set_link", "for_s", "direction", "frozen", "up", "down"});
  TimelineEntry entry;
  entry.at_s = any.Number("at_s", kSeconds);
  any.RefuseBoth("cut_link", "restore_link");
  any.RefuseBoth("cut_link", "set_link");
  any.RefuseBoth("restore_link", "set_link");
  if (any.Has("cut_link")) {
    entry.action = ReadCut(Object(value, {"at_s", "cut_link", "for_s", "direction", "frozen"}));
  } else if (any.Has("restore_link")) {
    const Object object(value, {"at_s", "restore_link"});
    entry.action = RestoreLink{.vehicle_id = object.At("restore_link").Integer(kIds)};
  } else if (any.Has("set_link")) {
    entry.action = ReadSet(Object(value, {"at_s", "set_link", "up", "down"}));
  } else {
    value.Refuse("needs cut_link, restore_link or set_link");
  }
  return entry;
}

}  // namespace skein::config
