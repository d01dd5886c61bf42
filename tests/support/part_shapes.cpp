#include "support/part_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include "geom/predicates.h"
#include "support/shape_building.h"
#include "support/shapes.h"

namespace tetrafront::testing {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

bool areCrossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return orient2d(a, b, c) * orient2d(a, b, d) <= 0 && orient2d(c, d, a) * orient2d(c, d, b) <= 0;
}

/// Positions of the corners of a face, and its loops; those of the holes are clockwise.
struct FaceLoops {
  std::vector<Vec2> positions;
  std::vector<std::vector<std::uint32_t>> loops;
};

FaceLoops loopsOf(const FlatFace& face) {
  FaceLoops result;
  const auto add = [&](const Vec2& p) {
    result.positions.push_back(p);
    result.loops.back().push_back(static_cast<std::uint32_t>(result.positions.size() - 1));
  };
  result.loops.emplace_back();
  for (const Vec2& p : face.outline) add(p);
  for (const Outline& hole : face.holes) {
    result.loops.emplace_back();
    for (std::size_t i = hole.size(); i > 0; --i) add(hole[i - 1]);
  }
  return result;
}

/// Returns true if the segment between two corners meets no side of the face except at these corners.
bool isFree(const FaceLoops& face, std::uint32_t a, std::uint32_t b) {
  for (const std::vector<std::uint32_t>& loop : face.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t c = loop[i];
      const std::uint32_t d = loop[(i + 1) % loop.size()];
      if (c == a || c == b || d == a || d == b) continue;
      const auto& p = face.positions;
      if (areCrossing(p[a], p[b], p[c], p[d])) return false;
    }
  }
  return true;
}

/// Joins the loops of a face by slits to one polygon.
std::vector<std::uint32_t> slitPolygonOf(const FaceLoops& face) {
  std::vector<std::uint32_t> polygon = face.loops.front();
  std::vector<std::vector<std::uint32_t>> holes(face.loops.begin() + 1, face.loops.end());
  while (!holes.empty()) {
    double shortest = INFINITY;
    std::array<std::size_t, 3> slit{};
    for (std::size_t h = 0; h < holes.size(); ++h) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        for (std::size_t j = 0; j < holes[h].size(); ++j) {
          const double length =
              glm::length(face.positions[polygon[i]] - face.positions[holes[h][j]]);
          // A node at a slit occurs twice; a second slit there would need to know on which side it is.
          const bool isSlit = std::count(polygon.begin(), polygon.end(), polygon[i]) > 1;
          if (isSlit || length >= shortest || !isFree(face, polygon[i], holes[h][j])) continue;
          shortest = length;
          slit = {h, i, j};
        }
      }
    }
    const auto [h, i, j] = slit;
    std::vector<std::uint32_t>& hole = holes[h];
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(j), hole.end());
    hole.push_back(hole.front());
    hole.push_back(polygon[i]);
    polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1, hole.begin(), hole.end());
    holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(h));
  }
  return polygon;
}

/// Returns true if these consecutive corners of the polygon form an ear, by exact signs.
bool isEar(const std::vector<Vec2>& positions, const std::vector<std::uint32_t>& polygon,
           const std::array<std::uint32_t, 3>& ear) {
  const Vec2& a = positions[ear[0]];
  const Vec2& b = positions[ear[1]];
  const Vec2& c = positions[ear[2]];
  if (orient2d(a, b, c) <= 0) return false;
  return std::none_of(polygon.begin(), polygon.end(), [&](std::uint32_t other) {
    if (std::find(ear.begin(), ear.end(), other) != ear.end()) return false;
    const Vec2& p = positions[other];
    return orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 && orient2d(c, a, p) >= 0;
  });
}

/// Cuts a face into triangles, always taking the first ear: most triangles are needles.
std::vector<std::array<std::uint32_t, 3>> needlesOf(const FaceLoops& face) {
  std::vector<std::uint32_t> polygon = slitPolygonOf(face);
  std::vector<std::array<std::uint32_t, 3>> needles;
  std::size_t at = 0;
  std::size_t missed = 0;
  while (polygon.size() > 2 && missed <= polygon.size()) {
    const std::size_t n = polygon.size();
    const std::array<std::uint32_t, 3> ear{polygon[(at + n - 1) % n], polygon[at],
                                           polygon[(at + 1) % n]};
    if (isEar(face.positions, polygon, ear)) {
      needles.push_back(ear);
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(at));
      missed = 0;
      at %= polygon.size();
    } else {
      at = (at + 1) % n;
      ++missed;
    }
  }
  return needles;
}

