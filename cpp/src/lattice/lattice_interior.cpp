#include "lattice/lattice_interior.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/free_memory.h"
#include "lattice/free_space.h"
#include "lattice/island_trimmer.h"
#include "lattice/lattice_nodes.h"
#include "lattice/rules.h"
#include "lattice/size_survey.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// What is known of the space around the middle of a cube.
struct Surroundings {
  Vec3 middle;
  double distance;  ///< to the nearest triangle, or less
  bool isInside;
};

/// Finds the nodes of one lattice.
class NodeFinder {
 public:
  NodeFinder(const SizeSurvey& survey, const FreeSpace& space, const SizeField& field,
             std::uint32_t region, std::uint32_t sizeClass, const Lattice& lattice)
      : survey_(survey),
        space_(space),
        field_(field),
        lattice_(lattice),
        sizeClass_(sizeClass),
        hint_{.region = region} {}

  /// Adds the nodes in a cube.
  void visit(const SurveyCube& cube) {
    if (cube.firstClass > sizeClass_ || cube.lastClass < sizeClass_) return;
    const Vec3 middle = 0.5 * (cube.low + cube.high);
    const double reach = 0.5 * glm::length(cube.high - cube.low);
    // Farther than this, no triangle is too near to any node of the cube.
    const double far = reach + 2.0 * kLatticeDepth * field_.sizeAt(middle, hint_);
    const double distance = space_.distance(middle, far);
    const Surroundings around{middle, distance, distance > 0.0 && space_.isInside(middle)};
    if (distance >= reach && !around.isInside) return;
    const LatticePlace first = placeFrom(cube.low);
    const LatticePlace last = placeFrom(cube.high);
    for (std::uint32_t z = first.z; z < last.z; ++z) {
      const std::uint32_t parity = z % 2;
      for (std::uint32_t y = first.y + (first.y + parity) % 2; y < last.y; y += 2) {
        for (std::uint32_t x = first.x + (first.x + parity) % 2; x < last.x; x += 2) {
          if (isDeep(lattice_.positionOf({x, y, z}), around)) nodes_.add({x, y, z});
        }
      }
    }
  }

  [[nodiscard]] LatticeNodes take() { return std::move(nodes_); }

 private:
  [[nodiscard]] LatticePlace placeFrom(const Vec3& corner) const {
    return {lattice_.firstFrom(corner.x, 0), lattice_.firstFrom(corner.y, 1),
            lattice_.firstFrom(corner.z, 2)};
  }

  /// Returns whether the position has the size of the class, and lies inside, far enough from everything.
  [[nodiscard]] bool isDeep(const Vec3& position, const Surroundings& around) {
    const double size = field_.sizeAt(position, hint_);
    if (survey_.classes().of(size) != sizeClass_) return false;
    const double depth = kLatticeDepth * size;
    const double moved = glm::length(position - around.middle);
    if (around.distance - moved > depth) return around.isInside;
    if (space_.distance(position, depth) < depth) return false;
    return moved < around.distance ? around.isInside : space_.isInside(position);
  }

  const SizeSurvey& survey_;
  const FreeSpace& space_;
  const SizeField& field_;
  const Lattice& lattice_;
  std::uint32_t sizeClass_;
  FieldHint hint_;
  LatticeNodes nodes_;
};

/// Islands of one lattice.
struct Islands {
  std::vector<Vec3> points;
  std::vector<NodeQuad> tetrahedra;
  std::vector<NodeTriple> hull;
};

Task<Islands> makeIslands(Work& work, const SizeSurvey& survey, const FreeSpace& space,
                          const SizeField& field, std::uint32_t region, std::uint32_t sizeClass,
                          const Lattice& lattice) {
  NodeFinder finder(survey, space, field, region, sizeClass, lattice);
  work.beginPart(0.4);
  for (const SurveyCube& cube : survey.cubes()) {
    finder.visit(cube);
    co_await work.spend(4);
  }
  LatticeNodes nodes = finder.take();
  work.beginPart(0.5);
  co_await nodes.sort(work);
  work.beginPart(0.6);
  std::vector<NodeQuad> tetrahedra = co_await nodes.tetrahedra(work);
  work.beginPart(1.0);
  IslandTrimmer trimmer(nodes.count(), std::move(tetrahedra));
  co_await trimmer.run(work);
  Islands islands;
  islands.hull = trimmer.hull();
  islands.tetrahedra = trimmer.take();
  islands.points.reserve(nodes.count());
  for (const NodeId node : IdRange<NodeId>(nodes.count())) {
    islands.points.push_back(lattice.positionOf(nodes.placeOf(node)));
  }
  co_return islands;
}

/// Appends islands; their nodes get ids after those that are there.
void append(Islands& all, Islands more) {
  if (all.points.empty()) {
    all = std::move(more);
    return;
  }
  const std::size_t first = all.points.size();
  const auto shifted = [&](auto nodes) {
    for (NodeId& node : nodes) node = NodeId(node.index() + first);
    return nodes;
  };
  all.points.insert(all.points.end(), more.points.begin(), more.points.end());
  for (const NodeQuad& nodes : more.tetrahedra) all.tetrahedra.push_back(shifted(nodes));
  for (const NodeTriple& nodes : more.hull) all.hull.push_back(shifted(nodes));
}

