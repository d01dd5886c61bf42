#include "surface/patch_boundary.h"

#include <algorithm>
#include <optional>

#include "base/sort.h"
#include "model/patch_projection.h"
#include "search/quadtree.h"
#include "surface/carrier_table.h"
#include "surface/tube_boundary.h"

namespace tetrafront {

namespace {

PlaneBox regionOf(const PlanarMesh& mesh) {
  PlaneBox region = PlaneBox::of(mesh.plane.front(), mesh.plane.front());
  for (const Vec2& node : mesh.plane) region.include(node);
  return region;
}

/// Maps one loop after the other to the plane.
class BoundaryBuilder {
 public:
  BoundaryBuilder(const ResolvedModel& model, const Patch& patch, const PatchSurface& surface,
                  const SizeField& field, const DividedLines& lines)
      : model_(&model), patch_(&patch), surface_(&surface), field_(&field), lines_(&lines) {
    if (hasCurvedHoles(patch)) projection_.emplace(surface);
  }

  void addLoop(std::size_t loop) {
    const std::size_t firstNode = boundary.mesh.plane.size();
    const std::size_t firstSide = boundary.origins.size();
    boundary.loops.push_back(static_cast<std::uint32_t>(firstSide));
    for (std::size_t i = 0; i < patch_->loops[loop].size(); ++i) addLine(loop, i);
    const std::size_t endNode = boundary.mesh.plane.size();
    for (std::size_t node = firstNode; node < endNode; ++node) {
      const std::size_t next = node + 1 == endNode ? firstNode : node + 1;
      boundary.mesh.sides.push_back({PlanarNodeId(node), PlanarNodeId(next)});
    }
    const bool isCounterClockwise = twiceArea(firstNode, endNode) > 0.0;
    if (isCounterClockwise != (loop == 0)) reverse(firstSide);
    // The orientation of the plane is that of the outer loop's lines.
    if (loop == 0) boundary.isFlipped = !isCounterClockwise;
  }

  /// Stores the carriers of all nodes, after all loops were added.
  void findCarriers() {
    CarrierTable table(regionOf(boundary.mesh));
    std::size_t firstLine = 0;
    for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop) {
      findCarriersOf(loop, firstLine, table);
      firstLine += patch_->loops[loop].size();
    }
  }

  PatchBoundary boundary;

 private:
  /// Adds the nodes of the loop's line `index` except the last one, with which the next line begins.
  void addLine(std::size_t loop, std::size_t index) {
    const OrientedLine& line = patch_->loops[loop][index];
    const LineDivision& division = lines_->divisions[line.line];
    const std::vector<NodeId>& nodes = lines_->nodes[line.line];
    const bool isBackward = line.reversed != model_->isFlipped(LineId(line.line));
    lineStarts_.push_back(boundary.mesh.plane.size());
    const auto count = static_cast<std::uint32_t>(division.sideCount());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t at = isBackward ? count - i : i;
      const double t = isBackward ? 1.0 - division.parameters[at] : division.parameters[at];
      const Vec3& position = division.nodes[at];
      const Vec2 plane = loop > 0 && projection_ ? projection_->project(position).plane
                                                 : surface_->boundaryToPlane(index, t, position);
      boundary.mesh.addNode(plane, position, field_->sizeAt(position, hint_));
      boundary.mesh.surfaceNodes.back() = nodes[at];
      boundary.origins.push_back({LineId(line.line), isBackward ? at - 1 : at});
    }
  }

  void findCarriersOf(std::size_t loop, std::size_t firstLine, CarrierTable& table) {
    const std::size_t lineCount = patch_->loops[loop].size();
    const std::size_t firstNode = lineStarts_[firstLine];
    const std::size_t endNode = firstLine + lineCount < lineStarts_.size()
                                    ? lineStarts_[firstLine + lineCount]
                                    : boundary.mesh.plane.size();
    for (std::size_t i = 0; i < lineCount; ++i) {
      if (!surface_->straightInPlane(loop, i)) continue;
      const std::size_t from = lineStarts_[firstLine + i];
      const bool isLast = i + 1 == lineCount;
      const std::size_t to = isLast ? firstNode : lineStarts_[firstLine + i + 1];
      const CarrierId carrier = table.findOrAdd(boundary.mesh.plane[from], boundary.mesh.plane[to]);
      for (std::size_t node = from; node < (isLast ? endNode : to); ++node)
        boundary.mesh.addCarrier(node, carrier);
      boundary.mesh.addCarrier(to, carrier);
    }
  }

  [[nodiscard]] double twiceArea(std::size_t firstNode, std::size_t endNode) const {
    double sum = 0.0;
    const Vec2 origin = boundary.mesh.plane[firstNode];
    for (std::size_t node = firstNode + 1; node + 1 < endNode; ++node) {
      const Vec2 a = boundary.mesh.plane[node] - origin;
      const Vec2 b = boundary.mesh.plane[node + 1] - origin;
      sum += a.x * b.y - a.y * b.x;
    }
    return sum;
  }

  void reverse(std::size_t firstSide) {
    for (std::size_t side = firstSide; side < boundary.origins.size(); ++side)
      std::swap(boundary.mesh.sides[side].from, boundary.mesh.sides[side].to);
  }

  const ResolvedModel* model_;
  const Patch* patch_;
  const PatchSurface* surface_;
  const SizeField* field_;
  const DividedLines* lines_;
  std::optional<PatchProjection> projection_;
  std::vector<std::size_t> lineStarts_;  ///< per line of all loops: its first node
  FieldHint hint_;
};

