#include "surface/surface_mesher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/sort.h"
#include "sizing/expected_count.h"
#include "surface/patch_summary.h"
#include "surface/shared_strips.h"
#include "surface/short_lines.h"
#include "tetrafront/options.h"

namespace tetrafront {

namespace {

/// Rounds of halving sides that cross others because they are too coarse for the bends of their
/// lines. Each round halves the error of a chord by four; loops that still touch, touch.
constexpr int kMaxHalvingRounds = 8;
/// Counted against the budget for dividing a line or laying a patch's loops out, per side.
constexpr std::uint32_t kSidesPerStep = 4;
/// Counted against the budget for appending triangles to the mesh.
constexpr std::uint32_t kTrianglesPerStep = 64;
/// A closed line needs three sides to enclose anything, and two lines that join the same points
/// need two each (one of them would do, but which one must not depend on who asks).
constexpr std::uint32_t kClosedLineSides = 3;
constexpr std::uint32_t kParallelLineSides = 2;
/// A closed line of a patch with a seam: with fewer sides a node could be joined to both images
/// of a seam's node, which are one node of the surface.
constexpr std::uint32_t kSeamedLineSides = 6;

/// Rounds of triangulating patches anew that would lie on others. Only what is new in a round can
/// ask for another.
constexpr int kMaxSeparationRounds = 3;

/// A line, and one of its sides.
using LineSide = std::pair<std::uint32_t, std::uint32_t>;

/// The interior nodes and the triangles of one patch. The interior nodes have the indices after those of all nodes of
/// lines.
struct PatchTriangulation {
  std::vector<Vec3> nodes;
  std::vector<std::array<NodeId, 3>> triangles;
  std::vector<Chord> chords;
};

/// Marks the boundary nodes that are among `nodes`, ascending, as separated.
void separateNodes(const std::vector<NodeId>& nodes, PlanarMesh& mesh) {
  if (nodes.empty()) return;
  mesh.separated.resize(mesh.boundaryCount);
  std::ranges::transform(mesh.surfaceNodes, mesh.separated.begin(), [&](NodeId node) {
    return std::ranges::binary_search(nodes, node) ? std::uint8_t{1} : std::uint8_t{0};
  });
}

/// Adds the elements of `found` to a set, both ascending. Returns false if the set has all of them already.
bool mergeInto(std::vector<NodeId>& set, const std::vector<NodeId>& found) {
  std::vector<NodeId> merged;
  std::ranges::set_union(set, found, std::back_inserter(merged));
  if (merged.size() == set.size()) return false;
  set = std::move(merged);
  return true;
}

/// The values of kTooManyElements for a body of `sides` sides in each direction.
std::vector<double> tetrahedraAsked(double sides) {
  return {counted(kTetrahedraPerUnitVolume * sides * sides * sides),
          static_cast<double>(MeshOptions{}.maxTetrahedra)};
}

}  // namespace

class SurfaceMesher::Impl {
 public:
  Impl(const Model& model, const SizeField& field);
  MeshStatus advance(std::uint32_t budget);
  [[nodiscard]] double fraction() const;

  Phase phase = Phase::kSides;
  SurfaceMesh mesh;
  std::vector<Diagnostic> diagnostics;
  std::vector<PatchSummary> patches;

 private:
  enum class Stage : std::uint8_t {
    kDivide,
    kNumber,
    kLayOut,
    kMesh,
    kSeparate,
    kJoin,
    kDone,
    kFailed
  };

  void findUsedLines();
  void findMinimumSides();
  std::uint32_t divideNextLine();
  bool growFromShortLines();
  void numberNodes();
  std::uint32_t layOutNextPatch();
  bool gatherHalvings(std::uint32_t patch, const PatchBoundary& boundary,
                      const std::vector<std::uint32_t>& faulty);
  void halveSides();
  void reportFaulty(std::uint32_t patch, const PatchBoundary& boundary,
                    const std::vector<std::uint32_t>& faulty);
  void writeLines();
  void beginPatches();
  std::uint32_t meshPatch(std::uint32_t budget);
  void takePatch(std::uint32_t patch);
  void reportPatch(std::uint32_t patch);
  void separatePatches();
  std::uint32_t joinNextPatch();
  void fail(Diagnostic diagnostic);

