#include <spdlog/fmt/fmt.h>

#include <array>
#include <iterator>
#include <string>

#include "cli/geo_point.h"
#include "cli/log/flight_tracks.h"
#include "cli/log/log.h"
#include "cli/log/text.h"
#include "plot/chart.h"

namespace skein::cli {
namespace {

// Okabe and Ito's colours, as in the plots; KML has them as alpha, blue, green, red.
constexpr std::array<const char*, 7> kColours = {"ffb27200", "ff009fe6", "ff739e00", "ff005ed5",
                                                 "ffa779cc", "ffe9b456", "ffffffff"};
constexpr const char* kAbsolute = "<altitudeMode>absolute</altitudeMode>";

std::string Coordinates(const Eigen::Vector3d& local, const config::Origin& origin, char separator) {
  const auto [longitude_deg, latitude_deg, altitude_m] = GeoPosition(local, origin);
  return fmt::format("{}{}{}{}{}", longitude_deg, separator, latitude_deg, separator, altitude_m);
}

void WriteStyles(std::ostream& out) {
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    out << fmt::format(
        "<Style id=\"uav{}\"><IconStyle><color>{}</color><scale>0.7</scale></IconStyle>"
        "<LineStyle><color>{}</color><width>2</width></LineStyle></Style>\n",
        i, kColours.at(i), kColours.at(i));
  }
  out << "<Style id=\"path\"><LineStyle><color>c0ffffff</color><width>1</width></LineStyle></Style>\n"
         "<Style id=\"event\"><IconStyle><scale>0.6</scale></IconStyle>"
         "<LabelStyle><scale>0.7</scale></LabelStyle></Style>\n";
}

void WriteTrack(const FlightTracks& tracks, const VehicleTrack& track, std::size_t colour,
                std::ostream& out) {
  out << fmt::format(
      "<Placemark><name>{}</name><styleUrl>#uav{}</styleUrl>\n<gx:MultiTrack>{}"
      "<gx:interpolate>0</gx:interpolate>\n",
      plot::EscapedXml(track.callsign), colour, kAbsolute);
  for (const TrackPiece& piece : track.pieces) {
    out << "<gx:Track>" << kAbsolute << '\n';
    for (const TrackPoint& point : piece.points) {
      out << "<when>" << IsoTime(tracks.UtimeOf(point)) << "</when>\n";
    }
    for (const TrackPoint& point : piece.points) {
      out << "<gx:coord>" << Coordinates(point.position, piece.origin, ' ') << "</gx:coord>\n";
    }
    out << "</gx:Track>\n";
  }
  out << "</gx:MultiTrack>\n</Placemark>\n";
}

void WritePath(const FormationPath& path, std::ostream& out) {
  const std::string name = path.formation_name.empty() ? "" : ": " + path.formation_name;
  out << fmt::format(
      "<Placemark><name>{}</name><TimeSpan><begin>{}</begin><end>{}</end></TimeSpan>"
      "<styleUrl>#path</styleUrl>\n<LineString>{}<coordinates>\n",
      plot::EscapedXml(fmt::format("Path {} of formation {}{}", path.revision, path.formation_id, name)),
      IsoTime(path.first_utime), IsoTime(path.last_utime), kAbsolute);
  for (const auto& point : path.line) out << Coordinates(point, path.origin, ',') << '\n';
  out << "</coordinates></LineString></Placemark>\n";
}

void WriteEvent(const PlacedEvent& placed, std::ostream& out) {
  const event_t& event = placed.event;
  out << fmt::format(
      "<Placemark><name>{}</name><description>{}</description><TimeStamp><when>{}</when></TimeStamp>"
      "<styleUrl>#event</styleUrl>",
      plot::EscapedXml(event.code),
      plot::EscapedXml(
          fmt::format("{}: {}", kSeverities.at(static_cast<std::size_t>(event.severity)), event.text)),
      IsoTime(event.utime));
  if (placed.place) {
    out << "<Point>" << kAbsolute << "<coordinates>" << Coordinates(*placed.place, placed.origin, ',')
        << "</coordinates></Point>";
  }
  out << "</Placemark>\n";
}

}  // namespace

void WriteLogKml(const LogTracksOptions& options, std::ostream& out) {
  LogSource source(options.file);
  Output output(options.output, out, source.parts());
  const FlightTracks tracks = ReadTracks(source, options);
  std::ostream& stream = output.stream();
  stream << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<kml xmlns=\"http://www.opengis.net/kml/2.2\" xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n"
         << "<Document><name>" << plot::EscapedXml(Printable(source.name())) << "</name>\n";
  if (!tracks.scenario.empty())
    stream << "<description>" << plot::EscapedXml(tracks.scenario) << "</description>\n";
  WriteStyles(stream);
  stream << "<Folder><name>UAVs</name>\n";
  std::size_t count = 0;
  for (const auto& [id, track] : tracks.vehicles)
    WriteTrack(tracks, track, count++ % kColours.size(), stream);
  stream << "</Folder>\n<Folder><name>Paths</name>\n";
  for (const FormationPath& path : tracks.paths) WritePath(path, stream);
  stream << "</Folder>\n<Folder><name>Events</name>\n";
  for (const PlacedEvent& event : tracks.events) WriteEvent(event, stream);
  stream << "</Folder>\n</Document>\n</kml>\n";
  output.Finish();
  source.TellProblems();
}

}  // namespace skein::cli
