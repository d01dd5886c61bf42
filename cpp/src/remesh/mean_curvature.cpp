#include "remesh/mean_curvature.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "geom/measure.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Angle in radians by which triangles in a cell bend in all from which their mean curvature counts: rounding cancels out over
/// many triangles.
constexpr double kCellAngle = 0.002;
/// Sum of the absolute bends / bend of the larger curvature above which a surface or a line bends both ways. A saddle has at most
/// 2; triangles of two tessellations of a round face that were cut along each other have 3.
constexpr double kWavyBend = 8.0;
/// Least area of the triangles in a cell / squared width of the cell.
constexpr double kCellArea = 0.1;
/// Area / squared diagonal below which the curvature of a triangle is rounding: coordinates are rounded by about 1e-16 of the
/// diagonal, so the normal of a needle as long as the diagonal and 1e-12 as wide is known to 1e-4.
constexpr double kMinArea = 1e-12;
/// Slots per unit of budget: to measure bends, and to sum them up in cells.
constexpr std::size_t kSlotsPerUnit = 8;
constexpr std::size_t kCellSlotsPerUnit = 64;

/// Curvatures of pieces by the cells that they lie in.
class CellCurvatures {
 public:
  using Slot = PieceCells::Slot;

  /// Everything must outlive this. `slots`: sorted.
  CellCurvatures(const ReferenceSurface& reference, const PieceCells& cells,
                 const CurvatureRule& rule, std::span<const Slot> slots)
      : reference_(reference),
        cells_(cells),
        rule_(rule),
        slots_(slots),
        parts_(slots.size()),
        curvatures_(reference.pieces().size()) {}

  /// Measures the bends of a range of slots; first of all.
  void measure(std::size_t first, std::size_t last);
  /// Finds the curvatures of the slots in the widest cell that begins at a slot. Returns the end of the cell.
  std::size_t findInCell(std::size_t first);
  /// Per piece.
  [[nodiscard]] std::vector<Curvature> take() { return std::move(curvatures_); }

 private:
  /// The bend of a piece.
  struct Part {
    BendTensor bend;
    double area = 0.0;
  };

  void descend(std::size_t first, std::size_t last, std::uint32_t level);
  [[nodiscard]] Curvature curvatureOf(const Slot& slot) const;

  const ReferenceSurface& reference_;
  const PieceCells& cells_;
  CurvatureRule rule_;
  std::span<const Slot> slots_;
  std::vector<Part> parts_;  ///< per slot
  std::vector<Curvature> curvatures_;
};

void CellCurvatures::measure(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const ReferenceSurface::Piece& piece = reference_.pieces()[slots_[i].piece];
    const double ofTriangle = areaOf(cornersOf(reference_.mesh(), piece.triangle));
    if (!(ofTriangle > 0.0)) continue;
    parts_[i].bend.add(BendTensor(reference_, piece.triangle, 0.0), piece.area / ofTriangle);
    parts_[i].area = piece.area;
  }
}

std::size_t CellCurvatures::findInCell(std::size_t first) {
  const std::size_t last = PieceCells::endOfCell(slots_, first, 0);
  descend(first, last, 0);
  return last;
}

void CellCurvatures::descend(std::size_t first, std::size_t last, std::uint32_t level) {
  BendTensor bend;
  double area = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    bend.add(parts_[i].bend, 1.0);
    area += parts_[i].area;
  }
  const double width = cells_.widthAt(level);
  const bool isLarge = area > kCellArea * width * width;
  const Curvature mean = isLarge ? bend.over(area) : Curvature{};
  const bool isBent = mean.largest * width > kCellAngle;
  const bool isWavy = bend.absolute() > kWavyBend * mean.largest * area;
  if (isBent && !isWavy && rule_.sizeFor(mean) >= width) {
    for (std::size_t i = first; i < last; ++i) curvatures_[slots_[i].piece] = mean;
  } else if (level + 1 < PieceCells::kLevels) {
    for (std::size_t begin = first; begin < last;) {
      const std::size_t end = PieceCells::endOfCell(slots_.first(last), begin, level + 1);
      descend(begin, end, level + 1);
      begin = end;
    }
  } else {
    for (std::size_t i = first; i < last; ++i) {
      const Curvature ofPiece = curvatureOf(slots_[i]);
      const bool isPieceBent = ofPiece.largest > 0.0;
      curvatures_[slots_[i].piece] = isPieceBent ? ofPiece : isBent ? mean : Curvature{};
    }
  }
}