  ResolvedModel model_;
  const SizeField* field_;
  std::optional<SizeField> graded_;  ///< the field with sizes that grow from short lines, if any
  Stage stage_ = Stage::kDivide;
  std::uint32_t cursor_ = 0;
  int round_ = 0;
  DividedLines lines_;
  std::set<LineSide> halvings_;  ///< wanted by the patches of this round so far
  std::vector<std::uint8_t> used_;
  std::vector<std::uint32_t> minimumSides_;
  std::vector<std::uint32_t> endPoints_;  ///< model points that are nodes, ascending
  std::vector<PatchSurface> surfaces_;
  std::unique_ptr<PatchMesher> patchMesher_;
  std::uint32_t lineNodes_ = 0;  ///< nodes of lines come first in the mesh
  std::vector<PatchTriangulation> triangulations_;
  std::vector<std::uint32_t> pending_;  ///< patches to be triangulated in this round
  int separationRound_ = 0;
  std::vector<std::vector<NodeId>> separated_;  ///< per patch: see findNodesToSeparate()
  FieldHint hint_;
};

SurfaceMesher::Impl::Impl(const Model& model, const SizeField& field)
    : model_(model), field_(&field) {
  lines_.divisions.resize(model.lines.size());
  lines_.nodes.resize(model.lines.size());
  surfaces_.reserve(model.patches.size());
  for (const Patch& patch : model.patches) surfaces_.emplace_back(model_, patch);
  findUsedLines();
  findMinimumSides();
}

void SurfaceMesher::Impl::findUsedLines() {
  const Model& model = model_.model();
  used_.assign(model.lines.size(), 0);
  for (const Patch& patch : model.patches)
    for (const Loop& loop : patch.loops)
      for (const OrientedLine& line : loop) used_[line.line] = 1;
  for (std::uint32_t line = 0; line < used_.size(); ++line) {
    if (used_[line] == 0) continue;
    endPoints_.push_back(model.lines[line].points.front());
    endPoints_.push_back(model.lines[line].points.back());
  }
  sortUnique(endPoints_);
}

void SurfaceMesher::Impl::findMinimumSides() {
  const Model& model = model_.model();
  minimumSides_.assign(model.lines.size(), 1);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> joined;
  for (std::uint32_t line = 0; line < used_.size(); ++line) {
    if (used_[line] == 0) continue;
    const std::vector<std::uint32_t>& points = model.lines[line].points;
    if (points.front() == points.back()) {
      minimumSides_[line] = kClosedLineSides;
      continue;
    }
    const auto [entry, first] =
        joined.try_emplace(std::minmax(points.front(), points.back()), line);
    if (first) continue;
    minimumSides_[line] = kParallelLineSides;
    minimumSides_[entry->second] = kParallelLineSides;
  }
  for (const Patch& patch : model.patches) {
    if (patch.type == PatchType::kPlanar) continue;
    for (const OrientedLine& line : patch.loops.front())
      if (minimumSides_[line.line] == kClosedLineSides) minimumSides_[line.line] = kSeamedLineSides;
  }
}

MeshStatus SurfaceMesher::Impl::advance(std::uint32_t budget) {
  std::uint32_t work = 0;
  while (work < budget || work == 0) {
    switch (stage_) {
      case Stage::kDivide:
        work += divideNextLine();
        break;
      case Stage::kNumber:
        numberNodes();
        ++work;
        break;
      case Stage::kLayOut:
        work += layOutNextPatch();
        break;
      case Stage::kMesh:
        work += meshPatch(budget - work);
        break;
      case Stage::kSeparate:
        separatePatches();
        ++work;
        break;
      case Stage::kJoin:
        work += joinNextPatch();
        break;
      case Stage::kDone:
        return MeshStatus::kDone;
      case Stage::kFailed:
        return MeshStatus::kInvalidInput;
    }
  }
  if (stage_ == Stage::kFailed) return MeshStatus::kInvalidInput;
  return stage_ == Stage::kDone ? MeshStatus::kDone : MeshStatus::kRunning;
}

double SurfaceMesher::Impl::fraction() const {
  // Lines and loops are a small part of the work.
  constexpr double kLinesShare = 0.1;
  if (stage_ < Stage::kMesh) return 0.0;
  if (stage_ > Stage::kMesh || separationRound_ > 0) return 1.0;
  return kLinesShare + (1.0 - kLinesShare) * cursor_ / static_cast<double>(pending_.size());
}

void SurfaceMesher::Impl::fail(Diagnostic diagnostic) {
  diagnostics.push_back(std::move(diagnostic));
  stage_ = Stage::kFailed;
}

// ---- sides -------------------------------------------------------------------------------------

std::uint32_t SurfaceMesher::Impl::divideNextLine() {
  if (cursor_ == used_.size()) {
    cursor_ = 0;
    // All lines are looked at before giving up, so that the user sees all of them at once.
    if (!diagnostics.empty()) {
      stage_ = Stage::kFailed;
    } else if (!growFromShortLines()) {
      stage_ = Stage::kNumber;
    }
    return 1;
  }
  const std::uint32_t line = cursor_++;
  if (used_[line] == 0) return 0;
  LineDivision& division = lines_.divisions[line];
  division = divideLine(model_.curve(line), *field_, minimumSides_[line]);
  if (division.status != LineDivisionStatus::kDivided) {
    Diagnostic diagnostic;
    diagnostic.code = division.status == LineDivisionStatus::kOutsideGrid
                          ? DiagnosticCode::kOutsideBackgroundGrid
                          : DiagnosticCode::kTooManyElements;
    if (division.status == LineDivisionStatus::kTooManySides)
      diagnostic.values = tetrahedraAsked(division.requiredSides);
    diagnostic.entities = {{EntityKind::kLine, line}};
    diagnostic.hasPlace = true;
    diagnostic.place = division.position;
    diagnostics.push_back(std::move(diagnostic));
  }
  return static_cast<std::uint32_t>(division.sideCount()) / kSidesPerStep + 1;
}

/// True if sizes were cut down beside short lines, so that all lines are to be divided again.
bool SurfaceMesher::Impl::growFromShortLines() {
  if (graded_) return false;
  const std::vector<SizeSource> sources = sourcesAtShortLines(model_, lines_.divisions);
  if (sources.empty()) return false;
  graded_.emplace(*field_);
  graded_->addSources(sources);
  field_ = &*graded_;
  return true;
}

void SurfaceMesher::Impl::numberNodes() {
  const Model& model = model_.model();
  const auto nodeAt = [&](std::uint32_t point) {
    return NodeId(
        static_cast<std::size_t>(std::ranges::lower_bound(endPoints_, point) - endPoints_.begin()));
  };
  std::size_t next = endPoints_.size();
  for (std::uint32_t line = 0; line < used_.size(); ++line) {
    if (used_[line] == 0) continue;
    std::uint32_t from = model.lines[line].points.front();
    std::uint32_t to = model.lines[line].points.back();
    if (model_.flipped(line)) std::swap(from, to);
    std::vector<NodeId>& nodes = lines_.nodes[line];
    nodes.assign(lines_.divisions[line].nodes.size(), {});
    nodes.front() = nodeAt(from);
    nodes.back() = nodeAt(to);
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) nodes[i] = NodeId(next++);
  }
  stage_ = Stage::kLayOut;
  cursor_ = 0;
}

