#include "quality/quality_analysis.h"

#include <algorithm>

#include "quality/poor_elements.h"
#include "topology/mesh_access.h"
#include "topology/tetrahedron.h"

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

/// Returns the lower node first.
std::pair<NodeId, NodeId> sortedNodes(const NodeQuad& nodes, const TetEdge& edge) {
  return std::minmax(nodes[edge.from], nodes[edge.to]);
}

/// Returns a value above 1 if and only if an angle is out of range; the larger, the worse.
double dihedralCostOf(const TetrahedronMeasures& measures) {
  constexpr double kFlat = 1e300;
  const double c = measures.largestCosine;
  const double d = measures.smallestCosine;
  if (c >= 1.0 || d <= -1.0) return kFlat;
  return std::max(kSquaredTangentOfHalf30 * (1.0 + c) / (1.0 - c),
                  kSquaredTangentOfHalf45 * (1.0 - d) / (1.0 + d));
}

}  // namespace

QualityAnalysis::QualityAnalysis(const MeshView& mesh, const SurfaceMesh& surface,
                                 const SizeField& field, std::size_t maxEdges)
    : mesh_(mesh),
      surface_(surface),
      field_(field),
      maxEdges_(maxEdges),
      isStretched_(field.isStretched()),
      job_([this](Work& work) { return analyse(work); }) {
  const std::size_t nodes = countNodes(mesh);
  if (isStretched_) {
    tensors_.resize(nodes);
  } else {
    sizes_.resize(nodes);
  }
  if (field.isRaised()) raiseFactors_.resize(nodes);
}

Task<> QualityAnalysis::analyse(Work& work) {
  work.beginPart(0.2);
  co_await work.forEachId<NodeId>(countNodes(mesh_), [this](NodeId node) { querySize(node); });
  work.beginPart(0.9);
  co_await measureElements(work);
  work.beginPart(0.98);
  co_await findLimits(work);
  work.beginPart(1.0);
  co_await findReasons(work);
  finish();
}

/// Measures the elements, and then each of their edges once.
Task<> QualityAnalysis::measureElements(Work& work) {
  const std::size_t elements = countTetrahedra(mesh_);
  NodeListPasses<EdgeUse> edges(countNodes(mesh_), elements, maxEdges_);
  work.beginPart(0.5);
  co_await work.forEachBlock(elements, [&](std::size_t first, std::size_t last) {
    mesh_.forEachElement(first, last, [&](TetId element, const ElementSource::Element& made) {
      measureElement(element, made);
      for (const TetEdge& edge : kTetEdges) edges.count(sortedNodes(made.nodes, edge).first);
    });
  });
  work.beginPart(1.0);
  co_await measureEdges(work, edges);
}

Task<> QualityAnalysis::measureEdges(Work& work, NodeListPasses<EdgeUse>& edges) {
  edges.endCounting();
  // Per node: the last lower node with which it shared an edge, or none.
  std::vector<NodeId> lastLowerNode(countNodes(mesh_));
  const double perPass = 1.0 / static_cast<double>(edges.passCount());
  for (double done = 0.0; edges.beginPass(); done += perPass) {
    work.beginPart(done + 0.4 * perPass);
    co_await work.forEachId<FaceId>(edges.chunks().size(), [&](FaceId i) {
      const std::uint32_t chunk = edges.chunks()[i.index()];
      mesh_.forEachNodes(edges.firstOf(chunk), edges.lastOf(chunk),
                         [&](TetId element, const NodeQuad& nodes) {
                           for (const TetEdge& edge : kTetEdges) {
                             const auto [lower, upper] = sortedNodes(nodes, edge);
                             edges.add(chunk, lower, {upper, element});
                           }
                         });
    });
    work.beginPart(done + perPass);
    co_await work.forEachId<NodeId>(edges.nodeCount(), [&](NodeId i) {
      const NodeId lower(edges.firstNode() + i.index());
      for (const EdgeUse& edge : edges.at(lower)) {
        if (lastLowerNode[edge.upper.index()] == lower) continue;
        lastLowerNode[edge.upper.index()] = lower;
        measureEdge(lower, edge);
      }
    });
  }
}

