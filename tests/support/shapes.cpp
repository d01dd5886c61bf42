#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "support/random.h"

namespace tetrafront::testing {
namespace {

/// Collects nodes and triangles. Nodes with the same key are the same node.
class Builder {
 public:
  using Key = std::array<int, 4>;

  std::uint32_t node(const Key& key, const Vec3& position) {
    const auto [at, isNew] = nodes_.try_emplace(key, static_cast<std::uint32_t>(nodes_.size()));
    if (isNew) mesh_.points.insert(mesh_.points.end(), {position.x, position.y, position.z});
    return at->second;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
  }
  SurfaceMesh take() { return std::move(mesh_); }

 private:
  std::map<Key, std::uint32_t> nodes_;
  SurfaceMesh mesh_;
};

Vec3 normalized(const Vec3& v) { return v / std::sqrt(glm::dot(v, v)); }

struct Icosahedron {
  std::array<Vec3, 12> nodes;
  std::array<std::array<int, 3>, 20> faces;
};

Icosahedron icosahedron() {
  const double p = std::numbers::phi;
  return {{{{-1, p, 0},
            {1, p, 0},
            {-1, -p, 0},
            {1, -p, 0},
            {0, -1, p},
            {0, 1, p},
            {0, -1, -p},
            {0, 1, -p},
            {p, 0, -1},
            {p, 0, 1},
            {-p, 0, -1},
            {-p, 0, 1}}},
          {{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
            {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
            {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}}};
}

/// Returns the key of the node with these weights (sum n) at three corners; it is the same from
/// every face that has the node.
Builder::Key weightKey(std::array<int, 3> corners, std::array<int, 3> weights, int n) {
  std::array<std::pair<int, int>, 3> parts;
  for (std::size_t q = 0; q < 3; ++q) {
    parts[q] = weights[q] > 0 ? std::pair(corners[q], weights[q]) : std::pair(12, 0);
  }
  std::sort(parts.begin(), parts.end());
  const int code = parts[0].first + 13 * parts[1].first + 169 * parts[2].first;
  return {code, parts[0].second, parts[1].second, n};
}

/// Returns whether the square (i, j) is cut from its lowest corner to the opposite one.
bool cutsForward(Diagonals diagonals, int i, int j, Random& random) {
  switch (diagonals) {
    case Diagonals::kParallel:
      return true;
    case Diagonals::kAlternating:
      return (i + j) % 2 == 0;
    case Diagonals::kUnionJack:
      return i % 2 == j % 2;
    case Diagonals::kRandom:
      return random.coin();
  }
  return true;
}

}  // namespace

SurfaceMesh geodesicSphere(int n) {
  const Icosahedron ico = icosahedron();
  Builder builder;
  for (const auto& face : ico.faces) {
    const auto at = [&](int i, int j) {
      const std::array<int, 3> w{n - i - j, i, j};
      Vec3 sum(0.0);
      for (std::size_t q = 0; q < 3; ++q) {
        sum += static_cast<double>(w[q]) * ico.nodes[static_cast<std::size_t>(face[q])];
      }
      return builder.node(weightKey(face, w, n), normalized(sum));
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        builder.triangle(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) builder.triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  return builder.take();
}

SurfaceMesh sphereOfAbout(int triangles) {
  return geodesicSphere(std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 20.0)))));
}

SurfaceMesh latitudeSphere(int rings, int sectors) {
  Builder builder;
  const auto at = [&](int ring, int sector) {
    const double theta = std::numbers::pi * ring / rings;
    const double phi = 2.0 * std::numbers::pi * (sector % sectors) / sectors;
    const bool isPole = ring == 0 || ring == rings;
    const Vec3 position = isPole ? Vec3(0.0, 0.0, ring == 0 ? 1.0 : -1.0)
                                 : Vec3(std::sin(theta) * std::cos(phi),
                                        std::sin(theta) * std::sin(phi), std::cos(theta));
    return builder.node({ring, isPole ? 0 : sector % sectors, 0, 0}, position);
  };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < sectors; ++s) {
      if (r + 1 < rings) builder.triangle(at(r, s), at(r + 1, s), at(r + 1, s + 1));
      if (r > 0) builder.triangle(at(r, s), at(r + 1, s + 1), at(r, s + 1));
    }
  }
  return builder.take();
}

