#include "remesh/automatic_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "base/tolerance.h"
#include "geom/measure.h"
#include "remesh/curvature.h"
#include "remesh/mean_curvature.h"
#include "remesh/piece_cells.h"
#include "remesh/thickness.h"
#include "remesh/wedges.h"
#include "search/box_tree.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Length over which points of a feature line turn together / smallest size.
constexpr double kStraightWidth = 2.0;
/// Edge length / width of a gap between two feature lines at which triangles across the gap are
/// equilateral.
constexpr double kSizePerGap = 1.15;
/// Target size / length of a feature line or size that fits a gap, where these are below the smallest size: triangles
/// may be this much longer than the detail, and there are fewer of them.
constexpr double kSizePerShortLine = 1.5;
constexpr double kSizePerNarrowGap = 2.0;
/// Another part of the same line bounds a gap only if its distance along the line is at least this
/// many times the width of the gap.
constexpr double kArcPerGap = 3.0;
/// Edges between two positions along a narrow gap where it is measured.
constexpr double kEdgesPerGapStep = 2.0;
/// Smallest number of edges of a closed feature line.
constexpr double kEdgesPerLoop = 3.0;
/// Distance between the positions where curvature is measured / smallest size.
constexpr double kSampleWidth = 1.0;
/// First level of the cells in which thickness is measured once. The next level is used only where the thickness / width of
/// the cell is below kThicknessPerCell: rays are expensive.
constexpr std::uint32_t kThicknessLevel = 2;
constexpr double kThicknessPerCell = 1.5;
/// Size / thickness at which nearly all elements of one layer have angles above 10 degrees. Of the elements of discs and plates, 0.3 %
/// have smaller ones if the edges are 5 times as long as the thickness, 2 % at 5.5, 6 % at 6 and 16 % at 7.
constexpr double kSizePerThickness = 4.25;
/// Thickness / smallest size below which the smallest size is too large for one good layer.
constexpr double kThinPerMinSize = 0.4;
/// Distance of the positions in a thin piece / size there: between them, sizes grow by a sixth at most.
constexpr double kThinStep = 1.5;
/// Largest number of steps from the middle of a thin piece: with more, one good layer has too many triangles.
constexpr double kMaxThinSteps = 20.0;
/// Radius of the circumscribed circle / square root of the area, of an equilateral triangle.
constexpr double kCircumradius = 0.88;
/// Deviation / thickness of edges on curved thin walls, whose two sides must not come near each other.
constexpr double kDeviationPerThickness = 0.2;
/// Curvature x diagonal below which a patch is as good as flat: its sizes would exceed any body.
constexpr double kMinCurvature = 1e-6;
/// Sizes measured per unit of budget.
constexpr std::size_t kPiecesPerUnit = 8;

/// Returns a unit vector at a right angle to a unit vector.
Vec3 anyNormalTo(const Vec3& normal) {
  const Vec3 axis = std::fabs(normal.x) < 0.6 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
  return glm::normalize(glm::cross(normal, axis));
}

bool isEndOf(const FeatureLine& line, NodeId node) {
  return !line.isClosed() && (node == line.nodes().front() || node == line.nodes().back());
}

/// Returns true if the lines have a common end.
bool haveCommonEnd(const FeatureLine& a, const FeatureLine& b) {
  return !b.isClosed() && (isEndOf(a, b.nodes().front()) || isEndOf(a, b.nodes().back()));
}

class ShapeMeasure {
 public:
  ShapeMeasure(const ReferenceSurface& reference, const ShapeSizeRules& rules)
      : reference_(reference),
        rules_(rules),
        cells_(reference, kSampleWidth * rules.minSize),
        curvatureRule_{rules.anglePerEdge, rules.tolerance},
        wedges_(reference) {}

  /// A piece to measure.
  struct Sample {
    std::uint32_t piece;
    std::uint32_t level;  ///< the first one at which it is the first sample of its cell
    Curvature curvature;
  };
  /// Returns the pieces to measure. Of pieces that are very close to each other and have similar normals, only the one
  /// with the largest curvature is returned.
  Task<std::vector<Sample>> findSamples(Work& work) const;
  /// Measures a sample; all of them in their order.
  void measure(const Sample& sample);
  void measureLine(const FeatureLine& line);
  void beginGaps();
  void measureGaps(FeatureLineId id);
  [[nodiscard]] ShapeSizes take() { return std::move(sizes_); }

