#include "curved/untangling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geom/predicates.h"
#include "tetrafront/second_order.h"

namespace tetrafront {
namespace {

constexpr int kMiddleSweeps = 10;
constexpr int kCornerSweeps = 5;
/// Smallest gain of the least scaled Jacobian around a node for which the node is moved: a smaller one, of values up to 1, is not
/// worth the elements that must be measured again.
constexpr double kMinGain = 1e-3;
/// An element with a smaller scaled Jacobian is not proven to be valid.
constexpr double kSmallestValid = std::numeric_limits<double>::min();
/// Units of work of moving the nodes of an element.
constexpr std::size_t kUnitsPerElement = 200;

bool hasNode(const NodeQuad& nodes, NodeId node) {
  return std::ranges::find(nodes, node) != nodes.end();
}

double linearJacobian(const QuadraticTet& tet) {
  const auto& [a, b, c, d] = tet.corners;
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

}  // namespace

Task<> Untangling::run(Work& work) {
  work.beginPart(0.5);
  co_await improveMiddles(work);
  work.beginPart(0.7);
  co_await moveCorners(work);
  work.beginPart(0.9);
  co_await straighten(work);
  work.beginPart(1.0);
  co_await improveMiddles(work);
}

std::vector<TetId> Untangling::elementsBelow(double limit) const {
  std::vector<TetId> found;
  for (std::size_t t = 0; t < curved_.scaled.size(); ++t) {
    if (curved_.scaled[t] < limit) found.emplace_back(t);
  }
  return found;
}

Task<> Untangling::improveMiddles(Work& work) {
  for (int sweep = 0; sweep < kMiddleSweeps; ++sweep) {
    bool isChanged = false;
    const std::vector<TetId> poor = elementsBelow(kGoodScaledJacobian);
    for (const TetId tet : poor) {
      isChanged = improveMiddlesOf(tet) || isChanged;
      co_await work.spend(kUnitsPerElement);
    }
    if (!isChanged) break;
  }
}

Task<> Untangling::moveCorners(Work& work) {
  for (int sweep = 0; sweep < kCornerSweeps; ++sweep) {
    bool isChanged = false;
    const std::vector<TetId> invalid = elementsBelow(kSmallestValid);
    for (const TetId tet : invalid) {
      isChanged = improveCornersOf(tet) || isChanged;
      isChanged = improveMiddlesOf(tet) || isChanged;
      co_await work.spend(2 * kUnitsPerElement);
    }
    if (!isChanged) break;
  }
}

Task<> Untangling::straighten(Work& work) {
  // Each step makes one more edge straight for good.
  std::vector<TetId> invalid = elementsBelow(kSmallestValid);
  for (std::size_t next = 0; next < invalid.size(); ++next) {
    const TetId tet = invalid[next];
    while (curved_.scaled[tet.index()] < kSmallestValid) {
      straightenBestOf(tet, invalid);
      improveMiddlesOf(tet);
      co_await work.spend(2 * kUnitsPerElement);
    }
  }
}

bool Untangling::improveMiddlesOf(TetId tet) {
  bool isChanged = false;
  const NodeQuad nodes = nodesOf(curved_.mesh(), tet);
  for (std::size_t e = 0; e < 6 && curved_.scaled[tet.index()] < kGoodScaledJacobian; ++e) {
    const EdgeEnds edge = endsOf(nodes, e);
    const MiddleNode* middle = curved_.middles.find(edge.low, edge.high);
    if (middle != nullptr && middle->isFixed) continue;
    isChanged = improve({.edge = edge, .corner = NodeId()}) || isChanged;
  }
  return isChanged;
}

bool Untangling::improveCornersOf(TetId tet) {
  bool isChanged = false;
  for (const NodeId node : nodesOf(curved_.mesh(), tet)) {
    if (isFixed_[node.index()] != 0) continue;
    if (curved_.scaled[tet.index()] >= kGoodScaledJacobian) break;
    isChanged = improve({.edge = {}, .corner = node}) || isChanged;
  }
  return isChanged;
}

/// Moves a node to where the elements around it are better; false if there is no such place.
bool Untangling::improve(const Movable& movable) {
  gatherElements(movable);
  double before = 1.0;
  double unit = std::numeric_limits<double>::infinity();
  for (const TetId tet : around_) {
    before = std::min(before, curved_.scaled[tet.index()]);
    const auto [a, b, c, d] = cornersOf(curved_.mesh(), tet);
    for (const Vec3& other : {b, c, d}) unit = std::min(unit, glm::length(other - a));
  }
  gatherCoefficients(movable, unit);
  save(movable);
  Vec3 step = unit * raisingStep(coefficients_);
  constexpr int kTries = 3;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    if (step == Vec3(0.0)) return false;
    move(movable, step);
    if (areValidWhenStraight() && areBetter(before)) {
      for (std::size_t i = 0; i < around_.size(); ++i) {
        curved_.scaled[around_[i].index()] = measuredAround_[i];
      }
      if (!movable.corner.isNone()) movedNodes_.push_back(movable.corner);
      return true;
    }
    restore(movable);
    step *= 0.5;
  }
  return false;
}

void Untangling::gatherElements(const Movable& movable) {
  around_.clear();
  const NodeId node = movable.corner.isNone() ? movable.edge.low : movable.corner;
  for (const TetId tet : elements_.at(node)) {
    const bool isAround =
        !movable.corner.isNone() || hasNode(nodesOf(curved_.mesh(), tet), movable.edge.high);
    if (isAround && curved_.isInverted[tet.index()] == 0) around_.push_back(tet);
  }
}

/// Coefficients as functions of the displacement divided by `unit`.
void Untangling::gatherCoefficients(const Movable& movable, double unit) {
  coefficients_.clear();
  for (const TetId tet : around_) {
    const QuadraticTet now = curved_.tetAt(tet);
    const NodeQuad nodes = nodesOf(curved_.mesh(), tet);
    const double linear = linearJacobian(now);
    if (!(linear > 0.0)) continue;
    const JacobianPolynomial values = jacobianOf(now);
    std::array<JacobianPolynomial, 3> moved;
    for (int k = 0; k < 3; ++k) {
      Vec3 step{0.0};
      step[k] = unit;
      moved[k] = jacobianOf(displaced(now, nodes, movable, step));
    }
    for (std::size_t c = 0; c < kJacobianCoefficients; ++c) {
      const double value = values.coefficients[c];
      Vec3 gradient{0.0};
      for (int k = 0; k < 3; ++k) gradient[k] = (moved[k].coefficients[c] - value) / linear;
      coefficients_.push_back({value / linear, gradient});
    }
  }
}

QuadraticTet Untangling::displaced(QuadraticTet tet, const NodeQuad& nodes, const Movable& movable,
                                   const Vec3& step) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (nodes[i] == movable.corner) tet.corners[i] += step;
  }
  for (std::size_t e = 0; e < 6; ++e) {
    const EdgeEnds ends = endsOf(nodes, e);
    if (ends == movable.edge) tet.middles[e] += step;
    if (ends.low == movable.corner || ends.high == movable.corner) tet.middles[e] += 0.5 * step;
  }
  return tet;
}

