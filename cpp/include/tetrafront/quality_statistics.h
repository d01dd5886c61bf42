#pragma once

/// @file Statistics of a finished mesh beyond QualitySummary: histograms of angles, radius ratios and edge lengths,
/// and the worst elements. Shapes and lengths are measured in the metric of the size field: in the space in which
/// the target element is regular with edge length 1.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

inline constexpr std::size_t kDihedralBins = 36;       ///< of 5 degrees
inline constexpr std::size_t kRatioBins = 20;          ///< of 0.05
inline constexpr std::size_t kEdgeBinsPerTarget = 10;  ///< per target length
/// The last bin also holds all edges longer than three target lengths.
inline constexpr std::size_t kEdgeBins = 3 * kEdgeBinsPerTarget;

struct RegionStatistics {
  std::uint32_t region = 0;  ///< as in VolumeMesh::regions
  std::uint32_t tetrahedra = 0;
  double volume = 0.0;
  double minDihedral = 0.0;     ///< degrees
  double maxDihedral = 0.0;     ///< degrees
  double minRadiusRatio = 0.0;  ///< 3 x inradius / circumradius, 1 for the regular tetrahedron
  double meanRadiusRatio = 0.0;
  std::array<std::uint32_t, kDihedralBins> dihedral{};  ///< all six angles of each element
  std::array<std::uint32_t, kDihedralBins>
      smallestDihedral{};  ///< the smallest angle of each element
  std::array<std::uint32_t, kRatioBins> radiusRatio{};
  std::array<std::uint32_t, kEdgeBins> edge{};  ///< length / target length; each edge counts once
};

/// Quality of one element.
struct ElementQuality {
  std::uint32_t tetrahedron = 0;
  Vec3 centroid{0.0};
  double volume = 0.0;            ///< in cubed model units
  double smallestDihedral = 0.0;  ///< degrees
  double largestDihedral = 0.0;   ///< degrees
  double radiusRatio = 0.0;
};

/// Shapes of all elements, measured in the metric of a stretched size field; empty without stretching. One number per
/// element each.
struct MetricShapes {
  std::vector<float> radiusRatio;
  std::vector<float> smallestDihedral;  ///< degrees
};

/// Why an element has a dihedral angle below 10 degrees.
enum class PoorReason : std::uint8_t {
  kOther = 0,      ///< none of the others: smaller elements or more optimization may help
  kWedge = 1,      ///< two faces meet there at a small angle, which no element can open
  kTriangle = 2,   ///< a triangle of the boundary or of an interface is a needle or cap
  kThickness = 3,  ///< the region is much thinner than the elements are wide
};

/// Elements whose smallest dihedral angle is below 10 degrees, and why the worst of them is poor.
struct PoorElements {
  std::uint32_t count = 0;
  std::uint32_t inWedges = 0;
  std::uint32_t atNeedles = 0;
  std::uint32_t inThinPlaces = 0;
  ElementQuality worst;  ///< without meaning if there is none, as all that follows
  PoorReason reason = PoorReason::kOther;
  /// Degrees: angle of the edge, or smallest angle of the triangle. In model units: thickness. 0 for other reasons.
  double value = 0.0;
  /// Ends of the straight part of the edge at which faces meet.
  Vec3 edgeFrom{0.0};
  Vec3 edgeTo{0.0};
  /// Size with which nearly all elements at the worst thin place would have angles above 10 degrees, and the number that the mesh
  /// would have if all thin places had such sizes.
  double goodSize = 0.0;
  double goodTetrahedra = 0.0;
};

struct QualityStatistics {
  std::vector<RegionStatistics> regions;  ///< ascending
  std::vector<ElementQuality> worst;      ///< up to ten, by their angles, worst first
  ElementQuality smallest;                ///< element with the smallest volume
  double volumeRatio = 0.0;               ///< largest / smallest volume
  double meanEdge = 0.0;                  ///< mean of length / target length
  /// Mean of length / length that the surface's triangles allow.
  double meanEdgeOfAchievable = 0.0;
  double edgesNearTarget = 0.0;  ///< share of the edges with 0.6 to 1.5 target lengths
  /// Elements with a dihedral angle outside 30 to 135 degrees, except those limited by the boundary.
  std::uint32_t outOfRange = 0;
  /// Such elements that are limited by the boundary: the sum of the next three, each element counted under the
  /// first reason that applies.
  std::uint32_t limitedByBoundary = 0;
  /// Elements at an edge of the boundary or of interfaces where the boundary forces an angle out of range. Either
  /// the region spans less than 30 degrees there; or less than 60, so that one element must fill the wedge, and the
  /// tetrahedron of its two triangles is out of range itself. This limit is proved.
  std::uint32_t limitedByEdges = 0;
  /// Elements with an edge of a boundary triangle that is a needle or a cap (radius ratio below
  /// 0.3). This limit is empirical, not proved: good elements at such triangles exist, but they
  /// rarely fit their neighbours.
  std::uint32_t limitedByNeedles = 0;
  /// Elements in a narrow gap: all nodes are on the boundary, and the element joins two parts of it that share no
  /// edge of the element and are closer than 0.6 target lengths. Not proved: the triangles of both parts determine
  /// the elements between them, and a node in the gap would be too close to them.
  std::uint32_t limitedByNarrowGaps = 0;
  std::vector<ElementQuality>
      worstLimited;  ///< up to ten elements limited by the boundary, worst first
  PoorElements poor;
};

}  // namespace tetrafront