/// Adds a horizontal face that faces up or down.
void addFace(SurfaceMesh& mesh, const FlatFace& flat, double z, bool up) {
  const FaceLoops face = loopsOf(flat);
  const auto base = static_cast<std::uint32_t>(nodeCount(mesh));
  for (const Vec2& p : face.positions) addPoint(mesh, {p.x, p.y, z});
  for (const auto& needle : needlesOf(face)) {
    const auto [a, b, c] = needle;
    addTriangle(mesh, base + a, base + (up ? b : c), base + (up ? c : b));
  }
}

/// Adds a vertical wall; its outside is on the right of the outline if `high` > `low`.
void addWall(SurfaceMesh& mesh, const Outline& outline, double low, double high) {
  const auto base = static_cast<std::uint32_t>(nodeCount(mesh));
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {low, high}) {
    for (const Vec2& p : outline) addPoint(mesh, {p.x, p.y, z});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    addSquare(mesh, {base + i, base + j, base + n + j, base + n + i}, false);
  }
}

/// Merges nodes at the same position and removes triangles with fewer than three nodes.
SurfaceMesh closed(const SurfaceMesh& mesh) {
  SurfaceMesh result = joined(mesh);
  std::vector<std::uint32_t> kept;
  for (std::size_t t = 0; t < result.triangles.size(); t += 3) {
    const std::uint32_t a = result.triangles[t];
    const std::uint32_t b = result.triangles[t + 1];
    const std::uint32_t c = result.triangles[t + 2];
    if (a != b && b != c && c != a) kept.insert(kept.end(), {a, b, c});
  }
  result.triangles = std::move(kept);
  return result;
}

/// Adds a square of a block: the side of cell i j k towards `sign` along `axis`.
void addBlockSide(SurfaceMesh& mesh, const std::array<const std::vector<double>*, 3>& grid,
                  const std::array<int, 3>& cell, int axis, int sign) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  std::array<std::uint32_t, 4> nodes{};
  for (std::size_t c = 0; c < 4; ++c) {
    std::array<int, 3> at = cell;
    at[static_cast<std::size_t>(axis)] += sign > 0 ? 1 : 0;
    at[static_cast<std::size_t>(u)] += c == 1 || c == 2 ? 1 : 0;
    at[static_cast<std::size_t>(v)] += c >= 2 ? 1 : 0;
    Vec3 p(0.0);
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      p[k] = grid[i]->at(static_cast<std::size_t>(at[i]));
    }
    nodes[c] = addPoint(mesh, p);
  }
  if (sign < 0) std::swap(nodes[1], nodes[3]);
  addSquare(mesh, nodes, (cell[0] + cell[1] + cell[2]) % 2 == 0);
}

}  // namespace

Outline rectangle(const Vec2& lower, const Vec2& upper) {
  return {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}};
}

Outline circle(const Vec2& centre, double radius, int sectors) {
  Outline result;
  for (int i = 0; i < sectors; ++i) {
    const double angle = kWholeTurn * i / sectors;
    result.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return result;
}

Outline filleted(const Outline& outline, double radius, int pieces) {
  Outline result;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 corner = outline[i];
    const Vec2 back = glm::normalize(outline[(i + n - 1) % n] - corner);
    const Vec2 forth = glm::normalize(outline[(i + 1) % n] - corner);
    const double half = 0.5 * std::acos(std::clamp(glm::dot(back, forth), -1.0, 1.0));
    const Vec2 begin = back * (radius / std::tan(half));
    const Vec2 end = forth * (radius / std::tan(half));
    const Vec2 centre = glm::normalize(back + forth) * (radius / std::sin(half));
    // The arc spans less than half a turn, so directions between those of its ends are inside it.
    for (int k = 0; k <= pieces; ++k) {
      const double angle = (std::numbers::pi - 2.0 * half) * k / pieces;
      const double side = orient2d(Vec2(0.0), back, forth) > 0 ? -1.0 : 1.0;
      const Vec2 from = begin - centre;
      const Vec2 across = side * Vec2(-from.y, from.x);
      const Vec2 onArc = centre + std::cos(angle) * from + std::sin(angle) * across;
      result.push_back(corner + (k == 0 ? begin : k == pieces ? end : onArc));
    }
  }
  return result;
}

Outline gear(int teeth, const std::vector<Vec2>& tooth) {
  Outline result;
  for (int i = 0; i < teeth; ++i) {
    for (const Vec2& corner : tooth) {
      const double angle = kWholeTurn * (i + corner.x) / teeth;
      result.push_back(corner.y * Vec2(std::cos(angle), std::sin(angle)));
    }
  }
  return result;
}

Outline shifted(Outline outline, const Vec2& by) {
  for (Vec2& p : outline) p += by;
  return outline;
}

