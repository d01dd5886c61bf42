#include "boundary/region_map.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/diagnostics.h"
#include "base/sort.h"
#include "topology/disjoint_sets.h"

namespace tetrafront {
namespace {

/// How the triangles of a shell face.
struct Orientation {
  std::uint64_t outward = 0;
  std::uint64_t inward = 0;

  /// A few triangles may be flipped; a random orientation says nothing.
  [[nodiscard]] bool isMostlyOutward() const { return outward > kClearMajority * inward; }
  [[nodiscard]] bool isMostlyInward() const { return inward > kClearMajority * outward; }

  /// Triangles that face one way / those that face the other, from which on the orientation is clear.
  static constexpr std::uint64_t kClearMajority = 4;
};

class RegionFinder {
 public:
  RegionFinder(const SurfaceMesh& mesh, const EdgeTable& edges, const BoxTree& tree,
               const MeshedRule& rule, BoundaryReport& report)
      : mesh_(mesh),
        edges_(edges),
        tree_(tree),
        innerShells_(rule.innerShells),
        firstOriented_(rule.firstOriented),
        givenRegions_(rule.givenRegions),
        report_(report) {}

  RegionMap run() {
    map_.componentOf = connectedComponents(mesh_, edges_);
    map_.shellOf = linkHalfFaces(mesh_, edges_);
    map_.shells = measureShells(mesh_, map_.shellOf);
    componentCount_ = std::ranges::max_element(map_.componentOf)->index() + 1;
    reportDegenerateComponents();
    if (!report_.hasErrors()) findOuterShells();
    reportDanglingSheets();
    if (report_.hasErrors()) return std::move(map_);
    if (givenRegions_.empty()) {
      decideWhatIsMeshed();
    } else {
      takeGivenRegions();
    }
    return std::move(map_);
  }

 private:
  [[nodiscard]] ComponentId componentOfShell(ShellId shell) const {
    return map_.componentOf[triangleOf(map_.shells[shell.index()].firstHalfFace).index()];
  }

  /// Skips dangling sheets, which enclose nothing either and are reported as such.
  void reportDegenerateComponents() {
    std::vector<std::uint8_t> isReported(componentCount_, 0);
    for (std::size_t s = 0; s < map_.shells.size(); ++s) {
      const HalfFaceId halfFace = map_.shells[s].firstHalfFace;
      std::uint8_t& reported = isReported[componentOfShell(ShellId(s)).index()];
      if (!map_.shells[s].isDegenerate || reported != 0) continue;
      if (map_.shellOf[halfFace.index()] == map_.shellOf[oppositeOf(halfFace).index()]) continue;
      reported = 1;
      report_.addTriangle(diagnoseCounted<DiagnosticCode::kZeroVolume>(), triangleOf(halfFace));
    }
  }

  /// A shell of positive volume bounds its volume from outside. A shell of negative volume looks into the smallest
  /// volume that contains its component.
  void findOuterShells() {
    const std::vector<Shell>& shells = map_.shells;
    depth_.assign(componentCount_, 0);
    std::vector<ShellId> smallestAround(componentCount_);
    if (componentCount_ > 1) {
      const ShellNesting nesting(mesh_, map_.componentOf, componentCount_, map_.shellOf, tree_);
      for (std::size_t c = 0; c < componentCount_; ++c) {
        ShellId& smallest = smallestAround[c];
        for (const ShellId shell : nesting.shellsAround(ComponentId(c))) {
          const double volume = shells[shell.index()].volume;
          if (volume <= 0.0) continue;
          ++depth_[c];
          if (smallest.isNone() || volume < shells[smallest.index()].volume) smallest = shell;
        }
      }
    }
    map_.outerShellOf.resize(shells.size());
    for (std::size_t s = 0; s < shells.size(); ++s) {
      const ShellId shell(s);
      map_.outerShellOf[s] =
          shells[s].volume > 0.0 ? shell : smallestAround[componentOfShell(shell).index()];
    }
  }

