#include "remesh/model_remeshing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/sort.h"
#include "boundary/boundary.h"
#include "field/size_octree_builder.h"
#include "geom/measure.h"
#include "remesh/given_faces.h"
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
constexpr int kRefinements = 6;
/// Share of the area too far away that a triangulation may leave, or no other follows.
constexpr double kLessArea = 0.75;
/// Share of the whole area below which only single triangles are farther than a tolerance that is given: another triangulation may
/// have none. On a torus, it was 0.5 to 2 %.
constexpr double kSingleArea = 0.03;
/// Largest deviation from the given triangles / tolerance: they are as far from the faces as the CAD kernel has allowed.
constexpr double kMaxFacesDeviation = 2.0;
/// Largest distance of nodes of the given surface from the edges of the model on which they are / tolerance.
constexpr double kOnEdge = 0.05;
/// Triangulations of the faces until those that cannot be triangulated are known, and their edges are divided at given nodes.
constexpr int kMaxFailingRounds = 6;
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

/// Marks the given triangles of patches that contain no face, nor does any other patch of their group: coarse triangles have
/// creases within a face. Empty if there are none.
std::vector<std::uint8_t> trianglesWithoutFace(std::span<const SmoothPatchId> ofFaces,
                                               const ReferenceSurface& reference) {
  std::vector<std::uint8_t> isCovered(reference.patchCount(), 0);
  std::vector<std::uint32_t> groups;
  for (const SmoothPatchId patch : ofFaces) {
    isCovered[patch.index()] = 1;
    groups.push_back(reference.patch(patch).group);
  }
  sortUnique(groups);
  std::vector<std::uint8_t> isWithout(countTriangles(reference.mesh()), 0);
  bool areAny = false;
  for (const TriangleId t : IdRange<TriangleId>(isWithout.size())) {
    const SmoothPatchId patch = reference.patchOf(t);
    const std::uint32_t group = reference.patch(patch).group;
    if (isCovered[patch.index()] != 0 || std::ranges::binary_search(groups, group)) continue;
    isWithout[t.index()] = 1;
    areAny = true;
  }
  if (!areAny) isWithout.clear();
  return isWithout;
}

/// The faces of a model without those that cannot be triangulated.
struct FacesLeft {
  TrimmedModel model;
  std::vector<std::uint32_t> faces;  ///< per face: its index in the whole model
};

FacesLeft facesWithout(const TrimmedModel& model, std::span<const std::uint32_t> failed) {
  FacesLeft left{model, {}};
  left.model.faces.clear();
  for (std::uint32_t face = 0; face < model.faces.size(); ++face) {
    if (std::ranges::binary_search(failed, face)) continue;
    left.model.faces.push_back(model.faces[face]);
    left.faces.push_back(face);
  }
  return left;
}

struct TriangulatedFaces {
  std::optional<SurfaceMesh> mesh;
  DividedLines lines;
  std::vector<std::uint32_t> failed;  ///< with any, there is no mesh
};

Task<TriangulatedFaces> triangulate(Work& work, const TrimmedModel& model, const SizeField& field,
                                    std::span<const EdgeStations> stations) {
  std::vector<std::vector<double>> parameters;
  for (const EdgeStations& own : stations) parameters.push_back(own.parameters);
  TrimmedMesher mesher(model, field, MeshOptions{}.maxTetrahedra, std::move(parameters));
  MeshStatus status = MeshStatus::kRunning;
  while ((status = mesher.advance(work.remaining())) == MeshStatus::kRunning) {
    work.setFraction(mesher.fraction());
    co_await work.yield();
  }
  TriangulatedFaces faces;
  faces.lines = mesher.lines();
  if (status == MeshStatus::kDone) faces.mesh.emplace(mesher.takeMesh());
  faces.failed = failedFacesIn(mesher.diagnostics());
  co_return faces;
}

/// Triangulated faces, each in a smooth patch of the given surface, and after them given triangles in place of faces that cannot be
/// triangulated.
struct JoinedFaces {
  SurfaceMesh mesh;
  std::vector<SmoothPatchId> ofFaces;
  std::vector<TriangleId> given;  ///< the last triangles
};

/// Triangulates the faces without those that have failed, and adds faces that fail to these. None if that cannot be done.
Task<std::optional<JoinedFaces>> triangulateFaces(Work& work, const Remeshing& remeshing,
                                                  const SizeField& field,
                                                  std::vector<std::uint32_t>& failed) {
  const ReferenceSurface& reference = remeshing.reference;
  std::vector<EdgeStations> stations;
  for (int round = 0; round < kMaxFailingRounds; ++round) {
    const FacesLeft left = facesWithout(*remeshing.model, failed);
    if (left.faces.empty()) break;
    TriangulatedFaces made = co_await triangulate(work, left.model, field, stations);
    for (const std::uint32_t face : made.failed) failed.push_back(left.faces[face]);
    sortUnique(failed);
    if (!made.failed.empty()) {
      stations.clear();
      continue;
    }
    if (!made.mesh) break;
    JoinedFaces joined;
    joined.ofFaces = patchesOfFaces(*made.mesh, left.faces.size(), remeshing);
    if (joined.ofFaces.empty()) break;
    const std::vector<std::uint8_t> isWithout = trianglesWithoutFace(joined.ofFaces, reference);
    if (isWithout.empty() && !failed.empty()) break;
    if (!isWithout.empty() && stations.empty()) {
      std::optional<std::vector<EdgeStations>> found = stationsAround(
          isWithout, reference.mesh(), left.model, kOnEdge * remeshing.lengths.tolerance);
      if (!found) break;
      stations = std::move(*found);
      continue;
    }
    joined.mesh = std::move(*made.mesh);
    if (!isWithout.empty())
      joined.given = appendGiven(isWithout, reference.mesh(), stations, made.lines, joined.mesh);
    co_return joined;
  }
  co_return std::nullopt;
}