SurfaceMesh prism(const FlatFace& base, double height) {
  SurfaceMesh mesh;
  addFace(mesh, base, 0.0, false);
  addFace(mesh, base, height, true);
  addWall(mesh, base.outline, 0.0, height);
  for (const Outline& hole : base.holes) addWall(mesh, hole, height, 0.0);
  return closed(mesh);
}

SurfaceMesh embossed(const Outline& outline, const std::vector<FlatFace>& letters, double thickness,
                     double rise) {
  SurfaceMesh mesh;
  FlatFace top{outline, {}};
  for (const FlatFace& letter : letters) {
    top.holes.push_back(letter.outline);
    addFace(mesh, letter, thickness + rise, true);
    addWall(mesh, letter.outline, thickness, thickness + rise);
    for (const Outline& hole : letter.holes) {
      addWall(mesh, hole, thickness + rise, thickness);
      addFace(mesh, {hole, {}}, thickness, true);
    }
  }
  addFace(mesh, top, thickness, true);
  addFace(mesh, {outline, {}}, 0.0, false);
  addWall(mesh, outline, 0.0, thickness);
  return closed(mesh);
}

SurfaceMesh revolved(const Outline& section, int sectors) {
  SurfaceMesh mesh;
  const auto n = static_cast<std::uint32_t>(section.size());
  const auto count = static_cast<std::uint32_t>(sectors);
  for (const Vec2& direction : circle(Vec2(0.0), 1.0, sectors)) {
    for (const Vec2& p : section) addPoint(mesh, {p.x * direction.x, p.x * direction.y, p.y});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t near = i * n;
    const std::uint32_t far = ((i + 1) % count) * n;
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t next = (k + 1) % n;
      // Sides on the axis have no area.
      if (section[k].x == 0.0 && section[next].x == 0.0) continue;
      addSquare(mesh, {near + k, far + k, far + next, near + next}, section[k].x == 0.0);
    }
  }
  return closed(mesh);
}

SurfaceMesh swept(const FlatFace& section, int count,
                  const std::function<SectionFrame(double position)>& frameAt) {
  SurfaceMesh mesh;
  const FaceLoops face = loopsOf(section);
  const auto n = static_cast<std::uint32_t>(face.positions.size());
  for (int i = 0; i <= count; ++i) {
    const SectionFrame frame = frameAt(static_cast<double>(i) / count);
    for (const Vec2& p : face.positions)
      addPoint(mesh, frame.centre + p.x * frame.u + p.y * frame.v);
  }
  const std::uint32_t last = n * static_cast<std::uint32_t>(count);
  for (const auto& [a, b, c] : needlesOf(face)) {
    addTriangle(mesh, a, c, b);
    addTriangle(mesh, last + a, last + b, last + c);
  }
  for (std::uint32_t base = 0; base < last; base += n) {
    for (const std::vector<std::uint32_t>& loop : face.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t a = base + loop[k];
        const std::uint32_t b = base + loop[(k + 1) % loop.size()];
        addSquare(mesh, {a, b, b + n, a + n}, k % 2 == 0);
      }
    }
  }
  return mesh;
}

SectionFrame helixFrame(double radius, double pitch, double turn) {
  const Vec3 outward(std::cos(kWholeTurn * turn), std::sin(kWholeTurn * turn), 0.0);
  return {radius * outward + Vec3(0.0, 0.0, pitch * turn), outward, Vec3(0.0, 0.0, -1.0)};
}

SurfaceMesh blocks(const std::vector<double>& x, const std::vector<double>& y,
                   const std::vector<double>& z,
                   const std::function<bool(int i, int j, int k)>& isSolid) {
  const std::array<const std::vector<double>*, 3> grid{&x, &y, &z};
  std::array<int, 3> counts{};
  for (std::size_t a = 0; a < 3; ++a) counts[a] = static_cast<int>(grid[a]->size()) - 1;
  const auto isInside = [&](const std::array<int, 3>& cell) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (cell[a] < 0 || cell[a] >= counts[a]) return false;
    }
    return isSolid(cell[0], cell[1], cell[2]);
  };
  SurfaceMesh mesh;
  for (int cell = 0; cell < counts[0] * counts[1] * counts[2]; ++cell) {
    const std::array<int, 3> at{cell % counts[0], cell / counts[0] % counts[1],
                                cell / (counts[0] * counts[1])};
    if (!isInside(at)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) {
        std::array<int, 3> beyond = at;
        beyond[static_cast<std::size_t>(axis)] += sign;
        if (!isInside(beyond)) addBlockSide(mesh, grid, at, axis, sign);
      }
    }
  }
  return closed(mesh);
}

}  // namespace tetrafront::testing
