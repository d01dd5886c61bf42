#include "metric/mesh_metric.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/ids.h"
#include "base/sort.h"
#include "geom/exponential.h"
#include "geom/measure.h"
#include "metric/metric.h"
#include "topology/mesh_access.h"
#include "topology/node_lists.h"

namespace tetrafront {
namespace {

/// Elements, nodes or edges per unit of budget: visiting one costs far less than a step of the front.
constexpr std::size_t kMetricsPerUnit = 8;

/// Slack of the limits of growth: smaller violations would keep sweeps busy without a visible effect.
constexpr double kGrowthSlack = 1e-4;
constexpr int kGrowthSweeps = 100;

double volumeOf(const std::array<Vec3, 4>& p) {
  return glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) / 6.0;
}

/// Returns the divided difference of the exponential at one to four ascending arguments.
double dividedExponential(std::span<const double> arguments) {
  constexpr double kNear = 1.0;       // below, differences would lose digits
  constexpr std::size_t kTerms = 12;  // at this range, the rest is below rounding
  const double range = arguments.back() - arguments.front();
  if (range > kNear) {
    return (dividedExponential(arguments.subspan(1)) -
            dividedExponential(arguments.first(arguments.size() - 1))) /
           range;
  }
  // The Taylor series about the mean: sum of h_k / (n + k)!, of n + 1 arguments, with the complete homogeneous
  // symmetric polynomials h_k.
  double mean = 0.0;
  for (const double argument : arguments) mean += argument / static_cast<double>(arguments.size());
  std::array<double, kTerms> polynomials{1.0};
  for (const double argument : arguments) {
    for (std::size_t k = 1; k < kTerms; ++k)
      polynomials[k] += (argument - mean) * polynomials[k - 1];
  }
  double factorial = 1.0;
  for (std::size_t k = 2; k < arguments.size(); ++k) factorial *= static_cast<double>(k);
  double sum = 0.0;
  for (std::size_t k = 0; k < kTerms; ++k) {
    sum += polynomials[k] / factorial;
    factorial *= static_cast<double>(arguments.size() + k);
  }
  return exponential(mean) * sum;
}

/// Limits the metrics at the ends of edges by each other.
class GrowthLimiter {
 public:
  GrowthLimiter(const VolumeMesh& mesh, double growth, std::vector<double>& metrics)
      : mesh_(mesh), growth_(growth), metrics_(metrics), changedIn_(countNodes(mesh), 0) {}

  void beginSweep(int sweep) {
    sweep_ = sweep;
    hasChanged_ = false;
  }
  [[nodiscard]] bool hasChanged() const { return hasChanged_; }

  void visit(const std::array<std::uint32_t, 2>& edge) {
    const auto [a, b] = edge;
    if (changedIn_[a] < sweep_ - 1 && changedIn_[b] < sweep_ - 1) return;
    const Vec3 along = pointOf(mesh_, NodeId(b)) - pointOf(mesh_, NodeId(a));
    limit(b, a, along);
    limit(a, b, along);
  }

 private:
  /// Limits the metric at `node` by the metric at `from`.
  void limit(std::uint32_t node, std::uint32_t from, const Vec3& along) {
    const SymmetricTensor limiting = tensorAt(metrics_, from);
    const double growth = 1.0 + growth_ * metricLength(limiting, along);
    const SymmetricTensor grown = limiting.scaledBy(1.0 / (growth * growth));
    const SymmetricTensor own = tensorAt(metrics_, node);
    if (isNowhereBelow(own, grown, kGrowthSlack)) return;
    putTensor(metrics_, node, intersectionOf(own, grown));
    changedIn_[node] = sweep_;
    hasChanged_ = true;
  }

  const VolumeMesh& mesh_;
  double growth_;
  std::vector<double>& metrics_;
  std::vector<int> changedIn_;  ///< per node: the last sweep that changed it
  int sweep_ = 0;
  bool hasChanged_ = false;
};

}  // namespace

SymmetricTensor impliedMetric(const std::array<Vec3, 4>& p) {
  // The columns a b c of the matrix that maps a regular tetrahedron with edges 1 to this one.
  const Vec3 a = p[1] - p[0];
  const Vec3 b = (p[2] - p[0] - 0.5 * a) * (2.0 / std::sqrt(3.0));
  const Vec3 c = (p[3] - p[0] - 0.5 * a - (std::sqrt(3.0) / 6.0) * b) * std::sqrt(1.5);
  const double determinant = glm::dot(glm::cross(a, b), c);
  SymmetricTensor metric = SymmetricTensor::isotropic(0.0);
  if (determinant == 0.0) return metric;
  for (const Vec3& row : {glm::cross(b, c), glm::cross(c, a), glm::cross(a, b)}) {
    const Vec3 r = row / determinant;
    metric.accumulate({r.x * r.x, r.y * r.y, r.z * r.z, r.x * r.y, r.x * r.z, r.y * r.z}, 1.0);
  }
  return metric;
}

