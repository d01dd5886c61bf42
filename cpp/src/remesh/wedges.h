#pragma once

/// @file Wedges: places where two faces of a region meet at an edge of less than 65 degrees. The distance between the faces falls
/// to zero towards the edge. Elements there have the angle of the edge, however small they are: smaller ones only move the same
/// angles nearer to the edge. So the distance between the faces is no reason for smaller sizes.

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "remesh/reference_surface.h"
#include "search/box_tree.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Two opposite positions of a region's surface.
struct OppositeFaces {
  Vec3 position;    ///< on the first face
  double distance;  ///< to the second one
  std::array<TriangleId, 2> triangles;
  double tangent;  ///< of the angle between both faces
};

class Wedges {
 public:
  /// `reference` must be prepared and outlive this. O(n log n) for n triangles.
  explicit Wedges(const ReferenceSurface& reference);

  /// Returns true if the faces belong to a wedge whose edge is as near as its angle and the distance between them suggest.
  /// O(log n).
  [[nodiscard]] bool contain(const OppositeFaces& faces) const;
  /// Returns true if feature lines that meet at a node, and are apart by a width at a distance from it, bound a face that ends at
  /// the edge of a wedge.
  [[nodiscard]] bool endAt(NodeId node, double width, double distance) const;

 private:
  struct Edge {
    Vec3 from;
    Vec3 to;
    std::array<SmoothPatchId, 2> patches;
    double tangent;  ///< of the angle of the wedge
  };

  const ReferenceSurface& reference_;
  std::vector<Edge> edges_;
  BoxTree tree_;
  std::vector<double>
      tangentOf_;  ///< per node: smallest one of its edges; 0 if it has none. Empty without edges.
  double smallestTangent_ = 0.0;
};

}  // namespace tetrafront