/// Keeps what move() changes.
void Untangling::save(const Movable& movable) {
  savedMiddles_.clear();
  if (movable.corner.isNone()) {
    MiddleNode middle{.ends = movable.edge, .position = curved_.middleOf(movable.edge)};
    const MiddleNode* known = curved_.middles.find(movable.edge.low, movable.edge.high);
    middle.isStraight = known == nullptr || known->isStraight;
    savedMiddles_.push_back(middle);
    return;
  }
  savedCorner_ = curved_.pointAt(movable.corner);
  for (const TetId tet : elements_.at(movable.corner)) {
    for (const NodeId other : nodesOf(curved_.mesh(), tet)) {
      if (other == movable.corner) continue;
      const MiddleNode* middle = curved_.middles.find(movable.corner, other);
      if (middle == nullptr || middle->isStraight) continue;
      const bool isNew = std::ranges::none_of(
          savedMiddles_, [middle](const MiddleNode& saved) { return saved.ends == middle->ends; });
      if (isNew) savedMiddles_.push_back(*middle);
    }
  }
}

/// Moves by `step` from what was saved. Straight edges follow their corners.
void Untangling::move(const Movable& movable, const Vec3& step) {
  const bool isCorner = !movable.corner.isNone();
  if (isCorner) curved_.movePoint(movable.corner, savedCorner_ + step);
  for (const MiddleNode& saved : savedMiddles_) {
    MiddleNode& middle = curved_.middles.at(saved.ends.low, saved.ends.high);
    middle.position = saved.position + (isCorner ? 0.5 : 1.0) * step;
    middle.isStraight = false;
  }
}

