#include "arrangement/planar_triangulation.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

namespace tetrafront {

PlanarTriangulation::PlanarTriangulation(const CutPoints& points, const CutView& view,
                                         const std::array<CutPointId, 3>& corners)
    : points_(points), view_(view), vertices_(corners.begin(), corners.end()), triangleAt_(3, 0) {
  triangles_.push_back({.corners = {0, 1, 2}});
}

std::uint32_t PlanarTriangulation::cornerOf(std::uint32_t triangle, Vertex vertex) const {
  const Corners& corners = triangles_[triangle].corners;
  return corners[0] == vertex ? 0 : (corners[1] == vertex ? 1 : 2);
}

PlanarTriangulation::Side PlanarTriangulation::opposite(const Side& side) const {
  const std::uint32_t beyond = triangles_[side.triangle].beyond[side.corner];
  const Vertex a = triangles_[side.triangle].corners[(side.corner + 1) % 3];
  // The other triangle has the edge in the opposite direction.
  return {beyond, (cornerOf(beyond, a) + 1) % 3};
}

void PlanarTriangulation::link(std::uint32_t triangle, std::uint32_t corner, std::uint32_t beyond) {
  triangles_[triangle].beyond[corner] = beyond;
  if (beyond == kOutside) return;
  const Vertex a = triangles_[triangle].corners[(corner + 1) % 3];
  triangles_[beyond].beyond[(cornerOf(beyond, a) + 1) % 3] = triangle;
}

PlanarTriangulation::Vertex PlanarTriangulation::insert(CutPointId point) {
  const auto vertex = static_cast<Vertex>(vertices_.size());
  vertices_.push_back(point);
  triangleAt_.push_back(0);
  const std::uint32_t triangle = locate(vertex);
  const Corners corners = triangles_[triangle].corners;
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (orient(corners[(k + 1) % 3], corners[(k + 2) % 3], vertex) != 0) continue;
    splitSide({triangle, k}, vertex);
    return vertex;
  }
  splitTriangle(triangle, vertex);
  return vertex;
}

std::uint32_t PlanarTriangulation::locate(Vertex vertex) const {
  std::uint32_t triangle = last_;
  std::uint32_t from = kOutside;
  for (std::size_t step = 0; step < 2 * triangles_.size() + 4; ++step) {
    const Triangle& here = triangles_[triangle];
    std::uint32_t next = kOutside;
    bool isInside = true;
    for (std::uint32_t i = 0; i < 3; ++i) {
      // Begin with another corner in each step, so that the walk does not turn in circles for long.
      const auto k = static_cast<std::uint32_t>((i + step) % 3);
      if (here.beyond[k] == from && from != kOutside) continue;
      if (orient(here.corners[(k + 1) % 3], here.corners[(k + 2) % 3], vertex) >= 0) continue;
      isInside = false;
      next = here.beyond[k];
      if (next != kOutside) break;
    }
    if (isInside) return last_ = triangle;
    if (next == kOutside) break;
    from = triangle;
    triangle = next;
  }
  return last_ = scan(vertex);
}

std::uint32_t PlanarTriangulation::scan(Vertex vertex) const {
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const Corners& c = triangles_[t].corners;
    if (orient(c[0], c[1], vertex) >= 0 && orient(c[1], c[2], vertex) >= 0 &&
        orient(c[2], c[0], vertex) >= 0) {
      return t;
    }
  }
  return 0;
}

void PlanarTriangulation::splitTriangle(std::uint32_t triangle, Vertex vertex) {
  const Triangle old = triangles_[triangle];
  const auto second = static_cast<std::uint32_t>(triangles_.size());
  const std::uint32_t third = second + 1;
  const auto [a, b, c] = old.corners;
  triangles_[triangle] = {.corners = {a, b, vertex}};
  triangles_.push_back({.corners = {b, c, vertex}});
  triangles_.push_back({.corners = {c, a, vertex}});
  triangles_[triangle].isKept[2] = old.isKept[2];
  triangles_[second].isKept[2] = old.isKept[0];
  triangles_[third].isKept[2] = old.isKept[1];
  link(triangle, 2, old.beyond[2]);
  link(second, 2, old.beyond[0]);
  link(third, 2, old.beyond[1]);
  link(triangle, 0, second);
  link(second, 0, third);
  link(third, 0, triangle);
  triangleAt_[a] = triangle;
  triangleAt_[b] = second;
  triangleAt_[c] = third;
  triangleAt_[vertex] = triangle;
}

