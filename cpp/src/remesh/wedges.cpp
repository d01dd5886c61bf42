#include "remesh/wedges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "geom/box.h"
#include "geom/measure.h"
#include "remesh/thickness.h"
#include "topology/edge_table.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Cosine of the largest angle of a wedge, 65 degrees. In a wider one, no ray across the region ends at the other face, so that it
/// asks for no sizes. Rays end at faces up to 60 degrees; the margin is for bent faces, and for rounding.
constexpr double kWedgeCosine = 0.42261826174069944;
static_assert(kWedgeCosine < kMinFacing);
/// Distance between the faces / distance that the edge's angle leads to, from which on the faces belong to the wedge: near 1 if
/// the faces are flat; less if they bend towards each other like those of a lens, but then they must not be parallel.
constexpr double kFlatShare = 0.8;
constexpr double kBentShare = 0.35;
/// Smallest tangent of the angle between bent faces / tangent of the edge's angle.
constexpr double kMinTangent = 0.3;

/// Returns the unit vector in the plane of a triangle that leaves the half-edge at a right angle.
Vec3 inwardOf(const ReferenceSurface& reference, HalfEdgeId halfEdge, const Vec3& along) {
  return glm::cross(reference.normalOf(triangleOf(halfEdge)), along);
}

/// Returns the cosine of the angle of the wedge between two triangles at an edge, if there is one. If only these two meet at the
/// edge, the region must be between them.
std::optional<double> wedgeCosine(const ReferenceSurface& reference, HalfEdgeId a, HalfEdgeId b,
                                  bool areAlone) {
  const SurfaceMesh& mesh = reference.mesh();
  const HalfEdgeNodes nodes = nodesOf(mesh.triangles, a);
  const Vec3 edge = pointOf(mesh, nodes.to) - pointOf(mesh, nodes.from);
  const double length = glm::length(edge);
  if (!(length > 0.0)) return {};
  const Vec3 along = edge / length;
  const bool isOpposite = nodesOf(mesh.triangles, b).from == nodes.to;
  const Vec3 ofA = inwardOf(reference, a, along);
  const Vec3 ofB = inwardOf(reference, b, isOpposite ? -along : along);
  const double cosine = glm::dot(ofA, ofB);
  if (!(cosine > kWedgeCosine)) return {};
  const bool isHollow = glm::dot(ofB, reference.normalOf(triangleOf(a))) > 0.0;
  if (areAlone && isHollow) return {};
  return std::min(cosine, 1.0);
}

double tangentOfCosine(double cosine) {
  return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / cosine;
}

}  // namespace

Wedges::Wedges(const ReferenceSurface& reference) : reference_(reference) {
  const SurfaceMesh& mesh = reference.mesh();
  const EdgeTable table(mesh.triangles, countNodes(mesh), {});
  std::vector<Box> boxes;
  for (const EdgeId id : IdRange<EdgeId>(table.edgeCount())) {
    const std::span<const HalfEdgeId> around = table.halfEdgesOf(id);
    for (std::size_t i = 0; i < around.size(); ++i) {
      for (std::size_t j = i + 1; j < around.size(); ++j) {
        const auto cosine = wedgeCosine(reference, around[i], around[j], around.size() == 2);
        if (!cosine) continue;
        const HalfEdgeNodes nodes = nodesOf(mesh.triangles, around[i]);
        const double tangent = tangentOfCosine(*cosine);
        edges_.push_back(
            {pointOf(mesh, nodes.from),
             pointOf(mesh, nodes.to),
             {reference.patchOf(triangleOf(around[i])), reference.patchOf(triangleOf(around[j]))},
             tangent});
        boxes.push_back(Box::of(edges_.back().from, edges_.back().to, edges_.back().from));
        tangentOf_.resize(countNodes(mesh), 0.0);
        for (const NodeId node : {nodes.from, nodes.to}) {
          double& least = tangentOf_[node.index()];
          least = least > 0.0 ? std::min(least, tangent) : tangent;
        }
      }
    }
  }
  if (boxes.empty()) return;
  tree_ = BoxTree(std::span<const Box>(boxes));
  smallestTangent_ = edges_.front().tangent;
  for (const Edge& edge : edges_) smallestTangent_ = std::min(smallestTangent_, edge.tangent);
}

bool Wedges::contain(const OppositeFaces& faces) const {
  if (edges_.empty()) return false;
  const SmoothPatchId first = reference_.patchOf(faces.triangles[0]);
  const SmoothPatchId second = reference_.patchOf(faces.triangles[1]);
  const double reach =
      std::min(faces.distance / (kBentShare * smallestTangent_), reference_.diagonal());
  double nearest = reach * reach;
  const Edge* wedge = nullptr;
  tree_.visitNear(faces.position, nearest, [&](std::uint32_t item) {
    const Edge& edge = edges_[item];
    if (!std::ranges::any_of(edge.patches,
                             [&](SmoothPatchId p) { return p == first || p == second; })) {
      return;
    }
    const Vec3 point = nearestPointOfSegment(faces.position, edge.from, edge.to);
    const double square = glm::dot(point - faces.position, point - faces.position);
    if (square >= nearest) return;
    nearest = square;
    wedge = &edge;
  });
  if (wedge == nullptr) return false;
  const double expected = std::sqrt(nearest) * wedge->tangent;
  const bool isBent = faces.tangent < kMinTangent * wedge->tangent;
  return faces.distance >= (isBent ? kFlatShare : kBentShare) * expected;
}

bool Wedges::endAt(NodeId node, double width, double distance) const {
  if (edges_.empty()) return false;
  const double tangent = tangentOf_[node.index()];
  return tangent > 0.0 && width >= kBentShare * tangent * distance;
}

}  // namespace tetrafront
