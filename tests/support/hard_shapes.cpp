#include "support/hard_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "support/random.h"
#include "support/shape_building.h"
#include "support/shapes.h"

namespace tetrafront::testing {
namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Cuts a simple counter-clockwise polygon into triangles. A triangle holds the indices of its
/// corners in `polygon`.
std::vector<std::array<std::uint32_t, 3>> earsOf(const std::vector<Vec2>& polygon) {
  std::vector<std::uint32_t> rest(polygon.size());
  std::iota(rest.begin(), rest.end(), 0U);
  std::vector<std::array<std::uint32_t, 3>> ears;
  while (rest.size() > 2) {
    const std::size_t n = rest.size();
    std::size_t best = 0;
    double bestArea = -1.0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2& a = polygon[rest[(i + n - 1) % n]];
      const Vec2& b = polygon[rest[i]];
      const Vec2& c = polygon[rest[(i + 1) % n]];
      if (turn(a, b, c) <= bestArea || turn(a, b, c) <= 0.0) continue;
      bool empty = true;
      for (const std::uint32_t k : rest) {
        const Vec2& p = polygon[k];
        if (p == a || p == b || p == c) continue;
        if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) empty = false;
      }
      if (!empty) continue;
      best = i;
      bestArea = turn(a, b, c);
    }
    ears.push_back({rest[(best + n - 1) % n], rest[best], rest[(best + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return ears;
}

/// Adds the triangles of a flat polygon in space. `flat` holds the positions of its nodes in the
/// plane, seen from outside.
void addPolygon(SurfaceMesh& mesh, const std::vector<std::uint32_t>& nodes,
                const std::vector<Vec2>& flat) {
  for (const auto& ear : earsOf(flat)) {
    addTriangle(mesh, nodes[ear[0]], nodes[ear[1]], nodes[ear[2]]);
  }
}

SurfaceMesh ringOfCircle(int sectors, const std::vector<std::array<double, 2>>& radiusAndHeight) {
  SurfaceMesh mesh;
  for (const auto& [radius, z] : radiusAndHeight) {
    for (int i = 0; i < sectors; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sectors;
      addPoint(mesh, {radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  return mesh;
}

}  // namespace

SurfaceMesh schoenhardtTower(int levels, double degrees) {
  SurfaceMesh mesh;
  const double twist = degrees * std::numbers::pi / 180.0;
  for (int level = 0; level <= levels; ++level) {
    for (int k = 0; k < 3; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 3.0 + twist * level;
      addPoint(mesh, {std::cos(angle), std::sin(angle), level});
    }
  }
  addTriangle(mesh, 0, 2, 1);
  const auto top = static_cast<std::uint32_t>(3 * levels);
  addTriangle(mesh, top, top + 1, top + 2);
  for (std::uint32_t base = 0; base < top; base += 3) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t l = (k + 1) % 3;
      addTriangle(mesh, base + k, base + l, base + l + 3);
      addTriangle(mesh, base + k, base + l + 3, base + k + 3);
    }
  }
  return mesh;
}

SurfaceMesh schoenhardtCavities(int n, double degrees) {
  SurfaceMesh mesh = gridBox(Vec3(-1.5, -1.5, -1.0), Vec3(3.0 * n - 1.5, 3.0 * n - 1.5, 2.0),
                             {n, n, 1}, Diagonals::kRandom);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      SurfaceMesh prism = schoenhardtPrism(degrees);
      translate(prism, Vec3(3.0 * i, 3.0 * j, 0.0));
      turnInsideOut(prism);
      append(mesh, prism);
    }
  }
  return mesh;
}

SurfaceMesh schoenhardtPair(double degrees) {
  SurfaceMesh mesh = schoenhardtPrism(degrees);
  const Vec3 p = pointOf(mesh, 0);
  const Vec3 axis = glm::normalize(pointOf(mesh, 3) - p);
  SurfaceMesh other = mesh;
  for (std::uint32_t i = 0; i < nodeCount(mesh); ++i) {
    if (i == 0 || i == 3) continue;
    const Vec3 q = pointOf(mesh, i) - p;
    const Vec3 turned = p + 2.0 * glm::dot(q, axis) * axis - q;
    for (int k = 0; k < 3; ++k) other.points[3 * i + static_cast<std::size_t>(k)] = turned[k];
  }
  append(mesh, other);
  return joined(mesh);
}

SurfaceMesh chazellePolyhedron(int n, double gap) {
  constexpr double kHalfWidth = 0.25;  // of a notch
  const double size = n + 1.0;
  const double bottom = -2.0 * size;
  const double top = size * size + 2.0 * size;
  SurfaceMesh mesh;
  // The nodes of a notch on its two upright sides, seen from outside, from the notched edge on.
  struct Notch {
    std::array<std::uint32_t, 3> near;
    std::array<std::uint32_t, 3> far;
  };
  const auto corner = [&](double x, double y, double z) { return addPoint(mesh, {x, y, z}); };
  std::array<std::uint32_t, 4> low{corner(0, 0, bottom), corner(size, 0, bottom),
                                   corner(size, size, bottom), corner(0, size, bottom)};
  std::array<std::uint32_t, 4> high{corner(0, 0, top), corner(size, 0, top),
                                    corner(size, size, top), corner(0, size, top)};
  std::vector<Notch> below;
  std::vector<Notch> above;
  for (int i = 1; i <= n; ++i) {
    const double c = i;
    below.push_back(
        {{corner(c - kHalfWidth, 0, bottom), corner(c, 0, 0), corner(c + kHalfWidth, 0, bottom)},
         {corner(c - kHalfWidth, size, bottom), corner(c, size, c * size),
          corner(c + kHalfWidth, size, bottom)}});
    above.push_back(
        {{corner(0, c - kHalfWidth, top), corner(0, c, gap), corner(0, c + kHalfWidth, top)},
         {corner(size, c - kHalfWidth, top), corner(size, c, c * size + gap),
          corner(size, c + kHalfWidth, top)}});
  }
  const auto square = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    addSquare(mesh, {a, b, c, d}, false);
  };
  std::array<std::uint32_t, 2> previous{low[0], low[3]};  // at y = 0 and y = size
  for (const Notch& notch : below) {
    square(previous[0], previous[1], notch.far[0], notch.near[0]);
    square(notch.near[0], notch.far[0], notch.far[1], notch.near[1]);
    square(notch.near[1], notch.far[1], notch.far[2], notch.near[2]);
    previous = {notch.near[2], notch.far[2]};
  }
  square(previous[0], previous[1], low[2], low[1]);
  previous = {high[0], high[1]};  // at x = 0 and x = size
  for (const Notch& notch : above) {
    square(previous[0], previous[1], notch.far[0], notch.near[0]);
    square(notch.near[0], notch.far[0], notch.far[1], notch.near[1]);
    square(notch.near[1], notch.far[1], notch.far[2], notch.near[2]);
    previous = {notch.near[2], notch.far[2]};
  }
  square(previous[0], previous[1], high[2], high[3]);
  const auto side = [&](const std::vector<std::uint32_t>& nodes, int axis, double sign) {
    std::vector<Vec2> flat;
    for (const std::uint32_t node : nodes) {
      const Vec3 p = pointOf(mesh, node);
      flat.emplace_back(sign * p[axis], p.z);
    }
    addPolygon(mesh, nodes, flat);
  };
  std::vector<std::uint32_t> front{low[0]};
  std::vector<std::uint32_t> back;
  std::vector<std::uint32_t> right;
  std::vector<std::uint32_t> left{high[0]};
  for (const Notch& notch : below) {
    front.insert(front.end(), notch.near.begin(), notch.near.end());
    back.insert(back.begin(), notch.far.rbegin(), notch.far.rend());
  }
  for (const Notch& notch : above) {
    left.insert(left.end(), notch.near.begin(), notch.near.end());
    right.insert(right.begin(), notch.far.rbegin(), notch.far.rend());
  }
  front.insert(front.end(), {low[1], high[1], high[0]});
  side(front, 0, 1.0);
  back.insert(back.begin(), low[2]);
  back.insert(back.end(), {low[3], high[3], high[2]});
  side(back, 0, -1.0);
  right.insert(right.begin(), high[2]);
  right.insert(right.end(), {high[1], low[1], low[2]});
  side(right, 1, 1.0);
  left.insert(left.end(), {high[3], low[3], low[0]});
  side(left, 1, -1.0);
  return mesh;
}

SurfaceMesh saddleSlab(int n, double gap) {
  SurfaceMesh mesh;
  const auto m = static_cast<std::uint32_t>(n + 1);
  for (const double offset : {-0.5 * gap, 0.5 * gap}) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) addPoint(mesh, {i, j, i * j + offset});
    }
  }
  const auto at = [&](std::uint32_t level, std::uint32_t i, std::uint32_t j) {
    return level * m * m + i * m + j;
  };
  for (std::uint32_t i = 0; i + 1 < m; ++i) {
    for (std::uint32_t j = 0; j + 1 < m; ++j) {
      addSquare(mesh, {at(1, i, j), at(1, i + 1, j), at(1, i + 1, j + 1), at(1, i, j + 1)}, false);
      addSquare(mesh, {at(0, i, j), at(0, i, j + 1), at(0, i + 1, j + 1), at(0, i + 1, j)}, true);
    }
  }
  for (std::uint32_t k = 0; k + 1 < m; ++k) {
    addSquare(mesh, {at(0, k, 0), at(0, k + 1, 0), at(1, k + 1, 0), at(1, k, 0)}, false);
    addSquare(mesh, {at(0, m - 1, k), at(0, m - 1, k + 1), at(1, m - 1, k + 1), at(1, m - 1, k)},
              false);
    addSquare(mesh, {at(0, k + 1, m - 1), at(0, k, m - 1), at(1, k, m - 1), at(1, k + 1, m - 1)},
              false);
    addSquare(mesh, {at(0, 0, k + 1), at(0, 0, k), at(1, 0, k), at(1, 0, k + 1)}, false);
  }
  return mesh;
}

