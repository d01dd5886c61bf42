#include "remesh/automatic_sizes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "base/mesh_access.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "boundary/surface_access.h"
#include "geom/measure.h"
#include "remesh/thickness.h"
#include "search/box_tree.h"

namespace tetrafront {
namespace {

/// Angle in radians below which two triangles count as coplanar.
constexpr double kFlatAngle = 0.002;
/// Angle in radians below which all angles at the edges of a triangle count as rounding. chordOf() takes the root of the rounding
/// of a cosine, about 1e-16, so its own error is about 1e-8. The limit is a hundred times that.
constexpr double kLeastAngle = 1e-6;
/// Angle at an edge / largest angle at an edge of the triangle below which the surface does not bend there.
constexpr double kFlatPerLargest = 0.1;
/// Angle in radians by which triangles in a cell bend in all from which their mean curvature counts: rounding cancels out over
/// many triangles.
constexpr double kCellAngle = 0.002;
/// Sum of the absolute bends in a cell / absolute value of their sum above which the surface bends both ways there. Triangles of two
/// tessellations of a round face that were cut along each other have 3.
constexpr double kWavyBend = 8.0;
/// Least area of these triangles / squared width of the cell.
constexpr double kCellArea = 0.1;
/// Angle in radians below which a feature line counts as straight, at a point or, where its points are closer, over
/// kStraightWidth times the smallest size.
constexpr double kStraightAngle = 0.01;
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
/// Levels of the cells in which curvature is averaged, and thickness is measured once: those of the last level are a sample wide, those of each other
/// one twice as wide as those of the next. The next level is used only where the thickness / width of the cell is below
/// this: rays are expensive.
constexpr std::uint32_t kCellLevels = 3;
constexpr double kThicknessPerCell = 1.5;
/// Area / squared diagonal below which the curvature of a triangle is rounding.
constexpr double kLeastArea = 1e-12;
/// Curvature x diagonal below which a patch is as good as flat: its sizes would exceed any body.
constexpr double kLeastCurvature = 1e-6;
/// Cosine of the largest angle between parallel bends, 2.5 degrees.
constexpr double kParallelCosine = 0.999;
/// Sizes measured per unit of budget.
constexpr std::size_t kPiecesPerUnit = 8;

double cosineBetween(const Vec3& a, const Vec3& b) {
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0.0 ? glm::dot(a, b) / lengths : 1.0;
}

/// Returns twice the sine of half the angle, which is about the angle itself if it is small.
double chordOf(double cosine) { return std::sqrt(std::max(0.0, 2.0 - 2.0 * cosine)); }

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
      : reference_(reference), rules_(rules) {}

  /// A piece to measure.
  struct Sample {
    std::uint32_t piece;
    std::uint32_t level;  ///< the first one at which it is the first sample of its cell
    double curvature;     ///< of the surface in one of its cells
  };
  /// Returns the pieces to measure. Of pieces that are very close to each other and have similar normals, only the one
  /// with the largest curvature is returned.
  [[nodiscard]] std::vector<Sample> findSamples() const;
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
  void append(const Vec3& position, double size, const Vec3& axis) {
    sizes_.positions.push_back(position);
    sizes_.axes.push_back(axis);
    sizes_.sizes.push_back(size);
  }
  [[nodiscard]] double sizeForDetail(double detail, double factor, double least) const;
  [[nodiscard]] double sizeForCurvature(double curvature) const {
    return std::min(rules_.anglePerEdge / curvature, std::sqrt(8.0 * rules_.tolerance / curvature));
  }
  /// Angles at smooth edges, in radians, times the lengths of the edges.
  struct Bend {
    double sum = 0.0;       ///< negative where the surface is hollow
    double absolute = 0.0;  ///< sum of the absolute values
  };
  [[nodiscard]] Bend bendOf(TriangleId triangle, double flatAngle) const;
  [[nodiscard]] double curvatureOf(TriangleId triangle) const;
  /// Pieces in one cell.
  struct Cluster {
    double curvature = 0.0;  ///< 0 if they are too few
    double width = 0.0;      ///< of the cell
    bool isWavy = false;     ///< whether they bend both ways
  };
  [[nodiscard]] double widthAt(std::uint32_t level) const {
    return static_cast<double>(1U << (kCellLevels - 1 - level)) * kSampleWidth * rules_.minSize;
  }
  [[nodiscard]] Cluster clusterOf(std::span<const std::uint32_t> pieces, double width) const;
  [[nodiscard]] double curvatureIn(std::span<const Cluster> clusters, double ofPiece) const;
  [[nodiscard]] Vec3 axisOf(TriangleId triangle) const;
  struct Gap {
    double width;
    bool isAtCorner;  ///< between lines that meet
  };
  [[nodiscard]] Gap gapAt(FeatureLineId id, double arc) const;
  [[nodiscard]] bool isSameCorner(const FeatureLine& a, const FeatureLine& b, const Vec3& position,
                                  double squaredGap) const;

