#include "quality/quality_analysis.h"

#include <algorithm>

namespace tetrafront {
namespace {

constexpr std::size_t kListed = 10;
constexpr double kNearFrom = 0.6;
constexpr double kNearTo = 1.5;
constexpr double kBinsPerRatio = static_cast<double>(kRatioBins);
constexpr double kBinsPerEdge = static_cast<double>(kEdgeBinsPerTarget);

/// Cosines of 0, 5 .. 180 degrees: bins must not depend on a library's rounding.
constexpr std::array<double, kDihedralBins + 1> kBinCosines = [] {
  constexpr std::array kQuarter{1.0,
                                0.9961946980917455,
                                0.984807753012208,
                                0.9659258262890683,
                                0.9396926207859084,
                                0.9063077870366499,
                                0.8660254037844387,
                                0.8191520442889918,
                                0.766044443118978,
                                0.7071067811865476,
                                0.6427876096865394,
                                0.5735764363510462,
                                0.5,
                                0.42261826174069944,
                                0.3420201433256688,
                                0.25881904510252074,
                                0.17364817766693041,
                                0.08715574274765814};
  std::array<double, kDihedralBins + 1> cosines{};
  for (std::size_t i = 0; i < kQuarter.size(); ++i) {
    cosines[i] = kQuarter[i];
    cosines[kDihedralBins - i] = -kQuarter[i];
  }
  return cosines;
}();

std::size_t angleBin(double cosine) {
  const auto* after = std::upper_bound(kBinCosines.begin() + 1, kBinCosines.end() - 1, cosine,
                                       [](double a, double b) { return a > b; });
  return static_cast<std::size_t>(after - kBinCosines.begin()) - 1;
}

std::size_t linearBin(double value, double binsPerUnit, std::size_t count) {
  const double bin = value * binsPerUnit;
  return bin < static_cast<double>(count) ? static_cast<std::size_t>(bin) : count - 1;
}

/// Above 1 if and only if an angle misses its target; the larger, the worse.
double badnessOf(const TetrahedronMeasures& measures) {
  constexpr double kFlat = 1e300;
  const double c = measures.largestCosine;
  const double d = measures.smallestCosine;
  if (c >= 1.0 || d <= -1.0) return kFlat;
  return std::max(kSquaredTangentOfHalf30 * (1.0 + c) / (1.0 - c),
                  kSquaredTangentOfHalf45 * (1.0 - d) / (1.0 + d));
}

/// Corners of an element's edges.
constexpr std::array<std::array<std::size_t, 2>, 6> kEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

}  // namespace

QualityAnalysis::QualityAnalysis(const VolumeMesh& mesh, const SurfaceMesh& surface,
                                 const SizeField& field)
    : mesh_(mesh),
      surface_(surface),
      field_(field),
      isStretched_(field.isStretched()),
      limits_(mesh.points) {
  const std::size_t nodes = mesh.points.size() / 3;
  if (isStretched_) {
    tensors_.resize(nodes);
  } else {
    sizes_.resize(nodes);
  }
  if (field.isLifted()) lifts_.resize(nodes);
  starts_.assign(nodes + 1, 0);
}

bool QualityAnalysis::advance(std::uint32_t budget) {
  const std::size_t nodes = mesh_.points.size() / 3;
  const std::size_t elements = mesh_.tetrahedra.size() / 4;
  const auto slice = [&](std::size_t end, Stage following, auto work) {
    const std::size_t last = next_ + std::min<std::size_t>(budget, end - next_);
    work(next_, last);
    next_ = last;
    if (next_ < end) return false;
    next_ = 0;
    stage_ = following;
    return true;
  };
  switch (stage_) {
    case Stage::kSizes:
      slice(nodes, Stage::kElements, [&](std::size_t a, std::size_t b) { askSizes(a, b); });
      break;
    case Stage::kElements:
      if (slice(elements, Stage::kPlaceEdges,
                [&](std::size_t a, std::size_t b) { measureElements(a, b); })) {
        startEdges();
      }
      break;
    case Stage::kPlaceEdges:
      slice(elements, Stage::kEdges, [&](std::size_t a, std::size_t b) { placeEdges(a, b); });
      break;
    case Stage::kEdges:
      if (slice(nodes, Stage::kBoundary,
                [&](std::size_t a, std::size_t b) { measureEdges(a, b); })) {
        startBoundary();
      }
      break;
    case Stage::kBoundary:
      if (slice(surface_.triangles.size() / 3, Stage::kLimits,
                [&](std::size_t a, std::size_t b) { findBoundaryFaces(a, b); })) {
        limits_.finish();
      }
      break;
    case Stage::kLimits:
      if (slice(missed_.size(), Stage::kDone,
                [&](std::size_t a, std::size_t b) { findLimits(a, b); })) {
        finish();
      }
      break;
    case Stage::kDone:
      break;
  }
  return stage_ == Stage::kDone;
}

Vec3 QualityAnalysis::pointOf(std::uint32_t node) const {
  const double* at = &mesh_.points[3 * std::size_t{node}];
  return {at[0], at[1], at[2]};
}

std::span<const std::uint32_t, 4> QualityAnalysis::nodesOf(std::size_t element) const {
  return std::span<const std::uint32_t, 4>(&mesh_.tetrahedra[4 * element], 4);
}

void QualityAnalysis::askSizes(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 place = pointOf(static_cast<std::uint32_t>(i));
    double size = 0.0;
    if (isStretched_) {
      const SymmetricTensor wanted = field_.wantedTensorAt(place, hint_);
      tensors_[i] = wanted.inverse();
      size = meanSizeOf(wanted);
    } else {
      size = sizes_[i] = field_.wantedSizeAt(place, hint_);
    }
    if (!lifts_.empty()) lifts_[i] = field_.liftAt(place, size);
  }
}