 private:
  struct Segment {
    FeatureLineId line;
    std::size_t first;  ///< index of its first point
  };

  void add(const Vec3& position, double size, const Vec3& axis = Vec3(0.0)) {
    if (size < rules_.maxSize) append(position, std::max(size, rules_.minSize), axis);
  }
  /// As add(), but the size may be below the smallest one.
  void addUnlimited(const Vec3& position, double size) {
    if (size < rules_.maxSize) append(position, size, Vec3(0.0));
    if (size < rules_.minSize) ++sizes_.countBelowMin;
  }
  void addThinPlace(const Sample& sample, double thickness);
  /// Returns the thickness at a piece, per layer; infinity in a wedge, where it does not ask for smaller sizes.
  [[nodiscard]] double thicknessForSize(const Sample& sample);
  void append(const Vec3& position, double size, const Vec3& axis) {
    sizes_.positions.push_back(position);
    sizes_.axes.push_back(axis);
    sizes_.sizes.push_back(size);
  }
  [[nodiscard]] double sizeForDetail(double detail, double factor, double least) const;
  struct Gap {
    double width;
    bool isAtCorner;  ///< between lines that meet
  };
  [[nodiscard]] Gap gapAt(FeatureLineId id, double arc) const;
  [[nodiscard]] bool isSameCorner(const FeatureLine& a, const FeatureLine& b, const Vec3& position,
                                  double squaredGap) const;

  const ReferenceSurface& reference_;
  ShapeSizeRules rules_;
  PieceCells cells_;
  CurvatureRule curvatureRule_;
  Wedges wedges_;
  ShapeSizes sizes_;
  std::array<bool, PieceCells::kLevels> isThin_{};  ///< the cells of the last sample
  std::vector<Segment> segments_;
  BoxTree segmentTree_;
};

Task<std::vector<ShapeMeasure::Sample>> ShapeMeasure::findSamples(Work& work) const {
  work.beginPart(0.5);
  const std::vector<Curvature> curvatures =
      co_await findMeanCurvatures(work, reference_, cells_, curvatureRule_);
  work.beginPart(1.0);
  const std::vector<ReferenceSurface::Piece>& pieces = reference_.pieces();
  std::vector<PieceCells::Slot> slots;
  slots.reserve(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Vec3& normal = reference_.normalOf(pieces[i].triangle);
    std::uint32_t facing = 0;
    for (int k = 0; k < 3; ++k) {
      // Five directions per axis.
      facing = 5 * facing + static_cast<std::uint32_t>(2.5 + 2.49 * normal[k]);
    }
    slots.push_back(cells_.slotOf(static_cast<std::uint32_t>(i), facing, curvatures[i].largest));
  }
  co_await work.yield();
  PieceCells::sort(slots);
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    // The first level at which the cell of the slot is another one than that of the slot before.
    const std::uint32_t level = i == 0 ? 0 : PieceCells::levelOfDifference(slots[i - 1], slots[i]);
    if (level == PieceCells::kLevels) continue;
    const std::uint32_t piece = slots[i].piece;
    samples.push_back({piece, level, curvatures[piece]});
  }
  co_return samples;
}

void ShapeMeasure::measure(const Sample& sample) {
  const ReferenceSurface::Piece& piece = reference_.pieces()[sample.piece];
  double size = rules_.maxSize;
  Vec3 axis(0.0);
  if (sample.curvature.largest > kMinCurvature / reference_.diagonal()) {
    size = curvatureRule_.sizeFor(sample.curvature);
    axis = bendAxisOf(reference_, piece.triangle);
  }
  const double thickness = thicknessForSize(sample);
  if (thickness < kThinPerMinSize * rules_.minSize && size > rules_.minSizeAtThinPlaces) {
    addThinPlace(sample, thickness);
    return;
  }
  if (thickness < size) axis = Vec3(0.0);
  size = std::min(size, thickness);
  add(piece.centroid, size, axis);
}

