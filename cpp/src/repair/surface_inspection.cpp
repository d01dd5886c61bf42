#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "quality/metrics.h"
#include "boundary/boundary.h"
#include "boundary/corner_fans.h"
#include "boundary/edge_table.h"
#include "boundary/surface_access.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {
namespace {

constexpr std::size_t kMaxWorst = 10;

bool hasCode(const std::vector<Diagnostic>& diagnostics, DiagnosticCode code) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [code](const Diagnostic& d) { return d.code == code; });
}

/// Coordinates and indices that nothing may be asked of.
bool hasInvalidNumbers(const std::vector<Diagnostic>& diagnostics) {
  return hasCode(diagnostics, DiagnosticCode::kNotFinite) ||
         hasCode(diagnostics, DiagnosticCode::kIndexOutOfRange) ||
         hasCode(diagnostics, DiagnosticCode::kEmptyModel);
}

double areaOf(const std::array<Vec3, 3>& p) {
  return 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
}

/// Of the angle between two edges from one corner; 1 where one has no length.
double cosineBetween(const Vec3& a, const Vec3& b) {
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0.0 ? glm::dot(a, b) / lengths : 1.0;
}

TriangleFigures qualityOf(const SurfaceMesh& mesh, std::uint32_t triangle, double radiusRatio) {
  const std::array<Vec3, 3> p = cornersOf(mesh, triangle);
  const double largestCosine =
      std::max({cosineBetween(p[1] - p[0], p[2] - p[0]), cosineBetween(p[2] - p[1], p[0] - p[1]),
                cosineBetween(p[0] - p[2], p[1] - p[2])});
  return {.triangle = triangle,
          .place = (p[0] + p[1] + p[2]) / 3.0,
          .area = areaOf(p),
          .smallestAngle = degreesOf(largestCosine),
          .radiusRatio = radiusRatio};
}

}  // namespace

class SurfaceInspector::Impl {
 public:
  Impl(std::span<const double> points, std::span<const std::uint32_t> triangles,
       const InspectionOptions& options) {
    mesh_.points.assign(points.begin(), points.end());
    mesh_.triangles.assign(triangles.begin(), triangles.end());
    given_ = mesh_.triangles;
    check_.emplace(mesh_, BoundarySource::kGivenSurface, options.enclosed,
                   MixedOrientation::kRefuse, options.findings);
  }

  bool advance(std::uint32_t budget) {
    if (isFinished_) return true;
    if (!check_->advance(budget)) return false;
    measure();
    isFinished_ = true;
    return true;
  }

  [[nodiscard]] double fraction() const { return isFinished_ ? 1.0 : check_->fraction(); }
  [[nodiscard]] const SurfaceInspection& result() const { return result_; }

 private:
  void measure();
  void measureNodes();
  void measureEdges(const EdgeTable& edges);
  void countNonManifoldNodes(const EdgeTable& edges);
  void measureTriangles();
  void countFlippedTriangles();
  void measureShellsAndRegions();

  SurfaceMesh mesh_;
  std::vector<std::uint32_t> given_;  ///< the triangles before the check turned some
  std::optional<BoundaryCheck> check_;
  bool isFinished_ = false;
  SurfaceInspection result_;
};

void SurfaceInspector::Impl::measure() {
  result_.diagnostics = check_->takeDiagnostics();
  result_.isFillable = check_->result().valid;
  if (hasInvalidNumbers(result_.diagnostics)) return;
  result_.isEmbedded = !hasCode(result_.diagnostics, DiagnosticCode::kSelfIntersection) &&
                       !hasCode(result_.diagnostics, DiagnosticCode::kDuplicateTriangle);
  measureNodes();
  // As the check has them, or the two would contradict each other.
  const EdgeTable edges(mesh_.triangles, mesh_.points.size() / 3, check_->withoutEdges());
  measureEdges(edges);
  countNonManifoldNodes(edges);
  result_.isClosed = result_.edges > 0 && result_.openEdges == 0;
  result_.isManifold = result_.crowdedEdges == 0 && result_.pinchedNodes == 0;
  measureTriangles();
  countFlippedTriangles();
  if (result_.isFillable) measureShellsAndRegions();
}

void SurfaceInspector::Impl::measureNodes() {
  std::vector<std::uint8_t> isUsed(mesh_.points.size() / 3, 0);
  for (const std::uint32_t node : mesh_.triangles) isUsed[node] = 1;
  for (std::uint32_t i = 0; i < isUsed.size(); ++i) {
    if (isUsed[i] == 0) {
      ++result_.unusedNodes;
      continue;
    }
    const Vec3 p = pointOf(mesh_, i);
    if (result_.nodes++ == 0) result_.low = result_.high = p;
    for (int k = 0; k < 3; ++k) {
      result_.low[k] = std::min(result_.low[k], p[k]);
      result_.high[k] = std::max(result_.high[k], p[k]);
    }
  }
}

