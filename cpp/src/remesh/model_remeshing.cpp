#include "remesh/model_remeshing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/sort.h"
#include "boundary/boundary.h"
#include "field/size_octree_builder.h"
#include "geom/measure.h"
#include "remesh/reference_surface.h"
#include "remesh/remesh_targets.h"
#include "remesh/triangle_parts.h"
#include "surface/trimmed_mesher.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Least cosine of the angle between a triangle and the given one near it: on the other side of a thin wall it is about -1.
constexpr double kMinAlignment = 0.5;
/// How far a triangle may be from the given one beneath it before the sizes are reduced, in tolerances.
constexpr double kGivenReach = 4.0;
/// Largest deviation of a triangle that follows from its size / its longest edge: one that spans 90 degrees of a cylinder.
/// Larger ones follow from another division into faces.
constexpr double kMaxBentShare = 0.21;
/// Longest edges of the front / size.
constexpr double kLongest = 1.5;
/// Deviation at which reduced sizes aim / tolerance.
constexpr double kReducedShare = 0.5;
/// The same at a cusp.
constexpr double kCuspShare = 0.9;
/// Triangulations of the faces, with sizes reduced in between. Each gets rid of most triangles that are too far away.
constexpr int kRefinements = 4;
/// Share of the area too far away that a triangulation may leave, or no other follows.
constexpr double kLessArea = 0.75;
/// Largest deviation from the given triangles / tolerance: they are as far from the faces as the CAD kernel has allowed.
constexpr double kMaxFacesDeviation = 2.0;
/// Triangles whose given ones are found per unit of budget.
constexpr std::size_t kLocatedPerUnit = 4;

/// What is wrong with a face that cannot be triangulated.
constexpr std::array kFaceFailures{DiagnosticCode::kDegeneratePatch, DiagnosticCode::kLoopNotClosed,
                                   DiagnosticCode::kLoopsIntersect};

/// Returns the corners of a triangle, the middles of its edges and its centroid.
std::array<Vec3, 7> samplesOf(const TriangleCorners& corners) {
  const auto& [a, b, c] = corners;
  return {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), centroidOf(corners)};
}

/// Returns true if only the shape, and perhaps one size, decides the sizes.
bool areOfShape(const Remeshing& remeshing) {
  const BackgroundGrid& grid = remeshing.sizes.grid;
  return grid.nodes.empty() && grid.sources.empty() && !remeshing.sizes.ofRegions.areGiven();
}

/// Edge lengths that grow from places on the surface.
struct PlacedSizes {
  std::vector<Vec3> positions;
  std::vector<double> sizes;
  /// Least sizes near cusps.
  std::optional<RemeshSizes> targets;
};

/// Returns the sizes that the given surface asks for; none if there are too many triangles, or if the work was stopped.
Task<std::optional<PlacedSizes>> findSizes(Work& work, const Remeshing& remeshing) {
  std::optional<PlacedSizes> none;
  Job<TargetField> finding([&](Work& inner) {
    return findTargetField(inner, remeshing.reference, remeshing.given.origin, remeshing.sizes,
                           remeshing.options, remeshing.lengths);
  });
  if (!co_await finishUnlessStopped(work, finding, remeshing.isStopped)) co_return none;
  TargetField targets = finding.take();
  if (!targets.diagnostics.empty()) co_return none;
  ShapeSizes& shape = targets.ofShape;
  for (std::size_t i = 0; i < shape.sizes.size(); ++i)
    shape.sizes[i] = std::max(shape.sizes[i], targets.sizes->leastAt(shape.positions[i]));
  co_return PlacedSizes{std::move(shape.positions), std::move(shape.sizes),
                        std::move(targets.sizes)};
}

Task<SizeField> fieldOf(Work& work, const PlacedSizes& placed, const Remeshing& remeshing) {
  const double largest = remeshing.lengths.maxSize;
  if (placed.positions.empty()) co_return SizeField::uniform(largest);
  SizeOctreeBuilder builder(placed.positions, placed.sizes, remeshing.options.growth, largest);
  co_await work.finish(builder);
  co_return SizeField::fromOctree(builder.take());
}