double ShapeMeasure::thicknessForSize(const Sample& sample) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const std::uint32_t first = std::max(sample.level, kThicknessLevel);
  if (!(rules_.layers > 0.0) || (first != kThicknessLevel && !isThin_[first - 1])) return kNone;
  const ReferenceSurface::Piece& piece = reference_.pieces()[sample.piece];
  const double limit = rules_.maxSize * std::max(rules_.layers, 1.0);
  const Vec3 inward = -reference_.normalOf(piece.triangle);
  const auto [distance, across] = findThickness(reference_, piece.centroid, inward, limit);
  const double perLayer = distance / rules_.layers;
  for (std::uint32_t level = first; level < PieceCells::kLevels; ++level) {
    isThin_[level] = perLayer < kThicknessPerCell * cells_.widthAt(level);
  }
  if (across.isNone()) return kNone;
  const double cosine = glm::dot(reference_.normalOf(across), inward);
  const double tangent = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / cosine;
  const bool isWedge =
      wedges_.contain({piece.centroid, distance, {piece.triangle, across}, tangent});
  return isWedge ? kNone : perLayer;
}

/// Adds sizes at which one layer has good elements, all over the piece.
void ShapeMeasure::addThinPlace(const Sample& sample, double thickness) {
  const ReferenceSurface::Piece& piece = reference_.pieces()[sample.piece];
  const double deviation = kDeviationPerThickness * thickness * rules_.layers;
  const CurvatureRule rule{rules_.anglePerEdge, std::min(rules_.tolerance, deviation)};
  double coarse = rules_.maxSize;
  if (sample.curvature.largest > kMinCurvature / reference_.diagonal()) {
    coarse = std::clamp(rule.sizeFor(sample.curvature), rules_.minSize, rules_.maxSize);
  }
  const double size =
      std::min(std::max(kSizePerThickness * thickness, rules_.minSizeAtThinPlaces), coarse);
  const Vec3& normal = reference_.normalOf(piece.triangle);
  const Vec3 u = kThinStep * size * anyNormalTo(normal);
  const Vec3 v = glm::cross(normal, u);
  const double radius = kCircumradius * std::sqrt(piece.area) / (kThinStep * size);
  const int steps = static_cast<int>(std::min(radius, kMaxThinSteps));
  for (int i = -steps; i <= steps; ++i) {
    for (int k = -steps; k <= steps; ++k) {
      if (i * i + k * k > steps * steps) continue;
      sizes_.thinPlaces.push_back({sizes_.positions.size(), coarse});
      append(piece.centroid + static_cast<double>(i) * u + static_cast<double>(k) * v, size,
             Vec3(0.0));
    }
  }
}

/// Returns the size at a line or gap that would fit triangles of size `detail`. Small details have sizes below the
/// smallest one; but those that would need less than `least` are not resolved: more needles would be the only effect.
double ShapeMeasure::sizeForDetail(double detail, double factor, double least) const {
  if (detail >= rules_.minSize) return detail;
  const double size = factor * detail;
  return size < least ? rules_.minSize : std::min(size, rules_.minSize);
}

/// Adds the sizes that follow from the curvature and the length of a line.
void ShapeMeasure::measureLine(const FeatureLine& line) {
  const LineTurns turns(line);
  // Points that are close turn together.
  std::size_t first = 1;
  for (std::size_t i = 1; i < turns.end(); ++i) {
    const bool isBent = glm::length(turns.over(i, i + 1).angles) > kStraightAngle;
    const bool areFar = turns.over(first, i + 1).length > kStraightWidth * rules_.minSize;
    if (isBent || areFar) first = i;
    const LineTurn turn = turns.over(first, i + 1);
    const double angle = glm::length(turn.angles);
    if (angle <= kStraightAngle) continue;
    const double curvature =
        meanCurvatureAlong(line, turns, i, angle / turn.length, cells_, curvatureRule_);
    add(line.points()[i], curvatureRule_.sizeFor({curvature, 0.0}), turn.angles / angle);
    first = i + 1;
  }
  const double length = line.length();
  // A line keeps at least one edge, and a closed one three, however large the sizes are.
  const double detail = std::min(rules_.detailFactor, 1.0) * length;
  const double size = line.isClosed()
                          ? std::max(detail / kEdgesPerLoop, rules_.minSize)
                          : sizeForDetail(detail, kSizePerShortLine, rules_.minSizeAtLines);
  const double step = std::max(0.25 * length, 0.5 * std::min(size, rules_.minSize));
  for (double arc = 0.0; arc <= length; arc += step) addUnlimited(line.at(arc), size);
}

