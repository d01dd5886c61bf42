#include "model/check_fold.h"

#include <algorithm>
#include <vector>

namespace tetrafront {

namespace {

/// Cells per direction of the grid on which normals are compared.
constexpr int kFoldCells = 16;
/// Sine of 10 degrees: two lines at a smaller angle form no real corner.
constexpr double kSmoothSine = 0.17364817766693033;
/// If the normal still changes by more than 90 degrees after the parameters are halved this many
/// times, it is a fold and not a bend.
constexpr int kFoldHalvings = 24;

/// Nodes of the cells, including those on the edges of the domain.
class NormalGrid {
 public:
  NormalGrid(const UnitSurface& surface, SmoothCorners corners)
      : surface_(&surface),
        isTriangle_(surface.shape() == UnitShape::kTriangle),
        smoothCorners_(corners == SmoothCorners::kAllowed) {
    for (int j = 0; j <= kFoldCells; ++j)
      for (int i = 0; has(i, j); ++i)
        longest_ = std::max(longest_, glm::length(normalAt(unitAt(i, j))));
  }

  [[nodiscard]] double longestNormal() const { return longest_; }

  [[nodiscard]] std::optional<Vec2> findFold() const {
    for (int line = 0; line <= kFoldCells; ++line) {
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

  /// Searches one row or column for a fold between each node with a normal and the next such node.
  template <class CellAt>
  [[nodiscard]] std::optional<Vec2> findFoldAlong(int line, CellAt&& cellAt) const {
    std::optional<Vec2> before;
    for (int step = 0;; ++step) {
      const Cell cell = cellAt(line, step);
      if (!has(cell.i, cell.j)) return std::nullopt;
      const Vec2 here = unitAt(cell.i, cell.j);
      if (glm::length(normalAt(here)) < leastNormal() || isSmoothCorner(cell)) continue;
      if (before)
        if (const std::optional<Vec2> fold = foldBetween(*before, here)) return fold;
      before = here;
    }
  }

  /// Length below which a normal has no direction.
  [[nodiscard]] double leastNormal() const { return kMinNormal * longest_; }

  [[nodiscard]] bool has(int i, int j) const {
    return (isTriangle_ ? i + j : std::max(i, j)) <= kFoldCells;
  }

  /// Returns whether two lines meet there at about 180 degrees in the domain, if that is permitted.
  [[nodiscard]] bool isSmoothCorner(const Cell& cell) const {
    // The corners of a square. Three of them are a triangle's; (1, 1) is outside.
    const bool isCorner = cell.i % kFoldCells == 0 && cell.j % kFoldCells == 0;
    if (!smoothCorners_ || !isCorner) return false;
    const SurfacePoint point = surface_->evaluate(unitAt(cell.i, cell.j));
    // A triangle's lines along its third side are as parallel as the two tangents.
    return glm::length(glm::cross(point.alongXi, point.alongEta)) <
           kSmoothSine * glm::length(point.alongXi) * glm::length(point.alongEta);
  }

  [[nodiscard]] static Vec2 unitAt(int i, int j) {
    return Vec2(i, j) / static_cast<double>(kFoldCells);
  }

  [[nodiscard]] Vec3 normalAt(const Vec2& unit) const { return normalOf(*surface_, unit); }

  [[nodiscard]] std::optional<Vec2> foldBetween(const Vec2& from, const Vec2& to) const {
    return findFoldBetween(*surface_, from, to, leastNormal());
  }

  const UnitSurface* surface_;
  bool isTriangle_;
  bool smoothCorners_;
  double longest_ = 0.0;
};

}  // namespace

Vec3 normalOf(const UnitSurface& surface, const Vec2& unit) {
  const SurfacePoint point = surface.evaluate(unit);
  return glm::cross(point.alongXi, point.alongEta);
}

std::optional<Vec2> findFoldBetween(const UnitSurface& surface, Vec2 from, Vec2 to,
                                    double leastNormal) {
  Vec3 normalFrom = normalOf(surface, from);
  Vec3 normalTo = normalOf(surface, to);
  for (int halving = 0; halving < kFoldHalvings; ++halving) {
    if (glm::dot(normalFrom, normalTo) >= 0.0) return std::nullopt;
    const Vec2 middle = 0.5 * (from + to);
    const Vec3 normal = normalOf(surface, middle);
    // A bend keeps its area; a fold has none where the normal changes.
    if (glm::length(normal) < leastNormal) return middle;
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

std::optional<SurfaceDefect> findSurfaceDefect(const UnitSurface& surface, SmoothCorners corners,
                                               const Tolerance& tolerance) {
  const NormalGrid grid(surface, corners);
  if (!(grid.longestNormal() > tolerance.area())) {
    constexpr double kThird = 1.0 / 3.0;
    return SurfaceDefect{true, surface.evaluate({kThird, kThird}).position};
  }
  if (const std::optional<Vec2> fold = grid.findFold())
    return SurfaceDefect{false, surface.evaluate(*fold).position};
  return std::nullopt;
}

}  // namespace tetrafront
