#include <nlohmann/json.hpp>
#include <string>

#include "cli/geo_point.h"
#include "cli/log/flight_tracks.h"
#include "cli/log/log.h"
#include "cli/log/text.h"

namespace skein::cli {
namespace {

using Json = nlohmann::ordered_json;

/// A FeatureCollection, written feature by feature: all of it in memory would be much.
class FeatureWriter {
 public:
  FeatureWriter(std::ostream& stream, const std::string& name) : stream_(stream) {
    stream_ << R"({"type":"FeatureCollection","name":)" << Json(Printable(name)).dump() << ",\"features\":[";
  }

  void Write(Json geometry, Json properties) {
    const Json feature = {
        {"type", "Feature"}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}};
    stream_ << (is_first_ ? "\n" : ",\n") << feature.dump();
    is_first_ = false;
  }

  void Finish() { stream_ << "\n]}\n"; }

 private:
  std::ostream& stream_;
  bool is_first_ = true;
};

Json PropertiesOf(const VehicleTrack& track) {
  return {{"kind", "track"}, {"vehicle_id", track.id}, {"callsign", track.callsign}};
}

void WriteLines(const FlightTracks& tracks, const VehicleTrack& track, FeatureWriter& features) {
  for (const TrackPiece& piece : track.pieces) {
    Json coordinates = Json::array();
    Json times = Json::array();
    for (const TrackPoint& point : piece.points) {
      coordinates.push_back(GeoPosition(point.position, piece.origin));
      times.push_back(IsoTime(tracks.UtimeOf(point)));
    }
    // A line has two points at least.
    if (coordinates.size() == 1) {
      coordinates.push_back(coordinates[0]);
      times.push_back(times[0]);
    }
    Json properties = PropertiesOf(track);
    properties["begin"] = times.front();
    properties["end"] = times.back();
    // As togeojson and others have it: a time for each position.
    properties["coordinateProperties"] = {{"times", std::move(times)}};
    features.Write({{"type", "LineString"}, {"coordinates", std::move(coordinates)}}, std::move(properties));
  }
}

void WritePoints(const FlightTracks& tracks, const VehicleTrack& track, FeatureWriter& features) {
  for (const TrackPiece& piece : track.pieces) {
    for (const TrackPoint& point : piece.points) {
      Json properties = PropertiesOf(track);
      properties["time"] = IsoTime(tracks.UtimeOf(point));
      features.Write({{"type", "Point"}, {"coordinates", GeoPosition(point.position, piece.origin)}},
                     std::move(properties));
    }
  }
}

void WritePath(const FormationPath& path, FeatureWriter& features) {
  Json coordinates = Json::array();
  for (const auto& point : path.line) coordinates.push_back(GeoPosition(point, path.origin));
  features.Write({{"type", "LineString"}, {"coordinates", std::move(coordinates)}},
                 {{"kind", "path"},
                  {"formation_id", path.formation_id},
                  {"formation", path.formation_name},
                  {"revision", path.revision},
                  {"begin", IsoTime(path.first_utime)},
                  {"end", IsoTime(path.last_utime)}});
}

void WriteEvent(const PlacedEvent& placed, FeatureWriter& features) {
  const event_t& event = placed.event;
  Json geometry;
  if (placed.place) {
    geometry = {{"type", "Point"}, {"coordinates", GeoPosition(*placed.place, placed.origin)}};
  }
  features.Write(std::move(geometry), {{"kind", "event"},
                                       {"time", IsoTime(event.utime)},
                                       {"severity", event.severity},
                                       {"code", event.code},
                                       {"vehicle_id", event.vehicle_id},
                                       {"formation_id", event.formation_id},
                                       {"text", event.text}});
}

}  // namespace

void WriteLogGeoJson(const LogTracksOptions& options, std::ostream& out) {
  LogSource source(options.file);
  Output output(options.output, out, source.parts());
  const FlightTracks tracks = ReadTracks(source, options);
  FeatureWriter features(output.stream(), source.name());
  for (const auto& [id, track] : tracks.vehicles) {
    if (options.points) {
      WritePoints(tracks, track, features);
    } else {
      WriteLines(tracks, track, features);
    }
  }
  for (const FormationPath& path : tracks.paths) WritePath(path, features);
  for (const PlacedEvent& event : tracks.events) WriteEvent(event, features);
  features.Finish();
  output.Finish();
  source.TellProblems();
}

}  // namespace skein::cli