/// Returns the faces that cannot be triangulated on their surfaces, whatever the sizes.
std::vector<std::uint32_t> failedFacesIn(const std::vector<Diagnostic>& diagnostics) {
  std::vector<std::uint32_t> faces;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (std::ranges::find(kFaceFailures, diagnostic.code) == kFaceFailures.end()) continue;
    for (const Entity& entity : diagnostic.entities) {
      if (entity.kind == EntityKind::kPatch) faces.push_back(entity.index);
    }
  }
  sortUnique(faces);
  return faces;
}

struct TriangulatedFaces {
  std::optional<SurfaceMesh> mesh;
  std::vector<std::uint32_t> failed;  ///< with any, there is no mesh
};

Task<TriangulatedFaces> triangulateFaces(Work& work, const TrimmedModel& model,
                                         const SizeField& field) {
  TrimmedMesher mesher(model, field);
  MeshStatus status = MeshStatus::kRunning;
  while ((status = mesher.advance(work.remaining())) == MeshStatus::kRunning) {
    work.setFraction(mesher.fraction());
    co_await work.yield();
  }
  TriangulatedFaces faces;
  if (status == MeshStatus::kDone) faces.mesh.emplace(mesher.takeMesh());
  faces.failed = failedFacesIn(mesher.diagnostics());
  co_return faces;
}

/// Returns the given triangle next to a position on the same side of the surface; none within the limit if there is none.
TriangleId givenNear(const ReferenceSurface& reference, const Vec3& position, const Vec3& normal,
                     double limit) {
  TriangleId nearest{};
  double squared = limit * limit;
  reference.tree().visitNear(position, squared, [&](std::uint32_t item) {
    const TriangleId t = reference.pieces()[item].triangle;
    if (t == nearest || glm::dot(reference.normalOf(t), normal) < kMinAlignment) return;
    const double distance = reference.squaredDistance(position, t);
    if (distance >= squared) return;
    squared = distance;
    nearest = t;
  });
  return nearest;
}

/// Returns the smooth patch of the given surface in which each face lies: the one beneath its largest triangle. None if there
/// is none for a face.
std::vector<SmoothPatchId> patchesOfFaces(const SurfaceMesh& mesh, std::size_t faceCount,
                                          const Remeshing& remeshing) {
  std::vector<TriangleId> largest(faceCount);
  std::vector<double> area(faceCount, 0.0);
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    const std::size_t face = mesh.trianglePatch[t.index()];
    const double own = areaOf(cornersOf(mesh, t));
    if (own <= area[face]) continue;
    area[face] = own;
    largest[face] = t;
  }
  std::vector<SmoothPatchId> patches;
  for (const TriangleId t : largest) {
    if (t.isNone()) return {};
    const TriangleCorners corners = cornersOf(mesh, t);
    // A large triangle of a face that bends much may be farther away than the tolerance.
    const double limit = std::max(remeshing.lengths.tolerance, longestEdgeLengthOf(corners));
    const TriangleId beneath = givenNear(remeshing.reference, centroidOf(corners),
                                         glm::normalize(crossOf(corners)), limit);
    if (beneath.isNone()) return {};
    patches.push_back(remeshing.reference.patchOf(beneath));
  }
  return patches;
}

/// Returns true if every smooth patch beside another group contains a face. Otherwise the given patches divide faces.
bool areAllCovered(std::span<const SmoothPatchId> ofFaces, const ReferenceSurface& reference) {
  std::vector<std::uint8_t> isCovered(reference.patchCount(), 0);
  for (const SmoothPatchId patch : ofFaces) isCovered[patch.index()] = 1;
  const auto groupOf = [&](std::uint32_t patch) {
    return reference.patch(SmoothPatchId(patch)).group;
  };
  return std::ranges::all_of(reference.lines(), [&](const FeatureLine& line) {
    // Coarse triangles have creases within a face.
    const bool isOfOneGroup = std::ranges::all_of(line.patches, [&](std::uint32_t patch) {
      return groupOf(patch) == groupOf(line.patches.front());
    });
    return isOfOneGroup || std::ranges::all_of(line.patches, [&](std::uint32_t patch) {
             return isCovered[patch] != 0;
           });
  });
}

