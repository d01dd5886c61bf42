#include "boundary/region_map.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include "base/sort.h"
#include "search/disjoint_sets.h"
#include "boundary/half_faces.h"

namespace tetrafront {
namespace {

class RegionFinder {
 public:
  RegionFinder(const SurfaceMesh& mesh, const EdgeTable& edges, const BoxTree& tree,
               EnclosedBodies enclosed, BoundaryReport& report)
      : mesh_(mesh), edges_(edges), tree_(tree), enclosed_(enclosed), report_(report) {}

  RegionMap run() {
    regions_.componentOf = connectedComponents(mesh_, edges_);
    regions_.shellOf = linkHalfFaces(mesh_, edges_);
    regions_.shells = measureShells(mesh_, regions_.shellOf);
    componentCount_ = *std::ranges::max_element(regions_.componentOf) + 1;
    reportFlatComponents();
    if (!report_.hasErrors()) findOuterShells();
    reportDanglingSheets();
    if (!report_.hasErrors()) decideWhatIsMeshed();
    return std::move(regions_);
  }

 private:
  [[nodiscard]] std::uint32_t componentOfShell(std::size_t shell) const {
    return regions_.componentOf[triangleOf(regions_.shells[shell].firstHalfFace)];
  }

  /// Sheets aside, which enclose nothing either.
  void reportFlatComponents() {
    std::vector<std::uint8_t> isReported(componentCount_, 0);
    for (std::size_t s = 0; s < regions_.shells.size(); ++s) {
      const std::uint32_t side = regions_.shells[s].firstHalfFace;
      std::uint8_t& reported = isReported[componentOfShell(s)];
      if (!regions_.shells[s].isFlat || reported != 0) continue;
      if (regions_.shellOf[side] == regions_.shellOf[oppositeOf(side)]) continue;
      reported = 1;
      report_.addTriangle(DiagnosticCode::kZeroVolume, triangleOf(side));
    }
  }

  /// A shell with a positive volume bounds a space of its own. One with a negative volume looks into
  /// the smallest space around its part.
  void findOuterShells() {
    const std::vector<Shell>& shells = regions_.shells;
    depth_.assign(componentCount_, 0);
    std::vector<std::uint32_t> around(componentCount_, RegionMap::kUnbounded);
    if (componentCount_ > 1) {
      const ShellNesting nesting(mesh_, regions_.componentOf, componentCount_, regions_.shellOf,
                                 tree_);
      for (std::uint32_t part = 0; part < componentCount_; ++part) {
        for (const std::uint32_t shell : nesting.around(part)) {
          if (shells[shell].volume <= 0.0) continue;
          ++depth_[part];
          const bool isFirst = around[part] == RegionMap::kUnbounded;
          if (isFirst || shells[shell].volume < shells[around[part]].volume) around[part] = shell;
        }
      }
    }
    regions_.outerShellOf.resize(shells.size());
    for (std::uint32_t s = 0; s < shells.size(); ++s) {
      regions_.outerShellOf[s] = shells[s].volume > 0.0 ? s : around[componentOfShell(s)];
    }
  }

  void reportDanglingSheets() {
    for (std::uint32_t t = 0; t < regions_.componentOf.size(); ++t) {
      const std::uint32_t back = regions_.shellOf[backOf(t)];
      const std::uint32_t front = regions_.shellOf[frontOf(t)];
      const bool isKnown = !regions_.outerShellOf.empty();
      if (back != front &&
          !(isKnown && regions_.outerShellOf[back] == regions_.outerShellOf[front]))
        continue;
      report_.addTriangle(DiagnosticCode::kDanglingSheet, t);
    }
  }

  /// A part with walls, or one that is to be a wall all over.
  [[nodiscard]] std::vector<std::uint8_t> findComponentsWithInterfaces() const {
    std::vector<std::uint8_t> hasInterfaces(componentCount_,
                                            enclosed_ == EnclosedBodies::kRegions ? 1 : 0);
    for (std::size_t e = 0; e < edges_.edgeCount(); ++e) {
      const std::span<const std::uint32_t> halfEdges = edges_.halfEdgesOf(e);
      if (halfEdges.size() % 2 == 1) hasInterfaces[regions_.componentOf[halfEdges[0] / 3]] = 1;
    }
    return hasInterfaces;
  }

  void decideWhatIsMeshed() {
    const std::vector<std::uint8_t> hasInterfaces = findComponentsWithInterfaces();
    OpposedSets sets(regions_.shells.size());
    for (std::uint32_t t = 0; t < regions_.componentOf.size(); ++t) {
      if (hasInterfaces[regions_.componentOf[t]] != 0) continue;
      sets.join(regions_.shellOf[backOf(t)], regions_.shellOf[frontOf(t)], true);
    }
    // Shells part by part, those around others first.
    std::vector<std::uint32_t> order(regions_.shells.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto rank = [&](std::uint32_t shell) {
      const std::uint32_t part = componentOfShell(shell);
      return std::array{depth_[part], part, shell};
    };
    stableSort(order, [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    regions_.isMeshed.assign(order.size(), 0);
    for (std::size_t i = 0, j = 0; i < order.size(); i = j) {
      while (j < order.size() && componentOfShell(order[j]) == componentOfShell(order[i])) ++j;
      const std::span<const std::uint32_t> ofPart(&order[i], j - i);
      const std::uint32_t outer = *std::ranges::min_element(
          ofPart, {}, [&](std::uint32_t shell) { return regions_.shells[shell].volume; });
      const std::uint32_t cell = regions_.outerShellOf[outer];
      const bool isMeshedAround = cell != RegionMap::kUnbounded && regions_.isMeshed[cell] != 0;
      for (const std::uint32_t shell : ofPart) {
        const bool isLikeOuter = sets.find(shell).isOpposite == sets.find(outer).isOpposite;
        const bool isEnclosed = regions_.outerShellOf[shell] == shell;
        const bool isMeshed = hasInterfaces[componentOfShell(shell)] != 0
                                  ? isEnclosed || isMeshedAround
                                  : isMeshedAround == isLikeOuter;
        regions_.isMeshed[shell] = isMeshed ? 1 : 0;
      }
    }
  }

  const SurfaceMesh& mesh_;
  const EdgeTable& edges_;
  const BoxTree& tree_;
  EnclosedBodies enclosed_;
  BoundaryReport& report_;
  RegionMap regions_;
  std::uint32_t componentCount_ = 0;
  std::vector<std::uint32_t> depth_;  ///< per part: how many spaces hold it
};

}  // namespace

RegionMap findRegions(const SurfaceMesh& mesh, const EdgeTable& edges, const BoxTree& tree,
                      EnclosedBodies enclosed, BoundaryReport& report) {
  return RegionFinder(mesh, edges, tree, enclosed, report).run();
}

}  // namespace tetrafront
