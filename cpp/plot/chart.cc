#include "plot/chart.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace skein::plot {
namespace {

constexpr double kTickTextWidth = 62;
constexpr double kBelow = 44;
constexpr double kAbove = 24;
constexpr const char* kInk = "#333333";
constexpr const char* kGrid = "#e2e2e2";

struct Interval {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void Include(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double length() const { return most - least; }
};

/// Some room above and below, and never without length.
Interval Padded(Interval interval, double share, double least_length) {
  if (interval.least > interval.most) return {0, 1};
  if (interval.length() < least_length) {
    const double middle = (interval.least + interval.most) / 2;
    return {middle - least_length / 2, middle + least_length / 2};
  }
  return {interval.least - share * interval.length(), interval.most + share * interval.length()};
}

std::string TickText(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", value == 0 ? 0.0 : value, decimals);
}

/// Where values lie in a box of the page.
class Scale {
 public:
  Scale(const Interval& x, const Interval& y, const Box& box) : x_(x), y_(y), box_(box) {}
  double X(double value) const { return box_.left + (value - x_.least) / x_.length() * box_.width; }
  double Y(double value) const { return box_.top + (y_.most - value) / y_.length() * box_.height; }

 private:
  Interval x_;
  Interval y_;
  Box box_;
};

std::string Line(double x1, double y1, double x2, double y2, const std::string& style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2,
                     style);
}

std::string Attributes(const Stroke& stroke) {
  return fmt::format("stroke=\"{}\" stroke-width=\"{:g}\"{}", stroke.colour, stroke.width,
                     stroke.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", stroke.dash));
}

std::string Polyline(const Curve& curve, const Scale& scale) {
  std::vector<Point> page;
  for (const Point& point : curve.points) page.push_back({scale.X(point.x), scale.Y(point.y)});
  std::string svg =
      "<polyline fill=\"none\" stroke-linejoin=\"round\" " + Attributes(curve.stroke) + " points=\"";
  for (const Point& point : Simplified(page, 0.15)) svg += fmt::format("{:.1f},{:.1f} ", point.x, point.y);
  svg.back() = '"';
  return svg + "/>\n";
}

/// Squared distance of a point from the line between two others.
double OffLine(const Point& point, const Point& from, const Point& to) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double length2 = dx * dx + dy * dy;
  const double px = point.x - from.x;
  const double py = point.y - from.y;
  const double along = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0;
  return std::pow(px - along * dx, 2) + std::pow(py - along * dy, 2);
}

void MakeScalesEqual(Interval& x, Interval& y, const Box& box) {
  const double per_pixel = std::max(x.length() / box.width, y.length() / box.height);
  const auto widen = [per_pixel](Interval& interval, double pixels) {
    const double middle = (interval.least + interval.most) / 2;
    interval = {middle - per_pixel * pixels / 2, middle + per_pixel * pixels / 2};
  };
  widen(x, box.width);
  widen(y, box.height);
}

}  // namespace

std::string EscapedXml(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '<'   ? "&lt;"
              : c == '>' ? "&gt;"
              : c == '&' ? "&amp;"
              : c == '"' ? "&quot;"
                         : std::string(1, c);
  }
  return result;
}

std::vector<double> TickValues(double least, double most, int count) {
  const double rough = (most - least) / std::max(1, count);
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double factor = rough / power;
  const double step = power * (factor < 1.5 ? 1 : factor < 3.5 ? 2 : factor < 7.5 ? 5 : 10);
  std::vector<double> values;
  for (auto n = static_cast<long long>(std::ceil(least / step - 1e-9));
       static_cast<double>(n) * step <= most + 1e-9 * step; ++n) {
    values.push_back(static_cast<double>(n) * step);
  }
  return values;
}