/// Finds out which of the elements out of range are limited by the boundary.
Task<> QualityAnalysis::findLimits(Work& work) {
  std::vector<std::uint8_t> isTested(countNodes(mesh_), 0);
  for (const Ranked& ranked : outOfRange_) {
    for (const NodeId node : nodesOf(mesh_, ranked.element)) isTested[node.index()] = 1;
  }
  BoundaryLimits limits(mesh_);
  work.beginPart(0.5);
  co_await work.forEachId<TriangleId>(countTriangles(surface_), [&](TriangleId triangle) {
    const NodeTriple nodes = nodesOf(surface_, triangle);
    if (std::ranges::any_of(nodes, [&](NodeId node) { return isTested[node.index()] != 0; }))
      limits.add(nodes);
  });
  limits.finish();
  work.beginPart(1.0);
  co_await work.forEachBlock(outOfRange_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const NodeQuad nodes = nodesOf(mesh_, outOfRange_[i].element);
      const BoundaryLimit limit = limits.limitOf(nodes, viewOf(nodes));
      count(limit);
      if (limit != BoundaryLimit::kNone) keepWorst(worstLimited_, outOfRange_[i]);
    }
  });
}

/// Finds out why elements are poor. In a stretched field, boundaries do not explain angles in the metric.
Task<> QualityAnalysis::findReasons(Work& work) {
  if (isStretched_) co_return;
  PoorElementAnalysis analysis(mesh_, surface_);
  statistics_.poor = co_await analysis.analyse(work, poor_);
}

void QualityAnalysis::querySize(NodeId node) {
  const Vec3 position = pointOf(mesh_, node);
  double size = 0.0;
  if (isStretched_) {
    const SymmetricTensor target = field_.targetTensorAt(position, hint_);
    tensors_[node.index()] = target.inverse();
    size = meanSizeOf(target);
  } else {
    size = sizes_[node.index()] = field_.targetSizeAt(position, hint_);
  }
  if (!raiseFactors_.empty()) raiseFactors_[node.index()] = field_.raiseFactorAt(position, size);
}

double QualityAnalysis::meanRaiseFactor(std::span<const NodeId> nodes) const {
  if (raiseFactors_.empty()) return 1.0;
  double sum = 0.0;
  for (const NodeId node : nodes) sum += raiseFactors_[node.index()];
  return sum / static_cast<double>(nodes.size());
}

std::array<Vec3, 4> QualityAnalysis::metricCorners(const ElementSource::Element& element) const {
  std::array<Vec3, 4> corners = element.corners;
  if (!isStretched_) return corners;
  const ElementView view = viewOf(element.nodes);
  for (Vec3& corner : corners) corner = view(corner);
  return corners;
}

double QualityAnalysis::relativeLength(NodeId a, NodeId b) const {
  const Vec3 edge = pointOf(mesh_, a) - pointOf(mesh_, b);
  if (!isStretched_) return glm::length(edge) / (0.5 * (sizes_[a.index()] + sizes_[b.index()]));
  SymmetricTensor toUnit = tensors_[a.index()].scaledBy(0.5);
  toUnit.accumulate(tensors_[b.index()], 0.5);
  return glm::length(toUnit * edge);
}

RegionStatistics& QualityAnalysis::statisticsOf(std::uint32_t region) {
  auto& regions = statistics_.regions;
  while (regions.size() <= region) {
    const auto next = static_cast<std::uint32_t>(regions.size());
    regions.emplace_back().region = next;
    regionMeters_.emplace_back();
  }
  return regions[region];
}

void QualityAnalysis::keepWorst(std::vector<Ranked>& worst, const Ranked& candidate) {
  if (worst.size() == kListed && !(candidate.cost > worst.back().cost)) return;
  if (worst.size() == kListed) worst.pop_back();
  worst.insert(std::upper_bound(worst.begin(), worst.end(), candidate,
                                [](const Ranked& p, const Ranked& q) { return p.cost > q.cost; }),
               candidate);
}

/// Adds the shape of the next element, measured in the metric.
void QualityAnalysis::measureShape(std::uint32_t region, const TetrahedronMeasures& measures) {
  RegionStatistics& statistics = statisticsOf(region);
  regionMeters_[region].add(measures);
  for (const double cosine : measures.cosines) ++statistics.dihedral[angleBin(cosine)];
  ++statistics.smallestDihedral[angleBin(measures.largestCosine)];
  ++statistics.radiusRatio[linearBin(measures.radiusRatio, kBinsPerRatio, kRatioBins)];
  if (!isStretched_) return;
  metricShapes_.radiusRatio.push_back(static_cast<float>(measures.radiusRatio));
  metricShapes_.smallestDihedral.push_back(static_cast<float>(degreesOf(measures.largestCosine)));
}