double QualityAnalysis::meanLift(std::span<const std::uint32_t> nodes) const {
  if (lifts_.empty()) return 1.0;
  double sum = 0.0;
  for (const std::uint32_t node : nodes) sum += lifts_[node];
  return sum / static_cast<double>(nodes.size());
}

std::array<Vec3, 4> QualityAnalysis::seenCorners(std::span<const std::uint32_t, 4> nodes) const {
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = pointOf(nodes[k]);
  if (!isStretched_) return corners;
  const ElementView view = viewOf(nodes);
  for (Vec3& corner : corners) corner = view(corner);
  return corners;
}

double QualityAnalysis::relativeLength(std::uint32_t a, std::uint32_t b) const {
  const Vec3 edge = pointOf(a) - pointOf(b);
  if (!isStretched_) return glm::length(edge) / (0.5 * (sizes_[a] + sizes_[b]));
  SymmetricTensor toUnit = tensors_[a].scaledBy(0.5);
  toUnit.accumulate(tensors_[b], 0.5);
  return glm::length(toUnit * edge);
}

RegionStatistics& QualityAnalysis::statisticsOf(std::uint32_t region) {
  auto& regions = statistics_.regions;
  while (regions.size() <= region) {
    const auto next = static_cast<std::uint32_t>(regions.size());
    regions.emplace_back().region = next;
  }
  return regions[region];
}

void QualityAnalysis::keepWorst(std::vector<Ranked>& worst, const Ranked& one) {
  if (worst.size() == kListed && !(one.badness > worst.back().badness)) return;
  if (worst.size() == kListed) worst.pop_back();
  worst.insert(
      std::upper_bound(worst.begin(), worst.end(), one,
                       [](const Ranked& p, const Ranked& q) { return p.badness > q.badness; }),
      one);
}

void QualityAnalysis::measureElements(std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) {
    const auto nodes = nodesOf(t);
    const auto element = static_cast<std::uint32_t>(t);
    const TetrahedronMeasures plain = measureTetrahedron(pointOf(nodes[0]), pointOf(nodes[1]),
                                                         pointOf(nodes[2]), pointOf(nodes[3]));
    meter_.add(plain);
    const auto seen = seenCorners(nodes);
    const TetrahedronMeasures measures =
        isStretched_ ? measureTetrahedron(seen[0], seen[1], seen[2], seen[3]) : plain;
    RegionStatistics& region = statisticsOf(mesh_.regions[t]);
    ++region.tetrahedra;
    region.volume += plain.volume;
    for (const double cosine : measures.cosines) ++region.dihedral[angleBin(cosine)];
    ++region.smallestDihedral[angleBin(measures.largestCosine)];
    ++region.radiusRatio[linearBin(measures.radiusRatio, kBinsPerRatio, kRatioBins)];
    if (t == 0 || plain.volume < smallestVolume_) {
      smallestVolume_ = plain.volume;
      smallest_ = element;
    }
    largestVolume_ = std::max(largestVolume_, plain.volume);
    const double badness = badnessOf(measures);
    keepWorst(worst_, {badness, element});
    if (badness > 1.0) missed_.push_back({badness, element});
    for (const auto& [i, j] : kEdges) ++starts_[std::min(nodes[i], nodes[j]) + 1];
  }
}

void QualityAnalysis::startEdges() {
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  filled_.assign(starts_.begin(), starts_.end() - 1);
  edges_.resize(starts_.back());
  metBy_.assign(filled_.size(), 0);
}

void QualityAnalysis::placeEdges(std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) {
    const auto nodes = nodesOf(t);
    for (std::size_t e = 0; e < kEdges.size(); ++e) {
      const std::uint32_t lower = std::min(nodes[kEdges[e][0]], nodes[kEdges[e][1]]);
      edges_[filled_[lower]++] = static_cast<std::uint32_t>(kEdges.size() * t + e);
    }
  }
}

