#pragma once

/// @file What a report says about a finished mesh beyond QualitySummary: how angles, ratios and edge
/// lengths are distributed, and where the worst elements are. Shapes and lengths are those the size
/// field sees: where it is stretched, in the space where the wanted element is regular with edge 1.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

inline constexpr std::size_t kDihedralBins = 36;  ///< of 5 degrees
inline constexpr std::size_t kRatioBins = 20;     ///< of 0.05
inline constexpr std::size_t kEdgeBins = 30;      ///< of 0.1; the last holds all longer edges too

struct RegionStatistics {
  std::uint32_t region = 0;  ///< as in VolumeMesh::regions
  std::uint32_t tetrahedra = 0;
  double volume = 0.0;
  std::array<std::uint32_t, kDihedralBins> dihedral{};          ///< all six of each element
  std::array<std::uint32_t, kDihedralBins> smallestDihedral{};  ///< one of each element
  std::array<std::uint32_t, kRatioBins> radiusRatio{};
  std::array<std::uint32_t, kEdgeBins> edge{};  ///< length by wanted length; each edge counts once
};

struct ElementFigures {
  std::uint32_t tetrahedron = 0;
  Vec3 place{0.0};                ///< centroid
  double volume = 0.0;            ///< in cubed model units
  double smallestDihedral = 0.0;  ///< degrees
  double largestDihedral = 0.0;   ///< degrees
  double radiusRatio = 0.0;
};

struct QualityStatistics {
  std::vector<RegionStatistics> regions;  ///< ascending
  std::vector<ElementFigures> worst;      ///< up to ten, by their angles, worst first
  ElementFigures smallest;                ///< by volume
  double volumeRatio = 0.0;               ///< largest by smallest volume
  double meanEdge = 0.0;                  ///< by wanted length
  double meanEdgeOfPossible = 0.0;        ///< by the length that the surface's triangles allow
  double edgesNearWanted = 0.0;           ///< share of the edges between 0.6 and 1.5 wanted lengths
  /// Wanted are dihedral angles from 30 to 135 degrees: elements with an angle beyond, which the
  /// boundary does not excuse.
  std::uint32_t missed = 0;
  /// Those it does, each counted under the first of the three reasons that applies to it.
  std::uint32_t limitedByBoundary = 0;
  /// They lie in an edge of the boundary or of walls where the space around them takes less than 30
  /// degrees, which all elements there share; or less than 60, so that only the tetrahedron of its
  /// two triangles could do without less than 30, and that tetrahedron misses its angles. Proved.
  std::uint32_t limitedByEdges = 0;
  /// They have an edge of a boundary triangle that is a needle or a cap (radius ratio below 0.3).
  /// Experience, not proof: good elements exist at such triangles, but hardly ever beside those of
  /// their neighbours.
  std::uint32_t limitedByNeedles = 0;
  /// All their nodes are the boundary's, and they join two parts of it, without a common boundary
  /// edge, that are nearer to each other than 0.6 wanted lengths. No proof either: the triangles of
  /// the two parts decide what can be made of them, and a node between them would be too near.
  std::uint32_t limitedBySheets = 0;
  std::vector<ElementFigures> worstLimited;  ///< up to ten of them, worst first
};

}  // namespace tetrafront
