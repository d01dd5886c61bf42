#pragma once

/// @file Drops small details of a given surface: where feature lines are nearer to each other than a distance, they become
/// one. Strips, steps and the ends of cusps that are narrower disappear, and so do shorter feature lines.

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "remesh/reference_surface.h"
#include "remesh/surface_complex.h"
#include "remesh/triangle_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/remesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Which details are dropped.
enum class DetailChoice : std::uint8_t {
  kAll,
  kPoor,  ///< only those that a triangle with a small angle lies across or along
};

/// Moves nodes of feature lines onto each other. Every change keeps the surface closed, its topology, and by exact signs
/// free of self-intersections; changes that would not are left out. No point of the surface moves farther than the
/// distance, and none through half of a wall: thin parts stay.
class DetailMerger {
 public:
  /// `reference` must outlive this. `distance` > 0: details below it are dropped.
  DetailMerger(const ReferenceSurface& reference, double distance, DetailChoice choice);

  Task<> run(Work& work);

  /// All merges, in the order in which they were made.
  [[nodiscard]] const std::vector<MergedDetail>& merged() const { return merged_; }
  /// Upper bound of the distance between the given surface and the result, both ways.
  [[nodiscard]] double deviation() const;

  /// Copies the result. `origin`: per triangle, the given triangle that it was a part of.
  void copyTo(SurfaceMesh& mesh, std::vector<TriangleId>& origin) const;

 private:
  /// Where a given node is on the feature lines.
  struct LinePlace {
    FeatureLineId line{};  ///< none at corners, and for nodes that are on no line
    double arc = 0.0;
  };
  struct Candidate {
    NodeId a;
    NodeId b;
    double length;
  };

  void insert(TriangleId triangle, TriangleId origin);
  [[nodiscard]] bool isOnLine(NodeId node) const {
    return complex_.kindOf(node) != NodeKind::kSmooth;
  }
  [[nodiscard]] NodeId nowAt(NodeId node) const;
  [[nodiscard]] double distanceToEnd(const LinePlace& place, NodeId end) const;
  [[nodiscard]] double distanceAlongLines(NodeId a, NodeId b) const;
  [[nodiscard]] bool boundDetail(NodeId a, NodeId b, double width) const;
  [[nodiscard]] bool isChosen(NodeId a, NodeId b) const;
  [[nodiscard]] bool isDetail(NodeId a, NodeId b) const;
  void collectCandidates();
  bool merge(const Candidate& candidate);
  bool moveOnto(NodeId a, NodeId b);
  [[nodiscard]] bool keepsTopology(NodeId a, NodeId b);
  [[nodiscard]] bool isAdmitted();
  [[nodiscard]] bool keepsWalls(NodeId from, NodeId onto) const;
  [[nodiscard]] bool hasWall(const Vec3& position, const Vec3& inward, double depth) const;
  bool splitUnderApex(TriangleId triangle);
  bool splitFeatureEdge(HalfEdgeId halfEdge, double part);
  [[nodiscard]] StretchId stretchAfter(NodeId a, NodeId b) const;
  void replace();

  const ReferenceSurface& reference_;
  double distance_;
  DetailChoice choice_;
  bool hasInterfaces_ = false;  ///< then both sides of a triangle may be filled
  SurfaceComplex complex_;
  TriangleGrid grid_;
  std::vector<LinePlace> places_;  ///< per node
  std::vector<NodeId> into_;       ///< per node: the one onto which it was moved, or none
  std::vector<double> moved_;  ///< per node: how far points of the surface have moved to come here
  std::vector<TriangleId> origin_;  ///< per triangle
  std::vector<MergedDetail> merged_;

  // Scratch of a change.
  std::vector<Candidate> candidates_;
  NodeId from_{};  ///< moves onto `onto_`, if any node does
  NodeId onto_{};
  std::vector<TriangleId> removed_;
  struct Added {
    NodeTriple nodes;
    SmoothPatchId patch;
    TriangleId origin;
  };
  std::vector<Added> added_;
  std::vector<NumberedTriangle> numbered_;
  std::vector<HalfEdgeId> edge_;
  std::vector<NodeId> ringA_;
  std::vector<NodeId> ringB_;
};

}  // namespace tetrafront
