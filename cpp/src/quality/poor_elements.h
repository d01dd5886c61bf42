#pragma once

/// @file Finds out why elements are poor: the angle of an edge, a needle of the boundary, the thickness of the region, or none of
/// these. The reasons are found by geometry, so they hold for meshes of any program. They are for reports, and decide nothing.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "search/box_tree.h"
#include "tetrafront/mesh.h"
#include "tetrafront/quality_statistics.h"
#include "tetrafront/vec3.h"
#include "topology/mesh_view.h"

namespace tetrafront {

/// Cosine of the angle below which an element is poor: 10 degrees.
inline constexpr double kPoorCosine = 0.984807753012208;

class PoorElementAnalysis {
 public:
  /// `surface` has the triangles of the boundary and of interfaces; its nodes are the mesh's. Both must outlive this.
  PoorElementAnalysis(const MeshView& mesh, const SurfaceMesh& surface);

  /// Finds the reasons of some elements, of which the first is the worst. O(n log n) for n triangles.
  Task<PoorElements> analyse(Work& work, std::span<const TetId> elements);

 private:
  /// An edge of a triangle, with its lower node first.
  struct Edge {
    NodeId lower;
    NodeId upper;
    TriangleId triangle;
  };
  /// An edge at which two triangles meet at an angle below 30 degrees, with the region between them.
  struct Wedge {
    NodeId from;
    NodeId to;
    double cosine;
  };
  /// One reason of an element, as in PoorElements.
  struct Reason {
    PoorReason reason = PoorReason::kOther;
    double value = 0.0;
    std::uint32_t item = 0;  ///< index of the wedge
  };

  void findEdges();
  void findWedges();
  void addWedge(const Edge& a, const Edge& b, bool areAlone);
  [[nodiscard]] std::span<const Edge> edgesBetween(NodeId a, NodeId b) const;
  [[nodiscard]] Vec3 inwardOf(const Edge& edge, const Vec3& along) const;
  [[nodiscard]] NodeId thirdOf(const Edge& edge) const;

  [[nodiscard]] Reason reasonOf(TetId element) const;
  [[nodiscard]] std::optional<Reason> wedgeAt(const NodeQuad& nodes, double smallest) const;
  [[nodiscard]] std::optional<Reason> needleAt(const NodeQuad& nodes, double smallest) const;
  [[nodiscard]] std::optional<Reason> gapAt(const NodeQuad& nodes) const;
  [[nodiscard]] std::optional<Reason> wedgeNear(const Vec3& position, double width,
                                                double longest) const;
  [[nodiscard]] std::array<Vec3, 2> straightPart(const Wedge& wedge) const;
  [[nodiscard]] Vec3 farthestAlong(NodeId start, const Vec3& direction) const;
  void describe(TetId element, const Reason& reason, PoorElements& poor) const;

  MeshView mesh_;
  const SurfaceMesh& surface_;
  std::vector<Edge> edges_;  ///< sorted
  std::vector<std::uint8_t> isOnBoundary_;
  std::vector<Wedge> wedges_;
  BoxTree wedgeTree_;
  double smallestTangent_ = 0.0;
  struct WedgeEnd {
    NodeId node;
    NodeId other;
  };
  std::vector<WedgeEnd> ends_;  ///< sorted
};

}  // namespace tetrafront