SurfaceMesh extruded(const std::vector<Vec2>& polygon, double height, int layers,
                     std::uint64_t seed) {
  Random random(seed);
  SurfaceMesh mesh;
  for (int layer = 0; layer <= layers; ++layer) {
    for (const Vec2& p : polygon) addPoint(mesh, {p.x, p.y, height * layer / layers});
  }
  const auto n = static_cast<std::uint32_t>(polygon.size());
  const std::uint32_t top = n * static_cast<std::uint32_t>(layers);
  for (const auto& ear : earsOf(polygon)) {
    addTriangle(mesh, ear[0], ear[2], ear[1]);
    addTriangle(mesh, top + ear[0], top + ear[1], top + ear[2]);
  }
  for (std::uint32_t base = 0; base < top; base += n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      addSquare(mesh, {base + i, base + j, base + n + j, base + n + i}, random.coin());
    }
  }
  return mesh;
}

SurfaceMesh wedge(double degrees, int layers) {
  const double rise = std::tan(degrees * std::numbers::pi / 360.0);
  return extruded({{0.0, 0.0}, {1.0, -rise}, {1.0, rise}}, 1.0, layers, 1);
}

SurfaceMesh slitBlock(double degrees, int layers) {
  const double rise = std::tan(degrees * std::numbers::pi / 360.0);
  return extruded(
      {{0.0, 0.0}, {1.0, rise}, {1.0, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}, {1.0, -rise}},
      1.0, layers, 1);
}

