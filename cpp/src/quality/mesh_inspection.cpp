#include "tetrafront/mesh_inspection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/ids.h"
#include "base/mesh_access.h"
#include "base/sort.h"
#include "field/size_field.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "geom/tetrahedron.h"
#include "quality/mesh_boundary.h"
#include "quality/quality_analysis.h"
#include "quality/verify_mesh.h"

namespace tetrafront {
namespace {

bool isReadable(const VolumeMesh& mesh) {
  const std::size_t nodes = countNodes(mesh);
  const std::size_t elements = countTetrahedra(mesh);
  return elements > 0 && mesh.points.size() % 3 == 0 && mesh.tetrahedra.size() % 4 == 0 &&
         (mesh.regions.empty() || mesh.regions.size() == elements) &&
         std::all_of(mesh.points.begin(), mesh.points.end(),
                     [](double x) { return std::fabs(x) <= kLargestCoordinate; }) &&
         std::all_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(),
                     [nodes](std::uint32_t node) { return node < nodes; });
}

void countUsedNodes(const VolumeMesh& mesh, MeshInspection& out) {
  std::vector<std::uint8_t> isUsed(countNodes(mesh), 0);
  for (const std::uint32_t node : mesh.tetrahedra) isUsed[node] = 1;
  const auto used = std::count(isUsed.begin(), isUsed.end(), std::uint8_t{1});
  out.nodes = static_cast<std::uint32_t>(used);
  out.unusedNodes = static_cast<std::uint32_t>(isUsed.size()) - out.nodes;
}

/// Reverses the orientation of an inverted element.
void orientElement(VolumeMesh& mesh, TetId element, MeshInspection& out) {
  const auto [a, b, c, d] = cornersOf(mesh, element);
  const int sign = orient3d(a, b, c, d);
  if (sign == 0) ++out.degenerateTetrahedra;
  if (sign >= 0) return;
  ++out.invertedTetrahedra;
  std::swap(mesh.tetrahedra[4 * element.index() + 2], mesh.tetrahedra[4 * element.index() + 3]);
}

std::uint32_t narrowed(std::uint64_t count) {
  constexpr std::uint64_t kMaxCount = 0xffffffffU;
  return static_cast<std::uint32_t>(std::min(count, kMaxCount));
}

class Inspection final : public ToolWork<MeshInspection> {
 public:
  Inspection(std::span<const double> points, std::span<const std::uint32_t> tetrahedra,
             std::span<const std::uint32_t> regions) {
    mesh_.points.assign(points.begin(), points.end());
    mesh_.tetrahedra.assign(tetrahedra.begin(), tetrahedra.end());
    mesh_.regions.assign(regions.begin(), regions.end());
  }

  bool advance(std::uint32_t budget) override;

  [[nodiscard]] double fraction() const override {
    const double within = verifier_ ? verifier_->fraction() : 0.0;
    return (static_cast<double>(stage_) + within) / static_cast<double>(Stage::kDone);
  }
  [[nodiscard]] const MeshInspection& result() const override { return out_; }

 private:
  enum class Stage : std::uint8_t { kNodes, kElements, kBoundary, kVerify, kAnalyse, kDone };

  [[nodiscard]] Stage readNodes();
  void numberRegions();
  /// Returns whether all tetrahedra are done.
  bool measureElements(std::uint32_t budget);
  void measureEdges(TetId element);
  void takeBoundary();
  void takeDefects();
  void beginAnalysis();

