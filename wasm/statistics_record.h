#pragma once

/// @file QualityStatistics as flat arrays, which src/engine/quality-report.ts unpacks.

#include <cstdint>
#include <vector>

#include "tetrafront/quality_statistics.h"
#include "typed_arrays.h"

namespace tetrafront::border {

struct StatisticsRecord {
  /// Per region: index, number of tetrahedra, volume.
  Float64Array regions = copyOut(std::vector<double>{});
  /// Per region: the histograms of all dihedral angles, the smallest dihedral angles, radius ratios
  /// and edges.
  Uint32Array bins = copyOut(std::vector<std::uint32_t>{});
  /// Per element: index, x y z of the centroid, volume, smallest and largest dihedral angle, radius
  /// ratio.
  Float64Array worst = regions;
  Float64Array worstLimited = regions;
  Float64Array smallest = regions;  ///< one element, or none
  double volumeRatio = 0.0;
  double meanEdge = 0.0;
  double meanEdgeOfAchievable = 0.0;
  double edgesNearTarget = 0.0;
  std::uint32_t outOfRange = 0;
  std::uint32_t limitedByBoundary = 0;
  std::uint32_t limitedByEdges = 0;
  std::uint32_t limitedByNeedles = 0;
  std::uint32_t limitedByNarrowGaps = 0;
};

[[nodiscard]] inline Float64Array flatFigures(const std::vector<ElementQuality>& elements) {
  std::vector<double> flat;
  for (const ElementQuality& e : elements) {
    flat.insert(flat.end(),
                {static_cast<double>(e.tetrahedron), e.centroid.x, e.centroid.y, e.centroid.z,
                 e.volume, e.smallestDihedral, e.largestDihedral, e.radiusRatio});
  }
  return copyOut(flat);
}

[[nodiscard]] inline StatisticsRecord toRecord(const QualityStatistics& statistics) {
  std::vector<double> regions;
  std::vector<std::uint32_t> bins;
  const auto append = [&bins](const auto& counts) {
    bins.insert(bins.end(), counts.begin(), counts.end());
  };
  for (const RegionStatistics& region : statistics.regions) {
    regions.insert(regions.end(), {static_cast<double>(region.region),
                                   static_cast<double>(region.tetrahedra), region.volume});
    append(region.dihedral);
    append(region.smallestDihedral);
    append(region.radiusRatio);
    append(region.edge);
  }
  const bool isEmpty = statistics.worst.empty();
  return {.regions = copyOut(regions),
          .bins = copyOut(bins),
          .worst = flatFigures(statistics.worst),
          .worstLimited = flatFigures(statistics.worstLimited),
          .smallest = isEmpty ? flatFigures({}) : flatFigures({statistics.smallest}),
          .volumeRatio = statistics.volumeRatio,
          .meanEdge = statistics.meanEdge,
          .meanEdgeOfAchievable = statistics.meanEdgeOfAchievable,
          .edgesNearTarget = statistics.edgesNearTarget,
          .outOfRange = statistics.outOfRange,
          .limitedByBoundary = statistics.limitedByBoundary,
          .limitedByEdges = statistics.limitedByEdges,
          .limitedByNeedles = statistics.limitedByNeedles,
          .limitedByNarrowGaps = statistics.limitedByNarrowGaps};
}

}  // namespace tetrafront::border