SurfaceMesh spikySphere(int n, double least, std::uint64_t seed) {
  Random random(seed);
  SurfaceMesh mesh = geodesicSphere(n);
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
    const double radius = random.between(least, 1.0);
    for (std::size_t k = 0; k < 3; ++k) mesh.points[i + k] *= radius;
  }
  return mesh;
}

SurfaceMesh coarseBar(int sectors, double length) {
  SurfaceMesh mesh = ringOfCircle(sectors, {{1.0, 0.0}, {1.0, length}});
  const auto n = static_cast<std::uint32_t>(sectors);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    addSquare(mesh, {i, j, n + j, n + i}, false);
    if (i == 0 || j == 0) continue;
    addTriangle(mesh, 0, j, i);
    addTriangle(mesh, n, n + i, n + j);
  }
  return mesh;
}

SurfaceMesh coarseTube(int sectors, double innerRadius, double length) {
  SurfaceMesh mesh =
      ringOfCircle(sectors, {{1.0, 0.0}, {1.0, length}, {innerRadius, 0.0}, {innerRadius, length}});
  const auto n = static_cast<std::uint32_t>(sectors);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    const std::uint32_t inner = 2 * n;
    addSquare(mesh, {i, j, n + j, n + i}, false);
    addSquare(mesh, {inner + j, inner + i, inner + n + i, inner + n + j}, true);
    addSquare(mesh, {i, inner + i, inner + j, j}, true);
    addSquare(mesh, {n + i, n + j, inner + n + j, inner + n + i}, false);
  }
  return mesh;
}