/// Returns true if two sides intersect, except at a common node.
bool sidesIntersect(const PlanarMesh& mesh, const PlanarMesh::Side& first,
                    const PlanarMesh::Side& second) {
  const auto& [a, b] = first;
  const auto& [c, d] = second;
  if (b == c && a == d) return true;
  if (b == c) return segmentsOverlap(mesh, b, a, d);
  if (a == d) return segmentsOverlap(mesh, a, b, c);
  return segmentsIntersect(mesh, a, b, c, d);
}

/// Returns the pairs of sides that intersect, one after the other.
std::vector<std::uint32_t> findIntersectingSides(const PlanarMesh& mesh) {
  Quadtree tree(regionOf(mesh));
  std::vector<std::uint32_t> intersecting;
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < mesh.sides.size(); ++i) {
    const PlanarMesh::Side& side = mesh.sides[i];
    const PlaneBox box = PlaneBox::of(mesh.planeOf(side.from), mesh.planeOf(side.to));
    near.clear();
    tree.query(box, near);
    for (const std::uint32_t other : near)
      if (sidesIntersect(mesh, mesh.sides[other], side))
        intersecting.insert(intersecting.end(), {other, i});
    tree.insert(i, box);
  }
  return intersecting;
}

/// The sides of one loop: `from` up to, but not including, `to`.
struct SideRange {
  std::uint32_t from;
  std::uint32_t to;
};

SideRange sidesOfLoop(const PatchBoundary& boundary, std::size_t loop) {
  const bool isLast = loop + 1 == boundary.loops.size();
  return {boundary.loops[loop],
          isLast ? static_cast<std::uint32_t>(boundary.origins.size()) : boundary.loops[loop + 1]};
}

/// Even-odd rule on a ray in the first direction, by exact orientations. No side of the loop may touch the node.
bool isInside(const PlanarMesh& mesh, PlanarNodeId node, const SideRange& loop) {
  const Vec2& position = mesh.planeOf(node);
  bool inside = false;
  for (std::uint32_t side = loop.from; side < loop.to; ++side) {
    const Vec2& a = mesh.planeOf(mesh.sides[side].from);
    const Vec2& b = mesh.planeOf(mesh.sides[side].to);
    const bool rises = b.y > a.y;
    if ((a.y > position.y) == (b.y > position.y)) continue;
    if ((orient2d(a, b, position) > 0) == rises) inside = !inside;
  }
  return inside;
}

/// Calls `use(hole, other)` for each hole outside the outer loop, with that loop, and for each hole inside another one.
template <class Use>
void forEachMisplacedHole(const PatchBoundary& boundary, const Use& use) {
  const auto count = static_cast<std::uint32_t>(boundary.loops.size());
  for (std::uint32_t hole = 1; hole < count; ++hole) {
    const PlanarNodeId node = boundary.mesh.sides[sidesOfLoop(boundary, hole).from].from;
    for (std::uint32_t loop = 0; loop < count; ++loop) {
      if (loop == hole) continue;
      if (isInside(boundary.mesh, node, sidesOfLoop(boundary, loop)) != (loop == 0))
        use(hole, loop);
    }
  }
}

/// Finds the sides of a flipped outer loop, of holes outside it, and of holes inside each other, together with the
/// sides of the other loop.
std::vector<std::uint32_t> findMisplacedSides(const PatchBoundary& boundary) {
  std::vector<std::uint32_t> misplaced;
  const auto add = [&](const SideRange& range) {
    for (std::uint32_t side = range.from; side < range.to; ++side) misplaced.push_back(side);
  };
  if (boundary.isFlipped) add(sidesOfLoop(boundary, 0));
  forEachMisplacedHole(boundary, [&](std::uint32_t hole, std::uint32_t loop) {
    add(sidesOfLoop(boundary, hole));
    add(sidesOfLoop(boundary, loop));
  });
  return misplaced;
}

}  // namespace

PatchBoundary layOutBoundary(const ResolvedModel& model, const Patch& patch,
                             const PatchSurface& surface, const SizeField& field,
                             const DividedLines& lines) {
  if (patch.type == PatchType::kTube) return layOutTube(model, patch, surface, field, lines);
  BoundaryBuilder builder(model, patch, surface, field, lines);
  for (std::size_t loop = 0; loop < patch.loops.size(); ++loop) builder.addLoop(loop);
  builder.findCarriers();
  builder.boundary.mesh.boundaryCount =
      static_cast<std::uint32_t>(builder.boundary.mesh.plane.size());
  return std::move(builder.boundary);
}

std::vector<std::uint32_t> findInvalidSides(const PatchBoundary& boundary) {
  std::vector<std::uint32_t> invalid = findIntersectingSides(boundary.mesh);
  if (invalid.empty()) invalid = findMisplacedSides(boundary);
  sortUnique(invalid);
  return invalid;
}

std::optional<LoopProblem> findLoopProblem(const PatchBoundary& boundary) {
  const std::vector<std::uint32_t> pairs = findIntersectingSides(boundary.mesh);
  if (!pairs.empty()) return LoopProblem{LoopProblem::Kind::kCrossing, pairs[0], pairs[1]};
  std::optional<LoopProblem> found;
  forEachMisplacedHole(boundary, [&](std::uint32_t hole, std::uint32_t loop) {
    if (found) return;
    const auto kind = loop == 0 ? LoopProblem::Kind::kHoleOutside : LoopProblem::Kind::kNestedHoles;
    found = LoopProblem{kind, hole, loop};
  });
  return found;
}

}  // namespace tetrafront
