#include "arrangement/part_shells.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "arrangement/cell_regions.h"
#include "arrangement/regions_around.h"
#include "base/sort.h"
#include "geom/measure.h"
#include "topology/disjoint_sets.h"
#include "topology/edge_table.h"
#include "topology/half_faces.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Disjoint sets whose members have integers that differ from that of the root by a known number.
class NumberedSets {
 public:
  explicit NumberedSets(std::size_t count) : sets_(count) {
    for (std::uint32_t i = 0; i < count; ++i) sets_[i].parent = i;
  }

  struct Root {
    std::uint32_t member;
    std::int64_t difference;  ///< number of the member - number of the root
  };
  [[nodiscard]] Root find(std::uint32_t x) {
    std::uint32_t root = x;
    std::int64_t sum = 0;
    while (sets_[root].parent != root) {
      sum += sets_[root].difference;
      root = sets_[root].parent;
    }
    // Path compression.
    std::int64_t rest = sum;
    while (sets_[x].parent != x) {
      const Entry old = sets_[x];
      sets_[x] = {root, rest};
      rest -= old.difference;
      x = old.parent;
    }
    return {root, sum};
  }

  /// Records that the number of `b` is that of `a` plus `step`. Returns false, without a change, if it contradicts a known one.
  bool join(std::uint32_t a, std::uint32_t b, std::int64_t step) {
    const Root ra = find(a);
    const Root rb = find(b);
    if (ra.member == rb.member) return rb.difference - ra.difference == step;
    if (ra.member < rb.member) {
      sets_[rb.member] = {ra.member, ra.difference + step - rb.difference};
    } else {
      sets_[ra.member] = {rb.member, rb.difference - step - ra.difference};
    }
    return true;
  }

 private:
  struct Entry {
    std::uint32_t parent = 0;
    std::int64_t difference = 0;
  };
  std::vector<Entry> sets_;
};

class InsideFinder {
 public:
  InsideFinder(const SurfaceMesh& mesh, const Arrangement& arrangement,
               std::span<const std::uint8_t> isInterface)
      : mesh_(mesh),
        arrangement_(arrangement),
        isInterface_(isInterface),
        isLeftOut_(arrangement.partCount(), 0) {}

  InsideBoundary run() {
    InsideBoundary found;
    linkParts();
    if (leaveOutSheets()) linkParts();
    for (std::uint32_t p = 0; p < isLeftOut_.size(); ++p) {
      const double area = areaOf(roundedCorners(p));
      found.area += area;
      if (isLeftOut_[p] != 0) found.sheetArea += area;
    }
    measureShells();
    findOuterShells();
    if (!mesh_.triangleRegions.empty()) {
      found.areRegionsInconsistent = !findShellRegions(found.shared);
      if (!found.areRegionsInconsistent) {
        found.parts = collectBetweenRegions();
        return found;
      }
    }
    findWindings();
    found.parts = collect();
    return found;
  }

 private:
  /// A shell: a connected set of half-faces.
  struct PartShell {
    double volume = 0.0;  ///< as in shell_nesting.h
    double area = 0.0;
    std::uint32_t component = kNoIndex;  ///< none if it belongs to parts that are left out
    std::int64_t winding = 0;
    bool isInside = false;
    std::uint32_t region = SurfaceMesh::kNoRegion;
  };
  struct PartComponent {
    std::uint32_t outerShell = kNoIndex;
    bool isConsistent = true;
    std::int64_t largest = 0;
    std::int64_t smallest = 0;
  };

  [[nodiscard]] std::uint32_t shellAt(HalfFaceId halfFace) const {
    return shellOf_[halfFace.index()];
  }

  /// Sorts the half-edges of an edge as sortByAngle() does, for exact points.
  void sortParts(std::vector<HalfEdgeId>& halfEdges) const {
    const CutPoints& points = arrangement_.points();
    struct Entry {
      int sector;
      HalfEdgeId halfEdge;
    };
    const auto orient = [&](HalfEdgeId a, HalfEdgeId b) {
      const HalfEdgeNodes nodes = nodesOf(arrangement_.parts(), a);
      const CutPointId apex(nodesOf(arrangement_.parts(), b).apex.value);
      const TriangleId plane = arrangement_.ownersOf(triangleOf(a).value)[0].triangle;
      const int side = points.sideOf(nodesOf(mesh_, plane), apex);
      return nodes.from < nodes.to ? side : -side;
    };
    std::vector<Entry> entries;
    for (const HalfEdgeId h : halfEdges) {
      entries.push_back({h == halfEdges[0] ? 0 : 2 - orient(halfEdges[0], h), h});
    }
    stableSort(entries, [&](const Entry& a, const Entry& b) {
      if (a.sector != b.sector) return a.sector < b.sector;
      return orient(a.halfEdge, b.halfEdge) > 0;
    });
    for (std::size_t i = 0; i < entries.size(); ++i) halfEdges[i] = entries[i].halfEdge;
  }