SurfaceMesh solidOfRevolution(const std::vector<Vec2>& radiusAndHeight, int sectors,
                              std::uint64_t seed) {
  Random random(seed);
  std::vector<std::array<double, 2>> rings;
  for (const Vec2& p : radiusAndHeight) rings.push_back({p.x, p.y});
  SurfaceMesh mesh = ringOfCircle(sectors, rings);
  const auto n = static_cast<std::uint32_t>(sectors);
  const auto top = static_cast<std::uint32_t>(n * (rings.size() - 1));
  for (std::uint32_t base = 0; base < top; base += n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      addSquare(mesh, {base + i, base + j, base + n + j, base + n + i}, random.integer(0, 1) == 1);
    }
  }
  const std::uint32_t below = addPoint(mesh, {0.0, 0.0, rings.front()[1]});
  const std::uint32_t above = addPoint(mesh, {0.0, 0.0, rings.back()[1]});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    addTriangle(mesh, below, j, i);
    addTriangle(mesh, above, top + i, top + j);
  }
  return mesh;
}

SurfaceMesh loft(int cornersBelow, int cornersAbove, double height, double ratio) {
  SurfaceMesh mesh = ringOfCircle(cornersBelow, {{1.0, 0.0}});
  append(mesh, ringOfCircle(cornersAbove, {{ratio, height}}));
  const auto n = static_cast<std::uint32_t>(cornersBelow);
  const auto m = static_cast<std::uint32_t>(cornersAbove);
  std::uint32_t i = 0;
  std::uint32_t j = 0;
  while (i < n || j < m) {
    // Continue with the polygon whose next corner comes first by angle.
    if (j == m || (i < n && (i + 1) * m <= (j + 1) * n)) {
      addTriangle(mesh, i, (i + 1) % n, n + j % m);
      ++i;
    } else {
      addTriangle(mesh, i % n, n + (j + 1) % m, n + j);
      ++j;
    }
  }
  for (std::uint32_t k = 1; k + 1 < n; ++k) addTriangle(mesh, 0, k + 1, k);
  for (std::uint32_t k = 1; k + 1 < m; ++k) addTriangle(mesh, n, n + k, n + k + 1);
  return mesh;
}

std::vector<Vec2> combOutline(int teeth, double width, double gap, double length) {
  std::vector<Vec2> outline{{0.0, 0.0}, {teeth * (width + gap) - gap, 0.0}};
  for (int i = teeth - 1; i >= 0; --i) {
    const double x = i * (width + gap);
    outline.insert(outline.end(), {Vec2(x + width, length), Vec2(x, length)});
    if (i == 0) break;
    outline.insert(outline.end(), {Vec2(x, 0.1 * length), Vec2(x - gap, 0.1 * length)});
  }
  return outline;
}

SurfaceMesh cubeWithFinePatch(int n) {
  constexpr double kInset = 0.1;
  SurfaceMesh mesh = gridCube(1);
  // Replace the triangles on top by the patch.
  SurfaceMesh result;
  result.points = mesh.points;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const std::array<std::uint32_t, 3> c{mesh.triangles[t], mesh.triangles[t + 1],
                                         mesh.triangles[t + 2]};
    double lowest = 1.0;
    for (const std::uint32_t node : c) lowest = std::min(lowest, pointOf(mesh, node).z);
    if (lowest < 1.0) addTriangle(result, c[0], c[1], c[2]);
  }
  std::array<std::uint32_t, 4> outer{};
  for (std::uint32_t i = 0; i < nodeCount(mesh); ++i) {
    const Vec3 p = pointOf(mesh, i);
    if (p.z < 1.0) continue;
    outer[p.y < 0.5 ? (p.x < 0.5 ? 0 : 1) : (p.x < 0.5 ? 3 : 2)] = i;
  }
  std::vector<std::uint32_t> grid;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      grid.push_back(addPoint(result, {kInset + (1.0 - 2.0 * kInset) * i / n,
                                       kInset + (1.0 - 2.0 * kInset) * j / n, 1.0}));
    }
  }
  const auto m = static_cast<std::uint32_t>(n);
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return grid[j * (m + 1) + i]; };
  for (std::uint32_t j = 0; j < m; ++j) {
    for (std::uint32_t i = 0; i < m; ++i) {
      addSquare(result, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, (i + j) % 2 == 0);
    }
  }
  for (std::uint32_t k = 0; k < m; ++k) {
    addTriangle(result, outer[0], at(k + 1, 0), at(k, 0));
    addTriangle(result, outer[1], at(m, k + 1), at(m, k));
    addTriangle(result, outer[2], at(m - k - 1, m), at(m - k, m));
    addTriangle(result, outer[3], at(0, m - k - 1), at(0, m - k));
  }
  addTriangle(result, outer[0], outer[1], at(m, 0));
  addTriangle(result, outer[1], outer[2], at(m, m));
  addTriangle(result, outer[2], outer[3], at(0, m));
  addTriangle(result, outer[3], outer[0], at(0, 0));
  return result;
}

