#include "optimize/node_moves.h"

#include <algorithm>
#include <cmath>

#include "field/size_tensor.h"
#include "optimize/rules.h"

namespace tetrafront {
namespace {

double lengthOf(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

/// Returns the sum of the eighth powers of all elements' costs, in units of `scale`; kInvalidCost
/// as soon as `bound` is reached.
template <class Space>
double sumOfPowers(const Hollow<Space>& hollow, const ElementCost<Space>& cost, const Vec3& apex,
                   double scale, double bound) {
  double sum = 0.0;
  for (std::size_t i = 0; i < hollow.size(); ++i) {
    const double one = hollow.costOf(i, apex, cost) / scale;
    const double fourth = one * one * one * one;
    sum += fourth * fourth;
    if (!(sum < bound)) return kInvalidCost;
  }
  return sum;
}

/// Returns the shortest vector in the convex hull of the gradients (Frank & Wolfe 1956): all of
/// them descend against it.
Vec3 shortestInHull(const std::array<Vec3, kMaxGradients>& gradients, std::size_t count) {
  constexpr int kIterations = 40;
  constexpr double kClose = 1e-6;
  Vec3 z = gradients[0];
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::size_t least = 0;
    for (std::size_t i = 1; i < count; ++i) {
      if (glm::dot(z, gradients[i]) < glm::dot(z, gradients[least])) least = i;
    }
    const double square = glm::dot(z, z);
    const double gap = square - glm::dot(z, gradients[least]);
    if (gap <= kClose * square) break;
    const Vec3 towards = z - gradients[least];
    z -= towards * std::min(1.0, gap / glm::dot(towards, towards));
  }
  return z;
}

}  // namespace

template <class Space>
double Hollow<Space>::costAt(const Vec3& apex, const ElementCost<Space>& cost, double bound) {
  // If the worst element decides, first test the one that exceeded the bound last time: it is the
  // most likely to do so again.
  if (cost.measure() == Measure::kDihedral && costOf(suspect_, apex, cost) >= bound) {
    return kInvalidCost;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < size_; ++i) {
    const double one = costOf(i, apex, cost);
    costs_[i] = one;
    sum = cost.combined(sum, one);
    if (one >= kInvalidCost || sum >= bound) {
      suspect_ = i;
      return kInvalidCost;
    }
  }
  return sum;
}

template <class Space>
double Hollow<Space>::meanRadius(const Vec3& apex, const Frame& frame) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size_; ++i) {
    sum += lengthOf(Space::toUnit(frame, faces_[i][0] - apex));
  }
  return sum / static_cast<double>(size_);
}

template <class Space>
Vec3 circumcentreMean(const Hollow<Space>& hollow, const Vec3& apex) {
  Vec3 sum(0.0);
  double volumes = 0.0;
  for (std::size_t i = 0; i < hollow.size(); ++i) {
    const auto& frame = hollow.frame(i);
    const Vec3 u = Space::toUnit(frame, hollow.face(i)[0] - apex);
    const Vec3 v = Space::toUnit(frame, hollow.face(i)[1] - apex);
    const Vec3 w = Space::toUnit(frame, hollow.face(i)[2] - apex);
    const Vec3 vw = glm::cross(v, w);
    // The circumcentre relative to the apex, times the volume.
    const Vec3 centre = (vw * glm::dot(u, u) + glm::cross(w, u) * glm::dot(v, v) +
                         glm::cross(u, v) * glm::dot(w, w)) *
                        0.5;
    sum += Space::toSpace(Space::backFrom(frame), centre);
    volumes += glm::dot(u, vw);
  }
  return volumes > 0.0 ? apex + sum * (1.0 / volumes) : apex;
}