  const ReferenceSurface& reference_;
  ShapeSizeRules rules_;
  ShapeSizes sizes_;
  std::array<bool, kCellLevels> isThin_{};  ///< the cells of the last sample
  std::vector<Segment> segments_;
  BoxTree segmentTree_;
};

/// Returns the share of a triangle in the bends at its edges: half of each. Angles up to `flatAngle` count as 0.
ShapeMeasure::Bend ShapeMeasure::bendOf(TriangleId triangle, double flatAngle) const {
  const std::array<Vec3, 3> corners = cornersOf(reference_.mesh(), triangle);
  const Vec3& normal = reference_.normalOf(triangle);
  Bend bend;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const TriangleId other = reference_.smoothNeighbour(halfEdgeOf(triangle, k));
    if (other.isNone()) continue;
    const Vec3& across = reference_.normalOf(other);
    const double angle = chordOf(glm::dot(normal, across));
    if (angle <= flatAngle) continue;
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    const double sign = glm::dot(glm::cross(normal, across), edge) < 0.0 ? -1.0 : 1.0;
    const double half = 0.5 * angle * glm::length(edge);
    bend.sum += sign * half;
    bend.absolute += half;
  }
  return bend;
}

/// Returns the curvature across the smooth edges of a triangle. On a cylinder it is 1 / radius,
/// even if the triangles are needles.
double ShapeMeasure::curvatureOf(TriangleId triangle) const {
  const double area = areaOf(cornersOf(reference_.mesh(), triangle));
  const double diagonal = reference_.diagonal();
  if (!(area > kLeastArea * diagonal * diagonal)) return 0.0;
  return std::fabs(bendOf(triangle, kFlatAngle).sum) / area;
}

/// Returns the mean curvature of the pieces in a cell of this width.
ShapeMeasure::Cluster ShapeMeasure::clusterOf(std::span<const std::uint32_t> pieces,
                                              double width) const {
  Bend bend;
  double area = 0.0;
  for (const std::uint32_t i : pieces) {
    const ReferenceSurface::Piece& piece = reference_.pieces()[i];
    if (reference_.patch(reference_.patchOf(piece.triangle)).isPlanar) continue;
    const double ofTriangle = areaOf(cornersOf(reference_.mesh(), piece.triangle));
    if (!(ofTriangle > 0.0)) continue;
    const Bend ofWhole = bendOf(piece.triangle, 0.0);
    bend.sum += ofWhole.sum * (piece.area / ofTriangle);
    bend.absolute += ofWhole.absolute * (piece.area / ofTriangle);
    area += piece.area;
  }
  if (!(area > kCellArea * width * width)) return {};
  return {std::fabs(bend.sum) / area, width, bend.absolute > kWavyBend * std::fabs(bend.sum)};
}

/// Returns the curvature of a sample: the mean of the widest cell in which an edge as long as the cell is wide may cross the
/// bends. Triangles of two tessellations that were cut along each other bend by turns more and less than the surface, or the other
/// way; those of waves and saddles bend as much one way as the other, and have no mean. `ofPiece`: curvature of the piece, which
/// counts in narrower cells, unless it bends too little to be measured alone.
double ShapeMeasure::curvatureIn(std::span<const Cluster> clusters, double ofPiece) const {
  for (const auto& [curvature, width, isWavy] : clusters) {
    const bool counts = curvature * width > kCellAngle && !isWavy;
    if (counts && sizeForCurvature(curvature) >= width) return curvature;
  }
  if (ofPiece > 0.0) return ofPiece;
  const Cluster& narrowest = clusters.back();
  return narrowest.curvature * narrowest.width > kCellAngle ? narrowest.curvature : 0.0;
}