  void linkParts() {
    const EdgeTable edges(arrangement_.parts(), arrangement_.points().size(), isLeftOut_);
    const auto count = std::size_t{arrangement_.partCount()};
    DisjointSets halfFaces(2 * count);
    DisjointSets parts(count);
    std::vector<HalfEdgeId> around;
    const auto isUp = [&](HalfEdgeId h) {
      const HalfEdgeNodes nodes = nodesOf(arrangement_.parts(), h);
      return nodes.from < nodes.to;
    };
    for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
      const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
      around.assign(halfEdges.begin(), halfEdges.end());
      if (around.size() > 2) sortParts(around);
      for (std::size_t i = 0; i < around.size(); ++i) {
        const HalfEdgeId here = around[i];
        const HalfEdgeId next = around[(i + 1) % around.size()];
        const TriangleId a = triangleOf(here);
        const TriangleId b = triangleOf(next);
        halfFaces.join((isUp(here) ? frontOf(a) : backOf(a)).value,
                       (isUp(next) ? backOf(b) : frontOf(b)).value);
        parts.join(a.value, b.value);
      }
    }
    shellOf_ = halfFaces.numbers();
    componentOf_ = parts.numbers();
  }

  /// Leaves out parts with one shell on both sides. Returns whether there are any.
  bool leaveOutSheets() {
    bool isAny = false;
    for (std::uint32_t p = 0; p < isLeftOut_.size(); ++p) {
      if (shellAt(backOf(TriangleId(p))) != shellAt(frontOf(TriangleId(p)))) continue;
      isLeftOut_[p] = 1;
      isAny = true;
    }
    return isAny;
  }

  [[nodiscard]] std::array<Vec3, 3> roundedCorners(std::uint32_t part) const {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = arrangement_.points().rounded(CutPointId(arrangement_.parts()[3 * part + k]));
    }
    return corners;
  }

  void measureShells() {
    std::uint32_t shells = 0;
    std::uint32_t components = 0;
    for (const std::uint32_t shell : shellOf_) shells = std::max(shells, shell + 1);
    for (const std::uint32_t component : componentOf_)
      components = std::max(components, component + 1);
    shells_.assign(shells, {});
    components_.assign(components, {});
    std::vector<Vec3> origins(components, Vec3(0.0));
    std::vector<std::uint8_t> hasOrigin(components, 0);
    for (std::uint32_t p = 0; p < isLeftOut_.size(); ++p) {
      if (isLeftOut_[p] != 0) continue;
      const std::array<Vec3, 3> corners = roundedCorners(p);
      const std::uint32_t component = componentOf_[p];
      if (hasOrigin[component] == 0) origins[component] = corners[0];
      hasOrigin[component] = 1;
      const double sixVolumes =
          sixVolumesByEdges(origins[component], corners[0], corners[1], corners[2]);
      shells_[shellAt(backOf(TriangleId(p)))].volume += sixVolumes / 6.0;
      shells_[shellAt(frontOf(TriangleId(p)))].volume -= sixVolumes / 6.0;
      for (const HalfFaceId side : {backOf(TriangleId(p)), frontOf(TriangleId(p))}) {
        shells_[shellAt(side)].component = component;
        shells_[shellAt(side)].area += areaOf(corners);
      }
    }
  }

  /// Returns by how much the winding number behind the part is higher than before it.
  [[nodiscard]] std::int64_t stepOf(std::uint32_t part) const {
    std::int64_t step = 0;
    for (const PartOwner& owner : arrangement_.ownersOf(part)) {
      if (standsForTwo(owner.triangle)) continue;
      step += owner.isReversed ? -1 : 1;
    }
    return step;
  }
  [[nodiscard]] bool standsForTwo(TriangleId triangle) const {
    return !isInterface_.empty() && isInterface_[triangle.index()] != 0;
  }
  /// Returns whether triangles of both orientations coincide in the part.
  [[nodiscard]] bool isOpposed(std::uint32_t part) const {
    const std::span<const PartOwner> owners = arrangement_.ownersOf(part);
    return std::ranges::any_of(owners, [&](const PartOwner& owner) {
      return standsForTwo(owner.triangle) || owner.isReversed != owners[0].isReversed;
    });
  }

  void findOuterShells() {
    for (std::uint32_t s = 0; s < shells_.size(); ++s) {
      if (shells_[s].component == kNoIndex) continue;
      std::uint32_t& outer = components_[shells_[s].component].outerShell;
      if (outer == kNoIndex || shells_[s].volume < shells_[outer].volume) outer = s;
    }
  }

  /// Returns the outer shell of each component, and how often the regions of other components wind around it.
  [[nodiscard]] std::vector<CellRegions::Known> outerCells() const {
    const auto components = static_cast<std::uint32_t>(components_.size());
    std::vector<std::uint32_t> componentOf(countTriangles(mesh_), kNoIndex);
    std::vector<std::uint8_t> isReduced(countTriangles(mesh_), 0);
    for (std::uint32_t p = 0; p < isLeftOut_.size(); ++p) {
      for (const PartOwner& owner : arrangement_.ownersOf(p)) {
        if (isLeftOut_[p] != 0)
          isReduced[owner.triangle.index()] = 1;
        else
          componentOf[owner.triangle.index()] = componentOf_[p];
      }
    }
    for (std::size_t t = 0; t < componentOf.size(); ++t) {
      if (isReduced[t] != 0 && componentOf[t] != kNoIndex) componentOf[t] = kInPart;
    }
    std::vector<RegionWindings> around = findRegionsAround(mesh_, componentOf, components);
    std::vector<CellRegions::Known> found;
    for (std::uint32_t c = 0; c < components; ++c) {
      if (components_[c].outerShell == kNoIndex) continue;
      found.push_back({components_[c].outerShell, std::move(around[c])});
    }
    return found;
  }

  /// Gives each shell its region, and lists those with several. Returns false if the regions contradict each other.
  bool findShellRegions(std::vector<SharedCell>& shared) {
    CellRegions regions(mesh_.triangleRegions, shells_.size());
    for (std::uint32_t p = 0; p < isLeftOut_.size(); ++p) {
      if (isLeftOut_[p] != 0) continue;
      const TriangleId part(p);
      regions.addWall(shellAt(frontOf(part)), shellAt(backOf(part)), arrangement_.ownersOf(p));
    }
    if (!regions.find(outerCells())) return false;
    std::vector<std::uint32_t> sharedAt(shells_.size(), kNoIndex);
    for (std::uint32_t s = 0; s < shells_.size(); ++s) {
      PartShell& shell = shells_[s];
      const std::vector<std::uint32_t> all = regions.regionsOf(s);
      if (all.empty()) continue;
      shell.region = all[0];
      if (all.size() < 2 || components_[shell.component].outerShell == s) continue;
      std::vector<SharingRegion> sharing;
      for (const std::uint32_t region : std::span(all).subspan(1)) {
        sharing.push_back({region, regions.isWithin(all[0], region)});
      }
      sharedAt[s] = static_cast<std::uint32_t>(shared.size());
      shared.push_back(
          {all[0], std::move(sharing), shell.volume, 2.0 * shell.volume / shell.area, Vec3(0.0)});
    }
    // The first part of each is the last one that is visited.
    for (std::uint32_t p = arrangement_.partCount(); p-- > 0;) {
      if (isLeftOut_[p] != 0) continue;
      for (const HalfFaceId side : {backOf(TriangleId(p)), frontOf(TriangleId(p))}) {
        const std::uint32_t cell = sharedAt[shellAt(side)];
        if (cell != kNoIndex) shared[cell].position = centroidOf(roundedCorners(p));
      }
    }
    return true;
  }

  [[nodiscard]] std::vector<BoundaryPart> collectBetweenRegions() const {
    std::vector<BoundaryPart> found;
    for (std::uint32_t p = 0; p < isLeftOut_.size(); ++p) {
      if (isLeftOut_[p] != 0) continue;
      const std::uint32_t behind = shells_[shellAt(backOf(TriangleId(p)))].region;
      const std::uint32_t before = shells_[shellAt(frontOf(TriangleId(p)))].region;
      if (behind == before) continue;
      const bool isReversed = behind == SurfaceMesh::kNoRegion;
      const bool isInterface = !isReversed && before != SurfaceMesh::kNoRegion;
      found.push_back(boundaryPart(p, isReversed, isInterface));
      found.back().regions = isReversed ? std::array{before, behind} : std::array{behind, before};
    }
    sortByOrigin(found);
    return found;
  }

  static void sortByOrigin(std::vector<BoundaryPart>& parts) {
    stableSort(parts,
               [](const BoundaryPart& a, const BoundaryPart& b) { return a.origin < b.origin; });
  }

  void findWindings() {
    NumberedSets sets(shells_.size());
    for (std::uint32_t p = 0; p < isLeftOut_.size(); ++p) {
      if (isLeftOut_[p] != 0) continue;
      const TriangleId part(p);
      const bool isKnown = sets.join(shellAt(frontOf(part)), shellAt(backOf(part)), stepOf(p));
      if (!isKnown) components_[componentOf_[p]].isConsistent = false;
    }
    for (std::uint32_t s = 0; s < shells_.size(); ++s) {
      if (shells_[s].component == kNoIndex) continue;
      PartComponent& component = components_[shells_[s].component];
      shells_[s].winding = sets.find(s).difference - sets.find(component.outerShell).difference;
      component.largest = std::max(component.largest, shells_[s].winding);
      component.smallest = std::min(component.smallest, shells_[s].winding);
    }
    for (std::uint32_t s = 0; s < shells_.size(); ++s) {
      if (shells_[s].component == kNoIndex) continue;
      const PartComponent& component = components_[shells_[s].component];
      const std::int64_t winding = shells_[s].winding;
      if (!component.isConsistent) {
        shells_[s].isInside = s != component.outerShell;
      } else {
        shells_[s].isInside = component.largest > 0 ? winding > 0 : winding < 0;
      }
    }
  }

  /// Returns whether the part may separate two volumes that are both inside.
  [[nodiscard]] bool maySeparate(std::uint32_t part) const {
    return !components_[componentOf_[part]].isConsistent || isOpposed(part);
  }

  [[nodiscard]] std::vector<BoundaryPart> collect() const {
    // Volumes are one region if a part between them is left out.
    DisjointSets regions(shells_.size());
    for (std::uint32_t p = 0; p < isLeftOut_.size(); ++p) {
      if (isLeftOut_[p] != 0 || maySeparate(p)) continue;
      const std::uint32_t behind = shellAt(backOf(TriangleId(p)));
      const std::uint32_t before = shellAt(frontOf(TriangleId(p)));
      if (shells_[behind].isInside && shells_[before].isInside) regions.join(behind, before);
    }
    std::vector<BoundaryPart> found;
    for (std::uint32_t p = 0; p < isLeftOut_.size(); ++p) {
      if (isLeftOut_[p] != 0) continue;
      const std::uint32_t behind = shellAt(backOf(TriangleId(p)));
      const std::uint32_t before = shellAt(frontOf(TriangleId(p)));
      const bool isBoundary = shells_[behind].isInside != shells_[before].isInside;
      const bool isInterface = shells_[behind].isInside && shells_[before].isInside &&
                               regions.find(behind) != regions.find(before);
      if (!isBoundary && !isInterface) continue;
      found.push_back(boundaryPart(p, isBoundary && shells_[before].isInside, isInterface));
    }
    sortByOrigin(found);
    return found;
  }

  [[nodiscard]] BoundaryPart boundaryPart(std::uint32_t part, bool isReversed,
                                          bool isInterface) const {
    const std::span<const PartOwner> owners = arrangement_.ownersOf(part);
    const auto facing = std::ranges::find(owners, isReversed, &PartOwner::isReversed);
    BoundaryPart found;
    found.origin = (facing != owners.end() ? *facing : owners[0]).triangle;
    found.isInterface = isInterface;
    for (std::size_t k = 0; k < 3; ++k) {
      found.points[k] = CutPointId(arrangement_.parts()[3 * std::size_t{part} + k]);
    }
    if (isReversed) std::swap(found.points[1], found.points[2]);
    return found;
  }

  const SurfaceMesh& mesh_;
  const Arrangement& arrangement_;
  std::span<const std::uint8_t> isInterface_;
  std::vector<std::uint8_t> isLeftOut_;     ///< per part
  std::vector<std::uint32_t> shellOf_;      ///< per half-face
  std::vector<std::uint32_t> componentOf_;  ///< per part
  std::vector<PartShell> shells_;
  std::vector<PartComponent> components_;
};

}  // namespace

InsideBoundary boundaryOfInside(const SurfaceMesh& mesh, const Arrangement& arrangement,
                                std::span<const std::uint8_t> isInterface) {
  return InsideFinder(mesh, arrangement, isInterface).run();
}

}  // namespace tetrafront