SurfaceMesh gridBox(const Vec3& lower, const Vec3& upper, std::array<int, 3> counts,
                    Diagonals diagonals, std::uint64_t seed) {
  Builder builder;
  Random random(seed);
  const auto at = [&](const std::array<int, 3>& cell) {
    Vec3 position(0.0);
    for (int a = 0; a < 3; ++a) {
      const int n = counts[static_cast<std::size_t>(a)];
      const int i = cell[static_cast<std::size_t>(a)];
      position[a] = i == n ? upper[a] : lower[a] + (upper[a] - lower[a]) * i / n;
    }
    return builder.node({cell[0], cell[1], cell[2], 0}, position);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (const bool isUpper : {false, true}) {
      for (int i = 0; i < counts[u]; ++i) {
        for (int j = 0; j < counts[v]; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> cell{};
            cell[axis] = isUpper ? counts[axis] : 0;
            cell[u] = i + di;
            cell[v] = j + dj;
            return at(cell);
          };
          std::array<std::uint32_t, 4> q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (!isUpper) std::swap(q[1], q[3]);
          if (cutsForward(diagonals, i, j, random)) {
            builder.triangle(q[0], q[1], q[2]);
            builder.triangle(q[0], q[2], q[3]);
          } else {
            builder.triangle(q[0], q[1], q[3]);
            builder.triangle(q[1], q[2], q[3]);
          }
        }
      }
    }
  }
  return builder.take();
}

SurfaceMesh gridCube(int n, Diagonals diagonals, std::uint64_t seed) {
  return gridBox(Vec3(0.0), Vec3(1.0), {n, n, n}, diagonals, seed);
}

SurfaceMesh torus(double majorRadius, double minorRadius, int majorCount, int minorCount) {
  Builder builder;
  const auto at = [&](int i, int j) {
    i %= majorCount;
    j %= minorCount;
    const double phi = 2.0 * std::numbers::pi * i / majorCount;
    const double theta = 2.0 * std::numbers::pi * j / minorCount;
    const double r = majorRadius + minorRadius * std::cos(theta);
    return builder.node({i, j, 0, 0},
                        {r * std::cos(phi), r * std::sin(phi), minorRadius * std::sin(theta)});
  };
  for (int i = 0; i < majorCount; ++i) {
    for (int j = 0; j < minorCount; ++j) {
      builder.triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      builder.triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return builder.take();
}

SurfaceMesh cubeWithCubicCavity(int n, int m) {
  SurfaceMesh mesh = gridCube(n);
  SurfaceMesh cavity = gridBox(Vec3(0.25), Vec3(0.75), {m, m, m});
  turnInsideOut(cavity);
  append(mesh, cavity);
  return mesh;
}

SurfaceMesh cubeWithSphericalCavity(int n, int m) {
  SurfaceMesh mesh = gridCube(n);
  SurfaceMesh cavity = geodesicSphere(m);
  scale(cavity, 0.3);
  translate(cavity, Vec3(0.5));
  turnInsideOut(cavity);
  append(mesh, cavity);
  return mesh;
}

SurfaceMesh schoenhardtPrism(double degrees) {
  SurfaceMesh mesh;
  const double twist = degrees * std::numbers::pi / 180.0;
  for (int k = 0; k < 6; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k % 3) / 3.0 + (k < 3 ? 0.0 : twist);
    mesh.points.insert(mesh.points.end(), {std::cos(angle), std::sin(angle), k < 3 ? 0.0 : 1.0});
  }
  mesh.triangles = {0, 2, 1, 3, 4, 5};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t l = (k + 1) % 3;
    // The top is rotated counter-clockwise, away from k: this bends the side inward along the edge
    // from k to l+3.
    mesh.triangles.insert(mesh.triangles.end(), {k, l, l + 3, k, l + 3, k + 3});
  }
  return mesh;
}

SurfaceMesh thinPlate(int n, double thickness) {
  return gridBox(Vec3(0.0), Vec3(1.0, 1.0, thickness), {n, n, 1}, Diagonals::kAlternating);
}