// ---- loops -------------------------------------------------------------------------------------

std::uint32_t SurfaceMesher::Impl::layOutNextPatch() {
  if (cursor_ == surfaces_.size()) {
    cursor_ = 0;
    if (!diagnostics.empty()) {
      stage_ = Stage::kFailed;
    } else if (!halvings_.empty()) {
      halveSides();
      ++round_;
      stage_ = Stage::kNumber;
    } else {
      writeLines();
      beginPatches();
      stage_ = Stage::kMesh;
      phase = Phase::kSurface;
    }
    return 1;
  }
  const std::uint32_t patch = cursor_++;
  const PatchBoundary boundary =
      layOutBoundary(model_, model_.model().patches[patch], surfaces_[patch], *field_, lines_);
  const std::vector<std::uint32_t> faulty = findInvalidSides(boundary);
  if (!faulty.empty()) {
    const bool mayHelp = round_ < kMaxHalvingRounds && gatherHalvings(patch, boundary, faulty);
    if (!mayHelp) reportFaulty(patch, boundary, faulty);
  }
  return static_cast<std::uint32_t>(boundary.origins.size()) / kSidesPerStep + 1;
}

/// Remembers those of the faulty sides that are bent in the patch's plane: on bent lines of a planar
/// patch, in holes of a curved one; false if there are none. Nothing is halved before all patches
/// of the round have been laid out: they share the lines, whose nodes are numbered once per round,
/// and which patch comes first must not matter.
bool SurfaceMesher::Impl::gatherHalvings(std::uint32_t patch, const PatchBoundary& boundary,
                                         const std::vector<std::uint32_t>& faulty) {
  const bool curved = surfaces_[patch].mapped() != nullptr;
  const std::uint32_t firstOfHoles = boundary.loops.size() > 1
                                         ? boundary.loops[1]
                                         : static_cast<std::uint32_t>(boundary.origins.size());
  bool found = false;
  for (const std::uint32_t side : faulty) {
    const SideOrigin& origin = boundary.origins[side];
    if (curved ? side < firstOfHoles : model_.curve(origin.line.value).isStraight()) continue;
    halvings_.emplace(origin.line.value, origin.side);
    found = true;
  }
  return found;
}

