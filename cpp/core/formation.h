#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace skein {

/// A place in a formation seen from the virtual leader; forward-left-up [m].
struct SlotOffset {
  double forward_m = 0;
  double left_m = 0;
  double up_m = 0;
};

/// A slot and who flies there.
struct Slot {
  int vehicle_id = 0;  ///< 1 or more
  SlotOffset offset;
};

enum class Shape { kTriangle, kColumn, kLineAbreast, kEchelonLeft, kEchelonRight, kDiamond, kVee, kCustom };

/// "triangle", "column", "line_abreast", "echelon_left", "echelon_right", "diamond", "vee", "custom".
std::string_view Name(Shape shape);
std::optional<Shape> ShapeFromName(std::string_view name);

/// Slots of a shape for `count` UAVs (any number >= 0), the first one lead_m behind the virtual leader and
/// foremost. Neighbours are at least spacing_m apart (horizontally); the shape is balanced left and right
/// where it can be. kCustom has no slots of its own: throws std::invalid_argument. spacing_m > 0, lead_m >=
/// 0, else throws.
std::vector<SlotOffset> ShapeSlots(Shape shape, int count, double spacing_m, double lead_m = 1000);

}  // namespace skein