void QualityAnalysis::measureEdges(std::size_t firstNode, std::size_t lastNode) {
  for (std::size_t lower = firstNode; lower < lastNode; ++lower) {
    for (std::uint32_t i = starts_[lower]; i < starts_[lower + 1]; ++i) {
      const std::size_t element = edges_[i] / kEdges.size();
      const auto& corners = kEdges[edges_[i] % kEdges.size()];
      const auto nodes = nodesOf(element);
      const std::uint32_t upper = std::max(nodes[corners[0]], nodes[corners[1]]);
      if (metBy_[upper] == lower + 1) continue;
      metBy_[upper] = static_cast<std::uint32_t>(lower + 1);
      const double length = relativeLength(static_cast<std::uint32_t>(lower), upper);
      ++statisticsOf(mesh_.regions[element]).edge[linearBin(length, kBinsPerEdge, kEdgeBins)];
      sumOfEdges_ += length;
      sumOfPossible_ += length / meanLift(std::array{static_cast<std::uint32_t>(lower), upper});
      ++edgeCount_;
      nearCount_ += length >= kNearFrom && length <= kNearTo ? 1 : 0;
    }
  }
}

void QualityAnalysis::startBoundary() {
  edges_ = {};
  starts_ = {};
  filled_ = {};
  metBy_ = {};
  concerned_.assign(mesh_.points.size() / 3, 0);
  for (const Ranked& one : missed_) {
    for (const std::uint32_t node : nodesOf(one.element)) concerned_[node] = 1;
  }
}

void QualityAnalysis::findBoundaryFaces(std::size_t first, std::size_t last) {
  for (std::size_t h = first; h < last; ++h) {
    const std::span<const std::uint32_t, 3> nodes(&surface_.triangles[3 * h], 3);
    if (concerned_[nodes[0]] + concerned_[nodes[1]] + concerned_[nodes[2]] > 0) limits_.add(nodes);
  }
}

ElementView QualityAnalysis::viewOf(std::span<const std::uint32_t, 4> nodes) const {
  constexpr double kPart = 0.25;
  if (!isStretched_) {
    double size = 0.0;
    for (const std::uint32_t node : nodes) size += kPart * sizes_[node];
    size *= meanLift(nodes);
    return {SymmetricTensor::isotropic(1.0 / size), pointOf(nodes[0])};
  }
  SymmetricTensor toUnit = tensors_[nodes[0]].scaledBy(kPart);
  for (std::size_t k = 1; k < 4; ++k) toUnit.accumulate(tensors_[nodes[k]], kPart);
  return {toUnit.scaledBy(1.0 / meanLift(nodes)), pointOf(nodes[0])};
}

void QualityAnalysis::count(BoundaryLimit limit) {
  switch (limit) {
    case BoundaryLimit::kNone:
      ++statistics_.outOfRange;
      return;
    case BoundaryLimit::kSharpEdge:
      ++statistics_.limitedByEdges;
      break;
    case BoundaryLimit::kNeedle:
      ++statistics_.limitedByNeedles;
      break;
    case BoundaryLimit::kNearSheets:
      ++statistics_.limitedByNarrowGaps;
      break;
  }
  ++statistics_.limitedByBoundary;
}

ElementQuality QualityAnalysis::figuresOf(std::uint32_t element) const {
  const auto nodes = nodesOf(element);
  const auto corners = seenCorners(nodes);
  const TetrahedronMeasures measures =
      measureTetrahedron(corners[0], corners[1], corners[2], corners[3]);
  ElementQuality figures;
  figures.tetrahedron = element;
  figures.smallestDihedral = degreesOf(measures.largestCosine);
  figures.largestDihedral = degreesOf(measures.smallestCosine);
  figures.radiusRatio = measures.radiusRatio;
  const std::array<Vec3, 4> plain{pointOf(nodes[0]), pointOf(nodes[1]), pointOf(nodes[2]),
                                  pointOf(nodes[3])};
  figures.centroid = (plain[0] + plain[1] + plain[2] + plain[3]) * 0.25;
  figures.volume = measureTetrahedron(plain[0], plain[1], plain[2], plain[3]).volume;
  return figures;
}

std::vector<ElementQuality> QualityAnalysis::figuresOf(const std::vector<Ranked>& worst) const {
  std::vector<ElementQuality> figures;
  for (const Ranked& one : worst) figures.push_back(figuresOf(one.element));
  return figures;
}

void QualityAnalysis::findLimits(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const auto nodes = nodesOf(missed_[i].element);
    const BoundaryLimit limit = limits_.limitOf(nodes, viewOf(nodes));
    count(limit);
    if (limit != BoundaryLimit::kNone) keepWorst(worstLimited_, missed_[i]);
  }
}

void QualityAnalysis::finish() {
  statistics_.worst = figuresOf(worst_);
  statistics_.worstLimited = figuresOf(worstLimited_);
  if (mesh_.tetrahedra.empty()) return;
  statistics_.smallest = figuresOf(smallest_);
  statistics_.volumeRatio = smallestVolume_ > 0.0 ? largestVolume_ / smallestVolume_ : 0.0;
  statistics_.meanEdge = sumOfEdges_ / static_cast<double>(edgeCount_);
  statistics_.meanEdgeOfAchievable = sumOfPossible_ / static_cast<double>(edgeCount_);
  statistics_.edgesNearTarget = static_cast<double>(nearCount_) / static_cast<double>(edgeCount_);
  missed_ = {};
  sizes_ = {};
  tensors_ = {};
  lifts_ = {};
}

}  // namespace tetrafront