/// Last first, so that the positions of those to come stay right.
void SurfaceMesher::Impl::halveSides() {
  for (auto at = halvings_.rbegin(); at != halvings_.rend(); ++at)
    halveSide(model_.curve(at->first), at->second, lines_.divisions[at->first]);
  halvings_.clear();
}

void SurfaceMesher::Impl::reportFaulty(std::uint32_t patch, const PatchBoundary& boundary,
                                       const std::vector<std::uint32_t>& faulty) {
  Diagnostic diagnostic;
  diagnostic.code = DiagnosticCode::kLoopsIntersect;
  diagnostic.entities = {{EntityKind::kPatch, patch}};
  std::vector<std::uint32_t> lines;
  for (const std::uint32_t side : faulty) lines.push_back(boundary.origins[side].line.value);
  sortUnique(lines);
  for (const std::uint32_t line : lines) diagnostic.entities.push_back({EntityKind::kLine, line});
  diagnostic.hasPlace = true;
  diagnostic.place = boundary.mesh.positionOf(boundary.mesh.sides[faulty.front()].from);
  diagnostics.push_back(std::move(diagnostic));
}

// ---- the mesh ----------------------------------------------------------------------------------

void SurfaceMesher::Impl::writeLines() {
  const auto append = [&](const Vec3& place) {
    mesh.points.insert(mesh.points.end(), {place.x, place.y, place.z});
  };
  for (const std::uint32_t point : endPoints_) append(model_.model().points[point]);
  for (std::uint32_t line = 0; line < used_.size(); ++line) {
    const std::vector<NodeId>& nodes = lines_.nodes[line];
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      if (i > 0) append(lines_.divisions[line].nodes[i]);
      mesh.sides.insert(mesh.sides.end(), {nodes[i].value, nodes[i + 1].value});
      mesh.sideLine.push_back(line);
    }
  }
}

void SurfaceMesher::Impl::beginPatches() {
  lineNodes_ = static_cast<std::uint32_t>(mesh.points.size() / 3);
  const auto count = static_cast<std::uint32_t>(surfaces_.size());
  pending_.resize(count);
  for (std::uint32_t patch = 0; patch < count; ++patch) pending_[patch] = patch;
  triangulations_.resize(count);
  separated_.resize(count);
  patches.resize(count);
}

std::uint32_t SurfaceMesher::Impl::meshPatch(std::uint32_t budget) {
  if (cursor_ == pending_.size()) {
    cursor_ = 0;
    stage_ = diagnostics.empty() ? Stage::kSeparate : Stage::kFailed;
    return 1;
  }
  const std::uint32_t patch = pending_[cursor_];
  if (patchMesher_ == nullptr) {
    PatchBoundary boundary =
        layOutBoundary(model_, model_.model().patches[patch], surfaces_[patch], *field_, lines_);
    separateNodes(separated_[patch], boundary.mesh);
    const auto sides = static_cast<std::uint32_t>(boundary.origins.size());
    patchMesher_ = std::make_unique<PatchMesher>(surfaces_[patch], *field_, std::move(boundary));
    return sides / kSidesPerStep + 1;
  }
  const MeshStatus status = patchMesher_->advance(budget);
  if (status == MeshStatus::kRunning) return budget;
  ++cursor_;
  if (status == MeshStatus::kDone)
    takePatch(patch);
  else
    reportPatch(patch);
  const auto triangles = static_cast<std::uint32_t>(patchMesher_->mesh().triangles.size());
  patchMesher_.reset();
  return triangles / kSidesPerStep + 1;
}