std::vector<FreeSpace::Triangle> cornersOf(const Islands& islands) {
  std::vector<FreeSpace::Triangle> triangles;
  triangles.reserve(islands.hull.size());
  for (const auto& [a, b, c] : islands.hull) {
    triangles.push_back(
        {islands.points[a.index()], islands.points[b.index()], islands.points[c.index()]});
  }
  return triangles;
}

/// Where a node of islands lies.
enum class Part : std::uint8_t { kUnused, kCore, kRim, kFixed, kHull };

/// Sorts nodes and tetrahedra by the part that they lie in.
class PartSort {
 public:
  explicit PartSort(Islands islands)
      : islands_(std::move(islands)),
        partOf_(islands_.points.size(), Part::kUnused),
        newId_(islands_.points.size()) {}

  Task<LatticeInterior> run(Work& work) {
    for (const NodeTriple& nodes : islands_.hull) {
      for (const NodeId node : nodes) partOf_[node.index()] = Part::kHull;
    }
    co_await work.forEachId<TetId>(
        islands_.tetrahedra.size(), [this](TetId tet) { divide(islands_.tetrahedra[tet.index()]); },
        kPerUnit);
    freeMemory(islands_.tetrahedra);
    co_await work.forEachId<TetId>(
        interior_.core.size(), [this](TetId tet) { markCore(interior_.core[tet.index()]); },
        kPerUnit);
    for (const NodeQuad& nodes : interior_.rim) markRim(nodes);
    co_await work.yield();
    interior_.fixed = addNodes(Part::kFixed);
    interior_.onHull = addNodes(Part::kHull);
    interior_.inRim = addNodes(Part::kRim);
    addNodes(Part::kCore);
    co_await work.yield();
    interior_.hull = std::move(islands_.hull);
    for (NodeTriple& nodes : interior_.hull) renumber(nodes);
    for (NodeQuad& nodes : interior_.rim) renumber(nodes);
    co_await work.forEachId<TetId>(
        interior_.core.size(), [this](TetId tet) { renumber(interior_.core[tet.index()]); },
        kPerUnit);
    co_return std::move(interior_);
  }

 private:
  /// Tetrahedra per unit of budget.
  static constexpr std::size_t kPerUnit = 64;

  void divide(const NodeQuad& nodes) {
    const bool isRim = std::ranges::any_of(
        nodes, [this](NodeId node) { return partOf_[node.index()] == Part::kHull; });
    (isRim ? interior_.rim : interior_.core).push_back(nodes);
  }
  void markCore(const NodeQuad& nodes) {
    for (const NodeId node : nodes) partOf_[node.index()] = Part::kCore;
  }
  void markRim(const NodeQuad& nodes) {
    for (const NodeId node : nodes) {
      Part& part = partOf_[node.index()];
      if (part == Part::kCore) part = Part::kFixed;
      if (part == Part::kUnused) part = Part::kRim;
    }
  }
  /// Returns how many nodes there are in this part.
  std::uint32_t addNodes(Part part) {
    const std::size_t before = interior_.points.size();
    for (const NodeId node : IdRange<NodeId>(islands_.points.size())) {
      if (partOf_[node.index()] != part) continue;
      newId_[node.index()] = NodeId(interior_.points.size());
      interior_.points.push_back(islands_.points[node.index()]);
    }
    return static_cast<std::uint32_t>(interior_.points.size() - before);
  }
  template <class Nodes>
  void renumber(Nodes& nodes) const {
    for (NodeId& node : nodes) node = newId_[node.index()];
  }

  Islands islands_;
  LatticeInterior interior_;
  std::vector<Part> partOf_;   ///< per node
  std::vector<NodeId> newId_;  ///< per node
};

}  // namespace

Task<LatticeInterior> makeLatticeInterior(Work& work, const SurfaceMesh& boundary,
                                          const SizeField& field, std::uint32_t region) {
  LatticeInterior none;
  if (field.isStretched() || boundary.triangles.empty()) co_return none;
  std::vector<FreeSpace::Triangle> triangles;
  triangles.reserve(countTriangles(boundary));
  for (const TriangleId triangle : IdRange<TriangleId>(countTriangles(boundary))) {
    triangles.push_back(cornersOf(boundary, triangle));
  }
  FreeSpace space;
  work.beginPart(0.1);
  co_await space.add(work, std::move(triangles));
  const Bounds bounds = boundsOf(boundary);
  work.beginPart(0.2);
  const SizeSurvey survey = co_await SizeSurvey::make(work, bounds, space, field, region);

  Islands all;
  for (std::uint32_t sizeClass = 0; sizeClass < SizeClasses::kMost; ++sizeClass) {
    work.beginPart(0.2 + 0.8 * (sizeClass + 1) / SizeClasses::kMost);
    const double size = survey.meanSizeOf(sizeClass);
    if (size == 0.0) continue;
    const Lattice lattice(Lattice::kConstantPerSize * size, bounds.low);
    if (!lattice.reaches(bounds.high)) continue;
    Islands found = co_await makeIslands(work, survey, space, field, region, sizeClass, lattice);
    if (found.hull.empty()) continue;
    // Later islands keep away from these.
    co_await space.add(work, cornersOf(found));
    append(all, std::move(found));
  }
  PartSort sort(std::move(all));
  LatticeInterior sorted = co_await sort.run(work);
  co_return sorted;
}

}  // namespace tetrafront