/// Gives each triangle the given one beneath it, in the patch of its face. Returns false if there is none near one: the
/// surfaces are not the same, or the patch is only a part of the face.
Task<bool> findGiven(Work& work, std::span<const SmoothPatchId> ofFaces, const Remeshing& remeshing,
                     RemeshPass& pass) {
  const SurfaceMesh& mesh = pass.surface.mesh;
  pass.beneath.reserve(countTriangles(mesh));
  bool areNear = true;
  co_await work.forEachBlock(
      countTriangles(mesh),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last && areNear; ++t) {
          const SmoothPatchId patch = ofFaces[mesh.trianglePatch[t]];
          const TriangleId hint = pass.beneath.empty() ? TriangleId{} : pass.beneath.back();
          const TriangleCorners corners = cornersOf(mesh, TriangleId(t));
          const double limit = kGivenReach * remeshing.lengths.tolerance;
          const NearestPoint nearest =
              remeshing.reference.nearest(centroidOf(corners), patch, limit, hint);
          areNear = !nearest.triangle.isNone();
          pass.beneath.push_back(nearest.triangle);
        }
      },
      kLocatedPerUnit);
  co_return areNear;
}

/// Measures triangles again that lie beside the given patch of their face, because the given triangles divide the surface a little
/// differently into faces, for example at the tip of a narrow one: their distance from any patch counts.
void measureBeside(const Remeshing& remeshing, RemeshPass& pass) {
  for (const TriangleId t : IdRange<TriangleId>(pass.beneath.size())) {
    float& deviation = pass.remesh.triangleDeviation[t.index()];
    const TriangleCorners corners = cornersOf(pass.surface.mesh, t);
    if (double{deviation} <= kMaxBentShare * longestEdgeLengthOf(corners)) continue;
    const Vec3 normal = glm::normalize(crossOf(corners));
    double largest = 0.0;
    for (const Vec3& position : samplesOf(corners)) {
      const TriangleId given = givenNear(remeshing.reference, position, normal, double{deviation});
      const double squared = given.isNone() ? double{deviation} * double{deviation}
                                            : remeshing.reference.squaredDistance(position, given);
      largest = std::max(largest, squared);
    }
    deviation = static_cast<float>(std::sqrt(largest));
  }
}

/// Adds smaller sizes where triangles are farther from the given ones than the tolerance: large ones on faces that the given
/// triangles show too roughly for their curvature. Returns their area.
double addSizesWhereFar(const RemeshPass& pass, const SizeField& field,
                        const RemeshLengths& lengths, PlacedSizes& placed) {
  double area = 0.0;
  FieldHint hint;
  for (const TriangleId t : IdRange<TriangleId>(pass.beneath.size())) {
    const double deviation = pass.remesh.triangleDeviation[t.index()];
    if (deviation < lengths.testedTolerance) continue;
    const TriangleCorners corners = cornersOf(pass.surface.mesh, t);
    const Vec3 centroid = centroidOf(corners);
    // At a cusp, where shorter edges have smaller angles, an edge is as long as the tolerance allows.
    const bool isAtCusp = placed.targets->leastAt(centroid) > 0.0;
    const double tolerance = isAtCusp ? lengths.tolerance : lengths.testedTolerance;
    if (deviation < tolerance) continue;
    area += areaOf(corners);
    const double length = longestEdgeLengthOf(corners);
    const double size =
        std::min(field.targetSizeAt(centroid, hint), isAtCusp ? length : length / kLongest);
    const double share = isAtCusp ? kCuspShare : kReducedShare;
    placed.positions.push_back(centroid);
    // The deviation grows with the square of the length.
    placed.sizes.push_back(size * std::sqrt(share * tolerance / deviation));
  }
  return area;
}

/// Returns true if the triangles are a valid boundary.
Task<bool> isBoundary(Work& work, const SurfaceMesh& mesh, const Remeshing& remeshing) {
  SurfaceMesh checked = mesh;
  BoundaryCheck boundary(checked, BoundarySource::kGivenSurface, remeshing.options.innerShells,
                         MixedOrientation::kRefuse);
  co_await work.finish(boundary);
  const std::vector<Diagnostic> found = boundary.takeDiagnostics();
  const bool isValid = std::ranges::none_of(found, [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::kError ||
           diagnostic.code == DiagnosticCode::kReorientedPatch;
  });
  co_return isValid;
}