/// Returns the direction of the smooth edges at which the surface bends, if they are parallel; otherwise zero.
Vec3 ShapeMeasure::axisOf(TriangleId triangle) const {
  const std::array<Vec3, 3> corners = cornersOf(reference_.mesh(), triangle);
  std::array<double, 3> angles{};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const TriangleId other = reference_.smoothNeighbour(halfEdgeOf(triangle, k));
    if (other.isNone()) continue;
    angles[k] = chordOf(glm::dot(reference_.normalOf(triangle), reference_.normalOf(other)));
  }
  const double largest = *std::ranges::max_element(angles);
  if (largest < kLeastAngle) return Vec3(0.0);
  const double flat = std::min(kFlatAngle, kFlatPerLargest * largest);
  Vec3 axis(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    if (angles[k] <= flat) continue;
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    const Vec3 direction = edge / glm::length(edge);
    if (axis == Vec3(0.0)) axis = direction;
    if (std::fabs(glm::dot(axis, direction)) < kParallelCosine) return Vec3(0.0);
  }
  return axis;
}

std::vector<ShapeMeasure::Sample> ShapeMeasure::findSamples() const {
  /// What a sample is chosen by, in few bytes, because sorting takes most of the time.
  struct Place {
    std::uint64_t facingAndX;  ///< direction of the normal, and coordinate of the widest cell
    std::uint64_t yAndZ;       ///< coordinates of the widest cell
    std::uint32_t inner;       ///< the smaller cells in the widest one, three bits per level
    std::uint32_t piece;
    double curvature;
  };
  constexpr std::uint32_t kInnerLevels = kCellLevels - 1;
  using Cell = std::array<std::int64_t, 3>;
  const double width = kSampleWidth * rules_.minSize;
  const auto cellOf = [&](const ReferenceSurface::Piece& piece) {
    Cell cell{};
    for (int k = 0; k < 3; ++k) {
      cell[static_cast<std::size_t>(k)] =
          static_cast<std::int64_t>(std::floor(piece.centroid[k] / width));
    }
    return cell;
  };
  const std::vector<ReferenceSurface::Piece>& pieces = reference_.pieces();
  Cell lowest;
  lowest.fill(std::numeric_limits<std::int64_t>::max());
  for (const ReferenceSurface::Piece& piece : pieces) {
    const Cell cell = cellOf(piece);
    for (std::size_t k = 0; k < 3; ++k) lowest[k] = std::min(lowest[k], cell[k] >> kInnerLevels);
  }
  std::vector<Place> places;
  places.reserve(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Cell cell = cellOf(pieces[i]);
    const Vec3& normal = reference_.normalOf(pieces[i].triangle);
    std::uint32_t facing = 0;
    std::uint32_t inner = 0;
    std::array<std::uint64_t, 3> widest{};
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      widest[axis] = static_cast<std::uint32_t>((cell[axis] >> kInnerLevels) - lowest[axis]);
      // Five directions per axis.
      facing = 5 * facing + static_cast<std::uint32_t>(2.5 + 2.49 * normal[k]);
    }
    for (std::uint32_t level = kInnerLevels; level-- > 0;) {
      for (const std::int64_t coordinate : cell) {
        inner = 2 * inner + static_cast<std::uint32_t>(coordinate >> level & 1);
      }
    }
    places.push_back({std::uint64_t{facing} << 32 | widest[0], widest[1] << 32 | widest[2], inner,
                      static_cast<std::uint32_t>(i), curvatureOf(pieces[i].triangle)});
  }
  const auto levelOfDifference = [](const Place& a, const Place& b) {
    if (a.facingAndX != b.facingAndX || a.yAndZ != b.yAndZ) return 0U;
    const auto differing = std::bit_width(a.inner ^ b.inner);
    return kCellLevels - (static_cast<std::uint32_t>(differing) + 2) / 3;
  };
  stableSort(places, [](const Place& a, const Place& b) {
    return std::tie(a.facingAndX, a.yAndZ, a.inner, b.curvature) <
           std::tie(b.facingAndX, b.yAndZ, b.inner, a.curvature);
  });
  std::vector<Sample> samples;
  std::array<Cluster, kCellLevels> clusters;
  for (std::size_t i = 0; i < places.size(); ++i) {
    // The first level at which the cell of the place is another one than that of the place before.
    const std::uint32_t level = i == 0 ? 0 : levelOfDifference(places[i - 1], places[i]);
    if (level == kCellLevels) continue;
    for (std::uint32_t k = level; k < kCellLevels; ++k) {
      std::vector<std::uint32_t> inCell;
      for (std::size_t j = i; j < places.size(); ++j) {
        if (levelOfDifference(places[i], places[j]) <= k) break;
        inCell.push_back(places[j].piece);
      }
      clusters[k] = clusterOf(inCell, widthAt(k));
    }
    samples.push_back({places[i].piece, level, curvatureIn(clusters, places[i].curvature)});
  }
  return samples;
}