void ShapeMeasure::beginGaps() {
  sizes_.countWithoutGaps = sizes_.positions.size();
  std::vector<Box> boxes;
  for (std::size_t l = 0; l < reference_.lines().size(); ++l) {
    const std::vector<Vec3>& points = reference_.lines()[l].points();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      boxes.push_back(Box::of(points[i], points[i + 1], points[i]));
      segments_.push_back({FeatureLineId(l), i});
    }
  }
  if (!boxes.empty()) segmentTree_ = BoxTree(std::span<const Box>(boxes));
}

/// Adds the sizes that follow from the distance to other feature lines of the same patch: triangles
/// across a gap must not be wider than the gap.
void ShapeMeasure::measureGaps(FeatureLineId id) {
  const FeatureLine& line = reference_.line(id);
  const double step =
      std::min(0.25 * line.length(), std::max(rules_.minSize, rules_.maxSize / 3.0));
  for (double arc = 0.5 * step; arc < line.length();) {
    const Gap gap = gapAt(id, arc);
    const double least = gap.isAtCorner ? rules_.minSize : rules_.minSizeAtGaps;
    const double size =
        sizeForDetail(rules_.detailFactor * kSizePerGap * gap.width, kSizePerNarrowGap, least);
    addUnlimited(line.at(arc), size);
    arc += size < rules_.minSize ? std::min(step, kEdgesPerGapStep * size) : step;
  }
}

ShapeMeasure::Gap ShapeMeasure::gapAt(FeatureLineId id, double arc) const {
  const FeatureLine& line = reference_.line(id);
  const Vec3 position = line.at(arc);
  double nearest = rules_.maxSize * rules_.maxSize;
  FeatureLineId across{};
  segmentTree_.visitNear(position, nearest, [&](std::uint32_t item) {
    const Segment& segment = segments_[item];
    const FeatureLine& other = reference_.line(segment.line);
    if (!sharePatch(line, other)) return;
    const Vec3& from = other.points()[segment.first];
    const Vec3 point = nearestPointOfSegment(position, from, other.points()[segment.first + 1]);
    const double square = glm::dot(point - position, point - position);
    if (square >= nearest) return;
    if (segment.line == id) {
      double along = std::fabs(other.arcs()[segment.first] + glm::length(point - from) - arc);
      if (line.isClosed()) along = std::min(along, line.length() - along);
      const double rounding = Tolerance(reference_.diagonal()).coincidence();
      if (along < kArcPerGap * std::sqrt(square) + rounding) return;
    } else if (isSameCorner(line, other, position, square)) {
      return;
    }
    nearest = square;
    across = segment.line;
  });
  const bool isAtCorner =
      !across.isNone() && across != id && haveCommonEnd(line, reference_.line(across));
  return {std::sqrt(nearest), isAtCorner};
}

/// Returns true if the lines meet at a corner near the position, or at the edge of a wedge. Such lines bound no gap; otherwise
/// sizes would fall to zero towards every corner.
bool ShapeMeasure::isSameCorner(const FeatureLine& a, const FeatureLine& b, const Vec3& position,
                                double squaredGap) const {
  if (b.isClosed()) return false;
  for (const NodeId end : {b.nodes().front(), b.nodes().back()}) {
    if (!isEndOf(a, end)) continue;
    const double distance = glm::length(position - pointOf(reference_.mesh(), end));
    const double gap = std::sqrt(squaredGap);
    if (distance < kArcPerGap * gap || wedges_.endAt(end, gap, distance)) return true;
  }
  return false;
}

}  // namespace

Task<ShapeSizes> findShapeSizes(Work& work, const ReferenceSurface& reference,
                                const ShapeSizeRules& rules) {
  ShapeMeasure measure(reference, rules);
  work.beginPart(0.3);
  const std::vector<ShapeMeasure::Sample> samples = co_await measure.findSamples(work);
  work.beginPart(0.7);
  co_await work.forEachBlock(
      samples.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) measure.measure(samples[i]);
      },
      kPiecesPerUnit);
  work.beginPart(1.0);
  co_await work.forEachBlock(reference.lines().size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      measure.measureLine(reference.lines()[i]);
    }
  });
  measure.beginGaps();
  co_await work.forEachBlock(reference.lines().size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) measure.measureGaps(FeatureLineId(i));
  });
  co_return measure.take();
}

}  // namespace tetrafront
