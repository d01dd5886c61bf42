#include "surface/patch_summary.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "quality/metrics.h"

namespace tetrafront {

namespace {

/// The sine of the angle between two tangents below which they span no plane to measure from.
constexpr double kParallel = 1e-9;

/// Sums over the triangles.
class Summary {
 public:
  Summary(const PatchMetric& metric, const PlanarMesh& mesh) : metric_(&metric), mesh_(&mesh) {}

  void addTriangle(const std::array<std::uint32_t, 3>& nodes) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh_->places[nodes[k]];
    addShape(corners);
    deviate((mesh_->plane[nodes[0]] + mesh_->plane[nodes[1]] + mesh_->plane[nodes[2]]) / 3.0,
            (corners[0] + corners[1] + corners[2]) / 3.0);
    for (std::size_t k = 0; k < 3; ++k) addEdge(nodes[(k + 1) % 3], nodes[(k + 2) % 3]);
    ++triangles_;
  }

  /// Inner edges are met from both sides, those of the boundary once.
  void addBoundarySide(std::uint32_t from, std::uint32_t to) {
    edgeSum_ += metricLength(from, to);
    ++edgeCount_;
  }

  [[nodiscard]] PatchSummary result(std::uint32_t patch) const {
    PatchSummary summary;
    summary.patch = patch;
    summary.triangles = triangles_;
    if (triangles_ == 0) return summary;
    summary.minAngle = degreesOf(largestCosine_);
    summary.meanRadiusRatio = radiusRatioSum_ / triangles_;
    summary.meanEdge = edgeSum_ / edgeCount_;
    summary.chordDeviation = deviation_;
    return summary;
  }

 private:
  void addShape(const std::array<Vec3, 3>& corners) {
    radiusRatioSum_ += triangleRadiusRatio(corners[0], corners[1], corners[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 first = corners[(k + 1) % 3] - corners[k];
      const Vec3 second = corners[(k + 2) % 3] - corners[k];
      const double lengths = glm::length(first) * glm::length(second);
      largestCosine_ =
          std::max(largestCosine_, lengths > 0.0 ? glm::dot(first, second) / lengths : 1.0);
    }
  }

  void addEdge(std::uint32_t from, std::uint32_t to) {
    edgeSum_ += metricLength(from, to);
    ++edgeCount_;
    // The other triangle has the edge the other way round, unless there is none.
    if (from > to && from >= mesh_->boundaryCount) return;
    deviate(0.5 * (mesh_->plane[from] + mesh_->plane[to]),
            0.5 * (mesh_->places[from] + mesh_->places[to]));
  }

  [[nodiscard]] double metricLength(std::uint32_t from, std::uint32_t to) {
    const Vec3 edge = mesh_->places[to] - mesh_->places[from];
    const double size = 0.5 * (mesh_->sizes[from] + mesh_->sizes[to]);
    const Vec3 middle = 0.5 * (mesh_->places[from] + mesh_->places[to]);
    const LocalSpace local = metric_->spaceAt(middle, size, hint_);
    return glm::length(local.unit(edge)) / local.wantedSide;
  }

  /// Distance of `place` from the tangent plane where the surface is nearest, up to terms of
  /// fourth order in the edge length: `plane` is off that point by second order at most.
  void deviate(const Vec2& plane, const Vec3& place) {
    const SurfacePoint point = metric_->surface().evaluate(plane);
    const Vec3 offset = place - point.position;
    const Vec3 normal = glm::cross(point.alongXi, point.alongEta);
    const double length = glm::length(normal);
    const double tangents = glm::length(point.alongXi) * glm::length(point.alongEta);
    deviation_ = std::max(deviation_, length > kParallel * tangents
                                          ? std::fabs(glm::dot(offset, normal)) / length
                                          : glm::length(offset));
  }

  const PatchMetric* metric_;
  const PlanarMesh* mesh_;
  FieldHint hint_;
  std::uint32_t triangles_ = 0;
  double largestCosine_ = -1.0;
  double radiusRatioSum_ = 0.0;
  double edgeSum_ = 0.0;
  double edgeCount_ = 0.0;
  double deviation_ = 0.0;
};

}  // namespace

PatchSummary summarizePatch(const PatchMetric& metric, const PlanarMesh& mesh,
                            std::uint32_t patch) {
  Summary summary(metric, mesh);
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
    summary.addTriangle({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
  for (std::size_t i = 0; i + 1 < mesh.sides.size(); i += 2)
    summary.addBoundarySide(mesh.sides[i], mesh.sides[i + 1]);
  return summary.result(patch);
}

}  // namespace tetrafront
