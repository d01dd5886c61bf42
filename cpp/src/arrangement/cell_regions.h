#pragma once

/// @file Which regions each volume of an arrangement lies in, if the triangles state the regions on their sides. Regions may overlap:
/// each one is counted alone, by its winding number.

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "arrangement/arrangement.h"

namespace tetrafront {

/// Winding numbers other than 0, in the order of the regions.
using RegionWindings = std::vector<std::pair<std::uint32_t, std::int64_t>>;

/// Adds to the winding number of a region; nothing for SurfaceMesh::kNoRegion.
void addWinding(RegionWindings& windings, std::uint32_t region, std::int64_t number);

/// The volumes are the shells of part_shells.h, by index.
class CellRegions {
 public:
  /// `sides`: as SurfaceMesh::triangleRegions, for the triangles that own the walls; it must outlive this object.
  CellRegions(std::span<const std::uint32_t> sides, std::size_t cells)
      : sides_(sides), windings_(cells) {}

  /// Adds a part of the arrangement, with the volumes before and behind it.
  void addWall(std::uint32_t before, std::uint32_t behind, std::span<const PartOwner> owners);

  /// A volume whose winding numbers are known.
  struct Known {
    std::uint32_t cell;
    RegionWindings windings;
  };
  /// Finds the regions of all volumes that walls connect to known ones. Returns false if walls contradict each other; nothing is
  /// known then. O(n r) for n walls and up to r regions in a volume.
  [[nodiscard]] bool find(std::vector<Known> known);

  /// Returns the regions that a volume lies in: first the one to which it belongs, then the others, ascending. It belongs to a region that
  /// contains no other of them as a whole, to the lowest of several: what lies inside another region stays itself. Call after find().
  [[nodiscard]] std::vector<std::uint32_t> regionsOf(std::uint32_t cell) const;
  /// Returns whether a region lies inside another one as a whole, and is not the same.
  [[nodiscard]] bool isWithin(std::uint32_t inner, std::uint32_t outer) const;

 private:
  struct Wall {
    std::uint32_t before;
    std::uint32_t behind;
    RegionWindings step;  ///< windings behind - windings before
  };

  void countCells();

  std::span<const std::uint32_t> sides_;
  std::vector<RegionWindings> windings_;  ///< per volume
  std::vector<Wall> walls_;
  std::map<std::uint32_t, std::size_t> cellsIn_;  ///< number of volumes per region
  /// Number of volumes in two regions, the lower first.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> cellsInBoth_;
};

}  // namespace tetrafront
