#pragma once

/// @file The volume that a change of the remeshed surface sweeps: between the triangles that are removed and those that replace
/// them. Nothing may lie in it. A change that leaves no two triangles intersecting could otherwise pass over whole sheets of
/// triangles, or over components, that are smaller: they would then be on the other side, in another region.
///
/// At an edge of three or more triangles, several sheets move at once. Each of them alone is open there, but any two
/// enclose a volume.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/intersect.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class SweptVolume {
 public:
  /// Begins with the triangles before a change, and then those after it, which must remain while questions are asked. Both have
  /// the same boundary. A node that moves has another number after the change.
  void begin(std::span<const NumberedTriangle> triangles, std::size_t removedCount);

  /// Returns whether a triangle that intersects none of these lies in the volume; exactly, if one of its nodes belongs to none of
  /// these. Otherwise true also if its centroid is so near that roundings decide. O(n), after O(n log n) for the first
  /// question, with n triangles.
  [[nodiscard]] bool contains(const NumberedTriangle& other);

 private:
  void collectSheets();
  [[nodiscard]] bool isBetween(const Vec3& position);
  [[nodiscard]] bool isNear(const Vec3& position) const;

  std::span<const NumberedTriangle> triangles_;
  std::size_t removedCount_ = 0;
  bool isPrepared_ = false;
  std::vector<std::uint32_t> nodes_;        ///< of all triangles, sorted
  std::vector<std::uint32_t> sheetOf_;      ///< per triangle
  std::vector<std::uint8_t> isOpen_;        ///< per sheet
  std::vector<std::uint8_t> isCrossedOdd_;  ///< per sheet: by a ray
};

}  // namespace tetrafront
