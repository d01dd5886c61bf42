#include "surface/boundary.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "search/box_tree.h"
#include "surface/boundary_orientation.h"
#include "surface/boundary_soundness.h"
#include "surface/edge_table.h"
#include "surface/self_intersection.h"
#include "surface/shell_nesting.h"

namespace tetrafront {

class BoundaryCheck::Impl {
 public:
  Impl(SurfaceMesh& mesh, BoundarySource source)
      : mesh_(mesh), source_(source), report_(mesh, source) {}

  bool advance(std::uint32_t budget) {
    switch (stage_) {
      case Stage::kNumbers:
        checkNumbers(mesh_, report_);
        stage_ = report_.hasErrors() ? Stage::kReport : Stage::kTriangles;
        break;
      case Stage::kTriangles:
        unsound_ = checkTriangles(mesh_, report_);
        checkCoincidentNodes(mesh_, report_);
        stage_ = Stage::kEdges;
        break;
      case Stage::kEdges:
        edges_.emplace(mesh_.triangles, mesh_.points.size() / 3, unsound_.inTopology);
        checkEdges(mesh_, *edges_, report_);
        stage_ = Stage::kTree;
        break;
      case Stage::kTree:
        tree_ = BoxTree(triangleBoxes(mesh_));
        intersections_.emplace(mesh_, unsound_.inGeometry, tree_, report_);
        stage_ = Stage::kIntersections;
        break;
      case Stage::kIntersections:
        if (!intersections_->advance(budget)) break;
        stage_ = report_.hasErrors() ? Stage::kReport : Stage::kOrientation;
        break;
      case Stage::kOrientation:
        orient();
        stage_ = report_.hasErrors() ? Stage::kReport : Stage::kRegions;
        break;
      case Stage::kRegions:
        numberRegions();
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

 private:
  enum class Stage : std::uint8_t {
    kNumbers,
    kTriangles,
    kEdges,
    kTree,
    kIntersections,
    kOrientation,
    kRegions,
    kReport,
    kFinished
  };

  void orient();
  void turnOutward(const std::vector<Shell>& parts);
  void reportTurned(const std::vector<std::uint32_t>& before);
  void reportTurnedPatches(const std::vector<std::uint8_t>& isTurned);
  void reportTurnedShells(const std::vector<std::uint8_t>& isTurned);
  void numberRegions();

  SurfaceMesh& mesh_;
  BoundarySource source_;
  BoundaryReport report_;
  Stage stage_ = Stage::kNumbers;
  UnsoundTriangles unsound_;
  std::optional<EdgeTable> edges_;
  BoxTree tree_;
  std::optional<SelfIntersectionCheck> intersections_;
  std::vector<std::uint32_t> partOf_;  ///< per triangle: what it is connected with over edges
  BoundaryResult result_;
  std::vector<Diagnostic> diagnostics_;
};

void BoundaryCheck::Impl::orient() {
  const std::vector<std::uint32_t> before = mesh_.triangles;
  partOf_ = orientConsistently(mesh_, *edges_, report_);
  const std::vector<Shell> parts = measureShells(mesh_, partOf_);
  for (const Shell& part : parts) {
    if (part.isFlat) report_.addTriangle(DiagnosticCode::kZeroVolume, part.firstTriangle);
  }
  if (report_.hasErrors()) {
    mesh_.triangles = before;
    return;
  }
  turnOutward(parts);
  reportTurned(before);
  edges_.emplace(mesh_.triangles, mesh_.points.size() / 3, unsound_.inTopology);
}

/// Within an even number of others a part is the outside of a region, within an odd number it
/// bounds a cavity.
void BoundaryCheck::Impl::turnOutward(const std::vector<Shell>& parts) {
  std::vector<std::uint8_t> turns(parts.size());
  const ShellNesting nesting(mesh_, partOf_, parts.size(), tree_);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    const bool isCavity = parts.size() > 1 && nesting.around(p).size() % 2 == 1;
    turns[p] = (parts[p].volume < 0.0) != isCavity ? 1 : 0;
  }
  for (std::uint32_t t = 0; t < partOf_.size(); ++t) {
    if (turns[partOf_[t]] != 0) turnRound(mesh_, t);
  }
}

void BoundaryCheck::Impl::reportTurned(const std::vector<std::uint32_t>& before) {
  std::vector<std::uint8_t> isTurned(partOf_.size());
  for (std::size_t t = 0; t < isTurned.size(); ++t) {
    isTurned[t] = before[3 * t + 1] != mesh_.triangles[3 * t + 1] ? 1 : 0;
  }
  if (source_ == BoundarySource::kDrawnPatches) {
    reportTurnedPatches(isTurned);
  } else {
    reportTurnedShells(isTurned);
  }
}

void BoundaryCheck::Impl::reportTurnedPatches(const std::vector<std::uint8_t>& isTurned) {
  std::vector<std::uint8_t> isReported;
  for (std::uint32_t t = 0; t < isTurned.size(); ++t) {
    const std::uint32_t patch = mesh_.trianglePatch[t];
    if (patch >= isReported.size()) isReported.resize(std::size_t{patch} + 1, 0);
    if (isTurned[t] == 0 || isReported[patch] != 0) continue;
    isReported[patch] = 1;
    report_.addInformation(DiagnosticCode::kReorientedPatch, {{EntityKind::kPatch, patch}},
                           report_.centreOf(t), {});
  }
}

void BoundaryCheck::Impl::reportTurnedShells(const std::vector<std::uint8_t>& isTurned) {
  struct Count {
    std::uint32_t first = 0;
    std::uint32_t turned = 0;
    std::uint32_t all = 0;
  };
  std::vector<Count> counts;
  for (std::uint32_t t = 0; t < isTurned.size(); ++t) {
    if (partOf_[t] == counts.size()) counts.emplace_back();
    Count& count = counts[partOf_[t]];
    ++count.all;
    if (isTurned[t] == 0) continue;
    if (count.turned++ == 0) count.first = t;
  }
  for (const Count& count : counts) {
    if (count.turned == 0) continue;
    report_.addInformation(DiagnosticCode::kReorientedPatch, {{EntityKind::kTriangle, count.first}},
                           report_.centreOf(count.first),
                           {static_cast<double>(count.turned), static_cast<double>(count.all)});
  }
}

void BoundaryCheck::Impl::numberRegions() {
  const std::vector<std::uint32_t> shellOf = innerShells(mesh_, *edges_);
  const std::vector<Shell> shells = measureShells(mesh_, shellOf);
  std::vector<std::uint32_t> regionOf(shells.size(), 0);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (shells[s].volume > 0.0) regionOf[s] = result_.regionCount++;
  }
  if (shells.size() > 1) {
    const auto count = static_cast<std::uint32_t>(shells.size());
    report_.addNesting(shells[1].firstTriangle, result_.regionCount, count - result_.regionCount);
    const ShellNesting nesting(mesh_, shellOf, shells.size(), tree_);
    for (std::uint32_t s = 0; s < shells.size(); ++s) {
      if (shells[s].volume > 0.0) continue;
      // A cavity belongs to the smallest region around it.
      const Shell* owner = nullptr;
      for (const std::uint32_t a : nesting.around(s)) {
        if (shells[a].volume <= 0.0 || (owner != nullptr && owner->volume <= shells[a].volume))
          continue;
        owner = &shells[a];
        regionOf[s] = regionOf[a];
      }
    }
  }
  result_.triangleRegion.resize(shellOf.size());
  for (std::size_t t = 0; t < shellOf.size(); ++t) result_.triangleRegion[t] = regionOf[shellOf[t]];
  if (source_ == BoundarySource::kGivenSurface) mesh_.trianglePatch = shellOf;
}

BoundaryCheck::BoundaryCheck(SurfaceMesh& mesh, BoundarySource source)
    : impl_(std::make_unique<Impl>(mesh, source)) {}
BoundaryCheck::BoundaryCheck(BoundaryCheck&&) noexcept = default;
BoundaryCheck& BoundaryCheck::operator=(BoundaryCheck&&) noexcept = default;
BoundaryCheck::~BoundaryCheck() = default;

bool BoundaryCheck::advance(std::uint32_t budget) { return impl_->advance(budget); }
double BoundaryCheck::fraction() const { return impl_->fraction(); }
const BoundaryResult& BoundaryCheck::result() const { return impl_->result(); }
const std::vector<Diagnostic>& BoundaryCheck::diagnostics() const { return impl_->diagnostics(); }

BoundaryResult closeBoundary(SurfaceMesh& mesh, BoundarySource source,
                             std::vector<Diagnostic>& out) {
  constexpr std::uint32_t kSlice = 1U << 16U;
  BoundaryCheck check(mesh, source);
  while (!check.advance(kSlice)) {
  }
  out.insert(out.end(), check.diagnostics().begin(), check.diagnostics().end());
  return check.result();
}

}  // namespace tetrafront
