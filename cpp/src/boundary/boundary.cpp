#include "boundary/boundary.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/diagnostics.h"
#include "boundary/centred_surface.h"
#include "boundary/self_intersection.h"
#include "boundary/surface_checks.h"
#include "search/box_tree.h"
#include "topology/corner_fans.h"
#include "topology/edge_table.h"
#include "topology/half_faces.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Boxes per unit of budget: visiting one costs far less than testing a triangle.
constexpr std::size_t kBoxesPerUnit = 16;

/// Addresses an entry of Boundary::shells.
using BoundaryShellId = Id<BoundaryShell>;

}  // namespace

BoundaryCheck::BoundaryCheck(SurfaceMesh& mesh, BoundarySource source, InnerShells innerShells,
                             MixedOrientation mixed, std::size_t maxDiagnostics)
    : mesh_(mesh),
      source_(source),
      innerShells_(innerShells),
      mixed_(mixed),
      report_(mesh, source, maxDiagnostics),
      givenRegions_(std::exchange(mesh.triangleRegions, {})),
      job_([this](Work& work) { return run(work); }) {}

Task<> BoundaryCheck::run(Work& work) {
  co_await closeBoundary(work);
  result_.isValid = !report_.hasErrors();
  diagnostics_ = report_.take();
}

Task<> BoundaryCheck::closeBoundary(Work& work) {
  work.beginPart(0.02);
  checkNumbers(mesh_, report_);
  if (report_.hasErrors()) co_return;
  if (!givenRegions_.empty()) {
    givenRegions_.resize(2 * std::size_t{countTriangles(mesh_)}, SurfaceMesh::kNoRegion);
  }
  co_await work.yield();

  work.beginPart(0.08);
  InvalidTriangles invalid = checkTriangles(mesh_, report_);
  co_await work.yield();

  work.beginPart(0.16);
  checkCoincidentNodes(mesh_, report_);
  co_await work.yield();

  const CentredSurface centred(mesh_);
  report_.setOrigin(centred.centre());

  work.beginPart(0.22);
  result_.edges.emplace(mesh_.triangles, countNodes(mesh_), invalid.inTopology);
  result_.withoutEdges = std::move(invalid.inTopology);
  checkEdges(mesh_, *result_.edges, report_);
  co_await work.yield();

  work.beginPart(0.3);
  const BoxTree tree = co_await BoxTree::build(work, triangleBoxes(mesh_), kBoxesPerUnit);

  work.beginPart(0.85);
  if (!isEmbedded_) {
    co_await checkSelfIntersections(work, mesh_, invalid.inGeometry, tree, report_);
  }
  if (report_.hasErrors()) co_return;

  work.beginPart(0.95);
  RegionMap regions = findRegions(mesh_, *result_.edges, tree, meshedRule(), report_);
  if (report_.hasErrors()) co_return;
  reportContacts(regions);
  co_await work.yield();

  orientOutward(regions);
  if (!report_.hasErrors()) numberRegions(regions);
}

MeshedRule BoundaryCheck::meshedRule() const {
  const std::uint32_t firstOriented = source_ == BoundarySource::kGivenSurface
                                          ? 0
                                          : std::min(firstOfBodies_, countTriangles(mesh_));
  return {innerShells_, firstOriented, givenRegions_};
}

void BoundaryCheck::orientOutward(RegionMap& regions) {
  std::vector<std::uint8_t> isFlipped(countTriangles(mesh_), 0);
  for (std::uint32_t t = 0; t < isFlipped.size(); ++t) {
    const TriangleId triangle(t);
    const bool facesOutward = regions.isOfBody(triangle) ? !regions.looksOut(backOf(triangle))
                                                         : regions.isMeshedAt(backOf(triangle));
    if (facesOutward) continue;
    isFlipped[t] = 1;
    flipTriangle(mesh_, triangle);
    std::swap(regions.shellOf[backOf(triangle).index()],
              regions.shellOf[frontOf(triangle).index()]);
  }
  result_.edges->followFlips(isFlipped);
  if (source_ == BoundarySource::kDrawnPatches) {
    reportFlippedPatches(isFlipped);
  } else {
    reportFlippedComponents(regions, isFlipped);
  }
}

