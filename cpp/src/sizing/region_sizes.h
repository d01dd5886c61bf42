#pragma once

/// @file The sizes for the largest volumes of given regions, on the triangles of a surface.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// A triangle between two regions belongs to the one with the smaller size.
class RegionSizes {
 public:
  /// No limits.
  RegionSizes() = default;
  explicit RegionSizes(const GivenRegions& regions);

  /// True if a region that a triangle bounds has a largest volume.
  [[nodiscard]] bool areGiven() const { return !regionOf_.empty(); }
  /// Returns the region whose size applies to a given triangle; FieldHint::kAnyRegion if none does.
  [[nodiscard]] std::uint32_t regionOf(std::size_t triangle) const {
    return triangle < regionOf_.size() ? regionOf_[triangle] : FieldHint::kAnyRegion;
  }
  /// Returns the smallest of these sizes; infinite if there are none.
  [[nodiscard]] double smallest() const;
  /// Caps the sizes of a field by those of the regions, and by that of a largest volume everywhere, 0 for none.
  void cap(SizeField& field, double maxVolume) const;

 private:
  std::vector<double> sizes_;            ///< per region; 0 for no limit
  std::vector<std::uint32_t> regionOf_;  ///< per given triangle; empty if no region has a limit
};

}  // namespace tetrafront
