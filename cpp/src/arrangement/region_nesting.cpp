#include "arrangement/region_nesting.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "boundary/ray_crossing.h"
#include "boundary/self_intersection.h"
#include "geom/measure.h"
#include "search/box_tree.h"
#include "topology/disjoint_sets.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

class RegionNesting {
 public:
  explicit RegionNesting(SurfaceMesh& mesh) : mesh_(mesh) {
    DisjointSets nodes(countNodes(mesh));
    for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
      const auto [a, b, c] = nodesOf(mesh, TriangleId(t));
      nodes.join(a.value, b.value);
      nodes.join(a.value, c.value);
    }
    for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
      componentOf_.push_back(nodes.find(nodesOf(mesh, TriangleId(t))[0].value));
      trianglesOf_[componentOf_.back()].push_back(TriangleId(t));
    }
  }

  std::vector<SharedCell> run(std::vector<TriangleId>& origin) {
    std::vector<SharedCell> shared;
    if (trianglesOf_.size() < 2) return shared;
    const BoxTree tree(triangleBoxes(mesh_));
    std::map<std::uint32_t, std::uint32_t> regionAround;
    for (const auto& [component, triangles] : trianglesOf_) {
      const std::uint32_t around = regionOutside(tree, component);
      if (around == SurfaceMesh::kNoRegion) continue;
      regionAround[component] = around;
      listShared(triangles, around, shared);
    }
    for (const auto& [component, around] : regionAround) giveTo(component, around);
    if (!regionAround.empty()) removeInner(origin);
    return shared;
  }

 private:
  [[nodiscard]] std::uint32_t& sideOf(TriangleId triangle, std::size_t side) {
    return mesh_.triangleRegions[2 * triangle.index() + side];
  }

  /// Returns the lowest region of the other components around one. A ray crosses the boundary of each of them an odd number of times.
  [[nodiscard]] std::uint32_t regionOutside(const BoxTree& tree, std::uint32_t component) {
    const Vec3 start = pointOf(mesh_, NodeId(component));
    std::set<std::pair<std::uint32_t, std::uint32_t>> crossed;  // regions of components
    tree.visitOverlaps(boxOfRay(start), [&](std::uint32_t item) {
      const TriangleId triangle(item);
      if (componentOf_[item] == component || !isAheadOf(mesh_, start, triangle)) return;
      for (const std::size_t side : {0U, 1U}) {
        const std::pair key{sideOf(triangle, side), componentOf_[item]};
        if (key.first == SurfaceMesh::kNoRegion) continue;
        if (!crossed.insert(key).second) crossed.erase(key);
      }
    });
    return crossed.empty() ? SurfaceMesh::kNoRegion : crossed.begin()->first;
  }

  void listShared(const std::vector<TriangleId>& triangles, std::uint32_t around,
                  std::vector<SharedCell>& shared) {
    struct Measure {
      double volume = 0.0;
      double area = 0.0;
      Vec3 position{0.0};
    };
    std::map<std::uint32_t, Measure> measures;
    const Vec3 origin = cornersOf(mesh_, triangles[0])[0];
    for (const TriangleId triangle : triangles) {
      const auto [a, b, c] = cornersOf(mesh_, triangle);
      const double volume = sixVolumesBelow(origin, a, b, c) / 6.0;
      for (const std::size_t side : {0U, 1U}) {
        const std::uint32_t region = sideOf(triangle, side);
        if (region == SurfaceMesh::kNoRegion || region == around) continue;
        Measure& measure = measures[region];
        if (measure.area == 0.0) measure.position = centroidOf({a, b, c});
        measure.volume += side == 0 ? volume : -volume;
        measure.area += areaOf({a, b, c});
      }
    }
    for (const auto& [region, measure] : measures) {
      shared.push_back({{std::min(region, around), std::max(region, around)},
                        measure.volume,
                        2.0 * measure.volume / measure.area,
                        measure.position});
    }
  }

  /// kNoRegion is above all regions.
  void giveTo(std::uint32_t component, std::uint32_t around) {
    for (const TriangleId triangle : trianglesOf_.at(component)) {
      for (const std::size_t side : {0U, 1U}) {
        sideOf(triangle, side) = std::min(sideOf(triangle, side), around);
      }
    }
  }

  void removeInner(std::vector<TriangleId>& origin) {
    std::size_t kept = 0;
    for (std::uint32_t t = 0; t < componentOf_.size(); ++t) {
      const TriangleId from(t);
      if (sideOf(from, 0) == sideOf(from, 1)) continue;
      const TriangleId to(kept);
      for (std::size_t k = 0; k < 3; ++k) {
        mesh_.triangles[3 * kept + k] = mesh_.triangles[3 * std::size_t{t} + k];
      }
      for (const std::size_t side : {0U, 1U}) sideOf(to, side) = sideOf(from, side);
      origin[kept++] = origin[t];
    }
    mesh_.triangles.resize(3 * kept);
    mesh_.triangleRegions.resize(2 * kept);
    origin.resize(kept);
  }

  SurfaceMesh& mesh_;
  std::vector<std::uint32_t> componentOf_;                        ///< per triangle: a node of it
  std::map<std::uint32_t, std::vector<TriangleId>> trianglesOf_;  ///< per component
};

}  // namespace

std::vector<SharedCell> nestRegions(SurfaceMesh& mesh, std::vector<TriangleId>& origin) {
  return RegionNesting(mesh).run(origin);
}

}  // namespace tetrafront
