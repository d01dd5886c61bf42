#include "adapt/adapt_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "metric/metric.h"

namespace tetrafront {
namespace {

/// Returns the cube root of a normal number > 0 to about 1e-14; faster than cubeRoot().
double quickCubeRoot(double value) {
  // A third of the exponent, with the best offset for the first guess: 3 % off.
  constexpr std::uint64_t kOffset = 0x2a9f7893782da1ceULL;
  double root = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) / 3 + kOffset);
  for (int i = 0; i < 2; ++i) {  // Halley's method: each step cubes the error
    const double cube = root * root * root;
    root *= (cube + 2.0 * value) / (2.0 * cube + value);
  }
  return root;
}

/// Returns (a - b) / ln(a / b) to about 1e-9.
double quickLogarithmicMean(double a, double b) {
  const double sum = a + b;
  if (!(sum > 0.0)) return 0.0;
  const double t = (a - b) / sum;
  const double s = t * t;
  if (s > 0.04) return logarithmicMean(a, b);
  // ln(a / b) = 2 artanh(t)
  return 0.5 * sum /
         (1.0 + s * (1.0 / 3.0 + s * (0.2 + s * (1.0 / 7.0 + s * (1.0 / 9.0 + s / 11.0)))));
}

double squaredLength(const SymmetricTensor& m, const Vec3& e) {
  return m.xx * e.x * e.x + m.yy * e.y * e.y + m.zz * e.z * e.z +
         2.0 * (m.xy * e.x * e.y + m.xz * e.x * e.z + m.yz * e.y * e.z);
}

/// Returns the sum of the squares e e^T of the edges of an element, from those at one corner.
SymmetricTensor sumOfSquares(const Vec3& ab, const Vec3& ac, const Vec3& ad) {
  SymmetricTensor sum = SymmetricTensor::isotropic(0.0);
  for (const Vec3& e : {ab, ac, ad, ac - ab, ad - ab, ad - ac}) {
    sum.xx += e.x * e.x;
    sum.yy += e.y * e.y;
    sum.zz += e.z * e.z;
    sum.xy += e.x * e.y;
    sum.xz += e.x * e.z;
    sum.yz += e.y * e.z;
  }
  return sum;
}

/// 6 V sqrt(2) is 1 for the regular tetrahedron with edge 1.
constexpr double kRegular = 1.4142135623730951;

/// Below this part of the product of three edges, the sign of a determinant needs the exact predicate.
constexpr double kSignRounding = 1e-14;

}  // namespace

void AdaptMesh::save(State& state) const {
  state.elements = elements;
  state.nodes = nodes;
  state.free = free_;
}

void AdaptMesh::restore(const State& state) {
  elements = state.elements;
  nodes = state.nodes;
  free_ = state.free;
}

TetId AdaptMesh::addElement() {
  if (free_.empty()) {
    elements.emplace_back();
    return TetId(elements.size() - 1);
  }
  const TetId id = free_.back();
  free_.pop_back();
  return id;
}

void AdaptMesh::removeElement(TetId id) {
  element(id).nodes[0] = NodeId();
  free_.push_back(id);
}

double metricLengthBetween(const AdaptNode& from, const AdaptNode& to) {
  const Vec3 e = to.point - from.point;
  return quickLogarithmicMean(std::sqrt(squaredLength(from.metric, e)),
                              std::sqrt(squaredLength(to.metric, e)));
}

double AdaptMesh::qualityOf(const NodeQuad& corners) const {
  const std::array<const AdaptNode*, 4> at{&node(corners[0]), &node(corners[1]), &node(corners[2]),
                                           &node(corners[3])};
  const Vec3 ab = at[1]->point - at[0]->point;
  const Vec3 ac = at[2]->point - at[0]->point;
  const Vec3 ad = at[3]->point - at[0]->point;
  const double volume = glm::dot(ad, glm::cross(ab, ac));
  const double product = glm::dot(ab, ab) * glm::dot(ac, ac) * glm::dot(ad, ad);
  if (volume * std::fabs(volume) <= kSignRounding * kSignRounding * product) return -1.0;
  const SymmetricTensor edges = sumOfSquares(ab, ac, ad);
  // Where corners tie, neither rounding nor interpolation must decide: the worst of them counts.
  constexpr double kTie = 1.0 - 1e-9;
  double largest = 0.0;
  for (const AdaptNode* corner : at)
    largest = std::max(largest, kTie * (1.0 - corner->doubt) * corner->density);
  double least = 2.0;
  for (const AdaptNode* corner : at) {
    if ((1.0 + corner->doubt) * corner->density < largest) continue;
    const SymmetricTensor& m = corner->metric;
    const double squares = m.xx * edges.xx + m.yy * edges.yy + m.zz * edges.zz +
                           2.0 * (m.xy * edges.xy + m.xz * edges.xz + m.yz * edges.yz);
    const double root = quickCubeRoot(volume * corner->density * kRegular);
    least = std::min(least, 6.0 * root * root / squares);
  }
  return least;
}

void AdaptMesh::findBall(NodeId node, std::vector<TetId>& ball) {
  seen_.clear(elements.size());
  ball.clear();
  ball.push_back(this->node(node).element);
  seen_.mark(ball[0].index());
  for (std::size_t i = 0; i < ball.size(); ++i) {
    const AdaptElement& at = element(ball[i]);
    for (std::size_t k = 0; k < 4; ++k) {
      if (at.nodes[k] == node || !at.beyond[k].isElement()) continue;
      const TetId next = at.beyond[k].element();
      if (seen_.mark(next.index())) ball.push_back(next);
    }
  }
}

void AdaptMesh::walkShell(NodeId a, NodeId b, TetId first, NodeId leave, bool isSecond,
                          Shell& shell) const {
  TetId at = first;
  for (;;) {
    const AdaptElement& here = element(at);
    const Beyond beyond = here.beyond[here.cornerOf(leave)];
    if (!beyond.isElement()) {
      shell.isInside = false;
      shell.ends[isSecond ? 1 : 0] = beyond;
      return;
    }
    if (beyond.element() == first) return;
    for (const NodeId other : here.nodes) {
      if (other != a && other != b && other != leave) {
        leave = other;
        break;
      }
    }
    at = beyond.element();
    shell.elements.push_back(at);
  }
}

void AdaptMesh::findShell(NodeId a, NodeId b, TetId first, Shell& shell) const {
  shell.elements.assign(1, first);
  shell.isInside = true;
  std::array<NodeId, 2> others{};
  std::size_t count = 0;
  for (const NodeId other : element(first).nodes) {
    if (other != a && other != b) others[count++] = other;
  }
  walkShell(a, b, first, others[0], false, shell);
  if (!shell.isInside) walkShell(a, b, first, others[1], true, shell);
}

TetId AdaptMesh::findEdge(NodeId a, NodeId b, TetId hint) {
  if (!hint.isNone() && element(hint).isAlive() && element(hint).has(a) && element(hint).has(b))
    return hint;
  if (node(a).element.isNone() || node(b).element.isNone()) return {};
  findBall(a, ball_);
  for (const TetId id : ball_) {
    if (element(id).has(b)) return id;
  }
  return {};
}

void AdaptMesh::touch(std::span<const TetId> ids) {
  ++now;
  for (const TetId id : ids) {
    for (const NodeId corner : element(id).nodes) node(corner).changed = now;
  }
}

}  // namespace tetrafront
