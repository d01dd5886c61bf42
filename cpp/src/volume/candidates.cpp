#include "volume/candidates.h"

#include <algorithm>
#include <cmath>

namespace tetrafront {
namespace {

constexpr double cube(double x) { return x * x * x; }

constexpr std::array<double, 4> kClosingFactor{1.0, cube(1.0 + kClosingBonus),
                                               cube(1.0 + 2.0 * kClosingBonus),
                                               cube(1.0 + 3.0 * kClosingBonus)};

/// Returns true if the half-plane from the edge from-to to `apex` forms a dihedral angle below 90
/// degrees with the one to `third`, on the side that `normal` points to.
bool isWedge(const Vec3& from, const Vec3& to, const Vec3& third, const Vec3& apex,
             const Vec3& normal) {
  const Vec3 edge = to - from;
  const double square = glm::dot(edge, edge);
  const auto across = [&](const Vec3& position) {
    const Vec3 v = position - from;
    return v - edge * (glm::dot(v, edge) / square);
  };
  const Vec3 toApex = across(apex);
  return glm::dot(across(third), toApex) > 0.0 && glm::dot(toApex, normal) > 0.0;
}

}  // namespace

bool EdgeNeighbours::find(const Neighbourhood& around, const BaseFace& base, SearchRegion& region) {
  edgesClosed_.assign(around.nodeCount(), 0);
  wedgeCount_ = 0;
  bool grew = false;
  for (const AdjacentFace& face : around.adjacentFaces()) {
    if (!face.isNeighbour()) continue;
    ++edgesClosed_[face.apex];
    if (wedgeCount_ == wedgeApexes_.size() ||
        !isWedge(around.unitPosition(face.to), around.unitPosition(face.from),
                 around.unitPosition(face.third()), around.unitPosition(face.apex), base.normal)) {
      continue;
    }
    wedgeApexes_[wedgeCount_++] = face.apex;
    grew = region.include(around.position(face.apex)) || grew;
  }
  return grew;
}

bool EdgeNeighbours::isWedgeApex(LocalNode node) const {
  const auto end = wedgeApexes_.begin() + static_cast<std::ptrdiff_t>(wedgeCount_);
  return std::find(wedgeApexes_.begin(), end, node) != end;
}

void CandidateList::rank(const Neighbourhood& around, const CrossingTest& crossing,
                         const BaseFace& base, const IdealPoint& ideal,
                         const EdgeNeighbours& neighbours, const RuleClass& rules,
                         const RuleVariant& variant) {
  candidates_.clear();
  taken_ = 0;
  offerExisting(around, crossing, base, ideal, neighbours, rules);
  if (rules.newNodes && variant.newNodes) {
    offerNew(around, base, ideal, rules, variant.newNodeWeight);
  }
}

void CandidateList::offerExisting(const Neighbourhood& around, const CrossingTest& crossing,
                                  const BaseFace& base, const IdealPoint& ideal,
                                  const EdgeNeighbours& neighbours, const RuleClass& rules) {
  const double radius = rules.searchRadius * ideal.size;
  const double radiusSquare = radius * radius;
  const double minCubedQuality = cube(rules.minQuality) * std::min(1.0, bestCubedMeanRatio(base));
  const std::size_t count = around.nodeCount();
  for (LocalNode node = 3; node < count; ++node) {
    if (crossing.isBehindBase(node)) continue;
    const std::uint8_t closed = neighbours.edgesClosedBy(node);
    const bool wedge = closed > 0 && neighbours.isWedgeApex(node);
    const Vec3 position = around.unitPosition(node);
    const Vec3 toIdeal = position - ideal.position;
    if (!wedge && glm::dot(toIdeal, toIdeal) > radiusSquare) continue;
    // A candidate that closes all edges fills a pocket with four faces, and no better one can
    // exist. Accept it even if it is too flat for doubles to see its volume; the exact sign decides
    // later.
    const bool fillsPocket = closed >= 3;
    const double quality = cubedMeanRatio(base, position);
    if (!fillsPocket && quality < minCubedQuality * (wedge ? kWedgeQualityFactor : 1.0)) continue;
    double score = quality * kClosingFactor[std::min<std::size_t>(closed, 3)];
    if (wedge) score += kWedgeBonus;
    if (fillsPocket) score += kPocketBonus;
    const ScoreTerms terms{.closed = std::min<std::uint8_t>(closed, 3), .isWedge = wedge};
    candidates_.push_back({score, node, terms, position});
  }
}

void CandidateList::offerNew(const Neighbourhood& around, const BaseFace& base,
                             const IdealPoint& ideal, const RuleClass& rules, double weight) {
  const double minCubedQuality = cube(rules.minQuality) * std::min(1.0, bestCubedMeanRatio(base));
  const double* x = around.unitX();
  const double* y = around.unitY();
  const double* z = around.unitZ();
  const std::size_t count = around.nodeCount();
  for (std::size_t height = 0; height < kHeights.size(); ++height) {
    const double factor = kHeights[height];
    const Vec3 position = base.centroid + base.unitNormal * (ideal.height * factor);
    const double quality = cubedMeanRatio(base, position);
    if (!(quality > 0.0) || quality < minCubedQuality) continue;
    const double distance = rules.nodeDistance * ideal.size * factor;
    const double limit = distance * distance;
    bool isTooClose = false;
    for (std::size_t node = 3; node < count && !isTooClose; ++node) {
      const double dx = x[node] - position.x;
      const double dy = y[node] - position.y;
      const double dz = z[node] - position.z;
      isTooClose = dx * dx + dy * dy + dz * dz < limit;
    }
    if (isTooClose) continue;
    const double score = quality * cube(weight) * cube(factor) * cube(factor);
    const ScoreTerms terms{.height = static_cast<std::uint8_t>(height),
                           .hasLowWeight = weight == kLowNewNodeWeight};
    candidates_.push_back({score, Candidate::kNewNode, terms, position});
  }
}

const Candidate* CandidateList::next() {
  if (taken_ == candidates_.size()) return nullptr;
  std::size_t best = taken_;
  for (std::size_t i = taken_ + 1; i < candidates_.size(); ++i) {
    const Candidate& other = candidates_[i];
    const Candidate& leader = candidates_[best];
    if (other.score > leader.score || (other.score == leader.score && other.node < leader.node)) {
      best = i;
    }
  }
  std::swap(candidates_[taken_], candidates_[best]);
  return &candidates_[taken_++];
}

}  // namespace tetrafront
