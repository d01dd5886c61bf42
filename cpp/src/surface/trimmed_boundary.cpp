#include "surface/trimmed_boundary.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/sort.h"
#include "base/tolerance.h"
#include "surface/carrier_table.h"

namespace tetrafront {

namespace {

/// Distance of two occurrences of a node in the plane / length of a side there, below which loops touch.
constexpr double kTouching = 0.1;

/// A node of a loop in the plane, and the side that follows it.
struct LoopNode {
  Vec2 plane;
  Vec3 position;
  NodeId node;
  SideOrigin origin;
};

struct PlacedLoop {
  std::vector<LoopNode> nodes;
  std::vector<std::size_t> edgeStarts;  ///< per coedge: its first node
  double twiceArea = 0.0;
};

double twiceAreaOf(const std::vector<LoopNode>& nodes) {
  double sum = 0.0;
  const Vec2 origin = nodes.front().plane;
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    const Vec2 a = nodes[i].plane - origin;
    const Vec2 b = nodes[i + 1].plane - origin;
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

class FaceBoundaryBuilder {
 public:
  FaceBoundaryBuilder(const FaceLoops& loops, const FacePlane& plane, const SizeField& field,
                      const DividedLines& lines)
      : loops_(&loops), plane_(&plane), field_(&field), lines_(&lines) {}

  PatchBoundary run() {
    for (std::size_t loop = 0; loop < loops_->loops().size(); ++loop) place(loop);
    // The outer loop comes first. A loop between two poles may have one node twice and no area of its own.
    const auto outer = std::ranges::max_element(
        placed_, {}, [](const PlacedLoop& loop) { return std::fabs(loop.twiceArea); });
    std::rotate(placed_.begin(), outer, outer + 1);
    for (std::size_t loop = 0; loop < placed_.size(); ++loop) append(loop);
    joinTouchingLoops();
    addCarriers();
    boundary_.mesh.boundaryCount = static_cast<std::uint32_t>(boundary_.mesh.plane.size());
    return std::move(boundary_);
  }

 private:
  void place(std::size_t loop) {
    PlacedLoop placed;
    const std::vector<const Coedge*>& coedges = loops_->loops()[loop];
    for (std::size_t index = 0; index < coedges.size(); ++index) {
      placed.edgeStarts.push_back(placed.nodes.size());
      placeEdge(loop, index, placed.nodes);
    }
    placed.twiceArea = twiceAreaOf(placed.nodes);
    placed_.push_back(std::move(placed));
  }

  /// Adds the nodes of a coedge except the last one, with which the next coedge begins.
  void placeEdge(std::size_t loop, std::size_t index, std::vector<LoopNode>& nodes) {
    const Coedge& coedge = *loops_->loops()[loop][index];
    const LineDivision& division = lines_->divisions[coedge.edge];
    const auto count = static_cast<std::uint32_t>(division.sideCount());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t at = coedge.reversed ? count - i : i;
      const Vec3& position = division.nodes[at];
      const Vec2 uv = loops_->parametersAt(loop, index, division.parameters[at], position);
      nodes.push_back({plane_->toPlane(uv),
                       position,
                       lines_->nodes[coedge.edge][at],
                       {LineId(coedge.edge), coedge.reversed ? at - 1 : at}});
    }
  }

  void append(std::size_t loop) {
    const PlacedLoop& placed = placed_[loop];
    PlanarMesh& mesh = boundary_.mesh;
    const std::size_t first = mesh.plane.size();
    const std::size_t count = placed.nodes.size();
    const bool isKept = (placed.twiceArea > 0.0) == (loop == 0);
    boundary_.loops.push_back(static_cast<std::uint32_t>(boundary_.origins.size()));
    for (std::size_t i = 0; i < count; ++i) {
      const LoopNode& node = placed.nodes[i];
      mesh.addNode(node.plane, node.position, field_->sizeAt(node.position, hint_));
      mesh.surfaceNodes.back() = node.node;
      const PlanarNodeId from(first + i);
      const PlanarNodeId to(first + (i + 1) % count);
      mesh.sides.push_back(isKept ? PlanarMesh::Side{from, to} : PlanarMesh::Side{to, from});
      boundary_.origins.push_back(node.origin);
    }
  }

  /// Finds the nodes at which loops touch each other, and gives the sides of the later loop the node of the earlier one.
  void joinTouchingLoops() {
    PlanarMesh& mesh = boundary_.mesh;
    std::vector<std::pair<NodeId, std::size_t>> occurrences;
    for (std::size_t i = 0; i < mesh.plane.size(); ++i)
      occurrences.emplace_back(mesh.surfaceNodes[i], i);
    sortUnique(occurrences);
    joined_.resize(mesh.plane.size());
    std::iota(joined_.begin(), joined_.end(), std::size_t{0});
    for (std::size_t k = 1; k < occurrences.size(); ++k) {
      for (std::size_t before = k; before > 0; --before) {
        const auto& [node, earlier] = occurrences[before - 1];
        const std::size_t later = occurrences[k].second;
        if (node != occurrences[k].first) break;
        if (joined_[earlier] == earlier && areOne(earlier, later)) joined_[later] = earlier;
      }
    }
    for (std::uint32_t side = 0; side < mesh.sides.size(); ++side) {
      auto& [from, to] = mesh.sides[side];
      const PlanarMesh::Side given = mesh.sides[side];
      from = PlanarNodeId(joined_[from.index()]);
      to = PlanarNodeId(joined_[to.index()]);
      if (from != given.from || to != given.to) mesh.touchingSides.push_back(side);
    }
  }

  /// Returns true if two occurrences of a node are at one position of the plane. On a seam and at a pole they are not.
  [[nodiscard]] bool areOne(std::size_t earlier, std::size_t later) const {
    const std::vector<Vec2>& plane = boundary_.mesh.plane;
    const auto& [from, to] = boundary_.mesh.sides[later];
    const double length = glm::length(plane[to.index()] - plane[from.index()]);
    return glm::length(plane[later] - plane[earlier]) < kTouching * length;
  }

  /// Nodes of an edge that is straight in the plane get a common carrier.
  void addCarriers() {
    PlanarMesh& mesh = boundary_.mesh;
    PlaneBox region = PlaneBox::of(mesh.plane.front(), mesh.plane.front());
    for (const Vec2& node : mesh.plane) region.include(node);
    CarrierTable table(region);
    std::vector<std::size_t> nodes;
    for (std::size_t loop = 0; loop < placed_.size(); ++loop) {
      const PlacedLoop& placed = placed_[loop];
      const std::size_t first = boundary_.loops[loop];
      for (std::size_t edge = 0; edge < placed.edgeStarts.size(); ++edge) {
        const bool isLast = edge + 1 == placed.edgeStarts.size();
        const std::size_t end = isLast ? placed.nodes.size() : placed.edgeStarts[edge + 1];
        nodes.clear();
        for (std::size_t node = placed.edgeStarts[edge]; node < end; ++node)
          nodes.push_back(first + node);
        nodes.push_back(first + end % placed.nodes.size());
        if (!isStraight(nodes)) continue;
        const CarrierId carrier =
            table.findOrAdd(mesh.plane[nodes.front()], mesh.plane[nodes.back()]);
        for (const std::size_t node : nodes)
          if (mesh.carriers[joined_[node]][1].isNone()) mesh.addCarrier(joined_[node], carrier);
      }
    }
  }

  [[nodiscard]] bool isStraight(const std::vector<std::size_t>& nodes) const {
    const std::vector<Vec2>& plane = boundary_.mesh.plane;
    const Vec2 from = plane[nodes.front()];
    const Vec2 along = plane[nodes.back()] - from;
    const double squared = glm::dot(along, along);
    if (!(squared > 0.0)) return false;
    return std::ranges::all_of(nodes, [&](std::size_t node) {
      const Vec2 offset = plane[node] - from;
      return std::fabs(along.x * offset.y - along.y * offset.x) <=
             Tolerance::kCoincidence * squared;
    });
  }

  const FaceLoops* loops_;
  const FacePlane* plane_;
  const SizeField* field_;
  const DividedLines* lines_;
  std::vector<PlacedLoop> placed_;
  std::vector<std::size_t> joined_;  ///< per node: the one that its sides have
  PatchBoundary boundary_;
  FieldHint hint_;
};

}  // namespace

PatchBoundary layOutFace(const FaceLoops& loops, const FacePlane& plane, const SizeField& field,
                         const DividedLines& lines) {
  return FaceBoundaryBuilder(loops, plane, field, lines).run();
}

}  // namespace tetrafront
