#pragma once

/// @file Which regions each volume of an arrangement lies in, if the triangles state the regions on their sides. Regions may overlap:
/// each one is counted alone, by its winding number.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/arrangement.h"

namespace tetrafront {

/// The volumes are the shells of part_shells.h, by index.
class CellRegions {
 public:
  /// `sides`: as SurfaceMesh::triangleRegions, for the triangles that own the walls; it must outlive this object.
  CellRegions(std::span<const std::uint32_t> sides, std::size_t cells)
      : sides_(sides), windings_(cells) {}

  /// Adds a part of the arrangement, with the volumes before and behind it.
  void addWall(std::uint32_t before, std::uint32_t behind, std::span<const PartOwner> owners);

  /// Finds the regions of all volumes that walls connect to those outside of all regions. Returns false if walls
  /// contradict each other; nothing is known then. O(n r) for n walls and up to r regions in a volume.
  [[nodiscard]] bool find(std::span<const std::uint32_t> outside);

  /// Returns the regions that a volume lies in, ascending.
  [[nodiscard]] std::vector<std::uint32_t> regionsOf(std::uint32_t cell) const;
  /// Returns the lowest of them, or SurfaceMesh::kNoRegion.
  [[nodiscard]] std::uint32_t lowestOf(std::uint32_t cell) const;

 private:
  /// Winding numbers other than 0, in the order of the regions.
  using Windings = std::vector<std::pair<std::uint32_t, std::int64_t>>;
  struct Wall {
    std::uint32_t before;
    std::uint32_t behind;
    Windings step;  ///< windings behind - windings before
  };

  std::span<const std::uint32_t> sides_;
  std::vector<Windings> windings_;  ///< per volume
  std::vector<Wall> walls_;
};

}  // namespace tetrafront
