#include "model/check_fold.h"

#include <algorithm>
#include <vector>

#include "model/check_patch.h"

namespace tetrafront {

namespace {

/// Cells per direction of the grid on which normals are compared.
constexpr int kFoldCells = 16;
/// A normal shorter than this share of the longest belongs to a degenerate corner, where it
/// points anywhere.
constexpr double kLeastNormal = 1e-6;
/// A turn of the normal by more than 90 degrees that persists between parameters this many times
/// halved is a fold and not a bend.
constexpr int kFoldHalvings = 24;

/// Nodes of the cells, corners and edges of the domain included, or centres of the cells.
class NormalGrid {
 public:
  NormalGrid(const UnitSurface& surface, FoldSearch search) : surface_(&surface) {
    const bool isTriangle = surface.shape() == UnitShape::kTriangle;
    const bool upToEdges = search == FoldSearch::kUpToEdges;
    rows_ = upToEdges ? kFoldCells + 1 : kFoldCells;
    if (!upToEdges) offset_ = isTriangle ? 1.0 / 3.0 : 0.5;
    isTriangle_ = isTriangle;
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; has(i, j); ++i)
        longest_ = std::max(longest_, glm::length(normalAt(unitAt(i, j))));
  }

  [[nodiscard]] double longestNormal() const { return longest_; }

  [[nodiscard]] std::optional<Vec2> findFold() const {
    for (int line = 0; line < rows_; ++line) {
      std::optional<Vec2> fold = findFoldAlong(line, [](int row, int i) { return Cell{i, row}; });
      if (!fold) fold = findFoldAlong(line, [](int column, int j) { return Cell{column, j}; });
      if (fold) return fold;
    }
    return std::nullopt;
  }

 private:
  struct Cell {
    int i;
    int j;
  };

  /// In one row or column, between each place with a normal and the next one that has.
  template <class CellAt>
  [[nodiscard]] std::optional<Vec2> findFoldAlong(int line, CellAt&& cellAt) const {
    std::optional<Vec2> before;
    for (int step = 0;; ++step) {
      const Cell cell = cellAt(line, step);
      if (!has(cell.i, cell.j)) return std::nullopt;
      const Vec2 here = unitAt(cell.i, cell.j);
      if (glm::length(normalAt(here)) < leastNormal()) continue;
      if (before)
        if (const std::optional<Vec2> fold = foldBetween(*before, here)) return fold;
      before = here;
    }
  }

  /// Below it, a normal points anywhere.
  [[nodiscard]] double leastNormal() const { return kLeastNormal * longest_; }

  [[nodiscard]] bool has(int i, int j) const {
    return i < rows_ && j < rows_ && (!isTriangle_ || i + j < rows_);
  }

  [[nodiscard]] Vec2 unitAt(int i, int j) const {
    return {(i + offset_) / kFoldCells, (j + offset_) / kFoldCells};
  }

  [[nodiscard]] Vec3 normalAt(const Vec2& unit) const {
    const SurfacePoint point = surface_->evaluate(unit);
    return glm::cross(point.alongXi, point.alongEta);
  }

  /// Where the normal turns by more than 90 degrees between the two parameters, if it still does
  /// however near each other these are.
  [[nodiscard]] std::optional<Vec2> foldBetween(Vec2 from, Vec2 to) const {
    Vec3 normalFrom = normalAt(from);
    Vec3 normalTo = normalAt(to);
    for (int halving = 0; halving < kFoldHalvings; ++halving) {
      if (glm::dot(normalFrom, normalTo) >= 0.0) return std::nullopt;
      const Vec2 middle = 0.5 * (from + to);
      const Vec3 normal = normalAt(middle);
      // A bend keeps its area; a fold has none where it turns.
      if (glm::length(normal) < leastNormal()) return middle;
      if (glm::dot(normalFrom, normal) < 0.0) {
        to = middle;
        normalTo = normal;
      } else {
        from = middle;
        normalFrom = normal;
      }
    }
    return from;
  }

  const UnitSurface* surface_;
  bool isTriangle_ = false;
  int rows_ = 0;
  double offset_ = 0.0;
  double longest_ = 0.0;
};

}  // namespace

std::optional<SurfaceFault> findSurfaceFault(const UnitSurface& surface, FoldSearch search,
                                             double extent) {
  const NormalGrid grid(surface, search);
  if (!(grid.longestNormal() > kLeastArea * extent * extent)) {
    constexpr double kThird = 1.0 / 3.0;
    return SurfaceFault{true, surface.evaluate({kThird, kThird}).position};
  }
  if (const std::optional<Vec2> fold = grid.findFold())
    return SurfaceFault{false, surface.evaluate(*fold).position};
  return std::nullopt;
}

}  // namespace tetrafront
