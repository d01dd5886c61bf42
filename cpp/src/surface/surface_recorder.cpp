#include "surface/surface_recorder.h"

#include <algorithm>

#include "base/fingerprint.h"

namespace tetrafront {
namespace {

/// Kinds of events: the lowest four bits of their first byte; the other four are the detail. Kind 0 is left to the
/// first event of the volume.
enum class SurfaceEvent : std::uint8_t {
  kLine = 1,
  kStation = 2,
  kDivided = 3,
  kHalved = 4,
  kNumbered = 5,
  kPatch = 6,
  kBase = 7,
  kRefused = 8,
  kAccepted = 9,
  kPostponed = 10,
  kEnded = 11,
  kImproved = 12,
};
constexpr std::uint32_t kSurfaceKindBits = 4;

// Bits of details.
constexpr std::uint32_t kCurvedPatch = 1;
constexpr std::uint32_t kRepeatedPatch = 2;
constexpr std::uint32_t kPatchWithCarriers = 4;
constexpr std::uint32_t kSameSample = 4;
constexpr std::uint32_t kNewNode = 8;

std::uint32_t head(SurfaceEvent event, std::uint32_t detail) {
  return static_cast<std::uint32_t>(event) | detail << kSurfaceKindBits;
}

bool isSameSample(const PlaneSample& a, const PlaneSample& b) {
  return a.size == b.size && a.metric.xx == b.metric.xx && a.metric.xy == b.metric.xy &&
         a.metric.yy == b.metric.yy;
}

}  // namespace

// ---- sides -------------------------------------------------------------------------------------

void SurfaceRecorder::line(LineId line, const Curve& curve) {
  lineBegin_ = curve.position(0.0);
  bytes_.byte(head(SurfaceEvent::kLine, 0));
  bytes_.varint(line.value);
  bytes_.position(lineBegin_);
}

void SurfaceRecorder::station(const SideStep& step, double t, double lambda, const Curve& curve) {
  bytes_.byte(head(SurfaceEvent::kStation, static_cast<std::uint32_t>(step.end)));
  bytes_.shortNumber(t);
  bytes_.shortNumber(step.start);
  bytes_.shortNumber(step.length);
  bytes_.varint(static_cast<std::uint64_t>(step.rounds));
  bytes_.shortNumber(lambda);
  bytes_.offset(lineBegin_, curve.position(t));
}

void SurfaceRecorder::divided(const LineDivision& division) {
  bytes_.byte(head(SurfaceEvent::kDivided, static_cast<std::uint32_t>(division.status)));
  bytes_.number(division.length);
  bytes_.varint(division.nodes.size());
  for (const Vec3& node : division.nodes) bytes_.position(node);
}

void SurfaceRecorder::halved(LineId line, std::uint32_t side, const LineDivision& division) {
  bytes_.byte(head(SurfaceEvent::kHalved, 0));
  bytes_.varint(line.value);
  bytes_.varint(side);
  bytes_.position(division.nodes[side + 1]);
}

void SurfaceRecorder::numbered(const DividedLines& lines) {
  bytes_.byte(head(SurfaceEvent::kNumbered, 0));
  const auto isUsed = [](const std::vector<NodeId>& nodes) { return !nodes.empty(); };
  bytes_.varint(static_cast<std::uint64_t>(std::ranges::count_if(lines.nodes, isUsed)));
  bytes_.varint(lines.nodeCount);
  std::uint32_t before = 0;
  for (const LineId line : IdRange<LineId>(lines.nodes.size())) {
    const std::vector<NodeId>& nodes = lines.nodes[line.index()];
    if (nodes.empty()) continue;
    bytes_.varint(line.value - before);
    before = line.value;
    // The inner nodes have consecutive indices.
    bytes_.varint(nodes.front().value);
    bytes_.varint(nodes.back().value);
    bytes_.varint(nodes.size() > 2 ? nodes[1].value : 0);
  }
}

// ---- patches -----------------------------------------------------------------------------------

void SurfaceRecorder::patch(PatchId patch, const PatchBoundary& boundary, bool isCurved,
                            bool isRepeated) {
  const PlanarMesh& mesh = boundary.mesh;
  hasSample_ = false;
  base_ = {};
  const bool hasCarriers = std::ranges::any_of(
      mesh.carriers, [](const PlanarMesh::Carriers& known) { return !known[0].isNone(); });
  bytes_.byte(head(SurfaceEvent::kPatch, (isCurved ? kCurvedPatch : 0) +
                                             (isRepeated ? kRepeatedPatch : 0) +
                                             (hasCarriers ? kPatchWithCarriers : 0)));
  bytes_.varint(patch.value);
  writeNodes(mesh, boundary.seam);
  if (hasCarriers) {
    for (const PlanarMesh::Carriers& known : mesh.carriers) {
      for (const CarrierId carrier : known) bytes_.varint(carrier.isNone() ? 0 : carrier.value + 1);
    }
  }
  bytes_.varint(mesh.sides.size());
  std::uint32_t before = 0;
  for (const PlanarMesh::Side& side : mesh.sides) {
    bytes_.difference(side.from.value, before);
    bytes_.difference(side.to.value, side.from.value);
    before = side.to.value;
  }
}

void SurfaceRecorder::writeNodes(const PlanarMesh& mesh, const std::vector<Vec3>& seam) {
  bytes_.varint(mesh.boundaryCount);
  bytes_.varint(seam.size());
  for (const Vec3& position : seam) bytes_.position(position);
  std::uint32_t before = 0;
  for (const PlanarNodeId node : IdRange<PlanarNodeId>(mesh.boundaryCount)) {
    bytes_.number(mesh.planeOf(node).x);
    bytes_.number(mesh.planeOf(node).y);
    const std::uint32_t now = mesh.surfaceNodes[node.index()].value;
    bytes_.difference(now, before);
    before = now;
  }
}

void SurfaceRecorder::base(const BaseEdge& edge, const PlaneSample& sample) {
  const bool isSame = hasSample_ && isSameSample(sample, sample_);
  bytes_.byte(head(SurfaceEvent::kBase, edge.pass + (isSame ? kSameSample : 0)));
  bytes_.difference(edge.id, base_.id);
  bytes_.difference(edge.sizeClass, base_.sizeClass);
  bytes_.varint(edge.layer);
  if (!isSame) {
    for (const double number :
         {sample.size, sample.metric.xx, sample.metric.xy, sample.metric.yy}) {
      bytes_.shorterNumber(number);
    }
  }
  bytes_.varint(edge.edgesNear);
  bytes_.varint(edge.candidates);
  base_ = edge;
  sample_ = sample;
  hasSample_ = true;
}

void SurfaceRecorder::refused(PlanarNodeId node, PlanarRefusal why, std::uint32_t culprit) {
  const std::uint32_t isNew = node.isNone() ? kNewNode : 0;
  bytes_.byte(head(SurfaceEvent::kRefused, static_cast<std::uint32_t>(why) + isNew));
  if (!node.isNone()) bytes_.difference(node.value, base_.from.value);
  if (why == PlanarRefusal::kCrosses || why == PlanarRefusal::kTooClose) {
    bytes_.difference(culprit, base_.id);
  }
}

void SurfaceRecorder::accepted(const PlanarMesh& mesh, PlanarNodeId apex, bool isNew,
                               const std::array<EdgeChange, 2>& changes) {
  const std::uint32_t closed = (changes[0].isClosed ? 1U : 0U) + (changes[1].isClosed ? 2U : 0U);
  bytes_.byte(head(SurfaceEvent::kAccepted, closed + (isNew ? kNewNode : 0)));
  if (isNew) {
    // The exact position of the new node follows from the ideal point.
    bytes_.number(base_.ideal.x);
    bytes_.number(base_.ideal.y);
    const Vec3 offset = mesh.positionOf(apex) - mesh.positionOf(base_.from);
    for (int axis = 0; axis < 3; ++axis) bytes_.shorterNumber(offset[axis]);
  } else {
    bytes_.difference(apex.value, base_.from.value);
    writeIdealPoint();
  }
  for (const EdgeChange& change : changes) bytes_.difference(change.id, base_.id);
}

void SurfaceRecorder::postponed(std::uint32_t next) {
  bytes_.byte(head(SurfaceEvent::kPostponed, next));
  writeIdealPoint();
}

void SurfaceRecorder::writeIdealPoint() {
  const Vec2 offset = base_.ideal - base_.fromPlane;
  bytes_.shortNumber(offset.x);
  bytes_.shortNumber(offset.y);
}

void SurfaceRecorder::ended(const PlanarMesh& mesh, PlanarFrontEnd end) {
  bytes_.byte(head(SurfaceEvent::kEnded, static_cast<std::uint32_t>(end)));
  Fingerprint fingerprint;
  for (const PlanarMesh::Triangle& triangle : mesh.triangles) {
    for (const PlanarNodeId node : triangle) fingerprint.add(std::uint64_t{node.value});
  }
  bytes_.word(fingerprint.value());
}

void SurfaceRecorder::improved(const PlanarMesh& mesh) {
  bytes_.byte(head(SurfaceEvent::kImproved, 0));
  bytes_.varint(mesh.plane.size() - mesh.boundaryCount);
  for (std::size_t node = mesh.boundaryCount; node < mesh.plane.size(); ++node) {
    bytes_.shorterNumber(mesh.plane[node].x);
    bytes_.shorterNumber(mesh.plane[node].y);
  }
  bytes_.varint(mesh.triangles.size());
  std::uint32_t before = 0;
  for (const PlanarMesh::Triangle& triangle : mesh.triangles) {
    for (const PlanarNodeId node : triangle) {
      bytes_.difference(node.value, before);
      before = node.value;
    }
  }
}

}  // namespace tetrafront