/// Divides a triangle by the line from a corner to a vertex on the opposite edge. The first part keeps the index.
void PlanarTriangulation::divide(std::uint32_t triangle, std::uint32_t corner, Vertex vertex) {
  const Triangle old = triangles_[triangle];
  const auto second = static_cast<std::uint32_t>(triangles_.size());
  const std::uint32_t next = (corner + 1) % 3;
  const std::uint32_t previous = (corner + 2) % 3;
  const Vertex a = old.corners[corner];
  const Vertex b = old.corners[next];
  const Vertex c = old.corners[previous];
  triangles_[triangle] = {.corners = {a, b, vertex}};
  triangles_.push_back({.corners = {a, vertex, c}});
  triangles_[triangle].isKept = {old.isKept[corner], false, old.isKept[previous]};
  triangles_[second].isKept = {old.isKept[corner], old.isKept[next], false};
  link(triangle, 2, old.beyond[previous]);
  link(second, 1, old.beyond[next]);
  link(triangle, 1, second);
  triangleAt_[a] = triangle;
  triangleAt_[b] = triangle;
  triangleAt_[c] = second;
  triangleAt_[vertex] = triangle;
}

void PlanarTriangulation::splitSide(const Side& side, Vertex vertex) {
  const std::uint32_t triangle = side.triangle;
  const std::uint32_t beyond = triangles_[triangle].beyond[side.corner];
  const auto second = static_cast<std::uint32_t>(triangles_.size());
  if (beyond == kOutside) {
    divide(triangle, side.corner, vertex);
    return;
  }
  const std::uint32_t otherCorner = opposite(side).corner;
  divide(triangle, side.corner, vertex);
  divide(beyond, otherCorner, vertex);
  // The first part of each triangle lies beside the second part of the other.
  link(triangle, 0, second + 1);
  link(second, 0, beyond);
}

void PlanarTriangulation::collectAround(Vertex vertex, std::vector<std::uint32_t>& around) const {
  around.clear();
  const std::uint32_t first = triangleAt_[vertex];
  std::uint32_t triangle = first;
  do {
    around.push_back(triangle);
    triangle = triangles_[triangle].beyond[(cornerOf(triangle, vertex) + 1) % 3];
  } while (triangle != kOutside && triangle != first);
  if (triangle == first) return;
  triangle = triangles_[first].beyond[(cornerOf(first, vertex) + 2) % 3];
  while (triangle != kOutside) {
    around.push_back(triangle);
    triangle = triangles_[triangle].beyond[(cornerOf(triangle, vertex) + 2) % 3];
  }
}

/// Returns the side with the vertices as its ends, in either direction; kOutside if there is none.
PlanarTriangulation::Side PlanarTriangulation::sideBetween(Vertex a, Vertex b) const {
  std::vector<std::uint32_t> around;
  collectAround(a, around);
  for (const std::uint32_t triangle : around) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vertex p = triangles_[triangle].corners[(k + 1) % 3];
      const Vertex q = triangles_[triangle].corners[(k + 2) % 3];
      if ((p == a && q == b) || (p == b && q == a)) return {triangle, k};
    }
  }
  return {kOutside, 0};
}

bool PlanarTriangulation::isConvex(const Side& side) const {
  const Side other = opposite(side);
  const Corners& corners = triangles_[side.triangle].corners;
  const Vertex apex = corners[side.corner];
  const Vertex a = corners[(side.corner + 1) % 3];
  const Vertex b = corners[(side.corner + 2) % 3];
  const Vertex beyond = triangles_[other.triangle].corners[other.corner];
  return orient(apex, a, beyond) > 0 && orient(beyond, b, apex) > 0;
}

/// Replaces the edge between two triangles by the other diagonal.
void PlanarTriangulation::flip(const Side& side) {
  const Side other = opposite(side);
  const Triangle s = triangles_[side.triangle];
  const Triangle t = triangles_[other.triangle];
  const auto after = [](std::uint32_t k) { return (k + 1) % 3; };
  const auto before = [](std::uint32_t k) { return (k + 2) % 3; };
  const Vertex apex = s.corners[side.corner];
  const Vertex a = s.corners[after(side.corner)];
  const Vertex b = s.corners[before(side.corner)];
  const Vertex beyond = t.corners[other.corner];
  // The triangles apex a b and beyond b a become apex a beyond and beyond b apex.
  triangles_[side.triangle] = {.corners = {apex, a, beyond}};
  triangles_[other.triangle] = {.corners = {beyond, b, apex}};
  triangles_[side.triangle].isKept = {t.isKept[after(other.corner)], false,
                                      s.isKept[before(side.corner)]};
  triangles_[other.triangle].isKept = {s.isKept[after(side.corner)], false,
                                       t.isKept[before(other.corner)]};
  link(side.triangle, 0, t.beyond[after(other.corner)]);
  link(side.triangle, 2, s.beyond[before(side.corner)]);
  link(other.triangle, 0, s.beyond[after(side.corner)]);
  link(other.triangle, 2, t.beyond[before(other.corner)]);
  link(side.triangle, 1, other.triangle);
  triangleAt_[apex] = triangleAt_[a] = side.triangle;
  triangleAt_[beyond] = triangleAt_[b] = other.triangle;
}

