#include "preview/sampled_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/ids.h"
#include "boundary/boundary.h"
#include "sizing/expected_count.h"
#include "tetrafront/mesh.h"

namespace tetrafront {
namespace {

/// Builds a surface from the samples, with one node for all points that patches share.
class SampledSurface {
 public:
  explicit SampledSurface(const SampledModel& sampled) : sampled_(&sampled) {
    const auto highest = std::ranges::max_element(sampled.nodes);
    nodes_.assign(highest == sampled.nodes.end() ? 0 : *highest + 1, kNoIndex);
  }

  void addPatch(std::uint32_t patch, bool isFlipped) {
    const ModelPreview& preview = sampled_->preview;
    for (std::size_t t = preview.patchOffsets[patch]; t < preview.patchOffsets[patch + 1]; ++t) {
      std::array<std::uint32_t, 3> nodes{};
      for (std::size_t k = 0; k < 3; ++k) nodes[k] = nodeOf(preview.patchTriangles[3 * t + k]);
      // A side without length makes a degenerate triangle.
      if (nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[2] == nodes[0]) continue;
      if (isFlipped) std::swap(nodes[1], nodes[2]);
      mesh.triangles.insert(mesh.triangles.end(), nodes.begin(), nodes.end());
      mesh.trianglePatch.push_back(patch);
    }
  }

  SurfaceMesh mesh;

 private:
  std::uint32_t nodeOf(std::uint32_t point) {
    std::uint32_t& node = nodes_[sampled_->nodes[point]];
    if (node == kNoIndex) {
      node = static_cast<std::uint32_t>(mesh.points.size() / 3);
      for (std::size_t axis = 0; axis < 3; ++axis)
        mesh.points.push_back(sampled_->preview.patchPoints[3 * std::size_t{point} + axis]);
    }
    return node;
  }

  const SampledModel* sampled_;
  std::vector<std::uint32_t>
      nodes_;  ///< per node of the samples: its node in the mesh, or kNoIndex
};

bool isSingleRegion(const Closure& closure) {
  return closure.isPlain && std::ranges::all_of(closure.component, [](PatchId lowest) {
           return lowest == PatchId(0U);
         });
}

/// True for errors about intersections.
bool isIntersection(const Diagnostic& diagnostic) {
  return diagnostic.severity == Severity::kError &&
         diagnostic.code != DiagnosticCode::kDanglingSheet;
}

}  // namespace

SampledVolume findSampledVolume(const Model& model, const SampledModel& sampled,
                                const Closure& closure, InnerShells enclosed) {
  SampledVolume result;
  // A surface with a hole encloses nothing.
  if (std::ranges::count(sampled.isConforming, 0) > 0) return result;
  SampledSurface surface(sampled);
  for (std::uint32_t patch = 0; patch < model.patches.size(); ++patch)
    surface.addPatch(patch, closure.isReversed[patch] != 0);
  if (isSingleRegion(closure)) {
    result.volume = std::fabs(enclosedVolume(surface.mesh));
    result.boundary = std::move(surface.mesh);
    return result;
  }
  std::vector<Diagnostic> found;
  const Boundary closed =
      closeBoundary(surface.mesh, BoundarySource::kDrawnPatches, found, enclosed);
  if (std::ranges::any_of(found, isIntersection)) return result;
  if (closed.isValid) result.volume = enclosedVolume(surface.mesh);
  for (Diagnostic& diagnostic : found) {
    if (diagnostic.code == DiagnosticCode::kReorientedPatch) continue;
    // The user does not see the triangles of the samples.
    std::erase_if(diagnostic.entities,
                  [](const Entity& entity) { return entity.kind == EntityKind::kTriangle; });
    result.diagnostics.push_back(std::move(diagnostic));
  }
  if (result.volume) result.boundary = std::move(surface.mesh);
  return result;
}

}  // namespace tetrafront