/// Triangulates the faces once. Does not check the deviation, nor whether the triangles are a boundary; otherwise returns none as
/// remeshModel() does.
Task<ModelRemesh> remeshWith(Work& work, const SizeField& field, const Remeshing& remeshing) {
  ModelRemesh made;
  const TrimmedModel& model = *remeshing.model;
  work.beginPart(0.7);
  Job<TriangulatedFaces> triangulating(
      [&](Work& inner) { return triangulateFaces(inner, model, field); });
  if (!co_await finishUnlessStopped(work, triangulating, remeshing.isStopped)) co_return made;
  TriangulatedFaces faces = triangulating.take();
  made.failedFaces = std::move(faces.failed);
  if (!faces.mesh) co_return made;

  RemeshPass pass;
  pass.surface.mesh = std::move(*faces.mesh);
  SurfaceMesh& mesh = pass.surface.mesh;
  mesh.sides.clear();
  mesh.sideLine.clear();
  const std::vector<SmoothPatchId> ofFaces = patchesOfFaces(mesh, model.faces.size(), remeshing);
  if (ofFaces.empty() || !areAllCovered(ofFaces, remeshing.reference)) co_return made;
  work.beginPart(0.8);
  if (!co_await findGiven(work, ofFaces, remeshing, pass)) co_return made;
  for (std::uint32_t& patch : mesh.trianglePatch) patch = ofFaces[patch].value;
  pass.surface.origin = inherited(remeshing.given.origin, pass.beneath);
  mesh.triangleRegions = inherited(remeshing.given.mesh.triangleRegions, pass.beneath, 2);

  SurfaceRemesh& result = pass.remesh;
  result.size = remeshing.lengths.maxSize;
  result.minSize = remeshing.lengths.minSize;
  result.patches = static_cast<std::uint32_t>(remeshing.reference.patchCount());
  result.featureLines = static_cast<std::uint32_t>(remeshing.reference.lines().size());
  work.beginPart(1.0);
  // Distances up to the reach are measured.
  result.tolerance = kGivenReach * remeshing.lengths.tolerance;
  co_await sampleDeviation(work, remeshing.reference, mesh, pass.beneath, remeshing.isStopped,
                           result);
  result.tolerance = remeshing.lengths.tolerance;
  if (result.isPartial) co_return made;
  measureBeside(remeshing, pass);
  result.deviation = std::ranges::max(result.triangleDeviation);
  made.pass = std::move(pass);
  co_return made;
}

}  // namespace

Task<ModelRemesh> remeshModel(Work& work, const Remeshing& remeshing) {
  ModelRemesh none;
  if (!areOfShape(remeshing)) co_return none;
  work.beginPart(0.4);
  std::optional<PlacedSizes> placed = co_await findSizes(work, remeshing);
  if (!placed) co_return none;
  ModelRemesh made;
  double far = 0.0;
  for (int round = 0; round < kRefinements; ++round) {
    work.beginPart(0.5);
    const SizeField field = co_await fieldOf(work, *placed, remeshing);
    work.beginPart(0.9);
    made = co_await remeshWith(work, field, remeshing);
    if (!made.pass) co_return made;
    const double before =
        std::exchange(far, addSizesWhereFar(*made.pass, field, remeshing.lengths, *placed));
    // Where the given triangles are far from the faces, smaller ones are no nearer to them.
    if (far == 0.0 || (round > 0 && far > kLessArea * before)) break;
    work.leaveRest();
  }
  if (made.pass->remesh.deviation > kMaxFacesDeviation * remeshing.lengths.tolerance)
    co_return none;
  work.beginPart(1.0);
  if (!co_await isBoundary(work, made.pass->surface.mesh, remeshing)) co_return none;
  measureShapes(made.pass->surface.mesh, made.pass->remesh);
  co_return made;
}

}  // namespace tetrafront