void PlanarTriangulation::keep(Vertex a, Vertex b) {
  const Side side = sideBetween(a, b);
  if (side.triangle == kOutside) return;
  triangles_[side.triangle].isKept[side.corner] = true;
  if (triangles_[side.triangle].beyond[side.corner] == kOutside) return;
  const Side other = opposite(side);
  triangles_[other.triangle].isKept[other.corner] = true;
}

void PlanarTriangulation::constrain(Vertex from, Vertex to) {
  if (sideBetween(from, to).triangle != kOutside) {
    keep(from, to);
    return;
  }
  std::vector<std::uint32_t> around;
  collectAround(from, around);
  std::deque<std::pair<Vertex, Vertex>> crossed;
  std::optional<Side> next;
  for (const std::uint32_t triangle : around) {
    const std::uint32_t k = cornerOf(triangle, from);
    const Vertex right = triangles_[triangle].corners[(k + 1) % 3];
    const Vertex left = triangles_[triangle].corners[(k + 2) % 3];
    if (orient(from, to, right) < 0 && orient(from, to, left) > 0 && orient(right, left, to) < 0) {
      next = Side{triangle, k};
      break;
    }
  }
  while (next) {
    const Corners& corners = triangles_[next->triangle].corners;
    const Vertex right = corners[(next->corner + 1) % 3];
    const Vertex left = corners[(next->corner + 2) % 3];
    crossed.emplace_back(right, left);
    if (triangles_[next->triangle].beyond[next->corner] == kOutside) return;
    const Side other = opposite(*next);
    const Vertex apex = triangles_[other.triangle].corners[other.corner];
    if (apex == to) break;
    // The triangle beyond has the corners apex, left, right.
    next = orient(from, to, apex) > 0 ? Side{other.triangle, cornerOf(other.triangle, left)}
                                      : Side{other.triangle, cornerOf(other.triangle, right)};
  }
  std::size_t limit = 100 + 20 * crossed.size() * crossed.size();
  while (!crossed.empty() && limit-- > 0) {
    const auto [a, b] = crossed.front();
    crossed.pop_front();
    const Side side = sideBetween(a, b);
    if (!isConvex(side)) {
      crossed.emplace_back(a, b);
      continue;
    }
    const Vertex p = triangles_[side.triangle].corners[side.corner];
    const Side other = opposite(side);
    const Vertex q = triangles_[other.triangle].corners[other.corner];
    flip(side);
    if (p == from || p == to || q == from || q == to) continue;
    if (orient(from, to, p) * orient(from, to, q) < 0) crossed.emplace_back(p, q);
  }
  keep(from, to);
}

bool PlanarTriangulation::isBetterFlipped(const Side& side) const {
  const Side other = opposite(side);
  const Corners& corners = triangles_[side.triangle].corners;
  const Vec3 apex = points_.rounded(vertices_[corners[side.corner]]);
  const Vec3 a = points_.rounded(vertices_[corners[(side.corner + 1) % 3]]);
  const Vec3 b = points_.rounded(vertices_[corners[(side.corner + 2) % 3]]);
  const Vec3 beyond = points_.rounded(vertices_[triangles_[other.triangle].corners[other.corner]]);
  // By the sum of the opposite angles, without dividing: sin(p + q) < 0 if it is above 180 degrees.
  const auto sine = [](const Vec3& u, const Vec3& v) { return glm::length(glm::cross(u, v)); };
  const double sineP = sine(a - apex, b - apex);
  const double cosineP = glm::dot(a - apex, b - apex);
  const double sineQ = sine(a - beyond, b - beyond);
  const double cosineQ = glm::dot(a - beyond, b - beyond);
  const double sum = sineP * cosineQ + cosineP * sineQ;
  // Relative rounding is about 1e-15. The margin leaves edges alone whose flip would gain nothing, so that the flips end.
  constexpr double kMargin = 1e-9;
  const double scale = (sineP + (cosineP < 0.0 ? -cosineP : cosineP)) *
                       (sineQ + (cosineQ < 0.0 ? -cosineQ : cosineQ));
  return sum < -kMargin * scale;
}

void PlanarTriangulation::improve() {
  std::vector<Side> waiting;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) waiting.push_back({t, k});
  }
  std::size_t limit = 30 * waiting.size();
  while (!waiting.empty() && limit-- > 0) {
    const Side side = waiting.back();
    waiting.pop_back();
    const Triangle& triangle = triangles_[side.triangle];
    if (triangle.beyond[side.corner] == kOutside || triangle.isKept[side.corner]) continue;
    if (!isBetterFlipped(side) || !isConvex(side)) continue;
    const std::uint32_t beyond = triangle.beyond[side.corner];
    flip(side);
    for (const std::uint32_t changed : {side.triangle, beyond}) {
      for (std::uint32_t k = 0; k < 3; ++k) waiting.push_back({changed, k});
    }
  }
}

}  // namespace tetrafront