std::vector<Point> Simplified(const std::vector<Point>& points, double tolerance) {
  if (points.size() < 3) return points;
  std::vector<bool> keep(points.size());
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, points.size() - 1}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    double farthest = tolerance * tolerance;
    std::size_t split = 0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off = OffLine(points[i], points[first], points[last]);
      if (off > farthest) {
        farthest = off;
        split = i;
      }
    }
    if (split == 0) continue;
    keep[split] = true;
    spans.emplace_back(first, split);
    spans.emplace_back(split, last);
  }
  std::vector<Point> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i]) kept.push_back(points[i]);
  }
  return kept;
}

std::string SvgStart(double width, double height) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} "
      "{1:g}\" "
      "font-family=\"'DejaVu Sans', Helvetica, Arial, sans-serif\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n",
      width, height);
}

std::string Sample(double x, double y, double length, const Stroke& stroke) {
  return Line(x, y, x + length, y, Attributes(stroke));
}

std::string Text(double x, double y, const std::string& text, const std::string& anchor, double size,
                 const std::string& more) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{:g}\" fill=\"{}\"{}>{}</text>\n", x, y,
      anchor, size, kInk, more.empty() ? "" : " " + more, EscapedXml(text));
}

std::string Draw(const Chart& chart, const Box& box) {
  const Box plot{box.left + kTickTextWidth, box.top + kAbove, box.width - kTickTextWidth - 12,
                 box.height - kAbove - kBelow};
  Interval x;
  Interval y;
  for (const Curve& curve : chart.curves) {
    for (const Point& point : curve.points) {
      x.Include(point.x);
      y.Include(point.y);
    }
  }
  x = Padded(x, chart.equal_scales ? 0.05 : 0, 1e-3);
  y = Padded(y, 0.06, 1);
  if (chart.equal_scales) MakeScalesEqual(x, y, plot);
  const Scale scale(x, y, plot);
  const double right = plot.left + plot.width;
  const double bottom = plot.top + plot.height;

  std::string svg = "<g>\n";
  const auto x_ticks = TickValues(x.least, x.most, static_cast<int>(plot.width / 60));
  const auto y_ticks = TickValues(y.least, y.most, static_cast<int>(plot.height / 32));
  for (const double value : x_ticks) {
    svg += Line(scale.X(value), plot.top, scale.X(value), bottom, fmt::format("stroke=\"{}\"", kGrid));
    svg += Text(scale.X(value), bottom + 16,
                TickText(value, x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : 1), "middle", 11);
  }
  for (const double value : y_ticks) {
    svg += Line(plot.left, scale.Y(value), right, scale.Y(value), fmt::format("stroke=\"{}\"", kGrid));
    svg += Text(plot.left - 6, scale.Y(value) + 4,
                TickText(value, y_ticks.size() > 1 ? y_ticks[1] - y_ticks[0] : 1), "end", 11);
  }
  svg += fmt::format(
      "<svg x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" viewBox=\"{:.1f} {:.1f} {:.1f} "
      "{:.1f}\">\n",
      plot.left, plot.top, plot.width, plot.height, plot.left, plot.top, plot.width, plot.height);
  for (const double value : chart.vertical_lines) {
    svg += Line(scale.X(value), plot.top, scale.X(value), bottom, Attributes(chart.vertical_stroke));
  }
  for (const Curve& curve : chart.curves) {
    if (!curve.points.empty()) svg += Polyline(curve, scale);
  }
  svg += "</svg>\n";
  svg += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"{}\"/>\n",
      plot.left, plot.top, plot.width, plot.height, kInk);
  svg += Text(plot.left + plot.width / 2, plot.top - 8, chart.title, "middle", 13, "font-weight=\"bold\"");
  svg += Text(plot.left + plot.width / 2, bottom + 34, chart.x_label, "middle");
  const double middle = plot.top + plot.height / 2;
  svg += Text(box.left + 12, middle, chart.y_label, "middle", 12,
              fmt::format("transform=\"rotate(-90 {:.1f} {:.1f})\"", box.left + 12, middle));
  return svg + "</g>\n";
}

}  // namespace skein::plot