void ShapeMeasure::measure(const Sample& sample) {
  const ReferenceSurface::Piece& piece = reference_.pieces()[sample.piece];
  double size = rules_.maxSize;
  Vec3 axis(0.0);
  if (!reference_.patch(reference_.patchOf(piece.triangle)).isPlanar) {
    if (sample.curvature > kLeastCurvature / reference_.diagonal()) {
      size = sizeForCurvature(sample.curvature);
      axis = axisOf(piece.triangle);
    }
  }
  if (rules_.layers > 0.0 && (sample.level == 0 || isThin_[sample.level - 1])) {
    const double limit = rules_.maxSize * std::max(rules_.layers, 1.0);
    const Vec3 inward = -reference_.normalOf(piece.triangle);
    const double ofThickness =
        findThickness(reference_, piece.centroid, inward, limit) / rules_.layers;
    for (std::uint32_t level = sample.level; level < kCellLevels; ++level) {
      isThin_[level] = ofThickness < kThicknessPerCell * widthAt(level);
    }
    if (ofThickness < size) axis = Vec3(0.0);
    size = std::min(size, ofThickness);
  }
  add(piece.centroid, size, axis);
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
  const std::vector<Vec3>& points = line.points();
  const std::size_t last = points.size() - 1;
  // Over points that are close: about the sum of the angles, as a vector normal to both edges, and the length.
  Vec3 turn(0.0);
  double turned = 0.0;
  for (std::size_t i = 1; i < points.size() - (line.isClosed() ? 0 : 1); ++i) {
    const Vec3 before = points[i] - points[i - 1];
    const Vec3 after = i < last ? points[i + 1] - points[i] : points[1] - points[0];
    const double length = 0.5 * (glm::length(before) + glm::length(after));
    const double angle = chordOf(cosineBetween(before, after));
    if (angle > kStraightAngle || turned + length > kStraightWidth * rules_.minSize) {
      turn = Vec3(0.0);
      turned = 0.0;
    }
    const Vec3 normal = glm::cross(before, after);
    if (angle > 0.0 && normal != Vec3(0.0)) turn += normal * (angle / glm::length(normal));
    turned += length;
    const double angles = glm::length(turn);
    if (angles <= kStraightAngle) continue;
    add(points[i], sizeForCurvature(angles / turned), turn / angles);
    turn = Vec3(0.0);
    turned = 0.0;
  }
  const double length = line.length();
  const double size = line.isClosed()
                          ? std::max(length / kEdgesPerLoop, rules_.minSize)
                          : sizeForDetail(length, kSizePerShortLine, rules_.minSizeAtLines);
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
    const double size = sizeForDetail(kSizePerGap * gap.width, kSizePerNarrowGap, least);
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

/// Returns true if the lines meet at a corner near the position. Such lines bound no gap; otherwise
/// sizes would fall to zero towards every corner.
bool ShapeMeasure::isSameCorner(const FeatureLine& a, const FeatureLine& b, const Vec3& position,
                                double squaredGap) const {
  if (b.isClosed()) return false;
  for (const NodeId end : {b.nodes().front(), b.nodes().back()}) {
    if (!isEndOf(a, end)) continue;
    const Vec3 offset = position - pointOf(reference_.mesh(), end);
    if (glm::dot(offset, offset) < kArcPerGap * kArcPerGap * squaredGap) return true;
  }
  return false;
}

}  // namespace

Task<ShapeSizes> findShapeSizes(Work& work, const ReferenceSurface& reference,
                                const ShapeSizeRules& rules) {
  ShapeMeasure measure(reference, rules);
  const std::vector<ShapeMeasure::Sample> samples = measure.findSamples();
  co_await work.yield();
  work.beginPart(0.6);
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