void BoundaryCheck::reportFlippedPatches(const std::vector<std::uint8_t>& isFlipped) {
  std::vector<std::uint8_t> isNamed;
  std::vector<Entity> patches;
  TriangleId first;
  for (std::uint32_t t = 0; t < isFlipped.size(); ++t) {
    const std::uint32_t patch = mesh_.trianglePatch[t];
    if (patch >= isNamed.size()) isNamed.resize(std::size_t{patch} + 1, 0);
    if (isFlipped[t] == 0 || isNamed[patch] != 0) continue;
    isNamed[patch] = 1;
    if (patches.empty()) first = TriangleId(t);
    patches.push_back({EntityKind::kPatch, patch});
  }
  if (patches.empty()) return;
  report_.addInformation(diagnose<DiagnosticCode::kReorientedPatch>()
                             .about(std::move(patches))
                             .at(centroidOf(cornersOf(mesh_, first))));
}

void BoundaryCheck::reportFlippedComponents(const RegionMap& regions,
                                            const std::vector<std::uint8_t>& isFlipped) {
  struct Counts {
    TriangleId firstFlipped;
    std::uint32_t flipped = 0;
    std::uint32_t all = 0;  ///< without interfaces, except the outside of a body in a body
  };
  std::vector<Counts> counts;
  for (std::uint32_t t = 0; t < isFlipped.size(); ++t) {
    const std::size_t component = regions.componentOf[t].index();
    if (component == counts.size()) counts.emplace_back();
    Counts& count = counts[component];
    if (!regions.isInterface(TriangleId(t)) || regions.isOfBody(TriangleId(t))) ++count.all;
    if (isFlipped[t] == 0) continue;
    if (count.flipped++ == 0) count.firstFlipped = TriangleId(t);
  }
  const auto isRefused = [this](const Counts& count) {
    return mixed_ == MixedOrientation::kRefuse && count.flipped > 0 && count.flipped < count.all;
  };
  for (std::uint32_t t = 0; t < isFlipped.size(); ++t) {
    if (isFlipped[t] == 0 || !isRefused(counts[regions.componentOf[t].index()])) continue;
    report_.addTriangle(diagnoseCounted<DiagnosticCode::kFlippedTriangle>(
                            regions.isBetweenBoundedVolumes(TriangleId(t))),
                        TriangleId(t));
  }
  for (const Counts& count : counts) {
    if (count.flipped == 0 || isRefused(count)) continue;
    report_.addInformation(diagnose<DiagnosticCode::kReorientedPatch>(count.flipped, count.all)
                               .about({entityOf(count.firstFlipped)})
                               .at(centroidOf(cornersOf(mesh_, count.firstFlipped))));
  }
}

void BoundaryCheck::reportContacts(const RegionMap& regions) {
  const EdgeTable& edges = *result_.edges;
  struct Contact {
    TriangleId triangle;
    Vec3 position;
  };
  std::optional<Contact> first;
  std::vector<std::uint8_t> isAtEdge(countNodes(mesh_), 0);
  std::size_t edgeCount = 0;
  for (const EdgeId edge : IdRange<EdgeId>(edges.edgeCount())) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(edge);
    if (halfEdges.size() == 2) continue;
    const HalfEdgeNodes nodes = nodesOf(mesh_.triangles, halfEdges[0]);
    isAtEdge[nodes.from.index()] = isAtEdge[nodes.to.index()] = 1;
    const auto isInterface = [&](HalfEdgeId h) { return regions.isInterface(triangleOf(h)); };
    if (std::ranges::any_of(halfEdges, isInterface)) continue;
    ++edgeCount;
    if (first) continue;
    first = {triangleOf(halfEdges[0]),
             0.5 * (pointOf(mesh_, nodes.from) + pointOf(mesh_, nodes.to))};
  }
  std::vector<HalfEdgeId> fanOf(countNodes(mesh_));
  std::vector<std::uint8_t> isCounted(countNodes(mesh_), 0);
  std::size_t nodeCount = 0;
  const std::vector<HalfEdgeId> fans = cornerFans(mesh_.triangles, edges);
  for (std::size_t corner = 0; corner < fans.size(); ++corner) {
    const std::uint32_t node = mesh_.triangles[corner];
    if (isAtEdge[node] != 0 || isCounted[node] != 0) continue;
    if (fanOf[node].isNone()) fanOf[node] = fans[corner];
    if (fanOf[node] == fans[corner]) continue;
    isCounted[node] = 1;
    ++nodeCount;
    if (!first) first = {triangleOf(HalfEdgeId(corner)), pointOf(mesh_, NodeId(node))};
  }
  if (!first) return;
  report_.addContact(first->triangle, first->position, edgeCount, nodeCount);
}

