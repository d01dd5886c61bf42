#include "surface/patch_summary.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/tolerance.h"
#include "quality/metrics.h"
#include "sizing/target_sizes.h"
#include "topology/surface_access.h"

namespace tetrafront {

namespace {

/// If the sine of the angle between two tangents is smaller, they define no tangent plane.
constexpr double kParallel = Tolerance::kCoincidence;

/// Sums and extrema of the shapes of triangles and of the lengths of their edges.
class Shapes {
 public:
  void addTriangle(const std::array<Vec3, 3>& corners) {
    ++triangles_;
    radiusRatioSum_ += triangleRadiusRatio(corners[0], corners[1], corners[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 first = corners[(k + 1) % 3] - corners[k];
      const Vec3 second = corners[(k + 2) % 3] - corners[k];
      const double lengths = glm::length(first) * glm::length(second);
      largestCosine_ =
          std::max(largestCosine_, lengths > 0.0 ? glm::dot(first, second) / lengths : 1.0);
    }
  }

  /// `length`: length / target length.
  void addEdge(double length) {
    edgeSum_ += length;
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
    return summary;
  }

 private:
  std::uint32_t triangles_ = 0;
  double largestCosine_ = -1.0;
  double radiusRatioSum_ = 0.0;
  double edgeSum_ = 0.0;
  double edgeCount_ = 0.0;
};

/// Statistics of a drawn patch.
class Summary {
 public:
  Summary(const PatchMetric& metric, const PlanarMesh& mesh) : metric_(&metric), mesh_(&mesh) {}

  void addTriangle(const PlanarMesh::Triangle& nodes) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh_->positionOf(nodes[k]);
    shapes_.addTriangle(corners);
    addDeviation(
        (mesh_->planeOf(nodes[0]) + mesh_->planeOf(nodes[1]) + mesh_->planeOf(nodes[2])) / 3.0,
        (corners[0] + corners[1] + corners[2]) / 3.0);
    for (std::size_t k = 0; k < 3; ++k) addEdge(nodes[(k + 1) % 3], nodes[(k + 2) % 3]);
  }

  /// Adds a side once more: triangles visit interior edges twice, but sides once.
  void addBoundarySide(const PlanarMesh::Side& side) {
    shapes_.addEdge(metricLength(side.from, side.to));
  }

  [[nodiscard]] PatchSummary result(PatchId patch) const {
    PatchSummary summary = shapes_.result(patch.value);
    summary.chordDeviation = deviation_;
    return summary;
  }

 private:
  void addEdge(PlanarNodeId from, PlanarNodeId to) {
    shapes_.addEdge(metricLength(from, to));
    // The other triangle visits the edge in the opposite direction; a side has no other triangle.
    if (from > to && !mesh_->isBoundary(from)) return;
    addDeviation(0.5 * (mesh_->planeOf(from) + mesh_->planeOf(to)),
                 0.5 * (mesh_->positionOf(from) + mesh_->positionOf(to)));
  }

  [[nodiscard]] double metricLength(PlanarNodeId from, PlanarNodeId to) {
    const Vec3 edge = mesh_->positionOf(to) - mesh_->positionOf(from);
    const double size = 0.5 * (mesh_->sizeOf(from) + mesh_->sizeOf(to));
    const Vec3 middle = 0.5 * (mesh_->positionOf(from) + mesh_->positionOf(to));
    const LocalSpace local = metric_->spaceAt(middle, size, hint_);
    return glm::length(local.unit(edge)) / local.targetLength;
  }

  /// Measures the distance of `position` from the surface as the distance from the tangent plane at `plane`. The
  /// nearest point of the surface differs from that at `plane` in second order of the edge length, so the error is
  /// of fourth order.
  void addDeviation(const Vec2& plane, const Vec3& position) {
    const SurfacePoint point = metric_->surface().evaluate(plane);
    const Vec3 offset = position - point.position;
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
  Shapes shapes_;
  double deviation_ = 0.0;
};

}  // namespace

PatchSummary summarizePatch(const PatchMetric& metric, const PlanarMesh& mesh, PatchId patch) {
  Summary summary(metric, mesh);
  for (const PlanarMesh::Triangle& triangle : mesh.triangles) summary.addTriangle(triangle);
  for (const PlanarMesh::Side& side : mesh.sides) summary.addBoundarySide(side);
  return summary.result(patch);
}

std::vector<PatchSummary> summarizeGivenPatches(const SurfaceMesh& surface, const SizeField& field,
                                                std::uint32_t first, std::uint32_t end) {
  std::vector<Shapes> shapes(end - first);
  FieldHint hint;
  for (std::size_t t = 0; t < countTriangles(surface); ++t) {
    const std::uint32_t patch = surface.trianglePatch[t];
    if (patch < first || patch >= end) continue;
    Shapes& own = shapes[patch - first];
    const std::array<Vec3, 3> corners = cornersOf(surface, TriangleId(t));
    own.addTriangle(corners);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& from = corners[k];
      const Vec3& to = corners[(k + 1) % 3];
      own.addEdge(metricLengthAt(field, 0.5 * (from + to), to - from, hint));
    }
  }
  std::vector<PatchSummary> summaries;
  for (std::uint32_t patch = first; patch < end; ++patch) {
    summaries.push_back(shapes[patch - first].result(patch));
  }
  return summaries;
}

}  // namespace tetrafront