void Untangling::restore(const Movable& movable) {
  if (!movable.corner.isNone()) curved_.movePoint(movable.corner, savedCorner_);
  for (const MiddleNode& saved : savedMiddles_) {
    curved_.middles.at(saved.ends.low, saved.ends.high) = saved;
  }
}

bool Untangling::areValidWhenStraight() const {
  return std::ranges::all_of(around_, [this](TetId tet) {
    const auto [a, b, c, d] = cornersOf(curved_.mesh(), tet);
    return orient3d(a, b, c, d) > 0;
  });
}

/// Measures the elements that change. Whether the least scaled Jacobian has grown from `before`, and no element has become invalid.
bool Untangling::areBetter(double before) {
  if (!(measureAround() > before + kMinGain)) return false;
  for (std::size_t i = 0; i < around_.size(); ++i) {
    const bool wasValid = curved_.scaled[around_[i].index()] >= kSmallestValid;
    if (wasValid && measuredAround_[i] < kSmallestValid) return false;
  }
  return true;
}

/// Measures the elements that change, and returns the least scaled Jacobian.
double Untangling::measureAround() {
  measuredAround_.clear();
  for (const TetId tet : around_) measuredAround_.push_back(curved_.measured(tet));
  return *std::ranges::min_element(measuredAround_);
}

/// Straightens the given edge of an invalid element after which the elements around it are best; all its edges if no given one is
/// left.
void Untangling::straightenBestOf(TetId tet, std::vector<TetId>& invalid) {
  const NodeQuad nodes = nodesOf(curved_.mesh(), tet);
  double best = -std::numeric_limits<double>::infinity();
  EdgeEnds bestEdge;
  for (std::size_t e = 0; e < 6; ++e) {
    const EdgeEnds edge = endsOf(nodes, e);
    MiddleNode* middle = curved_.middles.find(edge.low, edge.high);
    if (middle == nullptr || !middle->isFixed || middle->isStraight) continue;
    gatherElements({.edge = edge, .corner = NodeId()});
    middle->isStraight = true;
    const double least = measureAround();
    middle->isStraight = false;
    if (least > best) {
      best = least;
      bestEdge = edge;
    }
  }
  if (!bestEdge.low.isNone()) {
    straightenFor(bestEdge, invalid);
    return;
  }
  for (std::size_t e = 0; e < 6; ++e) {
    const EdgeEnds edge = endsOf(nodes, e);
    const MiddleNode* middle = curved_.middles.find(edge.low, edge.high);
    if (middle != nullptr && !middle->isStraight) straightenFor(edge, invalid);
  }
}

/// Straightens an edge for good, and adds elements that are invalid because of it.
void Untangling::straightenFor(const EdgeEnds& edge, std::vector<TetId>& invalid) {
  MiddleNode& middle = curved_.middles.at(edge.low, edge.high);
  middle.isStraight = true;
  middle.isStraightened = middle.isFixed;
  middle.isFixed = true;
  gatherElements({.edge = edge, .corner = NodeId()});
  for (const TetId tet : around_) {
    double& scaled = curved_.scaled[tet.index()];
    const bool wasValid = scaled >= kSmallestValid;
    scaled = curved_.measured(tet);
    if (wasValid && scaled < kSmallestValid) invalid.push_back(tet);
  }
}

}  // namespace tetrafront
