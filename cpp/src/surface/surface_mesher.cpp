#include "surface/surface_mesher.h"

#include <algorithm>
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
constexpr int kMaxPartingRounds = 3;

/// A line, and one of its sides.
using LineSide = std::pair<std::uint32_t, std::uint32_t>;

/// What one patch adds to the mesh. Nodes of lines have their numbers in the triangles, its own
/// follow those.
struct PatchTriangulation {
  std::vector<Vec3> nodes;
  std::vector<std::uint32_t> triangles;
  std::vector<Joint> joints;
};

/// Marks the boundary nodes whose numbers in the surface are among `nodes`, ascending.
void partNodes(const std::vector<std::uint32_t>& nodes, PlanarMesh& mesh) {
  if (nodes.empty()) return;
  mesh.parted.resize(mesh.boundaryCount);
  std::ranges::transform(mesh.aliases, mesh.parted.begin(), [&](std::uint32_t node) {
    return std::ranges::binary_search(nodes, node) ? std::uint8_t{1} : std::uint8_t{0};
  });
}

/// Adds what is missing to a set of ascending numbers; false if nothing was.
bool mergeInto(std::vector<std::uint32_t>& set, const std::vector<std::uint32_t>& found) {
  std::vector<std::uint32_t> merged;
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
    kPart,
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
  void partPatches();
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
  int partingRound_ = 0;
  std::vector<std::vector<std::uint32_t>> parted_;  ///< per patch: see findNodesToPart()
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
      case Stage::kPart:
        partPatches();
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
  if (stage_ > Stage::kMesh || partingRound_ > 0) return 1.0;
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
      diagnostic.values = tetrahedraAsked(division.wantedSides);
    diagnostic.entities = {{EntityKind::kLine, line}};
    diagnostic.hasPlace = true;
    diagnostic.place = division.place;
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
  const auto numberOf = [&](std::uint32_t point) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(endPoints_, point) -
                                      endPoints_.begin());
  };
  auto next = static_cast<std::uint32_t>(endPoints_.size());
  for (std::uint32_t line = 0; line < used_.size(); ++line) {
    if (used_[line] == 0) continue;
    std::uint32_t from = model.lines[line].points.front();
    std::uint32_t to = model.lines[line].points.back();
    if (model_.flipped(line)) std::swap(from, to);
    std::vector<std::uint32_t>& nodes = lines_.nodes[line];
    nodes.assign(lines_.divisions[line].nodes.size(), 0);
    nodes.front() = numberOf(from);
    nodes.back() = numberOf(to);
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) nodes[i] = next++;
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
    if (curved ? side < firstOfHoles : model_.curve(origin.line).isStraight()) continue;
    halvings_.emplace(origin.line, origin.side);
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
  for (const std::uint32_t side : faulty) lines.push_back(boundary.origins[side].line);
  sortUnique(lines);
  for (const std::uint32_t line : lines) diagnostic.entities.push_back({EntityKind::kLine, line});
  diagnostic.hasPlace = true;
  diagnostic.place = boundary.mesh.places[boundary.mesh.sides[2 * std::size_t{faulty.front()}]];
  diagnostics.push_back(std::move(diagnostic));
}

// ---- the mesh ----------------------------------------------------------------------------------

void SurfaceMesher::Impl::writeLines() {
  const auto append = [&](const Vec3& place) {
    mesh.points.insert(mesh.points.end(), {place.x, place.y, place.z});
  };
  for (const std::uint32_t point : endPoints_) append(model_.model().points[point]);
  for (std::uint32_t line = 0; line < used_.size(); ++line) {
    const std::vector<std::uint32_t>& nodes = lines_.nodes[line];
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      if (i > 0) append(lines_.divisions[line].nodes[i]);
      mesh.sides.insert(mesh.sides.end(), {nodes[i], nodes[i + 1]});
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
  parted_.resize(count);
  patches.resize(count);
}

std::uint32_t SurfaceMesher::Impl::meshPatch(std::uint32_t budget) {
  if (cursor_ == pending_.size()) {
    cursor_ = 0;
    stage_ = diagnostics.empty() ? Stage::kPart : Stage::kFailed;
    return 1;
  }
  const std::uint32_t patch = pending_[cursor_];
  if (patchMesher_ == nullptr) {
    PatchBoundary boundary =
        layOutBoundary(model_, model_.model().patches[patch], surfaces_[patch], *field_, lines_);
    partNodes(parted_[patch], boundary.mesh);
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
  const auto triangles = static_cast<std::uint32_t>(patchMesher_->mesh().triangles.size() / 3);
  patchMesher_.reset();
  return triangles / kSidesPerStep + 1;
}

void SurfaceMesher::Impl::takePatch(std::uint32_t patch) {
  const PlanarMesh& planar = patchMesher_->mesh();
  PatchTriangulation& taken = triangulations_[patch];
  taken = {};
  taken.nodes.assign(planar.places.begin() + planar.boundaryCount, planar.places.end());
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
  for (const std::uint32_t node : planar.triangles)
    taken.triangles.push_back(node < planar.boundaryCount
                                  ? planar.aliases[node]
                                  : lineNodes_ + (node - planar.boundaryCount));
  collectJoints(patch, planar, taken.joints);
  patches[patch] = summarizePatch({surfaces_[patch], *field_}, planar, patch);
}

/// Looks for patches that would lie on others, and has these triangulated anew.
void SurfaceMesher::Impl::partPatches() {
  pending_.clear();
  if (partingRound_ < kMaxPartingRounds) {
    ++partingRound_;
    std::vector<Joint> joints;
    for (const PatchTriangulation& patch : triangulations_)
      joints.insert(joints.end(), patch.joints.begin(), patch.joints.end());
    const auto found = findNodesToPart(model_.model(), lines_, joints);
    for (std::uint32_t patch = 0; patch < found.size(); ++patch)
      if (mergeInto(parted_[patch], found[patch])) pending_.push_back(patch);
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
  for (const std::uint32_t node : taken.triangles)
    mesh.triangles.push_back(node < lineNodes_ ? node : node + shift);
  const std::size_t count = taken.triangles.size() / 3;
  mesh.trianglePatch.insert(mesh.trianglePatch.end(), count, patch);
  triangulations_[patch] = {};
  return static_cast<std::uint32_t>(count) / kTrianglesPerStep + 1;
}

void SurfaceMesher::Impl::reportPatch(std::uint32_t patch) {
  Diagnostic diagnostic;
  diagnostic.entities = {{EntityKind::kPatch, patch}};
  diagnostic.code = DiagnosticCode::kDegeneratePatch;
  if (patchMesher_->tooMany()) {
    diagnostic.code = DiagnosticCode::kTooManyElements;
    // A square of t triangles has about sqrt(t / 2) sides along each edge.
    const double triangles = static_cast<double>(patchMesher_->mesh().triangles.size()) / 3.0;
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