void BoundaryCheck::numberRegions(const RegionMap& regions) {
  const auto halfFaces = static_cast<std::uint32_t>(regions.shellOf.size());
  std::vector<BoundaryShellId> resultShellOf(regions.shells.size());
  std::vector<RegionId> regionOf(regions.shells.size());
  std::uint32_t cavities = 0;
  for (std::uint32_t h = 0; h < halfFaces; ++h) {
    const HalfFaceId halfFace(h);
    const ShellId shell = regions.shellOf[h];
    if (!regions.isMeshedAt(halfFace)) continue;
    BoundaryShellId& resultShell = resultShellOf[shell.index()];
    if (resultShell.isNone()) {
      resultShell = BoundaryShellId(result_.shells.size());
      result_.shells.push_back(
          {.firstTriangle = triangleOf(halfFace), .volume = regions.shells[shell.index()].volume});
      if (regions.outerShellOf[shell.index()] == shell) {
        regionOf[shell.index()] = RegionId(result_.regionCount++);
        if (!regions.givenRegionOf.empty()) {
          result_.givenRegionOf.push_back(regions.givenRegionOf[shell.index()]);
        }
      } else if (!regions.isMeshedAt(oppositeOf(halfFace))) {
        ++cavities;
      }
    }
    BoundaryShell& found = result_.shells[resultShell.index()];
    ++found.triangleCount;
    found.area += areaOf(cornersOf(mesh_, triangleOf(halfFace)));
  }
  mesh_.triangleRegions.assign(halfFaces, SurfaceMesh::kNoRegion);
  for (std::uint32_t h = 0; h < halfFaces; ++h) {
    const HalfFaceId halfFace(h);
    if (!regions.isMeshedAt(halfFace)) continue;
    const RegionId region = regionOf[regions.outerShellAt(halfFace).index()];
    mesh_.triangleRegions[h] = region.value;
    result_.shells[resultShellOf[regions.shellOf[h].index()].index()].region = region;
  }
  if (result_.shells.size() > 1) {
    report_.addNesting(result_.shells[1].firstTriangle, result_.regionCount, cavities);
  }
  // A given surface has shells in place of patches.
  if (source_ != BoundarySource::kGivenSurface) return;
  mesh_.trianglePatch.resize(countTriangles(mesh_));
  for (std::uint32_t t = 0; t < countTriangles(mesh_); ++t) {
    const ShellId shell = regions.shellOf[backOf(TriangleId(t)).index()];
    mesh_.trianglePatch[t] = resultShellOf[shell.index()].value;
  }
}

Boundary closeBoundary(SurfaceMesh& mesh, BoundarySource source,
                       std::vector<Diagnostic>& diagnostics, InnerShells innerShells) {
  BoundaryCheck check(mesh, source, innerShells);
  finish(check);
  const std::vector<Diagnostic> found = check.takeDiagnostics();
  diagnostics.insert(diagnostics.end(), found.begin(), found.end());
  return check.takeResult();
}

}  // namespace tetrafront