template <class Space>
bool newtonStep(const Hollow<Space>& hollow, const Vec3& apex, bool squareRoot, Vec3& step) {
  const double power = squareRoot ? 0.5 : 1.0;
  Vec3 gradient(0.0);
  SymmetricTensor hessian = SymmetricTensor::isotropic(0.0);
  for (std::size_t i = 0; i < hollow.size(); ++i) {
    const auto& frame = hollow.frame(i);
    const auto& [a, b, c] = hollow.face(i);
    const Vec3 ab = Space::toUnit(frame, b - a);
    const Vec3 ac = Space::toUnit(frame, c - a);
    const Vec3 bc = Space::toUnit(frame, c - b);
    const Vec3 pa = Space::toUnit(frame, apex - a);
    const Vec3 pb = Space::toUnit(frame, apex - b);
    const Vec3 pc = Space::toUnit(frame, apex - c);
    const Vec3 normal = glm::cross(ac, ab);
    const double volume = glm::dot(normal, pa);
    if (!(volume > 0.0)) return false;
    const double squares = glm::dot(pa, pa) + glm::dot(pb, pb) + glm::dot(pc, pc) +
                           glm::dot(ab, ab) + glm::dot(ac, ac) + glm::dot(bc, bc);
    const double e = squares * squares * squares / (432.0 * volume * volume);
    const double weight = squareRoot ? std::sqrt(e) : e;
    // Gradients with respect to the position: those of unit space, mapped through T (which is
    // symmetric).
    const Vec3 s =
        Space::toUnit(frame, (pa + pb + pc) * (2.0 / squares));    // gradient of log(squares)
    const Vec3 n = Space::toUnit(frame, normal * (1.0 / volume));  // gradient of log(volume)
    const Vec3 w = s * 3.0 - n * 2.0;                              // gradient of log(e)
    gradient += w * weight;
    const double k = 18.0 / squares;
    double kx = k;
    double ky = k;
    double kz = k;
    if constexpr (Space::kIsStretched) {
      // The second derivative of the squares is 6 T^2.
      const SymmetricTensor square = frame.squared();
      kx = k * square.xx;
      ky = k * square.yy;
      kz = k * square.zz;
      hessian.xy += weight * k * square.xy;
      hessian.xz += weight * k * square.xz;
      hessian.yz += weight * k * square.yz;
    }
    hessian.xx += weight * (power * w.x * w.x + kx - 3.0 * s.x * s.x + 2.0 * n.x * n.x);
    hessian.yy += weight * (power * w.y * w.y + ky - 3.0 * s.y * s.y + 2.0 * n.y * n.y);
    hessian.zz += weight * (power * w.z * w.z + kz - 3.0 * s.z * s.z + 2.0 * n.z * n.z);
    hessian.xy += weight * (power * w.x * w.y - 3.0 * s.x * s.y + 2.0 * n.x * n.y);
    hessian.xz += weight * (power * w.x * w.z - 3.0 * s.x * s.z + 2.0 * n.x * n.z);
    hessian.yz += weight * (power * w.y * w.z - 3.0 * s.y * s.z + 2.0 * n.y * n.z);
  }
  if (!(hessian.determinant() > 0.0)) return false;
  step = hessian.inverse() * gradient * -1.0;
  return glm::dot(step, gradient) < 0.0;
}

/// State of a descent: position, value there, and the largest next step.
struct Descent {
  Vec3& position;
  double& value;
  double& reach;
};

/// Makes one step along `down`, in the unit space of the first element: halves it until the value
/// falls, and continues while it falls further. Returns false, and changes nothing, if it does not
/// fall.
template <class Space, class ValueAt>
bool descend(Hollow<Space>& hollow, const Vec3& down, double maxReach, ValueAt valueAt,
             const Descent& at) {
  constexpr int kTries = 9;
  const auto& frame = hollow.frame(0);
  const auto back = Space::backFrom(frame);
  const double before = at.value;
  Vec3 best = at.position;
  double length = at.reach;
  for (int i = 0; i < kTries; ++i, length *= 0.5) {
    const Vec3 position = at.position + Space::toSpace(back, down * length);
    const double there = valueAt(position);
    if (there < at.value) {
      at.value = there;
      best = position;
    } else if (at.value < before) {
      break;
    }
  }
  if (!(at.value < before)) return false;
  at.reach =
      std::min(maxReach, 2.0 * lengthOf(Space::toUnit(frame, best - at.position)) + 4.0 * length);
  at.position = best;
  return true;
}

