// Transfers fields between meshes: all interpolated first, then, if asked for, the means over intersections.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/tool_job.h"
#include "solution/clipped_tetrahedra.h"
#include "solution/mass_projection.h"
#include "solution/mesh_locator.h"
#include "tetrafront/solution.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Covered volume / volume of an element, below which it counts as not covered, and difference of both / volume, below
/// which it counts as covered everywhere.
constexpr double kCovered = 1e-6;
constexpr double kCoverageRounding = 1e-10;

struct TransferInput {
  VolumeMesh from;
  VolumeMesh to;
  SolutionFields fields;
  bool isConservative = false;
};

/// One field on both meshes.
struct FieldPair {
  std::size_t components = 1;
  bool isPerElement = false;
  std::span<const double> before;
  std::vector<double> after;
};

std::vector<FieldPair> pairsOf(const TransferInput& input) {
  const SolutionFields& fields = input.fields;
  std::vector<FieldPair> pairs;
  std::size_t first = 0;
  for (std::size_t f = 0; f < fields.components.size(); ++f) {
    FieldPair pair;
    pair.components = fields.components[f];
    pair.isPerElement = fields.isPerElement[f] != 0;
    const auto samplesOf = [&](const VolumeMesh& mesh) -> std::size_t {
      return pair.isPerElement ? countTetrahedra(mesh) : countNodes(mesh);
    };
    const std::size_t count = pair.components * samplesOf(input.from);
    pair.before = std::span(fields.values).subspan(first, count);
    pair.after.assign(pair.components * samplesOf(input.to), 0.0);
    first += count;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

/// Adds the integral of each component over a mesh.
void addIntegrals(const VolumeMesh& mesh, const FieldPair& pair, std::span<const double> values,
                  std::vector<double>& integrals) {
  for (std::size_t c = 0; c < pair.components; ++c) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < countTetrahedra(mesh); ++t) {
      const double volume = volumeWithin(cornersOf(mesh, TetId(t)));
      if (pair.isPerElement) {
        sum += volume * values[pair.components * t + c];
        continue;
      }
      for (const NodeId node : nodesOf(mesh, TetId(t)))
        sum += 0.25 * volume * values[pair.components * node.index() + c];
    }
    integrals.push_back(sum);
  }
}

std::array<std::uint32_t, 4> nodeNumbers(const VolumeMesh& mesh, TetId tet) {
  const NodeQuad nodes = nodesOf(mesh, tet);
  return {nodes[0].value, nodes[1].value, nodes[2].value, nodes[3].value};
}

class Transfer {
 public:
  Transfer(const TransferInput& input, const MeshLocator& locator)
      : input_(input), locator_(locator), pairs_(pairsOf(input)) {}

  void interpolateAt(NodeId node) {
    const MeshLocator::Location location = located(pointOf(input_.to, node));
    const NodeQuad nodes = nodesOf(input_.from, location.element);
    for (FieldPair& pair : pairs_) {
      if (pair.isPerElement) continue;
      for (std::size_t c = 0; c < pair.components; ++c) {
        double sum = 0.0;
        for (std::size_t k = 0; k < 4; ++k)
          sum += location.weights[k] * pair.before[pair.components * nodes[k].index() + c];
        pair.after[pair.components * node.index() + c] = sum;
      }
    }
  }

  void interpolateAt(TetId tet) {
    const auto [a, b, c, d] = cornersOf(input_.to, tet);
    const Vec3 centroid = a + 0.25 * ((b - a) + (c - a) + (d - a));
    const MeshLocator::Location location = located(centroid);
    for (FieldPair& pair : pairs_) {
      if (!pair.isPerElement) continue;
      for (std::size_t k = 0; k < pair.components; ++k) {
        pair.after[pair.components * tet.index() + k] =
            pair.before[pair.components * location.element.index() + k];
      }
    }
  }

  /// Integrates over the intersections of an element with those of the given mesh.
  void intersect(TetId tet, MassProjection* projection) {
    const Corners corners = cornersOf(input_.to, tet);
    const BarycentricFrame frame(corners);
    const double volume = volumeWithin(corners);
    double covered = 0.0;
    means_.assign(means_.size(), 0.0);
    local_.assign(local_.size(), 0.0);
    Box box = Box::of(corners[0], corners[1], corners[2]);
    box.include(corners[3]);
    locator_.tree().visitOverlaps(
        box, [&](std::uint32_t item) { covered += addOverlap(TetId(item), corners, frame); });
    if (covered > kCovered * volume) setMeans(tet, 1.0 / covered);
    if (projection == nullptr) return;
    if (std::fabs(volume - covered) > kCoverageRounding * volume) addUncovered(tet, box);
    projection->add(tet, local_);
  }