/// Moves the nodes, by rounding errors, to where the engine accepts them, also in coordinates that are not about the centre.
void makeRepresentable(const ReferenceSurface& reference, SurfaceMesh& mesh) {
  for (const NodeId node : IdRange<NodeId>(countNodes(mesh))) {
    const Vec3 position = reference.representable(pointOf(mesh, node));
    for (int k = 0; k < 3; ++k)
      mesh.points[3 * node.index() + static_cast<std::size_t>(k)] = position[k];
  }
}

/// Gives each triangle the given one beneath it, in the patch of its face. Returns false if there is none near one: the
/// surfaces are not the same, or the patch is only a part of the face.
Task<bool> findGiven(Work& work, std::span<const SmoothPatchId> ofFaces, const Remeshing& remeshing,
                     RemeshPass& pass) {
  const SurfaceMesh& mesh = pass.surface.mesh;
  pass.beneath.reserve(countTriangles(mesh));
  bool areNear = true;
  co_await work.forEachBlock(
      mesh.trianglePatch.size(),
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
/// triangles show too roughly for their curvature. Returns their share of the area.
double addSizesWhereFar(const RemeshPass& pass, const SizeField& field,
                        const RemeshLengths& lengths, PlacedSizes& placed) {
  double whole = 0.0;
  double area = 0.0;
  FieldHint hint;
  for (const TriangleId t : IdRange<TriangleId>(pass.beneath.size())) {
    const TriangleCorners corners = cornersOf(pass.surface.mesh, t);
    whole += areaOf(corners);
    const double deviation = pass.remesh.triangleDeviation[t.index()];
    if (deviation < lengths.testedTolerance) continue;
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
  return area / whole;
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
Task<ModelRemesh> remeshWith(Work& work, const SizeField& field, const Remeshing& remeshing,
                             const std::vector<std::uint32_t>& failed) {
  ModelRemesh made;
  work.beginPart(0.7);
  made.failedFaces = failed;
  Job<std::optional<JoinedFaces>> triangulating(
      [&](Work& inner) { return triangulateFaces(inner, remeshing, field, made.failedFaces); });
  if (!co_await finishUnlessStopped(work, triangulating, remeshing.isStopped)) co_return made;
  std::optional<JoinedFaces> faces = triangulating.take();
  if (!faces) co_return made;
  made.givenTriangles = faces->given.size();

  RemeshPass pass;
  pass.surface.mesh = std::move(faces->mesh);
  SurfaceMesh& mesh = pass.surface.mesh;
  mesh.sides.clear();
  mesh.sideLine.clear();
  makeRepresentable(remeshing.reference, mesh);
  work.beginPart(0.8);
  if (!co_await findGiven(work, faces->ofFaces, remeshing, pass)) co_return made;
  for (std::uint32_t& patch : mesh.trianglePatch) patch = faces->ofFaces[patch].value;
  for (const TriangleId t : faces->given) {
    pass.beneath.push_back(t);
    mesh.trianglePatch.push_back(remeshing.reference.patchOf(t).value);
  }
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
  ModelRemesh best;
  std::vector<std::uint32_t> failed;
  double far = 0.0;
  double least = std::numeric_limits<double>::infinity();
  const double tolerance = remeshing.lengths.tolerance;
  const bool isGiven = remeshing.options.tolerance > 0.0;
  for (int round = 0; round < kRefinements; ++round) {
    work.beginPart(0.5);
    const SizeField field = co_await fieldOf(work, *placed, remeshing);
    work.beginPart(0.9);
    ModelRemesh made = co_await remeshWith(work, field, remeshing, failed);
    if (!made.pass) co_return made;
    failed = made.failedFaces;
    const double before =
        std::exchange(far, addSizesWhereFar(*made.pass, field, remeshing.lengths, *placed));
    const double deviation = std::max(made.pass->remesh.deviation, tolerance);
    if (deviation <= least) {
      least = deviation;
      best = std::move(made);
    }
    if (far == 0.0 || (isGiven && least == tolerance)) break;
    // Where the given triangles are far from the faces, smaller ones are no nearer to them.
    if (round > 0 && far > std::max(kLessArea * before, isGiven ? kSingleArea : 0.0)) break;
    work.leaveRest();
  }
  if (best.pass->remesh.deviation > kMaxFacesDeviation * remeshing.lengths.tolerance)
    co_return none;
  work.beginPart(1.0);
  if (!co_await isBoundary(work, best.pass->surface.mesh, remeshing)) co_return none;
  measureShapes(best.pass->surface.mesh, best.pass->remesh);
  co_return best;
}

}  // namespace tetrafront