void QualityAnalysis::measureElement(TetId element, const ElementSource::Element& made) {
  const TetrahedronMeasures plain = measureTetrahedron(made.corners);
  meter_.add(plain);
  const TetrahedronMeasures measures =
      isStretched_ ? measureTetrahedron(metricCorners(made)) : plain;
  const std::uint32_t number = mesh_.regionOf(element);
  RegionStatistics& region = statisticsOf(number);
  ++region.tetrahedra;
  region.volume += plain.volume;
  measureShape(number, measures);
  if (element.index() == 0 || plain.volume < smallestVolume_) {
    smallestVolume_ = plain.volume;
    smallest_ = element;
  }
  largestVolume_ = std::max(largestVolume_, plain.volume);
  if (plain.largestCosine > kPoorCosine) {
    poor_.push_back(element);
    if (plain.largestCosine > largestCosine_) std::swap(poor_.front(), poor_.back());
    largestCosine_ = std::max(largestCosine_, plain.largestCosine);
  }
  const double cost = dihedralCostOf(measures);
  keepWorst(worst_, {cost, element});
  if (cost > 1.0) outOfRange_.push_back({cost, element});
}

/// The edge counts in the region of this one of its elements.
void QualityAnalysis::measureEdge(NodeId lower, const EdgeUse& edge) {
  const auto [upper, element] = edge;
  const double length = relativeLength(lower, upper);
  RegionStatistics& region = statisticsOf(mesh_.regionOf(element));
  ++region.edge[linearBin(length, kBinsPerEdge, kEdgeBins)];
  sumOfEdges_ += length;
  sumOfAchievable_ += length / meanRaiseFactor(std::array{lower, upper});
  ++edgeCount_;
  nearTargetCount_ += length >= kNearFrom && length <= kNearTo ? 1 : 0;
}

ElementView QualityAnalysis::viewOf(const NodeQuad& nodes) const {
  constexpr double kPart = 0.25;
  if (!isStretched_) {
    double size = 0.0;
    for (const NodeId node : nodes) size += kPart * sizes_[node.index()];
    size *= meanRaiseFactor(nodes);
    return {SymmetricTensor::isotropic(1.0 / size), pointOf(mesh_, nodes[0])};
  }
  SymmetricTensor toUnit = tensors_[nodes[0].index()].scaledBy(kPart);
  for (std::size_t k = 1; k < 4; ++k) toUnit.accumulate(tensors_[nodes[k].index()], kPart);
  return {toUnit.scaledBy(1.0 / meanRaiseFactor(nodes)), pointOf(mesh_, nodes[0])};
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
    case BoundaryLimit::kNarrowGap:
      ++statistics_.limitedByNarrowGaps;
      break;
  }
  ++statistics_.limitedByBoundary;
}

ElementQuality QualityAnalysis::qualityOf(TetId element) const {
  const ElementSource::Element made{nodesOf(mesh_, element), cornersOf(mesh_, element)};
  const TetrahedronMeasures measures = measureTetrahedron(metricCorners(made));
  ElementQuality quality;
  quality.tetrahedron = element.value;
  quality.smallestDihedral = degreesOf(measures.largestCosine);
  quality.largestDihedral = degreesOf(measures.smallestCosine);
  quality.radiusRatio = measures.radiusRatio;
  const auto& [a, b, c, d] = made.corners;
  quality.centroid = (a + b + c + d) * 0.25;
  quality.volume = measureTetrahedron(a, b, c, d).volume;
  return quality;
}

std::vector<ElementQuality> QualityAnalysis::qualityOf(const std::vector<Ranked>& worst) const {
  std::vector<ElementQuality> qualities;
  for (const Ranked& ranked : worst) qualities.push_back(qualityOf(ranked.element));
  return qualities;
}

void QualityAnalysis::finish() {
  for (RegionStatistics& region : statistics_.regions) {
    const QualitySummary shapes = regionMeters_[region.region].summary();
    region.minDihedral = shapes.minDihedral;
    region.maxDihedral = shapes.maxDihedral;
    region.minRadiusRatio = shapes.minRadiusRatio;
    region.meanRadiusRatio = shapes.meanRadiusRatio;
  }
  statistics_.worst = qualityOf(worst_);
  statistics_.worstLimited = qualityOf(worstLimited_);
  if (countTetrahedra(mesh_) == 0) return;
  statistics_.smallest = qualityOf(smallest_);
  statistics_.volumeRatio = smallestVolume_ > 0.0 ? largestVolume_ / smallestVolume_ : 0.0;
  statistics_.meanEdge = sumOfEdges_ / static_cast<double>(edgeCount_);
  statistics_.meanEdgeOfAchievable = sumOfAchievable_ / static_cast<double>(edgeCount_);
  statistics_.edgesNearTarget =
      static_cast<double>(nearTargetCount_) / static_cast<double>(edgeCount_);
}

}  // namespace tetrafront
