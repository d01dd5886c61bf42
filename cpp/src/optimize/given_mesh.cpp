#include "optimize/given_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "base/diagnostics.h"
#include "base/ids.h"
#include "base/sort.h"
#include "boundary/boundary_report.h"
#include "boundary/self_intersection.h"
#include "boundary/shell_nesting.h"
#include "geom/measure.h"
#include "geom/predicates.h"
#include "search/box_tree.h"
#include "topology/disjoint_sets.h"
#include "topology/edge_table.h"
#include "topology/face_table.h"
#include "topology/half_faces.h"
#include "topology/mesh_access.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

/// The faces of elements and the kept triangles.
using Faces = FaceTable<ElementFace>;

/// Faces with the same nodes: of elements first, then kept triangles.
struct FaceGroup {
  std::span<const Faces::Face> owners;
  bool isKept = false;  ///< a kept triangle has the same nodes
};

/// Returns whether both elements lie on the same side of their common face.
bool onSameSide(const VolumeMesh& mesh, ElementFace one, ElementFace other) {
  const NodeTriple a = nodesOf(mesh, one);
  const NodeTriple b = nodesOf(mesh, other);
  const std::size_t shift = b[0] == a[0] ? 0 : b[1] == a[0] ? 1 : 2;
  return b[(shift + 1) % 3] == a[1];
}

Vec3 centroidOf(const VolumeMesh& mesh, ElementFace face) {
  const auto [a, b, c] = nodesOf(mesh, face);
  return (pointOf(mesh, a) + pointOf(mesh, b) + pointOf(mesh, c)) / 3.0;
}

/// Lists the faces of elements and the kept triangles, which have no owner.
Task<Faces> listAllFaces(Work& work, const VolumeMesh& mesh, std::span<const std::uint32_t> kept) {
  const std::size_t elements = countTetrahedra(mesh);
  Faces faces = co_await listFaces<ElementFace>(
      work, countNodes(mesh), elements + kept.size() / 3,
      [&mesh, kept, elements](std::size_t item, const auto& use) {
        if (item >= elements) {
          const std::size_t at = 3 * (item - elements);
          use({NodeId(kept[at]), NodeId(kept[at + 1]), NodeId(kept[at + 2])}, ElementFace());
          return;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const ElementFace face(TetId(item), k);
          use(nodesOf(mesh, face), face);
        }
      });
  co_return faces;
}

/// Calls visit(group) for the faces of elements whose lowest node is `node`.
template <class Visit>
void forEachGroup(Faces& faces, NodeId node, Visit visit) {
  faces.forEachGroup(node, [&](std::span<const Faces::Face> group) {
    // The packed value of no owner is the largest.
    const auto isKept = [](const Faces::Face& face) { return face.owner.isNone(); };
    const auto owners =
        static_cast<std::size_t>(std::ranges::find_if(group, isKept) - group.begin());
    if (owners > 0) visit(FaceGroup{group.first(owners), owners < group.size()});
  });
}

/// Counts one kind of defect and describes the first.
template <DiagnosticCode kCode>
class DefectCount {
 public:
  void add(std::vector<Entity> entities, const Vec3& position) {
    if (count_++ > 0) return;
    entities_ = std::move(entities);
    position_ = position;
  }
  void set(std::uint64_t count) { count_ = count; }
  [[nodiscard]] bool isEmpty() const { return count_ == 0; }
  void report(std::vector<Diagnostic>& out) {
    if (count_ == 0) return;
    out.push_back(diagnose<kCode>(count_).about(entities_).at(position_));
  }

 private:
  // Entities and position of the first defect.
  std::vector<Entity> entities_;
  Vec3 position_{0.0};
  std::uint64_t count_ = 0;
};

/// Does the work of prepareGivenMesh().
class GivenMeshMaker {
 public:
  GivenMeshMaker(const VolumeMesh& given, std::span<const std::uint32_t> kept)
      : mesh_(given), kept_(kept), part_(countTetrahedra(given)), isKept_(countNodes(given), 0) {}