  void reportDanglingSheets() {
    const bool isNestingKnown = !map_.outerShellOf.empty();
    for (std::uint32_t t = 0; t < map_.componentOf.size(); ++t) {
      const ShellId back = map_.shellOf[backOf(TriangleId(t)).index()];
      const ShellId front = map_.shellOf[frontOf(TriangleId(t)).index()];
      const bool isSameVolume =
          back == front ||
          (isNestingKnown && map_.outerShellOf[back.index()] == map_.outerShellOf[front.index()]);
      if (isSameVolume)
        report_.addTriangle(diagnoseCounted<DiagnosticCode::kDanglingSheet>(), TriangleId(t));
    }
  }

  /// Returns one flag per component: whether every volume that the component encloses is meshed.
  [[nodiscard]] std::vector<std::uint8_t> findComponentsWithInterfaces() const {
    std::vector<std::uint8_t> hasInterfaces(componentCount_,
                                            innerShells_ == InnerShells::kRegions ? 1 : 0);
    for (std::size_t e = 0; e < edges_.edgeCount(); ++e) {
      const std::span<const HalfEdgeId> halfEdges = edges_.halfEdgesOf(EdgeId(e));
      if (halfEdges.size() % 2 == 0) continue;
      hasInterfaces[map_.componentOf[triangleOf(halfEdges[0]).index()].index()] = 1;
    }
    return hasInterfaces;
  }

  /// Returns the shells grouped by component, the components in the order of their depth.
  [[nodiscard]] std::vector<ShellId> shellsFromOutside() const {
    std::vector<ShellId> order;
    for (std::size_t s = 0; s < map_.shells.size(); ++s) order.emplace_back(s);
    const auto rank = [&](ShellId shell) {
      const ComponentId component = componentOfShell(shell);
      return std::array{depth_[component.index()], component.value, shell.value};
    };
    stableSort(order, [&](ShellId a, ShellId b) { return rank(a) < rank(b); });
    return order;
  }

  void decideWhatIsMeshed() {
    const std::vector<std::uint8_t> hasInterfaces = findComponentsWithInterfaces();
    // In a component without interfaces, exactly one side of each triangle is meshed, unless it bounds a body in a body.
    OpposedSets sets(map_.shells.size());
    for (std::uint32_t t = 0; t < map_.componentOf.size(); ++t) {
      if (hasInterfaces[map_.componentOf[t].index()] != 0) continue;
      sets.join(map_.shellOf[backOf(TriangleId(t)).index()].value,
                map_.shellOf[frontOf(TriangleId(t)).index()].value, true);
    }
    const bool usesOrientation = innerShells_ == InnerShells::kByOrientation;
    if (usesOrientation) findOrientations();
    const std::vector<ShellId> order = shellsFromOutside();
    map_.isMeshed.assign(order.size(), 0);
    map_.isBody.assign(componentCount_, 0);
    for (std::size_t i = 0, j = 0; i < order.size(); i = j) {
      const ComponentId component = componentOfShell(order[i]);
      while (j < order.size() && componentOfShell(order[j]) == component) ++j;
      const std::span<const ShellId> ofComponent(&order[i], j - i);
      const ShellId outer = *std::ranges::min_element(
          ofComponent, {}, [&](ShellId shell) { return map_.shells[shell.index()].volume; });
      const ShellId around = map_.outerShellOf[outer.index()];
      const bool isMeshedAround = !around.isNone() && map_.isMeshed[around.index()] != 0;
      const bool isBody = isMeshedAround && usesOrientation && isBodyIn(component, around);
      if (isBody) map_.isBody[component.index()] = 1;
      for (const ShellId shell : ofComponent) {
        const bool isLikeOuter =
            sets.find(shell.value).isOpposite == sets.find(outer.value).isOpposite;
        const bool isEnclosed = map_.outerShellOf[shell.index()] == shell;
        const bool isMeshed = hasInterfaces[component.index()] != 0 || isBody
                                  ? isEnclosed || isMeshedAround
                                  : isMeshedAround == isLikeOuter;
        map_.isMeshed[shell.index()] = isMeshed ? 1 : 0;
      }
    }
  }