Task<std::vector<double>> impliedMetrics(Work& work, const VolumeMesh& mesh) {
  std::vector<double> sums(kTensorNumbers * countNodes(mesh), 0.0);
  std::vector<double> volumes(countNodes(mesh), 0.0);
  work.beginPart(0.7);
  co_await work.forEachId<TetId>(
      countTetrahedra(mesh),
      [&](TetId tet) {
        const std::array<Vec3, 4> corners = cornersOf(mesh, tet);
        const double volume = volumeOf(corners);
        const SymmetricTensor metric = impliedMetric(corners);
        if (!(volume > 0.0) || !areFinite(metric)) return;
        const SymmetricTensor logarithm = logarithmOf(metric);
        if (!areFinite(logarithm)) return;
        for (const NodeId node : nodesOf(mesh, tet)) {
          SymmetricTensor sum = tensorAt(sums, node.index());
          sum.accumulate(logarithm, volume);
          putTensor(sums, node.index(), sum);
          volumes[node.index()] += volume;
        }
      },
      kMetricsPerUnit);
  work.beginPart(1.0);
  co_await work.forEachId<NodeId>(
      countNodes(mesh),
      [&](NodeId node) {
        const std::size_t i = node.index();
        if (!(volumes[i] > 0.0)) return;
        putTensor(sums, i, exponentialOf(tensorAt(sums, i).scaledBy(1.0 / volumes[i])));
      },
      kMetricsPerUnit);
  co_return sums;
}

double complexityWithin(const std::array<Vec3, 4>& corners,
                        const std::array<double, 4>& densities) {
  std::array<double, 4> logarithms{};
  std::ranges::transform(densities, logarithms.begin(), logarithm);
  std::ranges::sort(logarithms);
  // The mean of a function of a linear function over a simplex (Hermite and Genocchi).
  return 6.0 * dividedExponential(logarithms) * std::fabs(volumeOf(corners));
}

double complexityOf(const VolumeMesh& mesh, std::span<const double> metrics) {
  std::vector<double> densities(countNodes(mesh));
  for (std::size_t i = 0; i < densities.size(); ++i) densities[i] = densityOf(tensorAt(metrics, i));
  double sum = 0.0;
  for (std::uint32_t t = 0; t < countTetrahedra(mesh); ++t) {
    std::array<double, 4> own{};
    std::ranges::transform(nodesOf(mesh, TetId(t)), own.begin(),
                           [&](NodeId node) { return densities[node.index()]; });
    sum += complexityWithin(cornersOf(mesh, TetId(t)), own);
  }
  return sum;
}

Task<MeshEdges> edgesOf(Work& work, const VolumeMesh& mesh) {
  NodeLists<std::uint32_t> lists(countNodes(mesh));
  const auto forEachEdge = [&](TetId tet, const auto& use) {
    const NodeQuad nodes = nodesOf(mesh, tet);
    for (const TetEdge& edge : kTetEdges) {
      const auto [low, high] = std::minmax(nodes[edge.from], nodes[edge.to]);
      use(low, high);
    }
  };
  const std::size_t tetrahedra = countTetrahedra(mesh);
  work.beginPart(0.3);
  co_await work.forEachId<TetId>(
      tetrahedra,
      [&](TetId tet) { forEachEdge(tet, [&](NodeId low, NodeId) { lists.count(low); }); },
      kMetricsPerUnit);
  lists.endCounting();
  work.beginPart(0.6);
  co_await work.forEachId<TetId>(
      tetrahedra,
      [&](TetId tet) {
        forEachEdge(tet, [&](NodeId low, NodeId high) { lists.add(low, high.value); });
      },
      kMetricsPerUnit);
  MeshEdges edges;
  work.beginPart(1.0);
  co_await work.forEachId<NodeId>(
      countNodes(mesh),
      [&](NodeId low) {
        const std::span<std::uint32_t> ends = lists.at(low);
        sortFew(ends, [](std::uint32_t a, std::uint32_t b) { return a < b; });
        for (std::size_t i = 0; i < ends.size(); ++i)
          if (i == 0 || ends[i] != ends[i - 1]) edges.push_back({low.value, ends[i]});
      },
      kMetricsPerUnit);
  co_return edges;
}

Task<> limitGrowth(Work& work, const VolumeMesh& mesh, const MeshEdges& edges, double growth,
                   std::vector<double>& metrics) {
  GrowthLimiter limiter(mesh, growth, metrics);
  for (int sweep = 1; sweep <= kGrowthSweeps; ++sweep) {
    limiter.beginSweep(sweep);
    const bool isForward = sweep % 2 == 1;
    co_await work.forEachBlock(
        edges.size(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i)
            limiter.visit(edges[isForward ? i : edges.size() - 1 - i]);
        },
        kMetricsPerUnit);
    if (!limiter.hasChanged()) break;
  }
}

}  // namespace tetrafront