SurfaceMesh gradedCube(int n, int power) {
  SurfaceMesh mesh = gridCube(n, Diagonals::kAlternating);
  for (double& x : mesh.points) {
    double product = 1.0;
    for (int i = 0; i < power; ++i) product *= x;
    x = product;
  }
  return mesh;
}

SurfaceMesh randomBlocks(int n, double share, std::uint64_t seed) {
  Random random(seed);
  const auto size = static_cast<std::size_t>(n);
  std::vector<bool> solid(size * size * size);
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = random.unit() < share;
  solid[0] = true;
  const auto isSolid = [&](int i, int j, int k) {
    if (i < 0 || j < 0 || k < 0 || i >= n || j >= n || k >= n) return false;
    return static_cast<bool>(
        solid[(static_cast<std::size_t>(i) * size + static_cast<std::size_t>(j)) * size +
              static_cast<std::size_t>(k)]);
  };
  SurfaceMesh mesh;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        if (!isSolid(i, j, k)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int step : {-1, 1}) {
            std::array<int, 3> beyond{i, j, k};
            beyond[static_cast<std::size_t>(axis)] += step;
            if (isSolid(beyond[0], beyond[1], beyond[2])) continue;
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            std::array<std::uint32_t, 4> nodes{};
            for (std::size_t c = 0; c < 4; ++c) {
              Vec3 p(i, j, k);
              p[axis] += step > 0 ? 1.0 : 0.0;
              p[u] += c == 1 || c == 2 ? 1.0 : 0.0;
              p[v] += c >= 2 ? 1.0 : 0.0;
              nodes[c] = addPoint(mesh, p);
            }
            if (step < 0) std::swap(nodes[1], nodes[3]);
            addSquare(mesh, nodes, random.coin());
          }
        }
      }
    }
  }
  return joined(mesh);
}

SurfaceMesh distantBlocks(int n, int step, std::uint64_t seed) {
  SurfaceMesh mesh = randomBlocks(n, 0.5, seed);
  for (double& x : mesh.points) {
    if (x != 0.0) x = std::ldexp(1.0, step * (static_cast<int>(x) - n));
  }
  return mesh;
}

SurfaceMesh flatPocket() {
  SurfaceMesh mesh;
  mesh.points = {-1.5591494342389112, 0.94246465370577592, 2.4048626330205507,  -1.5593072689515883,
                 0.96179815027522331, 2.3392980394465424,  -1.8454920061890396, 1.2598865166055933,
                 2.3527928171778227,  -1.345653839690343,  1.1447574607116033,  2.4640001958893101,
                 -1.2167118922889366, 0.94285999028781109, 2.6891340642943735,  -1.2567283631246111,
                 0.99237092024798967, 2.6642367791359844,  -1.290796607463135,  1.0390127840218575,
                 2.6276797524063267,  -1.3176074017802699, 1.0809931609416426,  2.580867850141205,
                 -1.3361304222860755, 1.1166987686651846,  2.5256000274922505,  -1.6258078606239088,
                 1.4691558534143931,  2.3657240427691657,  -1.6319964116404715, 1.4621793236114207,
                 2.4119303800465821,  -1.6444128498113972, 1.4619899625295341,  2.457403360396444,
                 -1.6625800183809967, 1.4685950472089155,  2.5003954826854482,  -1.4928675083436245,
                 1.246496111831044,   2.5695148713687241,  -1.6004279396760364, 1.2962158232545933,
                 2.3956191873515205};
  mesh.triangles = {4, 12, 13, 3,  8,  12, 3, 12, 11, 4, 13, 5,  6, 7,  10, 0, 2,  1,
                    4, 5,  11, 7,  8,  10, 8, 13, 12, 9, 10, 14, 9, 1,  10, 6, 13, 7,
                    3, 11, 10, 5,  13, 6,  5, 6,  10, 5, 10, 11, 3, 10, 8,  4, 11, 12,
                    0, 9,  14, 10, 1,  2,  2, 14, 10, 1, 9,  0,  7, 13, 8,  0, 14, 2};
  return mesh;
}

