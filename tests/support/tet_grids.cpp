#include "support/tet_grids.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "support/random.h"

namespace tetrafront::testing {
namespace {

/// The six orders of the axes. Each is a path of edges from the lowest corner of a cube to the
/// highest; its four nodes form a tetrahedron. The flag is set if the tetrahedron is positively
/// oriented.
struct Path {
  std::array<int, 3> axes;
  bool isPositive;
};
constexpr std::array<Path, 6> kPaths{{{{0, 1, 2}, true},
                                      {{1, 2, 0}, true},
                                      {{2, 0, 1}, true},
                                      {{0, 2, 1}, false},
                                      {{2, 1, 0}, false},
                                      {{1, 0, 2}, false}}};

bool isOnSurface(const std::array<int, 3>& cell, int n) {
  return std::any_of(cell.begin(), cell.end(), [n](int c) { return c == 0 || c == n; });
}

}  // namespace

VolumeMesh cubeOfTetrahedra(int n, double jitter, std::uint64_t seed) {
  Random random(seed);
  VolumeMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> nodes;
  for (const bool wantsSurface : {true, false}) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        for (int k = 0; k <= n; ++k) {
          if (isOnSurface({i, j, k}, n) != wantsSurface) continue;
          nodes.try_emplace({i, j, k}, static_cast<std::uint32_t>(nodes.size()));
          for (const int c : {i, j, k}) {
            const double moved = wantsSurface ? 0.0 : random.between(-jitter, jitter);
            mesh.points.push_back((c + moved) / n);
          }
        }
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        for (const Path& path : kPaths) {
          std::array<int, 3> at{i, j, k};
          std::array<std::uint32_t, 4> tet{nodes[at], 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[static_cast<std::size_t>(path.axes[step])];
            tet[step + 1] = nodes[at];
          }
          if (!path.isPositive) std::swap(tet[2], tet[3]);
          mesh.tetrahedra.insert(mesh.tetrahedra.end(), tet.begin(), tet.end());
          mesh.regions.push_back(0);
        }
      }
    }
  }
  return mesh;
}

SurfaceMesh surfaceOf(const VolumeMesh& mesh, std::size_t nodeCount) {
  using Face = std::array<std::uint32_t, 3>;
  std::map<Face, std::vector<Face>> faces;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
    const std::uint32_t* n = &mesh.tetrahedra[t];
    for (const Face& face : {Face{n[1], n[2], n[3]}, Face{n[0], n[3], n[2]}, Face{n[0], n[1], n[3]},
                             Face{n[0], n[2], n[1]}}) {
      Face key = face;
      std::sort(key.begin(), key.end());
      faces[key].push_back(face);
    }
  }
  SurfaceMesh surface;
  surface.points.assign(mesh.points.begin(),
                        mesh.points.begin() + static_cast<std::ptrdiff_t>(3 * nodeCount));
  for (const auto& [key, owners] : faces) {
    if (owners.size() != 1) continue;
    surface.triangles.insert(surface.triangles.end(), owners[0].begin(), owners[0].end());
  }
  return surface;
}

std::size_t surfaceNodeCount(int n) {
  const auto all = static_cast<std::size_t>(n + 1);
  const auto inner = static_cast<std::size_t>(n - 1);
  return all * all * all - inner * inner * inner;
}

BackgroundGrid gridOf(const VolumeMesh& mesh) {
  BackgroundGrid grid;
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
    BackgroundNode node;
    node.position = Vec3(mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]);
    node.size = 1.0;
    grid.nodes.push_back(node);
  }
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
    const std::uint32_t* n = &mesh.tetrahedra[t];
    grid.tetrahedra.push_back({n[0], n[1], n[2], n[3]});
  }
  return grid;
}

}  // namespace tetrafront::testing