void SurfaceMesher::Impl::takePatch(std::uint32_t patch) {
  const PlanarMesh& planar = patchMesher_->mesh();
  PatchTriangulation& taken = triangulations_[patch];
  taken = {};
  taken.nodes.assign(planar.positions.begin() + planar.boundaryCount, planar.positions.end());
  const auto outside = std::ranges::find_if(
      taken.nodes, [&](const Vec3& place) { return !field_->covers(place, hint_); });
  if (outside != taken.nodes.end()) {
    Diagnostic diagnostic;
    diagnostic.code = DiagnosticCode::kOutsideBackgroundGrid;
    diagnostic.entities = {{EntityKind::kPatch, patch}};
    diagnostic.hasPlace = true;
    diagnostic.place = *outside;
    diagnostics.push_back(std::move(diagnostic));
  }
  taken.triangles.reserve(planar.triangles.size());
  const auto nodeOf = [&](PlanarNodeId node) {
    return planar.isBoundary(node) ? planar.surfaceNodes[node.index()]
                                   : NodeId(lineNodes_ + (node.value - planar.boundaryCount));
  };
  for (const auto& [a, b, c] : planar.triangles)
    taken.triangles.push_back({nodeOf(a), nodeOf(b), nodeOf(c)});
  collectChords(PatchId(patch), planar, taken.chords);
  patches[patch] = summarizePatch({surfaces_[patch], *field_}, planar, PatchId(patch));
}

/// Looks for patches that would lie on others, and has these triangulated anew.
void SurfaceMesher::Impl::separatePatches() {
  pending_.clear();
  if (separationRound_ < kMaxSeparationRounds) {
    ++separationRound_;
    std::vector<Chord> chords;
    for (const PatchTriangulation& patch : triangulations_)
      chords.insert(chords.end(), patch.chords.begin(), patch.chords.end());
    const auto found = findNodesToSeparate(model_.model(), lines_, chords);
    for (std::uint32_t patch = 0; patch < found.size(); ++patch)
      if (mergeInto(separated_[patch], found[patch])) pending_.push_back(patch);
  }
  cursor_ = 0;
  stage_ = pending_.empty() ? Stage::kJoin : Stage::kMesh;
}

/// Appends a patch's triangulation to the mesh.
std::uint32_t SurfaceMesher::Impl::joinNextPatch() {
  if (cursor_ == triangulations_.size()) {
    stage_ = Stage::kDone;
    return 1;
  }
  const std::uint32_t patch = cursor_++;
  const PatchTriangulation& taken = triangulations_[patch];
  const auto shift = static_cast<std::uint32_t>(mesh.points.size() / 3) - lineNodes_;
  for (const Vec3& place : taken.nodes)
    mesh.points.insert(mesh.points.end(), {place.x, place.y, place.z});
  for (const auto& triangle : taken.triangles)
    for (const NodeId node : triangle)
      mesh.triangles.push_back(node.value < lineNodes_ ? node.value : node.value + shift);
  const std::size_t count = taken.triangles.size();
  mesh.trianglePatch.insert(mesh.trianglePatch.end(), count, patch);
  triangulations_[patch] = {};
  return static_cast<std::uint32_t>(count) / kTrianglesPerStep + 1;
}

void SurfaceMesher::Impl::reportPatch(std::uint32_t patch) {
  Diagnostic diagnostic;
  diagnostic.entities = {{EntityKind::kPatch, patch}};
  diagnostic.code = DiagnosticCode::kDegeneratePatch;
  if (patchMesher_->hasTooManyTriangles()) {
    diagnostic.code = DiagnosticCode::kTooManyElements;
    // A square of t triangles has about sqrt(t / 2) sides along each edge.
    const double triangles = static_cast<double>(patchMesher_->mesh().triangles.size());
    diagnostic.values = tetrahedraAsked(std::sqrt(0.5 * triangles));
  }
  diagnostics.push_back(std::move(diagnostic));
}

// ---- the public face ---------------------------------------------------------------------------

SurfaceMesher::SurfaceMesher(const Model& model, const SizeField& field)
    : impl_(std::make_unique<Impl>(model, field)) {}
SurfaceMesher::SurfaceMesher(SurfaceMesher&&) noexcept = default;
SurfaceMesher& SurfaceMesher::operator=(SurfaceMesher&&) noexcept = default;
SurfaceMesher::~SurfaceMesher() = default;

MeshStatus SurfaceMesher::advance(std::uint32_t budget) { return impl_->advance(budget); }
Phase SurfaceMesher::phase() const { return impl_->phase; }
double SurfaceMesher::fraction() const { return impl_->fraction(); }
const std::vector<Diagnostic>& SurfaceMesher::diagnostics() const { return impl_->diagnostics; }
const SurfaceMesh& SurfaceMesher::mesh() const { return impl_->mesh; }
const std::vector<PatchSummary>& SurfaceMesher::patchSummaries() const { return impl_->patches; }
SurfaceMesh SurfaceMesher::takeMesh() { return std::move(impl_->mesh); }

}  // namespace tetrafront
