/// Compares the crossing test with an independent oracle: the triangle is clipped by the element's
/// four half-spaces in exact integer arithmetic (homogeneous coordinates), and the result is
/// compared with what they share.

#include "volume/crossing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "support/random.h"

namespace tetrafront {
namespace {

__extension__ using Wide = __int128;
using Integers = std::array<Wide, 3>;

/// The position x/w y/w z/w with w > 0.
struct Homogeneous {
  Integers x;
  Wide w;
};

struct Plane {
  Integers normal;
  Wide offset;
  [[nodiscard]] Wide at(const Homogeneous& p) const {
    return normal[0] * p.x[0] + normal[1] * p.x[1] + normal[2] * p.x[2] - offset * p.w;
  }
};

Integers minus(const Integers& a, const Integers& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Integers cross(const Integers& a, const Integers& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Wide dot(const Integers& a, const Integers& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Plane planeThrough(const Integers& a, const Integers& b, const Integers& c) {
  const Integers normal = cross(minus(b, a), minus(c, a));
  return {normal, dot(normal, a)};
}

std::vector<Homogeneous> clip(const std::vector<Homogeneous>& polygon, const Plane& plane) {
  std::vector<Homogeneous> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Homogeneous& p = polygon[i];
    const Homogeneous& q = polygon[(i + 1) % polygon.size()];
    const Wide atP = plane.at(p);
    const Wide atQ = plane.at(q);
    if (atP >= 0) kept.push_back(p);
    if ((atP > 0 && atQ < 0) || (atP < 0 && atQ > 0)) {
      // Weight p and q so that the plane's value vanishes; both weights are positive.
      const Wide s = atP > 0 ? atP : -atP;
      const Wide t = atQ > 0 ? atQ : -atQ;
      Homogeneous cut{};
      for (int k = 0; k < 3; ++k) cut.x[k] = t * p.x[k] + s * q.x[k];
      cut.w = t * p.w + s * q.w;
      kept.push_back(cut);
    }
  }
  return kept;
}

bool onSegment(const Homogeneous& p, const Integers& a, const Integers& b) {
  Integers ap{};
  for (int k = 0; k < 3; ++k) ap[k] = p.x[k] - a[k] * p.w;
  const Integers area = cross(ap, minus(b, a));
  return area[0] == 0 && area[1] == 0 && area[2] == 0;
}

bool equals(const Homogeneous& p, const Integers& a) {
  return p.x[0] == a[0] * p.w && p.x[1] == a[1] * p.w && p.x[2] == a[2] * p.w;
}

/// Returns true if element and triangle have points in common other than those they share. Both
/// index `points`.
bool oracle(const std::vector<Integers>& points, const std::array<int, 4>& element,
            const std::array<int, 3>& face) {
  std::vector<Homogeneous> rest;
  for (const int corner : face) rest.push_back({points[corner], 1});
  constexpr std::array<std::array<int, 3>, 4> kInwardFaces{
      {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
  for (const auto& inward : kInwardFaces) {
    rest = clip(rest, planeThrough(points[element[inward[0]]], points[element[inward[1]]],
                                   points[element[inward[2]]]));
  }
  std::vector<int> shared;
  for (const int corner : face) {
    if (std::find(element.begin(), element.end(), corner) != element.end()) {
      shared.push_back(corner);
    }
  }
  if (shared.size() == 3) return false;
  return std::any_of(rest.begin(), rest.end(), [&](const Homogeneous& p) {
    if (shared.empty()) return true;
    if (shared.size() == 1) return !equals(p, points[shared[0]]);
    return !onSegment(p, points[shared[0]], points[shared[1]]);
  });
}

Wide sixVolumes(const std::vector<Integers>& points, const std::array<int, 4>& t) {
  const Integers& a = points[t[0]];
  return dot(cross(minus(points[t[1]], a), minus(points[t[2]], a)), minus(points[t[3]], a));
}

/// Returns the engine's answer, with or without its filters, for a front with the base and the
/// face.
bool engineAnswer(const std::vector<Integers>& points, const std::array<int, 4>& element,
                  const std::array<int, 3>& face, bool filters) {
  Front front(1.0, Vec3(0.0), FrontOrder::kLayered);
  for (const Integers& p : points) {
    front.addNode({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])},
                  0);
  }
  const auto id = [](int i) { return NodeId(static_cast<std::uint32_t>(i)); };
  const NodeTriple base{id(element[0]), id(element[1]), id(element[2])};
  front.addFace(base, 0, {}, false);
  front.addFace({id(face[0]), id(face[1]), id(face[2])}, 0, {}, false);
  const UnitSpace space = UnitSpace::plain(1.0);
  const SearchRegion everything(space,
                                {front.node(base[0]), front.node(base[1]), front.node(base[2])},
                                Vec3(0.0), 100.0, front.extent());
  Neighbourhood around;
  around.gather(front, base, everything, front.node(id(element[3])));
  CrossingTest test(around, filters);
  test.setBase();
  constexpr LocalNode kUnknown = 0xffffffffU;
  LocalNode apex = kUnknown;
  for (LocalNode i = 3; i < around.nodeCount(); ++i) {
    if (around.nodeId(i) == id(element[3])) apex = i;
  }
  if (apex == kUnknown) apex = around.setNewNode(front.node(id(element[3])));
  EXPECT_GT(test.volumeSign(apex), 0);
  test.setApex(apex);
  return !test.firstCrossedFace().isNone();
}

/// Tests random elements and faces over a small integer grid, where all kinds of contact are
/// frequent.
void compare(int sharedCount, int range, int rounds, std::uint64_t seed) {
  testing::Random random(seed);
  int crossings = 0;
  int tested = 0;
  while (tested < rounds) {
    std::vector<Integers> points;
    for (int i = 0; i < 7; ++i) {
      const int x = random.integer(-range, range);
      const int y = random.integer(-range, range);
      points.push_back({x, y, random.integer(-range, range)});
    }
    std::array<int, 4> element{0, 1, 2, 3};
    if (sixVolumes(points, element) == 0) continue;
    if (sixVolumes(points, element) < 0) std::swap(element[1], element[2]);
    std::array<int, 3> face{4, 5, 6};
    std::array<int, 4> corners{0, 1, 2, 3};
    for (int i = 0; i < sharedCount; ++i) {
      std::swap(corners[i], corners[random.integer(i, 3)]);
      face[i] = corners[i];
    }
    for (int i = 0; i < 3; ++i) std::swap(face[i], face[random.integer(i, 2)]);
    const Integers normal =
        cross(minus(points[face[1]], points[face[0]]), minus(points[face[2]], points[face[0]]));
    if (normal == Integers{0, 0, 0}) continue;
    const bool expected = oracle(points, element, face);
    for (const bool filters : {true, false}) {
      ASSERT_EQ(engineAnswer(points, element, face, filters), expected)
          << "seed " << seed << " case " << tested << " shared " << sharedCount << " filters "
          << filters;
    }
    crossings += expected ? 1 : 0;
    ++tested;
  }
  // Both answers must occur often, or the test would prove little.
  EXPECT_GT(crossings, rounds / 20);
  EXPECT_LT(crossings, rounds - rounds / 20);
}

TEST(CrossingTest, DecidesFacesApartAsExactClippingDoes) {
  compare(0, 2, 20000, 11);
  compare(0, 9, 20000, 12);
}
TEST(CrossingTest, DecidesFacesAtACommonNodeAsExactClippingDoes) {
  compare(1, 2, 20000, 21);
  compare(1, 9, 20000, 22);
}
TEST(CrossingTest, DecidesFacesAtACommonEdgeAsExactClippingDoes) {
  compare(2, 2, 20000, 31);
  compare(2, 9, 20000, 32);
}

TEST(CrossingTest, AllowsFacesOfTheElement) {
  const std::vector<Integers> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const bool filters : {true, false}) {
    EXPECT_FALSE(engineAnswer(points, {0, 1, 2, 3}, {1, 0, 3}, filters));
    EXPECT_FALSE(engineAnswer(points, {0, 1, 2, 3}, {3, 1, 2}, filters));
  }
}

}  // namespace
}  // namespace tetrafront