  /// Numbers per node in the projection: all components of all fields at nodes.
  [[nodiscard]] std::size_t nodeComponents() const {
    std::size_t count = 0;
    for (const FieldPair& pair : pairs_) count += pair.isPerElement ? 0 : pair.components;
    return count;
  }
  void beginIntersections() {
    std::size_t ofElements = 0;
    for (const FieldPair& pair : pairs_) ofElements += pair.isPerElement ? pair.components : 0;
    means_.assign(ofElements, 0.0);
    local_.assign(4 * nodeComponents(), 0.0);
  }
  /// Returns the interpolated values, with which the projection begins.
  [[nodiscard]] std::vector<double> nodeValues() const {
    const std::size_t nodes = countNodes(input_.to);
    std::vector<double> values;
    for (std::size_t i = 0; i < nodes; ++i) {
      for (const FieldPair& pair : pairs_) {
        if (pair.isPerElement) continue;
        for (std::size_t c = 0; c < pair.components; ++c)
          values.push_back(pair.after[pair.components * i + c]);
      }
    }
    return values;
  }
  void setNodeValues(std::span<const double> values) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < countNodes(input_.to); ++i) {
      for (FieldPair& pair : pairs_) {
        if (pair.isPerElement) continue;
        for (std::size_t c = 0; c < pair.components; ++c)
          pair.after[pair.components * i + c] = values[next++];
      }
    }
  }

  [[nodiscard]] TransferredSolution take() {
    for (const FieldPair& pair : pairs_) {
      addIntegrals(input_.from, pair, pair.before, result_.integralsBefore);
      addIntegrals(input_.to, pair, pair.after, result_.integralsAfter);
      result_.values.insert(result_.values.end(), pair.after.begin(), pair.after.end());
    }
    return std::move(result_);
  }
  [[nodiscard]] bool hasFieldsPer(bool element) const {
    return std::ranges::any_of(pairs_,
                               [&](const FieldPair& pair) { return pair.isPerElement == element; });
  }

 private:
  MeshLocator::Location located(const Vec3& position) {
    const MeshLocator::Location location = locator_.locate(position);
    if (location.distance > 0.0) {
      ++result_.outside;
      result_.farthest = std::max(result_.farthest, location.distance);
    }
    return location;
  }

  /// Adds the integrals over the intersection with a given element; returns its volume.
  double addOverlap(TetId given, const Corners& corners, const BarycentricFrame& frame) {
    const Corners own = cornersOf(input_.from, given);
    const ClippingPlanes planes(own, nodeNumbers(input_.from, given));
    const std::vector<Corners>& pieces = clipper_.clip(corners, planes);
    double volume = 0.0;
    for (const Corners& piece : pieces) volume += volumeWithin(piece);
    if (!(volume > 0.0)) return 0.0;
    std::size_t slot = 0;
    for (const FieldPair& pair : pairs_) {
      if (!pair.isPerElement) continue;
      for (std::size_t c = 0; c < pair.components; ++c)
        means_[slot++] += volume * pair.before[pair.components * given.index() + c];
    }
    if (local_.empty()) return volume;
    const BarycentricFrame ofGiven(own);
    Products products{};
    for (const Corners& piece : pieces) addProductsOf(frame, ofGiven, piece, 1.0, products);
    addIntegralsOf(products, nodesOf(input_.from, given), false);
    return volume;
  }

  /// products[i][j]: integral of weight i in one element times weight j in another.
  using Products = std::array<std::array<double, 4>, 4>;

  static void addProductsOf(const BarycentricFrame& first, const BarycentricFrame& second,
                            const Corners& piece, double sign, Products& products) {
    const double share = sign * volumeWithin(piece) / 20.0;
    std::array<double, 4> sums{};
    std::array<double, 4> secondSums{};
    for (const Vec3& corner : piece) {
      const auto a = first.at(corner);
      const auto b = second.at(corner);
      for (std::size_t i = 0; i < 4; ++i) {
        sums[i] += a[i];
        secondSums[i] += b[i];
        for (std::size_t j = 0; j < 4; ++j) products[i][j] += share * a[i] * b[j];
      }
    }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) products[i][j] += share * sums[i] * secondSums[j];
  }

  /// Adds the integrals of each field times the weight of each corner. `isAfter`: of the interpolated fields.
  void addIntegralsOf(const Products& products, const NodeQuad& nodes, bool isAfter) {
    std::size_t slot = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (const FieldPair& pair : pairs_) {
        if (pair.isPerElement) continue;
        const std::span<const double> values = isAfter ? std::span(pair.after) : pair.before;
        for (std::size_t c = 0; c < pair.components; ++c, ++slot) {
          for (std::size_t j = 0; j < 4; ++j)
            local_[slot] += products[i][j] * values[pair.components * nodes[j].index() + c];
        }
      }
    }
  }

  void setMeans(TetId tet, double perVolume) {
    std::size_t slot = 0;
    for (FieldPair& pair : pairs_) {
      if (!pair.isPerElement) continue;
      for (std::size_t c = 0; c < pair.components; ++c)
        pair.after[pair.components * tet.index() + c] = perVolume * means_[slot++];
    }
  }

  /// Adds the integrals of the interpolated values over the part of an element that the given mesh does not cover.
  void addUncovered(TetId tet, const Box& box) {
    const Corners corners = cornersOf(input_.to, tet);
    const BarycentricFrame frame(corners);
    // The whole, minus what is covered.
    Products rest{};
    addProductsOf(frame, frame, corners, 1.0, rest);
    locator_.tree().visitOverlaps(box, [&](std::uint32_t item) {
      const TetId given(item);
      const ClippingPlanes planes(cornersOf(input_.from, given), nodeNumbers(input_.from, given));
      for (const Corners& piece : clipper_.clip(corners, planes))
        addProductsOf(frame, frame, piece, -1.0, rest);
    });
    addIntegralsOf(rest, nodesOf(input_.to, tet), true);
  }

  const TransferInput& input_;
  const MeshLocator& locator_;
  std::vector<FieldPair> pairs_;
  TransferredSolution result_;
  TetrahedronClipper clipper_;
  std::vector<double> means_;  ///< of an element: integral per component of the fields at elements
  std::vector<double>
      local_;  ///< of an element: per corner, integral per component of the fields at nodes
};

