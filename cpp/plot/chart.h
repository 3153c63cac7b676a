#pragma once

#include <string>
#include <vector>

namespace skein::plot {

/// How a curve is drawn.
struct Stroke {
  std::string colour;  ///< "#0072B2"
  std::string dash;    ///< SVG's stroke-dasharray, "" for a solid line
  double width = 1.6;
};

struct Point {
  double x = 0;
  double y = 0;
};

struct Curve {
  std::vector<Point> points;
  Stroke stroke;
};

struct Box {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;
};

/// One diagram: curves over labelled axes.
struct Chart {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  std::vector<double> vertical_lines;
  Stroke vertical_stroke;
  bool equal_scales = false;  ///< for maps
};

/// Values for ticks: 1, 2 or 5 times a power of ten apart, about `count` of them, from `least` to `most`.
std::vector<double> TickValues(double least, double most, int count);

/// Without the points that lie on the way, to within `tolerance`; the first and the last one stay.
std::vector<Point> Simplified(const std::vector<Point>& points, double tolerance);

/// SVG elements of a chart that fills a box, labels included.
std::string Draw(const Chart& chart, const Box& box);

/// A level piece of line, for a legend.
std::string Sample(double x, double y, double length, const Stroke& stroke);

/// How an SVG figure of so many pixels begins; it ends with "</svg>".
std::string SvgStart(double width, double height);

/// One line of text. @param anchor "start", "middle" or "end".
std::string Text(double x, double y, const std::string& text, const std::string& anchor, double size = 12,
                 const std::string& more = "");

/// As text or attribute of an XML file.
std::string EscapedXml(const std::string& text);

}  // namespace skein::plot