namespace {

/// Cuts a polygon into triangles, always taking the first ear. Nodes may occur twice, at slits that
/// lead to holes.
std::vector<std::array<std::uint32_t, 3>> firstEarsOf(const std::vector<Vec2>& positions,
                                                      std::vector<std::uint32_t> polygon) {
  std::vector<std::array<std::uint32_t, 3>> ears;
  const auto isEar = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vec2& p = positions[a];
    const Vec2& q = positions[b];
    const Vec2& r = positions[c];
    if (turn(p, q, r) <= 1e-12) return false;
    return std::none_of(polygon.begin(), polygon.end(), [&](std::uint32_t other) {
      const Vec2& o = positions[other];
      if (other == a || other == b || other == c) return false;
      return turn(p, q, o) >= 0.0 && turn(q, r, o) >= 0.0 && turn(r, p, o) >= 0.0;
    });
  };
  std::size_t at = 0;
  std::size_t missed = 0;
  while (polygon.size() > 3 && missed <= polygon.size()) {
    const std::size_t n = polygon.size();
    const std::array<std::uint32_t, 3> ear{polygon[(at + n - 1) % n], polygon[at],
                                           polygon[(at + 1) % n]};
    if (isEar(ear[0], ear[1], ear[2])) {
      ears.push_back(ear);
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(at));
      missed = 0;
      at %= polygon.size();
    } else {
      at = (at + 1) % n;
      ++missed;
    }
  }
  ears.push_back({polygon[0], polygon[1], polygon[2]});
  return ears;
}

/// Returns a prism over loops in the plane, of which holes are clockwise. `polygon` passes through
/// all loops.
SurfaceMesh needlePrism(const std::vector<Vec2>& positions,
                        const std::vector<std::vector<std::uint32_t>>& loops,
                        const std::vector<std::uint32_t>& polygon, double height) {
  SurfaceMesh mesh;
  for (const double z : {0.0, height}) {
    for (const Vec2& p : positions) addPoint(mesh, {p.x, p.y, z});
  }
  const auto top = static_cast<std::uint32_t>(positions.size());
  for (const auto& ear : firstEarsOf(positions, polygon)) {
    addTriangle(mesh, ear[0], ear[2], ear[1]);
    addTriangle(mesh, top + ear[0], top + ear[1], top + ear[2]);
  }
  for (const std::vector<std::uint32_t>& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i];
      const std::uint32_t b = loop[(i + 1) % loop.size()];
      addSquare(mesh, {a, b, top + b, top + a}, false);
    }
  }
  return mesh;
}

/// Adds the squares between consecutive rings of nodes, each as two triangles; the ends stay open.
void addRings(SurfaceMesh& mesh, std::uint32_t rings, std::uint32_t around) {
  for (std::uint32_t i = 0; i + 1 < rings; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t a = i * around + j;
      const std::uint32_t b = i * around + (j + 1) % around;
      addSquare(mesh, {a, b, b + around, a + around}, true);
    }
  }
}

}  // namespace

