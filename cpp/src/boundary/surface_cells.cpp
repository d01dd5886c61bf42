#include "boundary/surface_cells.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include "base/sort.h"
#include "search/disjoint_sets.h"
#include "boundary/surface_sides.h"

namespace tetrafront {
namespace {

class CellFinder {
 public:
  CellFinder(const SurfaceMesh& mesh, const EdgeTable& edges, const BoxTree& tree,
             EnclosedBodies enclosed, BoundaryReport& report)
      : mesh_(mesh), edges_(edges), tree_(tree), enclosed_(enclosed), report_(report) {}

  SurfaceCells run() {
    cells_.partOf = connectedParts(mesh_, edges_);
    cells_.shellOf = glueSides(mesh_, edges_);
    cells_.shells = measureShells(mesh_, cells_.shellOf);
    partCount_ = *std::ranges::max_element(cells_.partOf) + 1;
    reportFlatParts();
    if (!report_.hasErrors()) findSpaces();
    reportSheets();
    if (!report_.hasErrors()) decideWhatIsFilled();
    return std::move(cells_);
  }

 private:
  [[nodiscard]] std::uint32_t partOfShell(std::size_t shell) const {
    return cells_.partOf[triangleOf(cells_.shells[shell].firstSide)];
  }

  /// Sheets aside, which enclose nothing either.
  void reportFlatParts() {
    std::vector<std::uint8_t> isReported(partCount_, 0);
    for (std::size_t s = 0; s < cells_.shells.size(); ++s) {
      const std::uint32_t side = cells_.shells[s].firstSide;
      std::uint8_t& reported = isReported[partOfShell(s)];
      if (!cells_.shells[s].isFlat || reported != 0) continue;
      if (cells_.shellOf[side] == cells_.shellOf[oppositeOf(side)]) continue;
      reported = 1;
      report_.addTriangle(DiagnosticCode::kZeroVolume, triangleOf(side));
    }
  }

  /// A shell with a positive volume bounds a space of its own. One with a negative volume looks into
  /// the smallest space around its part.
  void findSpaces() {
    const std::vector<Shell>& shells = cells_.shells;
    depth_.assign(partCount_, 0);
    std::vector<std::uint32_t> around(partCount_, SurfaceCells::kEndless);
    if (partCount_ > 1) {
      const ShellNesting nesting(mesh_, cells_.partOf, partCount_, cells_.shellOf, tree_);
      for (std::uint32_t part = 0; part < partCount_; ++part) {
        for (const std::uint32_t shell : nesting.around(part)) {
          if (shells[shell].volume <= 0.0) continue;
          ++depth_[part];
          const bool isFirst = around[part] == SurfaceCells::kEndless;
          if (isFirst || shells[shell].volume < shells[around[part]].volume) around[part] = shell;
        }
      }
    }
    cells_.cellOf.resize(shells.size());
    for (std::uint32_t s = 0; s < shells.size(); ++s) {
      cells_.cellOf[s] = shells[s].volume > 0.0 ? s : around[partOfShell(s)];
    }
  }

  void reportSheets() {
    for (std::uint32_t t = 0; t < cells_.partOf.size(); ++t) {
      const std::uint32_t back = cells_.shellOf[backOf(t)];
      const std::uint32_t front = cells_.shellOf[frontOf(t)];
      const bool isKnown = !cells_.cellOf.empty();
      if (back != front && !(isKnown && cells_.cellOf[back] == cells_.cellOf[front])) continue;
      report_.addTriangle(DiagnosticCode::kDanglingSheet, t);
    }
  }

  /// A part with walls, or one that is to be a wall all over.
  [[nodiscard]] std::vector<std::uint8_t> partsWithWalls() const {
    std::vector<std::uint8_t> hasWalls(partCount_, enclosed_ == EnclosedBodies::kRegions ? 1 : 0);
    for (std::size_t e = 0; e < edges_.edgeCount(); ++e) {
      const std::span<const std::uint32_t> halfEdges = edges_.halfEdgesOf(e);
      if (halfEdges.size() % 2 == 1) hasWalls[cells_.partOf[halfEdges[0] / 3]] = 1;
    }
    return hasWalls;
  }

  void decideWhatIsFilled() {
    const std::vector<std::uint8_t> hasWalls = partsWithWalls();
    OpposedSets sets(cells_.shells.size());
    for (std::uint32_t t = 0; t < cells_.partOf.size(); ++t) {
      if (hasWalls[cells_.partOf[t]] != 0) continue;
      sets.join(cells_.shellOf[backOf(t)], cells_.shellOf[frontOf(t)], true);
    }
    // Shells part by part, those around others first.
    std::vector<std::uint32_t> order(cells_.shells.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto rank = [&](std::uint32_t shell) {
      const std::uint32_t part = partOfShell(shell);
      return std::array{depth_[part], part, shell};
    };
    stableSort(order, [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    cells_.isFilled.assign(order.size(), 0);
    for (std::size_t i = 0, j = 0; i < order.size(); i = j) {
      while (j < order.size() && partOfShell(order[j]) == partOfShell(order[i])) ++j;
      const std::span<const std::uint32_t> ofPart(&order[i], j - i);
      const std::uint32_t outer = *std::ranges::min_element(
          ofPart, {}, [&](std::uint32_t shell) { return cells_.shells[shell].volume; });
      const std::uint32_t cell = cells_.cellOf[outer];
      const bool isFilledAround = cell != SurfaceCells::kEndless && cells_.isFilled[cell] != 0;
      for (const std::uint32_t shell : ofPart) {
        const bool isLikeOuter = sets.find(shell).isOpposite == sets.find(outer).isOpposite;
        const bool isEnclosed = cells_.cellOf[shell] == shell;
        const bool isFilled = hasWalls[partOfShell(shell)] != 0 ? isEnclosed || isFilledAround
                                                                : isFilledAround == isLikeOuter;
        cells_.isFilled[shell] = isFilled ? 1 : 0;
      }
    }
  }

  const SurfaceMesh& mesh_;
  const EdgeTable& edges_;
  const BoxTree& tree_;
  EnclosedBodies enclosed_;
  BoundaryReport& report_;
  SurfaceCells cells_;
  std::uint32_t partCount_ = 0;
  std::vector<std::uint32_t> depth_;  ///< per part: how many spaces hold it
};

}  // namespace

SurfaceCells findCells(const SurfaceMesh& mesh, const EdgeTable& edges, const BoxTree& tree,
                       EnclosedBodies enclosed, BoundaryReport& report) {
  return CellFinder(mesh, edges, tree, enclosed, report).run();
}

}  // namespace tetrafront
