#include "surface/self_intersection.h"

#include "base/sort.h"
#include "geom/intersect.h"
#include "geom/measure.h"
#include "surface/surface_access.h"

namespace tetrafront {
namespace {

NumberedTriangle triangleOf(const SurfaceMesh& mesh, std::uint32_t triangle) {
  const std::size_t i = 3 * std::size_t{triangle};
  return {{mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]},
          cornersOf(mesh, triangle)};
}

Box boxOf(const SurfaceMesh& mesh, std::uint32_t triangle) {
  const std::array<Vec3, 3> p = cornersOf(mesh, triangle);
  return Box::of(p[0], p[1], p[2]);
}

}  // namespace

std::vector<Box> triangleBoxes(const SurfaceMesh& mesh) {
  std::vector<Box> boxes;
  const std::size_t count = mesh.triangles.size() / 3;
  boxes.reserve(count);
  for (std::uint32_t t = 0; t < count; ++t) boxes.push_back(boxOf(mesh, t));
  return boxes;
}

SelfIntersectionCheck::SelfIntersectionCheck(const SurfaceMesh& mesh,
                                             std::span<const std::uint8_t> ignored,
                                             const BoxTree& tree, BoundaryReport& report)
    : mesh_(mesh), ignored_(ignored), tree_(tree), report_(report) {}

bool SelfIntersectionCheck::advance(std::uint32_t budget) {
  const auto count = static_cast<std::uint32_t>(mesh_.triangles.size() / 3);
  for (std::uint32_t i = 0; i < budget && next_ < count; ++i) {
    if (report_.countOf(DiagnosticCode::kSelfIntersection) >= kEnough) return true;
    if (ignored_[next_] == 0) testTriangle(next_);
    ++next_;
  }
  return next_ >= count;
}

void SelfIntersectionCheck::testTriangle(std::uint32_t triangle) {
  const NumberedTriangle own = triangleOf(mesh_, triangle);
  const Box box = boxOf(mesh_, triangle);
  const SectorSeparation separation(own);
  near_.clear();
  tree_.visitOverlaps(box, [&](std::uint32_t other) {
    if (other <= triangle || ignored_[other] != 0) return;
    if (!separation.proves(triangleOf(mesh_, other))) near_.push_back(other);
  });
  stableSort(near_);
  for (const std::uint32_t other : near_) {
    const NumberedTriangle met = triangleOf(mesh_, other);
    if (!meetImproperly(own, met)) continue;
    const Vec3 place = meetingPlace(own.corners, met.corners);
    report_.addTrianglePair(DiagnosticCode::kSelfIntersection, triangle, other, place);
  }
}

}  // namespace tetrafront