namespace {

/// Appends a unit box shifted by (1,1,dz), merging nodes at the same position.
SurfaceMesh cubesJoined(double dz) {
  SurfaceMesh mesh = gridCube(1);
  SurfaceMesh other = gridCube(1);
  translate(other, Vec3(1.0, 1.0, dz));
  std::vector<std::uint32_t> joined;
  for (std::uint32_t i = 0; i < nodeCount(other); ++i) {
    std::uint32_t at = 0;
    while (at < nodeCount(mesh) && pointOf(mesh, at) != pointOf(other, i)) ++at;
    if (at == nodeCount(mesh)) {
      const Vec3 p = pointOf(other, i);
      mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
    }
    joined.push_back(at);
  }
  for (const std::uint32_t node : other.triangles) mesh.triangles.push_back(joined[node]);
  return mesh;
}

}  // namespace

SurfaceMesh cubesSharingEdge() { return cubesJoined(0.0); }
SurfaceMesh cubesSharingNode() { return cubesJoined(1.0); }

SurfaceMesh nestedSpheres(int depth, int n) {
  SurfaceMesh mesh;
  for (int level = 0; level < depth; ++level) {
    SurfaceMesh shell = geodesicSphere(n);
    scale(shell, 1.0 - static_cast<double>(level) / depth);
    if (level % 2 == 1) turnInsideOut(shell);
    append(mesh, shell);
  }
  return mesh;
}

SurfaceMesh dividedBox(std::array<int, 3> counts, int m) {
  Builder builder;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const auto square = [&](int level, int i, int j) {
      const auto corner = [&](int di, int dj) {
        Builder::Key at{};
        at[axis] = level * m;
        at[u] = i + di;
        at[v] = j + dj;
        return builder.node(at, Vec3(at[0], at[1], at[2]) / static_cast<double>(m));
      };
      std::array<std::uint32_t, 4> nodes{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
      // At the lowest level, outward is towards decreasing coordinates.
      if (level == 0) std::swap(nodes[1], nodes[3]);
      builder.triangle(nodes[0], nodes[1], nodes[2]);
      builder.triangle(nodes[0], nodes[2], nodes[3]);
    };
    for (int level = 0; level <= counts[axis]; ++level) {
      for (int i = 0; i < counts[u] * m; ++i) {
        for (int j = 0; j < counts[v] * m; ++j) square(level, i, j);
      }
    }
  }
  return builder.take();
}

RegionedSurface twoRegions(double maxVolume) {
  RegionedSurface made{dividedBox({2, 1, 1}, 1), {}};
  made.regions.maxVolumes = {maxVolume, 0.0};
  for (std::size_t t = 0; t < triangleCount(made.mesh); ++t) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += pointOf(made.mesh, made.mesh.triangles[3 * t + k]).x;
    const std::uint32_t back = sum <= 3.0 ? 0 : 1;
    const std::uint32_t front = sum == 3.0 ? 1 : SurfaceMesh::kNoRegion;
    made.regions.triangleRegions.insert(made.regions.triangleRegions.end(), {back, front});
  }
  return made;
}

HalfShare halvesOf(const SurfaceMesh& mesh) {
  HalfShare share;
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = pointOf(mesh, mesh.triangles[3 * t + k]);
    const bool isLeft = std::ranges::all_of(corners, [](const Vec3& p) { return p.x <= 1.0; });
    ++(isLeft ? share.left : share.right);
    double& longest = isLeft ? share.longestLeft : share.longestRight;
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, glm::length(corners[(k + 1) % 3] - corners[k]));
    }
  }
  return share;
}

SurfaceMesh tetrahedronSurface(const std::array<Vec3, 4>& corners) {
  SurfaceMesh mesh;
  for (const Vec3& p : corners) mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
  mesh.triangles = {1, 2, 3, 0, 3, 2, 0, 1, 3, 0, 2, 1};
  if (enclosedVolume(mesh) < 0.0) turnInsideOut(mesh);
  return mesh;
}

void translate(SurfaceMesh& mesh, const Vec3& by) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    mesh.points[i] += by[static_cast<int>(i % 3)];
}

void stretch(SurfaceMesh& mesh, const Vec3& factors) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    mesh.points[i] *= factors[static_cast<int>(i % 3)];
  }
}

void scale(SurfaceMesh& mesh, double factor) {
  for (double& coordinate : mesh.points) coordinate *= factor;
}

void mirror(SurfaceMesh& mesh) {
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) mesh.points[i] = -mesh.points[i];
  turnInsideOut(mesh);
}

