#include "boundary/boundary.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/ids.h"
#include "base/budget.h"
#include "search/box_tree.h"
#include "boundary/surface_checks.h"
#include "boundary/edge_table.h"
#include "boundary/self_intersection.h"
#include "boundary/surface_access.h"
#include "boundary/region_map.h"
#include "boundary/half_faces.h"

namespace tetrafront {
namespace {

/// To come to a box costs far less than to test a triangle.
constexpr std::size_t kBoxesPerBudget = 16;

}  // namespace

class BoundaryCheck::Impl {
 public:
  Impl(SurfaceMesh& mesh, BoundarySource source, EnclosedBodies enclosed, MixedOrientation mixed,
       std::size_t maxDiagnostics)
      : mesh_(mesh),
        source_(source),
        enclosed_(enclosed),
        mixed_(mixed),
        report_(mesh, source, maxDiagnostics) {}

  bool advance(std::uint32_t budget) {
    switch (stage_) {
      case Stage::kNumbers:
        checkNumbers(mesh_, report_);
        stage_ = report_.hasErrors() ? Stage::kReport : Stage::kTriangles;
        break;
      case Stage::kTriangles:
        invalid_ = checkTriangles(mesh_, report_);
        stage_ = Stage::kNodes;
        break;
      case Stage::kNodes:
        checkCoincidentNodes(mesh_, report_);
        stage_ = Stage::kEdges;
        break;
      case Stage::kEdges:
        edges_.emplace(mesh_.triangles, mesh_.points.size() / 3, invalid_.inTopology);
        checkEdges(mesh_, *edges_, report_);
        stage_ = Stage::kBoxes;
        break;
      case Stage::kBoxes:
        builder_.emplace(triangleBoxes(mesh_));
        stage_ = Stage::kTree;
        break;
      case Stage::kTree:
        if (!builder_->advance(scaledBudget(budget, kBoxesPerBudget))) break;
        tree_ = builder_->take();
        builder_.reset();
        intersections_.emplace(mesh_, invalid_.inGeometry, tree_, report_);
        stage_ = Stage::kIntersections;
        break;
      case Stage::kIntersections:
        if (!intersections_->advance(budget)) break;
        intersections_.reset();
        stage_ = report_.hasErrors() ? Stage::kReport : Stage::kCells;
        break;
      case Stage::kCells:
        regions_ = findRegions(mesh_, *edges_, tree_, enclosed_, report_);
        stage_ = report_.hasErrors() ? Stage::kReport : Stage::kRegions;
        break;
      case Stage::kRegions:
        orientOutward();
        if (!report_.hasErrors()) numberRegions();
        stage_ = Stage::kReport;
        break;
      case Stage::kReport:
        result_.valid = !report_.hasErrors();
        diagnostics_ = report_.take();
        stage_ = Stage::kFinished;
        break;
      case Stage::kFinished:
        break;
    }
    return stage_ == Stage::kFinished;
  }

  [[nodiscard]] double fraction() const {
    // Stages count alike; only the longest is looked into.
    const auto stage = static_cast<double>(stage_);
    const double share = stage / static_cast<double>(Stage::kFinished);
    if (stage_ != Stage::kIntersections) return share;
    return share + intersections_->fraction() / static_cast<double>(Stage::kFinished);
  }

  [[nodiscard]] const BoundaryResult& result() const { return result_; }
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  [[nodiscard]] std::vector<Diagnostic> takeDiagnostics() { return std::move(diagnostics_); }
  [[nodiscard]] const std::vector<std::uint8_t>& withoutEdges() const {
    return invalid_.inTopology;
  }

 private:
  enum class Stage : std::uint8_t {
    kNumbers,
    kTriangles,
    kNodes,
    kEdges,
    kBoxes,
    kTree,
    kIntersections,
    kCells,
    kRegions,
    kReport,
    kFinished
  };