  Task<> run(Work& work) {
    work.beginPart(0.1);
    co_await work.forEachId<TetId>(countTetrahedra(mesh_), [this](TetId tet) { orient(tet); });
    degenerate_.report(made_.diagnostics);
    if (anyError(made_.diagnostics)) co_return;
    work.beginPart(0.4);
    Faces faces = co_await listAllFaces(work, mesh_, kept_);
    work.beginPart(0.5);
    DisjointSets sets(countTetrahedra(mesh_));
    co_await work.forEachId<NodeId>(countNodes(mesh_), [&](NodeId node) {
      forEachGroup(faces, node, [&](const FaceGroup& group) { match(group, sets); });
    });
    nonManifold_.report(made_.diagnostics);
    overlapping_.report(made_.diagnostics);
    if (anyError(made_.diagnostics)) co_return;
    work.beginPart(0.8);
    co_await checkBoundary(work);
    if (anyError(made_.diagnostics)) co_return;
    work.beginPart(0.9);
    divide(sets);
    co_await work.forEachId<NodeId>(countNodes(mesh_), [&](NodeId node) {
      forEachGroup(faces, node, [this](const FaceGroup& group) { keep(group); });
    });
    for (const std::uint32_t node : kept_) isKept_[node] = 1;
    renumber();
  }

  [[nodiscard]] GivenMesh take() { return std::move(made_); }

 private:
  void orient(TetId tet) {
    const auto [a, b, c, d] = cornersOf(mesh_, tet);
    const int sign = orient3d(a, b, c, d);
    if (sign == 0) degenerate_.add({entityOf(tet)}, (a + b + c + d) / 4.0);
    if (sign >= 0) return;
    ++made_.orientedTetrahedra;
    std::swap(mesh_.tetrahedra[4 * tet.index() + 2], mesh_.tetrahedra[4 * tet.index() + 3]);
  }

  [[nodiscard]] std::uint32_t regionOf(const Faces::Face& face) const {
    return mesh_.regions[face.owner.tet().index()];
  }

  void match(const FaceGroup& group, DisjointSets& sets) {
    const ElementFace one = group.owners[0].owner;
    if (group.owners.size() > 2) {
      std::vector<Entity> elements;
      for (const Faces::Face& face : group.owners) elements.push_back(entityOf(face.owner.tet()));
      return nonManifold_.add(std::move(elements), centroidOf(mesh_, one));
    }
    if (group.owners.size() == 1) return boundary_.push_back(one);
    const ElementFace other = group.owners[1].owner;
    if (onSameSide(mesh_, one, other)) {
      return overlapping_.add({entityOf(one.tet()), entityOf(other.tet())}, centroidOf(mesh_, one));
    }
    if (regionOf(group.owners[0]) != regionOf(group.owners[1])) return;
    if (group.isKept) {
      keptInside_.emplace_back(one.tet(), other.tet());
    } else {
      sets.join(one.tet().value, other.tet().value);
    }
  }

  /// Positive elements that match at their faces overlap only if their boundary intersects itself or winds around a point
  /// more than once: each point is in as many elements as the boundary winds around it. Parts that touch at equal triangles, whose
  /// nodes are not shared, do not overlap.
  Task<> checkBoundary(Work& work) {
    std::ranges::sort(boundary_);
    SurfaceMesh surface = weldedBoundary();
    co_await work.spend(boundary_.size());
    const std::vector<TrianglePair> touching = findTouching(surface);
    std::vector<std::uint8_t> ignored(boundary_.size(), 0);
    for (const TrianglePair& pair : touching) ignored[pair[1].index()] = 1;
    work.beginPart(0.2);
    const BoxTree tree = co_await BoxTree::build(work, triangleBoxes(surface), 1);
    work.beginPart(0.7);
    BoundaryReport report(surface, BoundarySource::kGivenSurface, 1);
    co_await checkSelfIntersections(work, surface, ignored, tree, report);
    for (const Diagnostic& found : report.take()) {
      const auto elementAt = [&](std::size_t i) {
        return entityOf(boundary_[found.entities.at(i).index].tet());
      };
      overlapping_.add({elementAt(0), elementAt(1)}, found.position);
      overlapping_.set(static_cast<std::uint64_t>(found.values.at(0)));
    }
    if (overlapping_.isEmpty()) {
      for (const TrianglePair& pair : touching) ignored[pair[0].index()] = 1;
      const std::vector<std::uint8_t> isOnBoundary = findBoundaryNodes();
      removeTriangles(surface, ignored);
      co_await checkNesting(work, surface, isOnBoundary);
    }
    overlapping_.report(made_.diagnostics);
  }