void rotateRandomly(SurfaceMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  // Draw a uniformly distributed unit quaternion by rejection.
  std::array<double, 4> q{};
  double square = 0.0;
  do {
    square = 0.0;
    for (double& c : q) {
      c = random.between(-1.0, 1.0);
      square += c * c;
    }
  } while (square > 1.0 || square < 0.01);
  const Vec3 axis = Vec3(q[1], q[2], q[3]) / std::sqrt(square);
  const double w = q[0] / std::sqrt(square);
  for (std::uint32_t i = 0; i < nodeCount(mesh); ++i) {
    const Vec3 p = pointOf(mesh, i);
    const Vec3 t = 2.0 * glm::cross(axis, p);
    const Vec3 r = p + w * t + glm::cross(axis, t);
    for (int a = 0; a < 3; ++a)
      mesh.points[3 * std::size_t{i} + static_cast<std::size_t>(a)] = r[a];
  }
}

void turnInsideOut(SurfaceMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    std::swap(mesh.triangles[t + 1], mesh.triangles[t + 2]);
  }
}

void flipRandomly(SurfaceMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    if (random.coin()) std::swap(mesh.triangles[t + 1], mesh.triangles[t + 2]);
  }
}

void shuffle(SurfaceMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  const auto permutation = [&](std::size_t n) {
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = n; i > 1; --i) {
      std::swap(order[i - 1],
                order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
    }
    return order;
  };
  const std::vector<std::uint32_t> newNode = permutation(nodeCount(mesh));
  const std::vector<std::uint32_t> newTriangle = permutation(triangleCount(mesh));
  SurfaceMesh result = mesh;
  for (std::uint32_t i = 0; i < nodeCount(mesh); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      result.points[3 * std::size_t{newNode[i]} + a] = mesh.points[3 * std::size_t{i} + a];
    }
  }
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    const auto turn = static_cast<std::size_t>(random.integer(0, 2));
    for (std::size_t k = 0; k < 3; ++k) {
      result.triangles[3 * std::size_t{newTriangle[t]} + k] =
          newNode[mesh.triangles[3 * t + (k + turn) % 3]];
    }
  }
  mesh = std::move(result);
}

void append(SurfaceMesh& mesh, const SurfaceMesh& other) {
  const auto offset = static_cast<std::uint32_t>(nodeCount(mesh));
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const std::uint32_t node : other.triangles) mesh.triangles.push_back(node + offset);
}

std::size_t nodeCount(const SurfaceMesh& mesh) { return mesh.points.size() / 3; }
std::size_t triangleCount(const SurfaceMesh& mesh) { return mesh.triangles.size() / 3; }

namespace {

/// Returns six times the volume of the tetrahedron of a triangle and a position.
double sixVolume(const SurfaceMesh& mesh, std::size_t triangle, const Vec3& position) {
  const std::uint32_t* nodes = &mesh.triangles[3 * triangle];
  const Vec3 a = pointOf(mesh, nodes[0]) - position;
  const Vec3 b = pointOf(mesh, nodes[1]) - position;
  const Vec3 c = pointOf(mesh, nodes[2]) - position;
  return glm::dot(a, glm::cross(b, c));
}

}  // namespace

double enclosedVolume(const SurfaceMesh& mesh) {
  Vec3 centre(0.0);
  for (std::uint32_t i = 0; i < nodeCount(mesh); ++i) centre += pointOf(mesh, i);
  centre /= static_cast<double>(std::max<std::size_t>(1, nodeCount(mesh)));
  double sum = 0.0;
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) sum += sixVolume(mesh, t, centre);
  return sum / 6.0;
}

// Each region has its own origin: with a distant origin, rounding would hide the volume of a small
// region.
std::vector<double> regionVolumes(const SurfaceMesh& mesh) {
  std::vector<double> volumes;
  std::vector<std::optional<Vec3>> positions;
  for (std::size_t side = 0; side < mesh.triangleRegions.size(); ++side) {
    const std::uint32_t region = mesh.triangleRegions[side];
    if (region == SurfaceMesh::kNoRegion) continue;
    if (region >= volumes.size()) {
      volumes.resize(region + 1, 0.0);
      positions.resize(region + 1);
    }
    if (!positions[region]) positions[region] = pointOf(mesh, mesh.triangles[3 * (side / 2)]);
    const double volume = sixVolume(mesh, side / 2, *positions[region]) / 6.0;
    volumes[region] += side % 2 == 0 ? volume : -volume;
  }
  return volumes;
}

}  // namespace tetrafront::testing
