#include "core/formation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace skein {
namespace {

using std::numbers::sqrt2;
using std::numbers::sqrt3;

constexpr std::array<std::pair<Shape, std::string_view>, 8> kNames{{
    {Shape::kTriangle, "triangle"},
    {Shape::kColumn, "column"},
    {Shape::kLineAbreast, "line_abreast"},
    {Shape::kEchelonLeft, "echelon_left"},
    {Shape::kEchelonRight, "echelon_right"},
    {Shape::kDiamond, "diamond"},
    {Shape::kVee, "vee"},
    {Shape::kCustom, "custom"},
}};

/// One behind the other in steps of (forward, left).
std::vector<SlotOffset> Line(int count, double forward_step_m, double left_step_m) {
  std::vector<SlotOffset> slots;
  for (int i = 0; i < count; ++i) slots.push_back({i * forward_step_m, i * left_step_m, 0});
  return slots;
}

/// Leader first, then left and right in turn.
std::vector<SlotOffset> Vee(int count, double step_m) {
  std::vector<SlotOffset> slots;
  for (int i = 0; i < count; ++i) {
    const int rank = (i + 1) / 2;
    slots.push_back({-rank * step_m, (i % 2 == 1 ? 1 : -1) * rank * step_m, 0});
  }
  return slots;
}

/// Centred rows; `size_of(row)` is how many a full row holds, the last row takes who is left. Where a row's
/// places lie between those of the row before, `between_m` behind keeps the spacing; where they lie behind
/// them, it takes spacing_m.
template <typename SizeOfRow>
std::vector<SlotOffset> Rows(int count, double spacing_m, double in_row_m, double between_m,
                             SizeOfRow size_of) {
  std::vector<SlotOffset> slots;
  double forward_m = 0;
  int previous = 0;
  for (int row = 0; count > 0; ++row) {
    const int size = std::min(count, size_of(row));
    if (row > 0) forward_m -= (size - previous) % 2 != 0 ? between_m : spacing_m;
    for (int i = 0; i < size; ++i) slots.push_back({forward_m, ((size - 1) / 2.0 - i) * in_row_m, 0});
    count -= size;
    previous = size;
  }
  return slots;
}

std::vector<SlotOffset> Diamond(int count, double spacing_m) {
  int widest = 0;
  while (widest * widest < count) ++widest;
  return Rows(count, spacing_m, spacing_m * sqrt2, spacing_m / sqrt2,
              [widest](int row) { return row < widest ? row + 1 : 2 * widest - 1 - row; });
}

std::vector<SlotOffset> UnitSlots(Shape shape, int count, double spacing_m) {
  const double diagonal_m = spacing_m / sqrt2;
  switch (shape) {
    case Shape::kTriangle:
      return Rows(count, spacing_m, spacing_m, spacing_m * sqrt3 / 2, [](int row) { return row + 1; });
    case Shape::kColumn:
      return Line(count, -spacing_m, 0);
    case Shape::kLineAbreast:
      return Rows(count, spacing_m, spacing_m, spacing_m, [count](int) { return count; });
    case Shape::kEchelonLeft:
      return Line(count, -diagonal_m, diagonal_m);
    case Shape::kEchelonRight:
      return Line(count, -diagonal_m, -diagonal_m);
    case Shape::kDiamond:
      return Diamond(count, spacing_m);
    case Shape::kVee:
      return Vee(count, diagonal_m);
    case Shape::kCustom:
      break;
  }
  throw std::invalid_argument("a custom formation has no slots of its own");
}

}  // namespace

std::string_view Name(Shape shape) {
  return std::find_if(kNames.begin(), kNames.end(),
                      [shape](const auto& entry) { return entry.first == shape; })
      ->second;
}

std::optional<Shape> ShapeFromName(std::string_view name) {
  for (const auto& [shape, shape_name] : kNames) {
    if (shape_name == name) return shape;
  }
  return std::nullopt;
}

std::vector<SlotOffset> ShapeSlots(Shape shape, int count, double spacing_m, double lead_m) {
  if (count < 0) throw std::invalid_argument("the number of slots must not be negative");
  if (!(spacing_m > 0) || !std::isfinite(spacing_m)) {
    throw std::invalid_argument("spacing_m must be above 0");
  }
  if (!(lead_m >= 0) || !std::isfinite(lead_m)) {
    throw std::invalid_argument("lead_m must not be negative");
  }
  std::vector<SlotOffset> slots = UnitSlots(shape, count, spacing_m);
  for (SlotOffset& slot : slots) slot.forward_m -= lead_m;
  return slots;
}

}  // namespace skein
