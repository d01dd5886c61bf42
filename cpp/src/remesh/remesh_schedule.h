#pragma once

/// @file The order of the remesher's operations: collapse short edges, split long ones, flip, smooth, and at last improve
/// the poorest triangles one by one.

#include <cstdint>
#include <vector>

#include "base/task.h"
#include "remesh/surface_editor.h"

namespace tetrafront {

/// The surface is valid whenever the task yields.
class RemeshSchedule {
 public:
  /// `editor` must outlive this.
  explicit RemeshSchedule(SurfaceEditor& editor) : editor_(editor), complex_(editor.complex()) {}

  Task<> run(Work& work);
  /// Only collapses edges far below their target size.
  Task<> coarsen(Work& work);

 private:
  struct Edge {
    NodeId a;
    NodeId b;
    double length;  ///< in target lengths
  };
  struct PoorTriangle {
    TriangleId triangle;
    std::uint32_t unused = 0;
    double squaredSine;
  };

  Task<> collapseShort(Work& work, double limit, double longest);
  Task<> splitLong(Work& work, double limit);
  Task<> flipAll(Work& work);
  Task<> smoothAndFlip(Work& work, int passes);
  Task<> smoothAll(Work& work);
  Task<> improvePoor(Work& work, double squaredSine);

  [[nodiscard]] bool isSettled(TriangleId triangle) const;
  void collectEdges(double shortest, double longest);
  bool collapseIfShort(const Edge& edge, double limit, double longest);
  bool splitAndFlip(const Edge& edge);
  bool collapseInto(NodeId node);
  void flipAround(NodeId node);
  [[nodiscard]] double footOf(NodeId a, NodeId b, NodeId node) const;
  [[nodiscard]] double heightOf(NodeId a, NodeId b, NodeId node) const;
  bool flipEdges(TriangleId triangle, std::uint32_t since);
  bool improveTriangle(TriangleId triangle, double squaredSine);
  bool splitUnder(const NodeTriple& nodes);

  SurfaceEditor& editor_;
  const SurfaceComplex& complex_;
  std::vector<Edge> edges_;
  bool isImproved_ = false;  ///< whether the last improvePoor() changed a triangle
  std::vector<PoorTriangle> poor_;
  std::vector<Edge> waiting_;
  std::vector<HalfEdgeId> edge_;
  std::uint32_t flipped_ = SurfaceEditor::kFirstTime;   ///< time of the last pass of flips
  std::uint32_t smoothed_ = SurfaceEditor::kFirstTime;  ///< time of the last pass of moves
};

}  // namespace tetrafront
