#pragma once

/// @file The volume that a change of the remeshed surface sweeps: between the triangles that are removed and those that replace
/// them. Nothing may lie in it. A change that leaves no two triangles intersecting could otherwise pass over whole sheets of
/// triangles, or over components, that are smaller: they would then be on the other side, in another region.
///
/// At an edge of three or more triangles, several sheets end and move at once. Each of them alone is open there, but those whose
/// ends cancel out modulo 2 enclose a volume.

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
  /// these. Otherwise true also if its centroid is so near that roundings decide, and always true if sheets end at more than
  /// kMaxEnds edges. O(n), after O(n log n) for the first question, with n triangles and few ends.
  [[nodiscard]] bool contains(const NumberedTriangle& other);

 private:
  static constexpr std::size_t kMaxEnds = 64;

  struct Edge {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t triangle;

    [[nodiscard]] bool isSame(const Edge& other) const {
      return low == other.low && high == other.high;
    }
  };
  struct End {
    std::uint32_t triangle;
    std::uint32_t edge;  ///< number among the edges at which sheets end
  };
  /// Of a sheet, or of a sum of sheets.
  struct Outline {
    std::uint64_t ends = 0;     ///< a bit per edge: whether an odd number of triangles ends there
    bool isCrossedOdd = false;  ///< by a ray, an odd number of times
  };

  void collectSheets();
  [[nodiscard]] bool isBetween(const Vec3& position);
  [[nodiscard]] bool isNear(const Vec3& position) const;

  std::span<const NumberedTriangle> triangles_;
  std::size_t removedCount_ = 0;
  bool isPrepared_ = false;
  bool hasTooManyEnds_ = false;
  std::vector<std::uint32_t> nodes_;  ///< of all triangles, sorted
  std::vector<Edge> edges_;           ///< sorted by their nodes
  std::vector<End> ends_;
  std::vector<std::uint32_t> sheetOf_;  ///< per triangle
  std::vector<Outline> outlines_;       ///< per sheet
};

}  // namespace tetrafront