  /// Finds how the triangles of the outer shell of each component face. Drawn ones face any way.
  void findOrientations() {
    orientations_.assign(componentCount_, {});
    for (std::uint32_t t = 0; t < map_.componentOf.size(); ++t) {
      Orientation& found = orientations_[map_.componentOf[t].index()];
      if (t < firstOriented_) continue;
      if (map_.looksOut(frontOf(TriangleId(t)))) ++found.outward;
      if (map_.looksOut(backOf(TriangleId(t)))) ++found.inward;
    }
  }

  /// Returns true if the component, which lies inside a meshed volume, faces the same way as the shell that bounds this volume
  /// from outside. A shell without a clear orientation counts as facing outward if it is outside, and as a cavity if it is inside.
  [[nodiscard]] bool isBodyIn(ComponentId component, ShellId around) const {
    const bool isInverted = orientations_[componentOfShell(around).index()].isMostlyInward();
    const Orientation& own = orientations_[component.index()];
    return isInverted ? own.isMostlyInward() : own.isMostlyOutward();
  }

  /// The first half-face of a volume decides its region. The volume outside everything must have none.
  void takeGivenRegions() {
    const std::size_t outside = map_.shells.size();
    std::vector<std::uint32_t> regionOf(outside + 1, SurfaceMesh::kNoRegion);
    std::vector<std::uint8_t> isKnown(outside + 1, 0);
    isKnown[outside] = 1;
    const auto volumeOf = [&](HalfFaceId halfFace) {
      const ShellId outer = map_.outerShellAt(halfFace);
      return outer.isNone() ? outside : outer.index();
    };
    for (std::uint32_t t = 0; t < map_.componentOf.size(); ++t) {
      bool isConsistent = false;
      for (const HalfFaceId halfFace : {backOf(TriangleId(t)), frontOf(TriangleId(t))}) {
        const std::size_t volume = volumeOf(halfFace);
        const std::uint32_t given = givenRegions_[halfFace.index()];
        if (isKnown[volume] == 0) regionOf[volume] = given;
        isKnown[volume] = 1;
        if (given != regionOf[volume]) {
          isConsistent = false;
          break;
        }
        isConsistent = isConsistent || given != SurfaceMesh::kNoRegion;
      }
      if (!isConsistent)
        report_.addTriangle(diagnoseCounted<DiagnosticCode::kInconsistentRegions>(), TriangleId(t));
    }
    map_.givenRegionOf.resize(outside);
    map_.isMeshed.resize(outside);
    for (std::size_t s = 0; s < outside; ++s) {
      const ShellId outer = map_.outerShellOf[s];
      map_.givenRegionOf[s] = regionOf[outer.isNone() ? outside : outer.index()];
      map_.isMeshed[s] = map_.givenRegionOf[s] == SurfaceMesh::kNoRegion ? 0 : 1;
    }
  }

  const SurfaceMesh& mesh_;
  const EdgeTable& edges_;
  const BoxTree& tree_;
  InnerShells innerShells_;
  std::uint32_t firstOriented_;
  std::span<const std::uint32_t> givenRegions_;
  BoundaryReport& report_;
  RegionMap map_;
  std::size_t componentCount_ = 0;
  std::vector<std::uint32_t> depth_;       ///< per component: number of volumes that contain it
  std::vector<Orientation> orientations_;  ///< per component
};

}  // namespace

RegionMap findRegions(const SurfaceMesh& mesh, const EdgeTable& edges, const BoxTree& tree,
                      const MeshedRule& rule, BoundaryReport& report) {
  return RegionFinder(mesh, edges, tree, rule, report).run();
}

}  // namespace tetrafront
