#pragma once

/// @file Writes the division of lines and the 2-D fronts of patches as the events of a trace, described in
/// docs/TRACE.md: a few bytes per step, in the order in which they happen.

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/trace_bytes.h"
#include "surface/divided_lines.h"
#include "surface/line_mesher.h"
#include "surface/patch_boundary.h"
#include "surface/patch_metric.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

/// Reason for refusing a candidate over an edge of a 2-D front.
enum class PlanarRefusal : std::uint8_t {
  kBehind = 0,    ///< the candidate is not on the unmeshed side of the base edge
  kCrosses = 1,   ///< the triangle would cross an edge of the front
  kTooClose = 2,  ///< a new node would be too close to an edge of the front
  kSameNode =
      3,  ///< on a seam: the candidate is the same node of the surface as an end of the base edge
  kOutside = 4,  ///< a new node would be outside the box around the patch
};

/// How a 2-D front ends.
enum class PlanarFrontEnd : std::uint8_t {
  kCovered = 0,  ///< it has covered the patch
  kStalled = 1,  ///< it has taken all its edges, but not covered the patch
  kStopped = 2,  ///< it was stopped while it had edges to take
};

class SurfaceRecorder {
 public:
  /// Appends to `bytes`, which must outlive this.
  explicit SurfaceRecorder(TraceBytes& bytes) : bytes_(bytes) {}

  /// The division of a line begins, at its first end.
  void line(LineId line, const Curve& curve);
  /// A walk of S1-S4 to a station, at the parameter `t` and the metric length `lambda` of the line up to it.
  void station(const SideStep& step, double t, double lambda, const Curve& curve);
  /// The line is divided, or cannot be.
  void divided(const LineDivision& division);
  void halved(LineId line, std::uint32_t side, const LineDivision& division);
  /// All lines are divided, and their nodes have indices.
  void numbered(const DividedLines& lines);

  /// The 2-D front of a patch begins. `isRepeated`: the patch is triangulated again.
  void patch(PatchId patch, const PatchBoundary& boundary, bool isCurved, bool isRepeated);
  /// Steps F4 and F5 for an edge of the front, after its candidates were ranked.
  struct BaseEdge {
    std::uint32_t id;
    PlanarNodeId from;
    Vec2 fromPlane;           ///< position of `from` in the plane
    std::uint8_t pass;        ///< number of failed attempts to complete it
    std::uint32_t sizeClass;  ///< lower ones come first
    std::uint32_t layer;      ///< then lower ones of these
    Vec2 ideal;
    std::size_t edgesNear;
    std::size_t candidates;
  };
  void base(const BaseEdge& edge, const PlaneSample& sample);
  /// `node`: none for a new one. `culprit`: the edge that the triangle crosses, or that the node is too close to.
  void refused(PlanarNodeId node, PlanarRefusal why, std::uint32_t culprit);
  /// What the front does with one of the two other edges of a new triangle.
  struct EdgeChange {
    std::uint32_t id;
    bool
        isClosed;  ///< true: the edge, of the opposite direction, leaves the front; false: it joins it
  };
  /// `changes`: for the edges from the base edge's first node to the apex, and from there to its second node.
  void accepted(const PlanarMesh& mesh, PlanarNodeId apex, bool isNew,
                const std::array<EdgeChange, 2>& changes);
  /// `next`: the pass of the next attempt, or kNoNextPass.
  void postponed(std::uint32_t next);
  static constexpr std::uint32_t kNoNextPass = 15;
  void ended(const PlanarMesh& mesh, PlanarFrontEnd end);
  /// The triangulation was improved.
  void improved(const PlanarMesh& mesh);

 private:
  void writeIdealPoint();
  void writeNodes(const PlanarMesh& mesh, const std::vector<Vec3>& seam);

  TraceBytes& bytes_;
  Vec3 lineBegin_{0.0};
  BaseEdge base_{};
  PlaneSample sample_;
  bool hasSample_ = false;
};

}  // namespace tetrafront