template <class Space>
bool lowerWorst(Hollow<Space>& hollow, const ElementCost<Space>& cost, int steps, Vec3& apex,
                double& worst) {
  constexpr double kBand = 0.85;  // include elements within 15 % of the worst
  constexpr double kFirstStep = 0.2;
  constexpr double kWorthwhile = 1e-3;
  // Steps are measured in the unit space of any of the elements.
  const auto& frame = hollow.frame(0);
  const auto back = Space::backFrom(frame);
  const double radius = hollow.meanRadius(apex, frame);
  double reach = kFirstStep * radius;
  bool fell = false;
  for (int step = 0; step < steps; ++step) {
    const double before = hollow.costAt(apex, cost, kInvalidCost);
    if (before >= kInvalidCost) return fell;
    worst = before;
    std::array<Vec3, kMaxGradients> gradients;
    std::size_t count = 0;
    for (std::size_t i = 0; i < hollow.size() && count < kMaxGradients; ++i) {
      if (hollow.lastCostOf(i) < kBand * before) continue;
      gradients[count++] = Space::toSpace(back, hollow.slopeOf(i, apex, cost).gradient);
    }
    const Vec3 up = shortestInHull(gradients, count);
    const double slope = lengthOf(up);
    if (!(slope > 0.0) || !std::isfinite(slope)) return fell;
    const auto costAt = [&](const Vec3& position) { return hollow.costAt(position, cost, worst); };
    if (!descend(hollow, up * (-1.0 / slope), kFirstStep * radius, costAt, {apex, worst, reach})) {
      return fell;
    }
    fell = true;
    if (worst > before * (1.0 - kWorthwhile)) return fell;
  }
  return fell;
}

template <class Space>
bool lowerPowers(Hollow<Space>& hollow, const ElementCost<Space>& cost, int steps, Vec3& apex) {
  constexpr double kFirstStep = 0.2;
  const auto& frame = hollow.frame(0);
  const auto back = Space::backFrom(frame);
  const double radius = hollow.meanRadius(apex, frame);
  double reach = kFirstStep * radius;
  // In units of the worst cost, so that no power of a valid cost reaches kInvalidCost.
  const double worst = hollow.costAt(apex, cost, kInvalidCost);
  if (!(worst > 0.0) || worst >= kInvalidCost) return false;
  double here = sumOfPowers(hollow, cost, apex, worst, kInvalidCost);
  bool fell = false;
  for (int step = 0; step < steps && here < kInvalidCost; ++step) {
    Vec3 up(0.0);
    for (std::size_t i = 0; i < hollow.size(); ++i) {
      const auto [own, gradient] = hollow.slopeOf(i, apex, cost);
      const double one = own / worst;
      const double third = one * one * one;
      up += gradient * (third * third * one);
    }
    up = Space::toSpace(back, up);
    const double slope = lengthOf(up);
    if (!(slope > 0.0) || !std::isfinite(slope)) return fell;
    const auto sumAt = [&](const Vec3& position) {
      return sumOfPowers(hollow, cost, position, worst, here);
    };
    if (!descend(hollow, up * (-1.0 / slope), kFirstStep * radius, sumAt, {apex, here, reach})) {
      return fell;
    }
    fell = true;
  }
  return fell;
}