void SurfaceInspector::Impl::measureEdges(const EdgeTable& edges) {
  double sum = 0.0;
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
    if (halfEdges.size() == 1) ++result_.openEdges;
    if (halfEdges.size() > 2) ++result_.crowdedEdges;
    const HalfEdgeNodes nodes = nodesOf(mesh_.triangles, halfEdges[0]);
    const double length = glm::length(pointOf(mesh_, nodes.to) - pointOf(mesh_, nodes.from));
    sum += length;
    result_.shortestEdge = e == 0 ? length : std::min(result_.shortestEdge, length);
    result_.longestEdge = std::max(result_.longestEdge, length);
  }
  result_.edges = static_cast<std::uint32_t>(edges.edgeCount());
  if (result_.edges > 0) result_.meanEdge = sum / result_.edges;
}

void SurfaceInspector::Impl::countNonManifoldNodes(const EdgeTable& edges) {
  const std::vector<std::uint32_t> fans = cornerFans(mesh_.triangles, edges);
  std::vector<std::uint8_t> fansAt(mesh_.points.size() / 3, 0);
  for (std::uint32_t c = 0; c < fans.size(); ++c) {
    if (fans[c] != c || check_->withoutEdges()[c / 3] != 0) continue;
    std::uint8_t& count = fansAt[mesh_.triangles[c]];
    if (count == 1) ++result_.pinchedNodes;
    if (count < 2) ++count;
  }
}

void SurfaceInspector::Impl::measureTriangles() {
  struct Ranked {
    double radiusRatio;
    std::uint32_t triangle;
    bool operator<(const Ranked& other) const {
      return radiusRatio != other.radiusRatio ? radiusRatio < other.radiusRatio
                                              : triangle < other.triangle;
    }
  };
  std::vector<Ranked> worst;
  result_.triangles = static_cast<std::uint32_t>(mesh_.triangles.size() / 3);
  for (std::uint32_t t = 0; t < result_.triangles; ++t) {
    const std::array<Vec3, 3> p = cornersOf(mesh_, t);
    result_.area += areaOf(p);
    const Ranked one{triangleRadiusRatio(p[0], p[1], p[2]), t};
    if (worst.size() == kMaxWorst && !(one < worst.back())) continue;
    worst.insert(std::upper_bound(worst.begin(), worst.end(), one), one);
    if (worst.size() > kMaxWorst) worst.pop_back();
  }
  for (const Ranked& one : worst) {
    result_.worst.push_back(qualityOf(mesh_, one.triangle, one.radiusRatio));
  }
}

/// None where the check went no further than to what keeps the surface from enclosing a volume.
void SurfaceInspector::Impl::countFlippedTriangles() {
  for (std::uint32_t t = 0; t < result_.triangles; ++t) {
    if (given_[3 * std::size_t{t} + 1] != mesh_.triangles[3 * std::size_t{t} + 1]) {
      ++result_.turnedTriangles;
    }
  }
}

void SurfaceInspector::Impl::measureShellsAndRegions() {
  const BoundaryResult& boundary = check_->result();
  result_.regions = boundary.regionCount;
  for (const BoundaryShell& shell : boundary.shells) {
    result_.volume += shell.volume;
    result_.shells.push_back({.firstTriangle = shell.firstTriangle,
                              .triangles = shell.triangles,
                              .region = shell.region,
                              .isCavity = shell.volume < 0.0 && !mesh_.isWall(shell.firstTriangle),
                              .area = shell.area,
                              .volume = std::fabs(shell.volume)});
  }
}

SurfaceInspector::SurfaceInspector(std::span<const double> points,
                                   std::span<const std::uint32_t> triangles,
                                   const InspectionOptions& options)
    : impl_(std::make_unique<Impl>(points, triangles, options)) {}
SurfaceInspector::SurfaceInspector(SurfaceInspector&&) noexcept = default;
SurfaceInspector& SurfaceInspector::operator=(SurfaceInspector&&) noexcept = default;
SurfaceInspector::~SurfaceInspector() = default;

bool SurfaceInspector::advance(std::uint32_t budget) {
  return impl_->advance(std::max(budget, 1U));
}
double SurfaceInspector::fraction() const { return impl_->fraction(); }
const SurfaceInspection& SurfaceInspector::result() const { return impl_->result(); }

}  // namespace tetrafront