/// Returns the curvature across the smooth edges of the triangle of a slot. On a cylinder the larger one is 1 / radius, even if
/// triangles are needles.
Curvature CellCurvatures::curvatureOf(const Slot& slot) const {
  const TriangleId triangle = reference_.pieces()[slot.piece].triangle;
  const double area = areaOf(cornersOf(reference_.mesh(), triangle));
  const double diagonal = reference_.diagonal();
  if (!(area > kMinArea * diagonal * diagonal)) return {};
  return BendTensor(reference_, triangle, kFlatBend).over(area);
}

}  // namespace

/// A triangle on a sphere is 4/3 times as far from it as one on a cylinder: one third of that comes from the other bend.
double CurvatureRule::sizeFor(const Curvature& curvature) const {
  const double sag = curvature.largest + std::max(0.0, curvature.other) / 3.0;
  return std::min(anglePerEdge / curvature.largest, std::sqrt(8.0 * tolerance / sag));
}

Task<std::vector<Curvature>> findMeanCurvatures(Work& work, const ReferenceSurface& reference,
                                                const PieceCells& cells,
                                                const CurvatureRule& rule) {
  std::vector<PieceCells::Slot> slots;
  const std::vector<ReferenceSurface::Piece>& pieces = reference.pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const SmoothPatchId patch = reference.patchOf(pieces[i].triangle);
    if (reference.patch(patch).isPlanar) continue;
    slots.push_back(cells.slotOf(static_cast<std::uint32_t>(i),
                                 static_cast<std::uint32_t>(patch.index()), 0.0));
  }
  co_await work.yield();
  PieceCells::sort(slots);
  CellCurvatures curvatures(reference, cells, rule, slots);
  work.beginPart(0.9);
  co_await work.forEachBlock(
      slots.size(), [&](std::size_t first, std::size_t last) { curvatures.measure(first, last); },
      kSlotsPerUnit);
  work.beginPart(1.0);
  std::size_t next = 0;
  co_await work.forEachBlock(
      slots.size(),
      [&](std::size_t, std::size_t last) {
        while (next < last) next = curvatures.findInCell(next);
      },
      kCellSlotsPerUnit);
  co_return curvatures.take();
}

double meanCurvatureAlong(const FeatureLine& line, const LineTurns& turns, std::size_t point,
                          double ofPoints, const PieceCells& cells, const CurvatureRule& rule) {
  const std::vector<double>& arcs = line.arcs();
  for (std::uint32_t level = 0; level < PieceCells::kLevels; ++level) {
    const double width = std::min(cells.widthAt(level), line.length());
    const double from = std::clamp(arcs[point] - 0.5 * width, 0.0, line.length() - width);
    const auto first = std::ranges::lower_bound(arcs, from) - arcs.begin();
    const auto last = std::ranges::upper_bound(arcs, from + width) - arcs.begin();
    const LineTurn turn = turns.over(std::max<std::size_t>(1, static_cast<std::size_t>(first)),
                                     std::min(static_cast<std::size_t>(last), turns.end()));
    const double angle = glm::length(turn.angles);
    if (angle <= kStraightAngle || turn.absolute > kWavyBend * angle) continue;
    const double curvature = angle / turn.length;
    if (rule.sizeFor({curvature, 0.0}) >= std::max(width, turn.length)) return curvature;
  }
  return ofPoints;
}

}  // namespace tetrafront