  /// Removes triangles and their faces of elements.
  void removeTriangles(SurfaceMesh& surface, std::span<const std::uint8_t> isRemoved) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < boundary_.size(); ++t) {
      if (isRemoved[t] != 0) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        surface.triangles[3 * kept + k] = surface.triangles[3 * t + k];
      }
      boundary_[kept++] = boundary_[t];
    }
    surface.triangles.resize(3 * kept);
    boundary_.resize(kept);
  }

  /// Without self-intersections, components of the boundary can still be inside each other: one that bounds elements from
  /// outside must be outside all elements of the others, and one around a cavity inside them once. Parts that are joined by
  /// an edge have one component. `surface`: the boundary without the triangles at which parts touch.
  Task<> checkNesting(Work& work, const SurfaceMesh& surface,
                      std::span<const std::uint8_t> isOnBoundary) {
    work.beginPart(0.8);
    const BoxTree tree = co_await BoxTree::build(work, triangleBoxes(surface), 1);
    const EdgeTable edges(surface.triangles, countNodes(surface), {});
    co_await work.spend(countTriangles(surface));
    const std::vector<ComponentId> componentOf = connectedComponents(surface, edges);
    co_await work.spend(countTriangles(surface));
    const std::vector<BoundaryComponent> components = measureComponents(surface, componentOf);
    co_await work.spend(countTriangles(surface));
    const ShellNesting nesting(surface, componentOf, components.size(), {}, tree);
    work.beginPart(0.9);
    std::vector<ComponentId> inside;
    co_await work.forEachId<ComponentId>(components.size(), [&](ComponentId component) {
      const int allowed = components[component.index()].volume < 0.0 ? 1 : 0;
      if (nesting.windingAround(component) > allowed) inside.push_back(component);
    });
    if (inside.empty()) co_return;
    const Vec3 start = nesting.startOf(inside[0]);
    const TetId inner = boundary_[components[inside[0].index()].first.index()].tet();
    work.beginPart(1.0);
    std::vector<TetId> around;
    co_await work.forEachId<TetId>(countTetrahedra(mesh_), [&](TetId tet) {
      if (around.empty() && tet != inner && isAround(tet, start, isOnBoundary))
        around.push_back(tet);
    });
    std::vector<Entity> elements{entityOf(inner)};
    if (!around.empty()) elements.push_back(entityOf(around[0]));
    overlapping_.add(std::move(elements), start);
    overlapping_.set(inside.size());
  }

  /// A connected part of the boundary.
  struct BoundaryComponent {
    TriangleId first;
    double volume = 0.0;  ///< times 6; negative around a cavity
  };

  static std::vector<BoundaryComponent> measureComponents(
      const SurfaceMesh& surface, std::span<const ComponentId> componentOf) {
    std::vector<BoundaryComponent> components;
    for (const TriangleId t : IdRange<TriangleId>(componentOf.size())) {
      const std::size_t component = componentOf[t.index()].index();
      if (component == components.size()) components.push_back({t});
      const Vec3 origin = pointOf(surface, nodesOf(surface, components[component].first)[0]);
      const auto [a, b, c] = cornersOf(surface, t);
      components[component].volume += sixVolumesBelow(origin, a, b, c);
    }
    return components;
  }

  [[nodiscard]] std::vector<std::uint8_t> findBoundaryNodes() const {
    std::vector<std::uint8_t> isOnBoundary(countNodes(mesh_), 0);
    for (const ElementFace face : boundary_) {
      for (const NodeId node : nodesOf(mesh_, face)) isOnBoundary[node.index()] = 1;
    }
    return isOnBoundary;
  }

  /// Returns whether the element contains a position on the boundary of another part. Elements of that part that contain
  /// the position have a boundary node there.
  [[nodiscard]] bool isAround(TetId tet, const Vec3& position,
                              std::span<const std::uint8_t> isOnBoundary) const {
    return contains(tet, position) && std::ranges::none_of(nodesOf(mesh_, tet), [&](NodeId node) {
             return isOnBoundary[node.index()] != 0 && pointOf(mesh_, node) == position;
           });
  }

  [[nodiscard]] bool contains(TetId tet, const Vec3& position) const {
    const auto [a, b, c, d] = cornersOf(mesh_, tet);
    return orient3d(position, b, c, d) >= 0 && orient3d(a, position, c, d) >= 0 &&
           orient3d(a, b, position, d) >= 0 && orient3d(a, b, c, position) >= 0;
  }

  /// Returns the boundary with nodes at one position as one.
  SurfaceMesh weldedBoundary() {
    SurfaceMesh surface;
    surface.points = mesh_.points;
    surface.triangles.reserve(3 * boundary_.size());
    for (const ElementFace face : boundary_) {
      for (const NodeId node : nodesOf(mesh_, face)) surface.triangles.push_back(node.value);
    }
    std::vector<std::uint32_t> nodes = surface.triangles;
    sortUnique(nodes);
    const auto position = [&](std::uint32_t node) {
      const double* const p = &mesh_.points[3 * std::size_t{node}];
      return std::array{p[0], p[1], p[2]};
    };
    stableSort(nodes, [&](std::uint32_t a, std::uint32_t b) { return position(a) < position(b); });
    std::vector<std::uint32_t> welded(countNodes(mesh_));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const bool isSame = i > 0 && position(nodes[i]) == position(nodes[i - 1]);
      welded[nodes[i]] = isSame ? welded[nodes[i - 1]] : nodes[i];
    }
    for (std::uint32_t& node : surface.triangles) node = welded[node];
    return surface;
  }

  using TrianglePair = std::array<TriangleId, 2>;

  /// Returns the pairs of triangles that touch from opposite sides. A triangle is in at most one pair.
  static std::vector<TrianglePair> findTouching(const SurfaceMesh& surface) {
    struct Oriented {
      NodeTriple nodes;
      std::uint32_t isEven;
      TriangleId triangle;
    };
    std::vector<Oriented> all;
    all.reserve(countTriangles(surface));
    for (const TriangleId t : IdRange<TriangleId>(countTriangles(surface))) {
      const NodeTriple nodes = nodesOf(surface, t);
      const NodeTriple ascending = sorted(nodes);
      const auto lowest =
          static_cast<std::size_t>(std::ranges::find(nodes, ascending[0]) - nodes.begin());
      all.push_back({ascending, nodes[(lowest + 1) % 3] == ascending[1] ? 1U : 0U, t});
    }
    stableSort(all, [](const Oriented& a, const Oriented& b) { return a.nodes < b.nodes; });
    std::vector<TrianglePair> touching;
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (all[i].nodes != all[i - 1].nodes || all[i].isEven == all[i - 1].isEven) continue;
      if (!touching.empty() && touching.back()[1] == all[i - 1].triangle) continue;
      touching.push_back({all[i - 1].triangle, all[i].triangle});
    }
    return touching;
  }

  /// Numbers the parts. Elements on both sides of a kept triangle that separates nothing are parts of their own: the
  /// optimizer could otherwise pass around its rim.
  void divide(DisjointSets& sets) {
    const std::vector<std::uint32_t> numbers = sets.numbers();
    std::vector<std::uint8_t> isAlone(numbers.size(), 0);
    for (const auto& [one, other] : keptInside_) {
      if (numbers[one.index()] != numbers[other.index()]) continue;
      isAlone[one.index()] = 1;
      isAlone[other.index()] = 1;
    }
    std::vector<std::uint32_t> partOf(numbers.size(), kNoIndex);
    for (std::size_t t = 0; t < numbers.size(); ++t) {
      std::uint32_t& known = partOf[numbers[t]];
      const auto next = static_cast<std::uint32_t>(made_.regionOfPart.size());
      if (isAlone[t] == 0 && known == kNoIndex) known = next;
      part_[t] = isAlone[t] != 0 ? next : known;
      if (part_[t] == next) made_.regionOfPart.push_back(mesh_.regions[t]);
    }
  }

  /// Keeps the face if it bounds a part.
  void keep(const FaceGroup& group) {
    const ElementFace one = group.owners[0].owner;
    const std::uint32_t own = part_[one.tet().index()];
    const bool isBoundary = group.owners.size() == 1;
    const std::uint32_t beyond =
        isBoundary ? SurfaceMesh::kNoRegion : part_[group.owners[1].owner.tet().index()];
    if (beyond == own) return;
    for (const NodeId node : nodesOf(mesh_, one)) {
      isKept_[node.index()] = 1;
      made_.surface.triangles.push_back(node.value);
    }
    made_.surface.triangleRegions.insert(made_.surface.triangleRegions.end(), {own, beyond});
  }

  /// Puts the kept nodes first and omits unused ones.
  void renumber() {
    std::vector<std::uint8_t> isUsed = isKept_;
    for (const std::uint32_t node : mesh_.tetrahedra) isUsed[node] = 1;
    std::vector<std::uint32_t> newIndex(isUsed.size(), kNoIndex);
    for (const std::uint8_t keeps : {std::uint8_t{1}, std::uint8_t{0}}) {
      for (std::uint32_t node = 0; node < isUsed.size(); ++node) {
        if (isUsed[node] == 0 || isKept_[node] != keeps) continue;
        newIndex[node] = static_cast<std::uint32_t>(made_.nodeOrigin.size());
        made_.nodeOrigin.push_back(node);
        const auto first = mesh_.points.begin() + 3 * static_cast<std::ptrdiff_t>(node);
        made_.mesh.points.insert(made_.mesh.points.end(), first, first + 3);
      }
      if (keeps == 1) made_.keptNodes = made_.nodeOrigin.size();
    }
    for (std::uint32_t& node : mesh_.tetrahedra) node = newIndex[node];
    for (std::uint32_t& node : made_.surface.triangles) node = newIndex[node];
    made_.surface.points.assign(
        made_.mesh.points.begin(),
        made_.mesh.points.begin() + 3 * static_cast<std::ptrdiff_t>(made_.keptNodes));
    made_.surface.trianglePatch.assign(made_.surface.triangles.size() / 3, 0);
    made_.mesh.tetrahedra = std::move(mesh_.tetrahedra);
    made_.mesh.regions = std::move(part_);
  }

  VolumeMesh mesh_;
  std::span<const std::uint32_t> kept_;
  std::vector<ElementFace> boundary_;  ///< faces of one element
  std::vector<std::pair<TetId, TetId>>
      keptInside_;  ///< elements of one region beside a kept triangle
  std::vector<std::uint32_t> part_;
  std::vector<std::uint8_t> isKept_;
  DefectCount<DiagnosticCode::kDegenerateTetrahedron> degenerate_;
  DefectCount<DiagnosticCode::kNonManifoldFace> nonManifold_;
  DefectCount<DiagnosticCode::kOverlappingTetrahedra> overlapping_;
  GivenMesh made_;
};

}  // namespace

Task<GivenMesh> prepareGivenMesh(Work& work, const VolumeMesh& given,
                                 std::span<const std::uint32_t> keptTriangles) {
  GivenMeshMaker maker(given, keptTriangles);
  co_await maker.run(work);
  co_return maker.take();
}

}  // namespace tetrafront
