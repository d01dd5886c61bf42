#include "surface/surface_mesher.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/diagnostics.h"
#include "base/sort.h"
#include "sizing/expected_count.h"
#include "surface/patch_summary.h"
#include "surface/rules.h"
#include "surface/short_lines.h"
#include "surface/tube_boundary.h"

namespace tetrafront {

namespace {

/// Part of the progress for dividing the lines and checking the loops.
constexpr double kLinesEnd = 0.1;
/// Part of the progress after which all patches are triangulated once.
constexpr double kPatchesEnd = 0.99;
/// Sides per unit of the budget when a line is divided or the loops of a patch are placed in its plane.
constexpr std::size_t kSidesPerUnit = 4;
/// Triangles per unit of the budget when they are appended to the mesh.
constexpr std::size_t kTrianglesPerUnit = 64;

/// Marks the boundary nodes that are among `nodes`, ascending, as separated.
void markSeparated(const std::vector<NodeId>& nodes, PlanarMesh& mesh) {
  if (nodes.empty()) return;
  mesh.separated.resize(mesh.boundaryCount);
  std::ranges::transform(mesh.surfaceNodes, mesh.separated.begin(), [&](NodeId node) {
    return std::ranges::binary_search(nodes, node) ? std::uint8_t{1} : std::uint8_t{0};
  });
}

/// Adds `found` to a set, both ascending. Returns false if the set already contains all of it.
bool mergeInto(std::vector<NodeId>& set, const std::vector<NodeId>& found) {
  std::vector<NodeId> merged;
  std::ranges::set_union(set, found, std::back_inserter(merged));
  if (merged.size() == set.size()) return false;
  set = std::move(merged);
  return true;
}

}  // namespace

template <class Trace>
BasicSurfaceMesher<Trace>::BasicSurfaceMesher(const Model& model, const SizeField& field,
                                              std::uint32_t maxTetrahedra, Trace trace)
    : model_(model), field_(&field), maxTetrahedra_(maxTetrahedra), lines_(model_), trace_(trace) {
  surfaces_.reserve(model.patches.size());
  for (const Patch& patch : model.patches) surfaces_.emplace_back(model_, patch);
}

template <class Trace>
MeshStatus BasicSurfaceMesher<Trace>::advance(std::uint32_t budget) {
  if (!job_.advance(budget)) return MeshStatus::kRunning;
  return diagnostics_.empty() ? MeshStatus::kDone : MeshStatus::kInvalidInput;
}

template <class Trace>
Task<> BasicSurfaceMesher<Trace>::meshSurface(Work& work) {
  work.beginPart(0.5 * kLinesEnd);
  co_await divideLines(work);
  if (!diagnostics_.empty()) co_return;
  work.beginPart(kLinesEnd);
  co_await makeLoopsSimple(work);
  if (!diagnostics_.empty()) co_return;
  phase_ = Phase::kSurface;
  lines_.writeTo(mesh_);
  trace_->numbered(lines_.lines());
  work.beginPart(kPatchesEnd);
  co_await meshPatches(work);
  if (!diagnostics_.empty()) co_return;
  work.beginPart(1.0);
  co_await appendPatches(work);
}

// ---- sides -------------------------------------------------------------------------------------

template <class Trace>
Task<> BasicSurfaceMesher<Trace>::divideLines(Work& work) {
  addSources(sourcesInTubes(surfaces_, *field_));
  co_await divideEachLine(work);
  if (diagnostics_.empty() && addSources(sourcesAtShortLines(model_, lines_.lines().divisions)))
    co_await divideEachLine(work);
}

/// Divides every line, also after a failure, so that the user gets all diagnostics at once.
template <class Trace>
Task<> BasicSurfaceMesher<Trace>::divideEachLine(Work& work) {
  for (const LineId line : IdRange<LineId>(lines_.lineCount())) {
    if (!lines_.isUsed(line)) continue;
    const LineDivision& division = lines_.divide(line, *field_, trace_);
    if (division.status != LineDivisionStatus::kDivided) reportLine(line, division);
    co_await work.spend(division.sideCount() / kSidesPerUnit + 1);
  }
}

template <class Trace>
void BasicSurfaceMesher<Trace>::reportLine(LineId line, const LineDivision& division) {
  Diagnostic found = division.status == LineDivisionStatus::kTooManySides
                         ? tooManySides(division.requiredSides)
                         : diagnose<DiagnosticCode::kOutsideBackgroundGrid>();
  diagnostics_.push_back(std::move(found).about({entityOf(line)}).at(division.position));
}

/// Caps the sizes near sources. Returns true if there are any: divided lines must then be divided again.
template <class Trace>
bool BasicSurfaceMesher<Trace>::addSources(const std::vector<SizeSource>& sources) {
  if (sources.empty()) return false;
  if (!gradedField_) gradedField_.emplace(*field_);
  gradedField_->addSources(sources);
  field_ = &*gradedField_;
  return true;
}

// ---- loops -------------------------------------------------------------------------------------

/// Halves the sides of bent lines until no loops intersect. No side is halved before the loops of all patches were
/// checked: patches share lines, and the result must not depend on the order of the patches.
template <class Trace>
Task<> BasicSurfaceMesher<Trace>::makeLoopsSimple(Work& work) {
  lines_.numberNodes();
  for (int round = 0; true; ++round) {
    std::set<LineSide> halvings;
    for (const PatchId patch : IdRange<PatchId>(surfaces_.size())) {
      const std::size_t sides = checkLoops(patch, round < kMaxHalvingRounds, halvings);
      co_await work.spend(sides / kSidesPerUnit + 1);
    }
    if (!diagnostics_.empty() || halvings.empty()) co_return;
    lines_.halveSides(halvings, trace_);
  }
}

template <class Trace>
PatchBoundary BasicSurfaceMesher<Trace>::layOut(PatchId patch) const {
  return layOutBoundary(model_, model_.model().patches[patch.index()], surfaces_[patch.index()],
                        *field_, lines_.lines());
}

/// Adds the invalid sides of a patch to `halvings`, or reports them if halving cannot help. Returns the number of
/// sides of the patch.
template <class Trace>
std::size_t BasicSurfaceMesher<Trace>::checkLoops(PatchId patch, bool canHalve,
                                                  std::set<LineSide>& halvings) {
  const PatchBoundary boundary = layOut(patch);
  const std::vector<std::uint32_t> invalid = findInvalidSides(boundary);
  if (!invalid.empty() && !(canHalve && gatherHalvings(patch, boundary, invalid, halvings)))
    reportLoops(patch, boundary, invalid);
  return boundary.origins.size();
}

/// Adds those of the invalid sides that are bent in the patch's plane: the sides of bent lines of a planar patch, and
/// those of the holes of a curved one. Returns false if there are none.
template <class Trace>
bool BasicSurfaceMesher<Trace>::gatherHalvings(PatchId patch, const PatchBoundary& boundary,
                                               const std::vector<std::uint32_t>& invalid,
                                               std::set<LineSide>& halvings) const {
  const bool isCurved = surfaces_[patch.index()].mapped() != nullptr;
  const std::size_t firstOfHoles =
      boundary.loops.size() > 1 ? boundary.loops[1] : boundary.origins.size();
  bool hasFound = false;
  for (const std::uint32_t side : invalid) {
    const auto& [line, lineSide] = boundary.origins[side];
    if (isCurved ? side < firstOfHoles : model_.curve(line).isStraight()) continue;
    halvings.emplace(line, lineSide);
    hasFound = true;
  }
  return hasFound;
}

template <class Trace>
void BasicSurfaceMesher<Trace>::reportLoops(PatchId patch, const PatchBoundary& boundary,
                                            const std::vector<std::uint32_t>& invalid) {
  std::vector<LineId> lines;
  for (const std::uint32_t side : invalid)
    if (!boundary.origins[side].line.isNone()) lines.push_back(boundary.origins[side].line);
  sortUnique(lines);
  diagnostics_.push_back(
      diagnose<DiagnosticCode::kLoopsIntersect>()
          .about(patchAndLines(patch, lines))
          .at(boundary.mesh.positionOf(boundary.mesh.sides[invalid.front()].from)));
}

// ---- patches -----------------------------------------------------------------------------------

/// Triangulates all patches, and then again those that would coincide with others.
template <class Trace>
Task<> BasicSurfaceMesher<Trace>::meshPatches(Work& work) {
  const std::size_t count = surfaces_.size();
  lineNodes_ = static_cast<std::uint32_t>(mesh_.points.size() / 3);
  triangulations_.resize(count);
  separated_.resize(count);
  summaries_.resize(count);
  std::vector<PatchId> pending;
  for (const PatchId patch : IdRange<PatchId>(count)) pending.push_back(patch);
  for (int round = 0; !pending.empty(); ++round) {
    for (std::size_t i = 0; i < pending.size(); ++i) {
      work.beginPart(static_cast<double>(i + 1) / static_cast<double>(pending.size()));
      co_await meshPatch(work, pending[i], round > 0);
    }
    if (!diagnostics_.empty() || round == kMaxSeparationRounds) co_return;
    pending = findPatchesToSeparate();
    co_await work.spend(1);
  }
}

template <class Trace>
Task<> BasicSurfaceMesher<Trace>::meshPatch(Work& work, PatchId patch, bool isRepeated) {
  PatchBoundary boundary = layOut(patch);
  const bool isCurved = surfaces_[patch.index()].mapped() != nullptr;
  trace_->patch(patch, boundary, isCurved, isRepeated);
  const std::vector<Vec3> seam = boundary.seam;
  markSeparated(separated_[patch.index()], boundary.mesh);
  co_await work.spend(boundary.origins.size() / kSidesPerUnit + 1);
  BasicPatchMesher<Trace> mesher(surfaces_[patch.index()], *field_, std::move(boundary), trace_);
  while (!mesher.advance(work.remaining())) co_await work.yield();
  if (mesher.isComplete()) {
    takePatch(patch, mesher.mesh(), seam);
  } else {
    reportPatch(patch, mesher);
  }
  co_await work.spend(mesher.mesh().triangles.size() / kSidesPerUnit + 1);
}

template <class Trace>
void BasicSurfaceMesher<Trace>::takePatch(PatchId patch, const PlanarMesh& planar,
                                          const std::vector<Vec3>& seam) {
  Triangulation taken;
  taken.nodes = seam;
  taken.nodes.insert(taken.nodes.end(), planar.positions.begin() + planar.boundaryCount,
                     planar.positions.end());
  const auto firstInterior = static_cast<std::uint32_t>(lineNodes_ + seam.size());
  FieldHint hint;
  const auto outside = std::ranges::find_if(
      taken.nodes, [&](const Vec3& position) { return !field_->covers(position, hint); });
  if (outside != taken.nodes.end()) {
    diagnostics_.push_back(
        diagnose<DiagnosticCode::kOutsideBackgroundGrid>().about({entityOf(patch)}).at(*outside));
  }
  const auto nodeOf = [&](PlanarNodeId node) {
    return planar.isBoundary(node) ? planar.surfaceNodes[node.index()]
                                   : NodeId(firstInterior + (node.value - planar.boundaryCount));
  };
  taken.triangles.reserve(planar.triangles.size());
  for (const auto& [a, b, c] : planar.triangles)
    taken.triangles.push_back({nodeOf(a), nodeOf(b), nodeOf(c)});
  collectChords(patch, planar, taken.chords);
  triangulations_[patch.index()] = std::move(taken);
  summaries_[patch.index()] = summarizePatch({surfaces_[patch.index()], *field_}, planar, patch);
}

template <class Trace>
void BasicSurfaceMesher<Trace>::reportPatch(PatchId patch, const BasicPatchMesher<Trace>& mesher) {
  // A square of t triangles has about sqrt(t / 2) sides along each edge.
  const auto triangles = static_cast<double>(mesher.mesh().triangles.size());
  Diagnostic found = mesher.hasTooManyTriangles() ? tooManySides(std::sqrt(0.5 * triangles))
                                                  : diagnose<DiagnosticCode::kDegeneratePatch>();
  diagnostics_.push_back(std::move(found).about({entityOf(patch)}));
}

/// Returns the diagnostic for sides so small that a cube with `sides` of them along each edge has too many elements.
template <class Trace>
Diagnostic BasicSurfaceMesher<Trace>::tooManySides(double sides) const {
  return tooManyElements(kTetrahedraPerUnitVolume * sides * sides * sides, maxTetrahedra_);
}

/// Returns the patches that need further nodes of their own because they would coincide with others.
template <class Trace>
std::vector<PatchId> BasicSurfaceMesher<Trace>::findPatchesToSeparate() {
  std::vector<Chord> chords;
  for (const Triangulation& patch : triangulations_)
    chords.insert(chords.end(), patch.chords.begin(), patch.chords.end());
  const auto found = findNodesToSeparate(model_.model(), lines_.lines(), chords);
  std::vector<PatchId> patches;
  for (const PatchId patch : IdRange<PatchId>(found.size()))
    if (mergeInto(separated_[patch.index()], found[patch.index()])) patches.push_back(patch);
  return patches;
}

// ---- the mesh ----------------------------------------------------------------------------------

template <class Trace>
Task<> BasicSurfaceMesher<Trace>::appendPatches(Work& work) {
  for (const PatchId patch : IdRange<PatchId>(triangulations_.size())) {
    const std::size_t count = triangulations_[patch.index()].triangles.size();
    append(patch);
    co_await work.spend(count / kTrianglesPerUnit + 1);
  }
}

/// Appends a triangulation to the mesh, and frees its memory.
template <class Trace>
void BasicSurfaceMesher<Trace>::append(PatchId patch) {
  const Triangulation taken = std::exchange(triangulations_[patch.index()], {});
  const auto shift = static_cast<std::uint32_t>(mesh_.points.size() / 3) - lineNodes_;
  for (const Vec3& position : taken.nodes)
    mesh_.points.insert(mesh_.points.end(), {position.x, position.y, position.z});
  for (const NodeTriple& triangle : taken.triangles)
    for (const NodeId node : triangle)
      mesh_.triangles.push_back(node.value < lineNodes_ ? node.value : node.value + shift);
  mesh_.trianglePatch.insert(mesh_.trianglePatch.end(), taken.triangles.size(), patch.value);
}

template class BasicSurfaceMesher<NullSurfaceTrace>;
template class BasicSurfaceMesher<RecordingSurfaceTrace>;

}  // namespace tetrafront