  VolumeMesh mesh_;  ///< its regions are indices in regionIds_
  std::vector<std::uint32_t> regionIds_;
  Stage stage_ = Stage::kNodes;
  TetId nextElement_{0U};
  double edgeSum_ = 0.0;
  std::optional<BoundaryFinder> boundary_;
  SurfaceMesh surface_;         ///< the boundary with its positions
  SurfaceMesh withInterfaces_;  ///< the boundary and the interfaces
  std::optional<MeshVerifier> verifier_;
  std::optional<SizeField> field_;
  std::optional<QualityAnalysis> analysis_;
  MeshInspection out_;
};

bool Inspection::advance(std::uint32_t budget) {
  switch (stage_) {
    case Stage::kNodes:
      stage_ = readNodes();
      break;
    case Stage::kElements:
      if (!measureElements(budget)) break;
      boundary_.emplace(mesh_);
      stage_ = Stage::kBoundary;
      break;
    case Stage::kBoundary:
      if (!boundary_->advance(budget)) break;
      takeBoundary();
      break;
    case Stage::kVerify:
      if (!verifier_->advance(budget)) break;
      takeDefects();
      beginAnalysis();
      break;
    case Stage::kAnalyse:
      if (!analysis_->advance(budget)) break;
      out_.quality = analysis_->summary();
      out_.statistics = analysis_->statistics();
      for (RegionStatistics& own : out_.statistics.regions) own.region = regionIds_[own.region];
      stage_ = Stage::kDone;
      break;
    case Stage::kDone:
      break;
  }
  return stage_ == Stage::kDone;
}

Inspection::Stage Inspection::readNodes() {
  out_.isReadable = isReadable(mesh_);
  if (!out_.isReadable) return Stage::kDone;
  mesh_.regions.resize(countTetrahedra(mesh_), 0);
  numberRegions();
  out_.tetrahedra = static_cast<std::uint32_t>(countTetrahedra(mesh_));
  countUsedNodes(mesh_, out_);
  out_.shortestEdge = std::numeric_limits<double>::infinity();  // until the first edge
  return Stage::kElements;
}

/// Regions may have any tag, and statistics are stored by index.
void Inspection::numberRegions() {
  for (const std::uint32_t region : mesh_.regions) {
    if (regionIds_.empty() || regionIds_.back() != region) regionIds_.push_back(region);
  }
  stableSort(regionIds_);
  regionIds_.erase(std::unique(regionIds_.begin(), regionIds_.end()), regionIds_.end());
  for (std::uint32_t& region : mesh_.regions) {
    const auto found = std::lower_bound(regionIds_.begin(), regionIds_.end(), region);
    region = static_cast<std::uint32_t>(found - regionIds_.begin());
  }
}

bool Inspection::measureElements(std::uint32_t budget) {
  const std::uint32_t last =
      nextElement_.value + std::min(out_.tetrahedra - nextElement_.value, budget);
  for (; nextElement_.value < last; ++nextElement_.value) {
    orientElement(mesh_, nextElement_, out_);
    measureEdges(nextElement_);
  }
  if (nextElement_.value < out_.tetrahedra) return false;
  out_.meanEdge = edgeSum_ / (6.0 * out_.tetrahedra);
  return true;
}

void Inspection::measureEdges(TetId element) {
  const std::array<Vec3, 4> corners = cornersOf(mesh_, element);
  for (const TetEdge& edge : kTetEdges) {
    const double length = glm::length(corners[edge.to] - corners[edge.from]);
    out_.shortestEdge = std::min(out_.shortestEdge, length);
    out_.longestEdge = std::max(out_.longestEdge, length);
    edgeSum_ += length;
  }
}

void Inspection::takeBoundary() {
  out_.boundary = boundary_->take();
  const std::vector<std::uint32_t> interfaces = boundary_->takeInterfaces();
  boundary_.reset();
  withInterfaces_.triangles = out_.boundary.triangles;
  withInterfaces_.triangles.insert(withInterfaces_.triangles.end(), interfaces.begin(),
                                   interfaces.end());
  surface_ = out_.boundary;
  surface_.points = mesh_.points;
  for (std::uint32_t& region : out_.boundary.trianglePatch) region = regionIds_[region];
  verifier_.emplace(mesh_, surface_);
  stage_ = Stage::kVerify;
}

void Inspection::takeDefects() {
  const MeshDefects& defects = verifier_->defects();
  out_.duplicateTetrahedra = narrowed(defects.duplicateTetrahedra);
  out_.nonManifoldFaces = narrowed(defects.nonManifoldFaces);
  out_.overlappingFaces = narrowed(defects.overlappingFaces);
  out_.coincidentNodes = narrowed(defects.coincidentNodes);
  verifier_.reset();
  surface_ = {};
}

void Inspection::beginAnalysis() {
  if (!(out_.meanEdge > 0.0)) {
    stage_ = Stage::kDone;
    return;
  }
  field_ = SizeField::uniform(out_.meanEdge);
  analysis_.emplace(mesh_, withInterfaces_, *field_);
  stage_ = Stage::kAnalyse;
}

}  // namespace

MeshInspector::MeshInspector(std::span<const double> points,
                             std::span<const std::uint32_t> tetrahedra,
                             std::span<const std::uint32_t> regions)
    : SlicedTool(std::make_unique<Inspection>(points, tetrahedra, regions)) {}

MeshInspection inspectMesh(std::span<const double> points,
                           std::span<const std::uint32_t> tetrahedra,
                           std::span<const std::uint32_t> regions) {
  constexpr std::uint32_t kSlice = 1U << 16U;
  MeshInspector inspector(points, tetrahedra, regions);
  while (!inspector.advance(kSlice)) {
  }
  return inspector.result();
}

}  // namespace tetrafront