Task<> transferConservatively(Work& work, const TransferInput& input, Transfer& transfer) {
  transfer.beginIntersections();
  const bool hasNodes = transfer.hasFieldsPer(false);
  MassProjection projection(input.to, hasNodes ? transfer.nodeComponents() : 0);
  work.beginPart(0.8);
  co_await work.forEachId<TetId>(countTetrahedra(input.to), [&](TetId tet) {
    transfer.intersect(tet, hasNodes ? &projection : nullptr);
  });
  if (!hasNodes) co_return;
  work.beginPart(1.0);
  const std::vector<double> values = co_await projection.solve(work, transfer.nodeValues());
  transfer.setNodeValues(values);
}

Task<TransferredSolution> transferSolution(Work& work, const TransferInput& input) {
  work.beginPart(0.1);
  const MeshLocator locator = co_await MeshLocator::build(work, input.from);
  Transfer transfer(input, locator);
  work.beginPart(input.isConservative ? 0.3 : 0.9);
  if (transfer.hasFieldsPer(false)) {
    co_await work.forEachId<NodeId>(countNodes(input.to),
                                    [&](NodeId node) { transfer.interpolateAt(node); });
  }
  if (transfer.hasFieldsPer(true)) {
    co_await work.forEachId<TetId>(countTetrahedra(input.to),
                                   [&](TetId tet) { transfer.interpolateAt(tet); });
  }
  work.beginPart(1.0);
  if (input.isConservative) co_await transferConservatively(work, input, transfer);
  co_return transfer.take();
}

}  // namespace

SolutionTransferrer::SolutionTransferrer(VolumeMesh from, VolumeMesh to, SolutionFields fields,
                                         bool isConservative)
    : SlicedTool(makeToolJob<TransferredSolution>(
          TransferInput{std::move(from), std::move(to), std::move(fields), isConservative},
          [](Work& work, const TransferInput& input) { return transferSolution(work, input); })) {}

}  // namespace tetrafront
