#include "lattice/lattice_interior.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lattice/free_space.h"
#include "lattice/island_trimmer.h"
#include "lattice/lattice_core.h"
#include "lattice/lattice_elements.h"
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
  Lattice lattice;
  LatticeNodes nodes;
  std::vector<ElementBits> bits;  ///< per node
  std::vector<NodeTriple> hull;

  [[nodiscard]] Vec3 positionOf(NodeId node) const {
    return lattice.positionOf(nodes.placeOf(node));
  }
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
  Islands islands{lattice, finder.take(), {}, {}};
  work.beginPart(0.5);
  co_await islands.nodes.sort(work);
  work.beginPart(1.0);
  IslandTrimmer trimmer(islands.nodes);
  co_await trimmer.run(work);
  islands.hull = trimmer.hull();
  islands.bits = trimmer.take();
  co_return islands;
}

std::vector<FreeSpace::Triangle> cornersOf(const Islands& islands) {
  std::vector<FreeSpace::Triangle> triangles;
  triangles.reserve(islands.hull.size());
  for (const auto& [a, b, c] : islands.hull) {
    triangles.push_back({islands.positionOf(a), islands.positionOf(b), islands.positionOf(c)});
  }
  return triangles;
}

/// Where a node of islands lies.
enum class Part : std::uint8_t { kUnused, kCore, kRim, kFixed, kHull };

/// Sorts the nodes and tetrahedra of one lattice by the part that they lie in.
class PartSort {
 public:
  explicit PartSort(Islands islands)
      : islands_(std::move(islands)), partOf_(islands_.nodes.count(), Part::kUnused) {}

  Task<> run(Work& work) {
    for (const NodeTriple& nodes : islands_.hull) {
      for (const NodeId node : nodes) partOf_[node.index()] = Part::kHull;
    }
    co_await work.forEachBlock(
        islands_.nodes.count(),
        [this](std::size_t first, std::size_t last) {
          forEachCentre(islands_.nodes, first, last,
                        [this](const CentreNodes& around) { divide(around); });
        },
        kNodesPerUnit);
    for (const NodeQuad& nodes : rim_) markRim(nodes);
    newId_.resize(partOf_.size());
  }

  /// Gives the nodes of a part ids from the number of `points` on, and appends their positions.
  void addNodes(Part part, std::vector<Vec3>& points) {
    for (const NodeId node : IdRange<NodeId>(partOf_.size())) {
      if (partOf_[node.index()] != part) continue;
      newId_[node.index()] = NodeId(points.size());
      points.push_back(islands_.positionOf(node));
    }
  }

  /// Appends the hull and the rim, once their nodes have ids.
  void addElements(LatticeInterior& interior) const {
    for (const NodeTriple& nodes : islands_.hull) interior.hull.push_back(renumbered(nodes));
    for (const NodeQuad& nodes : rim_) interior.rim.push_back(renumbered(nodes));
  }

  /// Returns the core; once, as the last call. Its nodes have ids from these on.
  [[nodiscard]] LatticeCore takeCore(std::uint32_t firstShared, std::uint32_t firstOwn) {
    CoreNodes nodes{.shared = {}, .own = {}, .firstShared = firstShared, .firstOwn = firstOwn};
    nodes.own.reserve(countOf(Part::kCore));
    std::vector<ElementBits> ofShared;
    std::vector<ElementBits> ofOwn;
    ofOwn.reserve(countOf(Part::kCore));
    for (const NodeId node : IdRange<NodeId>(partOf_.size())) {
      const Part part = partOf_[node.index()];
      if (part != Part::kFixed && part != Part::kCore) continue;
      (part == Part::kFixed ? nodes.shared : nodes.own).add(islands_.nodes.placeOf(node));
      (part == Part::kFixed ? ofShared : ofOwn).push_back(islands_.bits[node.index()]);
    }
    return {islands_.lattice, std::move(nodes), std::move(ofShared), std::move(ofOwn)};
  }

  [[nodiscard]] std::size_t countOf(Part part) const {
    return static_cast<std::size_t>(std::ranges::count(partOf_, part));
  }

 private:
  /// Nodes per unit of budget.
  static constexpr std::size_t kNodesPerUnit = 8;

  /// Moves the tetrahedra of a centre that have a node on the hull to the rim.
  void divide(const CentreNodes& around) {
    ElementBits& bits = islands_.bits[around.centre.index()];
    for (std::size_t number = 0; number < kElementsPerCentre; ++number) {
      if ((bits >> number & 1U) == 0) continue;
      const NodeQuad nodes = around.nodesOf(number);
      const bool isRim = std::ranges::any_of(
          nodes, [this](NodeId node) { return partOf_[node.index()] == Part::kHull; });
      if (isRim) {
        rim_.push_back(nodes);
        bits &= static_cast<ElementBits>(~(1U << number));
      } else {
        for (const NodeId node : nodes) partOf_[node.index()] = Part::kCore;
      }
    }
  }
  void markRim(const NodeQuad& nodes) {
    for (const NodeId node : nodes) {
      Part& part = partOf_[node.index()];
      if (part == Part::kCore) part = Part::kFixed;
      if (part == Part::kUnused) part = Part::kRim;
    }
  }
  template <class Nodes>
  [[nodiscard]] Nodes renumbered(Nodes nodes) const {
    for (NodeId& node : nodes) node = newId_[node.index()];
    return nodes;
  }

  Islands islands_;
  std::vector<Part> partOf_;   ///< per node
  std::vector<NodeQuad> rim_;  ///< of the nodes of the lattice
  std::vector<NodeId> newId_;  ///< per node outside the core
};

/// Joins the parts of all lattices.
Task<LatticeInterior> joinParts(Work& work, std::vector<PartSort> lattices) {
  LatticeInterior interior;
  const auto addNodes = [&](Part part) {
    const std::size_t before = interior.points.size();
    for (PartSort& lattice : lattices) lattice.addNodes(part, interior.points);
    return static_cast<std::uint32_t>(interior.points.size() - before);
  };
  interior.fixed = addNodes(Part::kFixed);
  interior.onHull = addNodes(Part::kHull);
  addNodes(Part::kRim);
  co_await work.yield();
  std::vector<LatticeCore> cores;
  std::uint32_t firstShared = 0;
  std::uint32_t firstOwn = interior.fixed;
  for (PartSort& lattice : lattices) {
    lattice.addElements(interior);
    co_await work.yield();
    const std::size_t shared = lattice.countOf(Part::kFixed);
    const std::size_t own = lattice.countOf(Part::kCore);
    cores.push_back(lattice.takeCore(firstShared, firstOwn));
    firstShared += static_cast<std::uint32_t>(shared);
    firstOwn += static_cast<std::uint32_t>(own);
    lattice = PartSort({Lattice(1.0, Vec3(0.0)), {}, {}, {}});
    co_await work.yield();
  }
  if (!cores.empty()) {
    interior.core = std::make_shared<LatticeCores>(std::move(cores), interior.fixed);
  }
  co_return interior;
}

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

  std::vector<PartSort> lattices;
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
    lattices.emplace_back(std::move(found));
    co_await lattices.back().run(work);
  }
  LatticeInterior interior = co_await joinParts(work, std::move(lattices));
  co_return interior;
}

}  // namespace tetrafront