template <class Space>
bool NodeMover<Space>::improve(NodeId node, MoveKind kind, const ElementCost<Space>& cost) {
  if (complex_.isFixed(node) || !complex_.isUsed(node) || !complex_.findStar(node, star_)) {
    return false;
  }
  hollow_.clear();
  double old = 0.0;
  for (std::size_t i = 0; i < star_.size; ++i) {
    const Element& element = complex_.element(star_.elements[i]);
    const auto& side = kFaceCorners[star_.corner[i]];
    hollow_.add(complex_.position(element.nodes[side[0]]),
                complex_.position(element.nodes[side[1]]),
                complex_.position(element.nodes[side[2]]), complex_.frameOf<Space>(element.nodes));
    old = cost.combined(old, complex_.cost(star_.elements[i]));
  }
  Vec3 position = complex_.position(node);
  if (kind == MoveKind::kLowerWorst) {
    constexpr int kSteps = 5;
    constexpr double kWorthwhile = 1e-4;
    double worst = old;
    if (!lowerWorst(hollow_, cost, kSteps, position, worst)) return false;
    if (hollow_.costAt(position, cost, kInvalidCost) >= old * (1.0 - kWorthwhile)) return false;
    accept(node, position);
    return true;
  }
  if (kind == MoveKind::kLowerPowers) {
    constexpr int kSteps = 3;
    if (!lowerPowers(hollow_, cost, kSteps, position)) return false;
    if (hollow_.costAt(position, cost, kInvalidCost) >= kInvalidCost) return false;
    accept(node, position);
    return true;
  }
  Vec3 direction(0.0);
  if (kind == MoveKind::kCircumcentres) {
    direction = circumcentreMean(hollow_, position) - position;
  } else if (!newtonStep(hollow_, position, cost.measure() != Measure::kFinish, direction)) {
    return false;
  }
  if (!stepAlong(direction, cost, old, position)) return false;
  accept(node, position);
  return true;
}

/// Tries the step and its halves until the cost falls.
template <class Space>
bool NodeMover<Space>::stepAlong(const Vec3& direction, const ElementCost<Space>& cost, double old,
                                 Vec3& position) {
  const auto& frame = hollow_.frame(0);
  const double edge = lengthOf(Space::toUnit(frame, hollow_.face(0)[0] - position));
  if (!(lengthOf(Space::toUnit(frame, direction)) >= kMinNodeMove * edge)) return false;
  const double bound = old * (1.0 - kMinMoveGain);
  double step = 1.0;
  for (int i = 0; i < kMoveHalvings; ++i, step *= 0.5) {
    const Vec3 tried = position + direction * step;
    if (hollow_.costAt(tried, cost, bound) >= bound) continue;
    position = tried;
    return true;
  }
  return false;
}

/// Sets the position and the costs that the cavity computed last, which must be those at that
/// position. Marks elements as changed if their cost moved by a tenth, and stars if the move was
/// longer than a small fraction of an edge; the rest need no second visit.
template <class Space>
void NodeMover<Space>::accept(NodeId node, const Vec3& position) {
  constexpr double kCostChange = 0.1;
  const Vec3 old = complex_.position(node);
  const auto& frame = hollow_.frame(0);
  const double edge = lengthOf(Space::toUnit(frame, hollow_.face(0)[0] - old));
  const bool far = lengthOf(Space::toUnit(frame, position - old)) > kChangingMove * edge;
  complex_.move(node, position);
  for (std::size_t i = 0; i < star_.size; ++i) {
    const TetId tet = star_.elements[i];
    const double before = complex_.cost(tet);
    const double now = hollow_.lastCostOf(i);
    complex_.setCost(tet, now);
    if (std::fabs(now - before) > kCostChange * (before + kCostChange)) complex_.markChanged(tet);
    if (far) complex_.markStars(tet);
  }
}

template class Hollow<PlainSpace>;
template class Hollow<StretchedSpace>;
template Vec3 circumcentreMean(const Hollow<PlainSpace>&, const Vec3&);
template Vec3 circumcentreMean(const Hollow<StretchedSpace>&, const Vec3&);
template bool newtonStep(const Hollow<PlainSpace>&, const Vec3&, bool, Vec3&);
template bool newtonStep(const Hollow<StretchedSpace>&, const Vec3&, bool, Vec3&);
template bool lowerWorst(Hollow<PlainSpace>&, const ElementCost<PlainSpace>&, int, Vec3&, double&);
template bool lowerWorst(Hollow<StretchedSpace>&, const ElementCost<StretchedSpace>&, int, Vec3&,
                         double&);
template bool lowerPowers(Hollow<PlainSpace>&, const ElementCost<PlainSpace>&, int, Vec3&);
template bool lowerPowers(Hollow<StretchedSpace>&, const ElementCost<StretchedSpace>&, int, Vec3&);
template class NodeMover<PlainSpace>;
template class NodeMover<StretchedSpace>;

}  // namespace tetrafront