SurfaceMesh needleDrum(std::uint32_t count, int lobes) {
  SurfaceMesh drum;
  for (const double z : {0.0, 2.0}) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count;
      const double radius = lobes == 0 ? 1.0 : 1.0 + 0.3 * std::cos(lobes * angle);
      drum.points.insert(drum.points.end(),
                         {radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  drum.points.insert(drum.points.end(), {0.0, 0.0, 0.0, 0.0, 0.0, 2.0});
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t j = (i + 1) % count;
    const std::uint32_t centre = 2 * count;
    drum.triangles.insert(drum.triangles.end(), {i, j, count + j, i, count + j, count + i, j, i,
                                                 centre, count + i, count + j, centre + 1});
  }
  return drum;
}

SurfaceMesh needlePlate(int n, int sides, double thickness) {
  std::vector<Vec2> positions;
  const auto add = [&](double x, double y) {
    positions.emplace_back(x, y);
    return static_cast<std::uint32_t>(positions.size() - 1);
  };
  // Go down the left side, with a slit along each row of holes: above the holes to the right, and
  // below them back.
  std::vector<std::uint32_t> outer{add(0.0, n)};
  std::vector<std::uint32_t> polygon = outer;
  std::vector<std::vector<std::uint32_t>> loops(1);
  for (int row = n - 1; row >= 0; --row) {
    outer.push_back(add(0.0, row + 0.5));
    polygon.push_back(outer.back());
    std::vector<std::uint32_t> back;
    for (int column = 0; column < n; ++column) {
      std::vector<std::uint32_t> hole;
      for (int k = 0; k < sides; ++k) {
        const double angle = std::numbers::pi * (1.0 - 2.0 * k / sides);
        hole.push_back(add(column + 0.5 + 0.02 * row + 0.3 * std::cos(angle),
                           row + 0.5 + 0.015 * column + 0.3 * std::sin(angle)));
      }
      const auto half = static_cast<std::ptrdiff_t>(sides / 2);
      polygon.insert(polygon.end(), hole.begin(), hole.begin() + half + 1);
      std::vector<std::uint32_t> below(hole.begin() + half, hole.end());
      below.push_back(hole.front());
      back.insert(back.begin(), below.begin(), below.end());
      loops.push_back(std::move(hole));
    }
    // Pass the far end of the last hole once.
    polygon.insert(polygon.end(), back.begin() + 1, back.end());
    polygon.push_back(outer.back());
  }
  for (const Vec2& corner : {Vec2(0.0, 0.0), Vec2(n + 0.1, 0.0), Vec2(n + 0.1, n)}) {
    outer.push_back(add(corner.x, corner.y));
    polygon.push_back(outer.back());
  }
  loops.front() = outer;
  return needlePrism(positions, loops, polygon, thickness);
}

SurfaceMesh needleGear(int teeth, double thickness) {
  constexpr std::array<std::array<double, 2>, 6> kTooth{
      {{0.0, 0.8}, {0.2, 0.8}, {0.35, 0.95}, {0.45, 1.0}, {0.65, 1.0}, {0.8, 0.9}}};
  std::vector<Vec2> positions;
  std::vector<std::uint32_t> loop;
  for (int tooth = 0; tooth < teeth; ++tooth) {
    for (const auto& [share, radius] : kTooth) {
      const double angle = 2.0 * std::numbers::pi * (tooth + share) / teeth;
      loop.push_back(static_cast<std::uint32_t>(positions.size()));
      positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  }
  return needlePrism(positions, {loop}, loop, thickness);
}

SurfaceMesh screwThread(int turns, int around) {
  constexpr int kRingsPerTurn = 8;
  constexpr double kPitch = 0.2;
  const auto depth = [](double turn) {
    turn -= std::floor(turn);
    if (turn < 0.2) return 0.0;
    if (turn < 0.4) return (turn - 0.2) / 0.2;
    return turn < 0.8 ? 1.0 : (1.0 - turn) / 0.2;
  };
  SurfaceMesh mesh;
  const int rings = turns * kRingsPerTurn + 1;
  for (int i = 0; i < rings; ++i) {
    const double turn = static_cast<double>(i) / kRingsPerTurn;
    for (int j = 0; j < around; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / around;
      const double radius = 0.5 + 0.15 * depth(turn - static_cast<double>(j) / around);
      addPoint(mesh, {radius * std::cos(angle), radius * std::sin(angle), kPitch * turn});
    }
  }
  const auto n = static_cast<std::uint32_t>(around);
  const std::uint32_t last = n * static_cast<std::uint32_t>(rings - 1);
  addRings(mesh, static_cast<std::uint32_t>(rings), n);
  const std::uint32_t below = addPoint(mesh, {0.0, 0.0, 0.0});
  const std::uint32_t above = addPoint(mesh, {0.0, 0.0, kPitch * turns});
  for (std::uint32_t j = 0; j < n; ++j) {
    const std::uint32_t k = (j + 1) % n;
    addTriangle(mesh, below, k, j);
    addTriangle(mesh, above, last + j, last + k);
  }
  return mesh;
}

SurfaceMesh twistedBlade(int along, int across, double thickness) {
  SurfaceMesh mesh;
  const auto addSection = [&](double share) {
    const auto addAt = [&](double x, double y) {
      const double chord = 1.0 - 0.5 * share;
      const double u = (x - 0.5) * chord;
      const double v = y * chord + 0.1 * u * u;
      const double angle = 1.2 * share;
      addPoint(mesh, {u * std::cos(angle) - v * std::sin(angle),
                      u * std::sin(angle) + v * std::cos(angle), 6.0 * share});
    };
    for (int k = 0; k < 2 * across; ++k) {
      const double x = 0.5 * (1.0 - std::cos(std::numbers::pi * k / across));
      addAt(x, (k < across ? -0.3 : 1.0) * 4.0 * thickness * x * (1.0 - x));
    }
  };
  for (int i = 0; i <= along; ++i) addSection(static_cast<double>(i) / along);
  const auto n = static_cast<std::uint32_t>(2 * across);
  const std::uint32_t last = n * static_cast<std::uint32_t>(along);
  addRings(mesh, static_cast<std::uint32_t>(along + 1), n);
  // Close both ends from edge to edge: a triangle, strips of two triangles, a triangle.
  for (std::uint32_t k = 0; k + 1 < n / 2; ++k) {
    const std::uint32_t below = k + 1;
    const std::uint32_t above = n - 1 - k;
    const std::uint32_t before = k == 0 ? 0 : above + 1;
    addTriangle(mesh, before, above, below);
    addTriangle(mesh, last + before, last + below, last + above);
    if (k > 0) {
      addTriangle(mesh, k, before, below);
      addTriangle(mesh, last + k, last + below, last + before);
    }
  }
  const std::uint32_t tip = n / 2;
  addTriangle(mesh, tip - 1, tip + 1, tip);
  addTriangle(mesh, last + tip - 1, last + tip, last + tip + 1);
  return mesh;
}

SurfaceMesh bentSheet(int strips, double thickness) {
  std::vector<Vec2> positions;
  std::vector<std::uint32_t> loop;
  const auto add = [&](double radius, int i) {
    const double angle = std::numbers::pi * i / strips;
    loop.push_back(static_cast<std::uint32_t>(positions.size()));
    positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int i = 0; i <= strips; ++i) add(1.0, i);
  for (int i = strips; i >= 0; --i) add(1.0 - thickness, i);
  return needlePrism(positions, {loop}, loop, 3.0);
}

SurfaceMesh blockWithIsland(int n) {
  SurfaceMesh mesh = gridBox(Vec3(0.0), Vec3(1.0), {n, n, n}, Diagonals::kRandom, 1);
  SurfaceMesh cavity = gridBox(Vec3(0.2), Vec3(0.8), {n, n, n}, Diagonals::kRandom, 2);
  turnInsideOut(cavity);
  append(mesh, cavity);
  append(mesh, gridBox(Vec3(0.4), Vec3(0.6), {n, n, n}, Diagonals::kRandom, 3));
  return mesh;
}

SurfaceMesh torusKnot(int p, int q, int count, int sectors) {
  constexpr double kMajor = 2.0;
  constexpr double kMinor = 1.0;
  constexpr double kRadius = 0.25;
  const auto position = [&](double t) {
    const double r = kMajor + kMinor * std::cos(q * t);
    return Vec3(r * std::cos(p * t), r * std::sin(p * t), kMinor * std::sin(q * t));
  };
  SurfaceMesh mesh;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * std::numbers::pi * i / count;
    const Vec3 centre = position(t);
    const Vec3 along = glm::normalize(position(t + 1e-4) - position(t - 1e-4));
    // This direction points away from the axis circle of the torus, so it never runs along the
    // knot.
    const Vec3 outwards = centre - kMajor * Vec3(std::cos(p * t), std::sin(p * t), 0.0);
    const Vec3 u = glm::normalize(outwards - along * glm::dot(outwards, along));
    const Vec3 v = glm::cross(along, u);
    for (int k = 0; k < sectors; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sectors;
      addPoint(mesh, centre + kRadius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  const auto n = static_cast<std::uint32_t>(sectors);
  const auto m = static_cast<std::uint32_t>(count);
  for (std::uint32_t i = 0; i < m; ++i) {
    const std::uint32_t next = (i + 1) % m;
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t l = (k + 1) % n;
      addSquare(mesh, {i * n + k, i * n + l, next * n + l, next * n + k}, (i + k) % 2 == 0);
    }
  }
  return mesh;
}

}  // namespace tetrafront::testing