  void orientOutward();
  void reportFlippedPatches(const std::vector<std::uint8_t>& isFlipped);
  void reportFlippedComponents(const std::vector<std::uint8_t>& isFlipped);
  [[nodiscard]] bool isWall(std::uint32_t triangle) const {
    return regions_.isMeshedAt(frontOf(triangle)) && regions_.isMeshedAt(backOf(triangle));
  }
  /// Whether the triangle would be a wall if every space were filled.
  [[nodiscard]] bool isBetweenRegions(std::uint32_t triangle) const {
    return regions_.outerShellAt(frontOf(triangle)) != RegionMap::kUnbounded &&
           regions_.outerShellAt(backOf(triangle)) != RegionMap::kUnbounded;
  }
  void numberRegions();

  SurfaceMesh& mesh_;
  BoundarySource source_;
  EnclosedBodies enclosed_;
  MixedOrientation mixed_;
  BoundaryReport report_;
  Stage stage_ = Stage::kNumbers;
  InvalidTriangles invalid_;
  std::optional<EdgeTable> edges_;
  std::optional<BoxTreeBuilder> builder_;
  BoxTree tree_;
  std::optional<SelfIntersectionCheck> intersections_;
  RegionMap regions_;
  BoundaryResult result_;
  std::vector<Diagnostic> diagnostics_;
};

/// The filled side becomes the back of each triangle. Walls, both of whose sides are filled, stay as
/// they were drawn.
void BoundaryCheck::Impl::orientOutward() {
  std::vector<std::uint8_t> isFlipped(regions_.componentOf.size(), 0);
  for (std::uint32_t t = 0; t < isFlipped.size(); ++t) {
    if (regions_.isMeshedAt(backOf(t))) continue;
    isFlipped[t] = 1;
    flipTriangle(mesh_, t);
    std::swap(regions_.shellOf[backOf(t)], regions_.shellOf[frontOf(t)]);
  }
  if (source_ == BoundarySource::kDrawnPatches) {
    reportFlippedPatches(isFlipped);
  } else {
    reportFlippedComponents(isFlipped);
  }
}

void BoundaryCheck::Impl::reportFlippedPatches(const std::vector<std::uint8_t>& isFlipped) {
  std::vector<std::uint8_t> isNamed;
  std::vector<Entity> patches;
  std::uint32_t first = 0;
  for (std::uint32_t t = 0; t < isFlipped.size(); ++t) {
    const std::uint32_t patch = mesh_.trianglePatch[t];
    if (patch >= isNamed.size()) isNamed.resize(std::size_t{patch} + 1, 0);
    if (isFlipped[t] == 0 || isNamed[patch] != 0) continue;
    isNamed[patch] = 1;
    if (patches.empty()) first = t;
    patches.push_back({EntityKind::kPatch, patch});
  }
  if (patches.empty()) return;
  report_.addInformation(DiagnosticCode::kReorientedPatch, std::move(patches),
                         report_.centroidOf(first), {});
}

void BoundaryCheck::Impl::reportFlippedComponents(const std::vector<std::uint8_t>& isFlipped) {
  struct Count {
    std::uint32_t first = 0;
    std::uint32_t turned = 0;
    std::uint32_t all = 0;
  };
  std::vector<Count> counts;
  for (std::uint32_t t = 0; t < isFlipped.size(); ++t) {
    if (regions_.componentOf[t] == counts.size()) counts.emplace_back();
    Count& count = counts[regions_.componentOf[t]];
    if (!isWall(t)) ++count.all;
    if (isFlipped[t] == 0) continue;
    if (count.turned++ == 0) count.first = t;
  }
  const auto isRefused = [this](const Count& count) {
    return mixed_ == MixedOrientation::kRefuse && count.turned > 0 && count.turned < count.all;
  };
  for (std::uint32_t t = 0; t < isFlipped.size(); ++t) {
    if (isFlipped[t] != 0 && isRefused(counts[regions_.componentOf[t]])) {
      report_.addTriangle(DiagnosticCode::kTurnedTriangle, t, {isBetweenRegions(t) ? 1.0 : 0.0});
    }
  }
  for (const Count& count : counts) {
    if (count.turned == 0 || isRefused(count)) continue;
    report_.addInformation(DiagnosticCode::kReorientedPatch, {{EntityKind::kTriangle, count.first}},
                           report_.centroidOf(count.first),
                           {static_cast<double>(count.turned), static_cast<double>(count.all)});
  }
}

/// Regions in order of the lowest triangles of the shells around them.
void BoundaryCheck::Impl::numberRegions() {
  std::vector<std::uint32_t> numberOf(regions_.shells.size(), kNoIndex);
  std::vector<std::uint32_t> regionOf(regions_.shells.size(), SurfaceMesh::kNoRegion);
  std::uint32_t cavities = 0;
  for (std::uint32_t side = 0; side < regions_.shellOf.size(); ++side) {
    const std::uint32_t shell = regions_.shellOf[side];
    if (regions_.isMeshed[shell] == 0) continue;
    if (numberOf[shell] == kNoIndex) {
      numberOf[shell] = static_cast<std::uint32_t>(result_.shells.size());
      result_.shells.push_back(
          {.firstTriangle = triangleOf(side), .volume = regions_.shells[shell].volume});
      if (regions_.outerShellOf[shell] == shell) {
        regionOf[shell] = result_.regionCount++;
      } else if (!regions_.isMeshedAt(oppositeOf(side))) {
        ++cavities;
      }
    }
    BoundaryShell& found = result_.shells[numberOf[shell]];
    ++found.triangles;
    const std::array<Vec3, 3> p = cornersOf(mesh_, triangleOf(side));
    found.area += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
  }
  mesh_.triangleRegions.assign(regions_.shellOf.size(), SurfaceMesh::kNoRegion);
  for (std::uint32_t side = 0; side < regions_.shellOf.size(); ++side) {
    const std::uint32_t shell = regions_.shellOf[side];
    if (regions_.isMeshed[shell] == 0) continue;
    mesh_.triangleRegions[side] = regionOf[regions_.outerShellOf[shell]];
    result_.shells[numberOf[shell]].region = mesh_.triangleRegions[side];
  }
  if (result_.shells.size() > 1)
    report_.addNesting(result_.shells[1].firstTriangle, result_.regionCount, cavities);
  // What a given surface has in place of patches.
  if (source_ != BoundarySource::kGivenSurface) return;
  mesh_.trianglePatch.resize(regions_.componentOf.size());
  for (std::uint32_t t = 0; t < mesh_.trianglePatch.size(); ++t) {
    mesh_.trianglePatch[t] = numberOf[regions_.shellOf[backOf(t)]];
  }
}

BoundaryCheck::BoundaryCheck(SurfaceMesh& mesh, BoundarySource source, EnclosedBodies enclosed,
                             MixedOrientation mixed, std::size_t maxDiagnostics)
    : impl_(std::make_unique<Impl>(mesh, source, enclosed, mixed, maxDiagnostics)) {}
BoundaryCheck::BoundaryCheck(BoundaryCheck&&) noexcept = default;
BoundaryCheck& BoundaryCheck::operator=(BoundaryCheck&&) noexcept = default;
BoundaryCheck::~BoundaryCheck() = default;

bool BoundaryCheck::advance(std::uint32_t budget) { return impl_->advance(budget); }
double BoundaryCheck::fraction() const { return impl_->fraction(); }
const BoundaryResult& BoundaryCheck::result() const { return impl_->result(); }
const std::vector<Diagnostic>& BoundaryCheck::diagnostics() const { return impl_->diagnostics(); }
std::vector<Diagnostic> BoundaryCheck::takeDiagnostics() { return impl_->takeDiagnostics(); }
const std::vector<std::uint8_t>& BoundaryCheck::withoutEdges() const {
  return impl_->withoutEdges();
}

BoundaryResult closeBoundary(SurfaceMesh& mesh, BoundarySource source, std::vector<Diagnostic>& out,
                             EnclosedBodies enclosed) {
  constexpr std::uint32_t kSlice = 1U << 16U;
  BoundaryCheck check(mesh, source, enclosed);
  while (!check.advance(kSlice)) {
  }
  out.insert(out.end(), check.diagnostics().begin(), check.diagnostics().end());
  return check.result();
}

}  // namespace tetrafront
