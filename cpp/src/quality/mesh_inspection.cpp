#include "tetrafront/mesh_inspection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/sort.h"
#include "field/size_field.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "quality/verify_mesh.h"
#include "quality/mesh_boundary.h"
#include "quality/quality_analysis.h"

namespace tetrafront {
namespace {

Vec3 pointOf(const VolumeMesh& mesh, std::uint32_t node) {
  const std::size_t i = 3 * std::size_t{node};
  return {mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
}

std::array<Vec3, 4> cornersOf(const VolumeMesh& mesh, std::size_t element) {
  const std::uint32_t* nodes = &mesh.tetrahedra[4 * element];
  return {pointOf(mesh, nodes[0]), pointOf(mesh, nodes[1]), pointOf(mesh, nodes[2]),
          pointOf(mesh, nodes[3])};
}

bool isReadable(const VolumeMesh& mesh) {
  const std::size_t nodes = mesh.points.size() / 3;
  const std::size_t elements = mesh.tetrahedra.size() / 4;
  return elements > 0 && mesh.points.size() % 3 == 0 && mesh.tetrahedra.size() % 4 == 0 &&
         (mesh.regions.empty() || mesh.regions.size() == elements) &&
         std::all_of(mesh.points.begin(), mesh.points.end(),
                     [](double x) { return std::fabs(x) <= kLargestCoordinate; }) &&
         std::all_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(),
                     [nodes](std::uint32_t node) { return node < nodes; });
}

void countNodes(const VolumeMesh& mesh, MeshInspection& out) {
  std::vector<std::uint8_t> isUsed(mesh.points.size() / 3, 0);
  for (const std::uint32_t node : mesh.tetrahedra) isUsed[node] = 1;
  const auto used = std::count(isUsed.begin(), isUsed.end(), std::uint8_t{1});
  out.nodes = static_cast<std::uint32_t>(used);
  out.unusedNodes = static_cast<std::uint32_t>(isUsed.size()) - out.nodes;
}

/// Flips inverted elements.
void turnElement(VolumeMesh& mesh, std::size_t element, MeshInspection& out) {
  const auto [a, b, c, d] = cornersOf(mesh, element);
  const int sign = orient3d(a, b, c, d);
  if (sign == 0) ++out.degenerateTetrahedra;
  if (sign >= 0) return;
  ++out.invertedTetrahedra;
  std::swap(mesh.tetrahedra[4 * element + 2], mesh.tetrahedra[4 * element + 3]);
}

std::uint32_t narrowed(std::uint64_t count) {
  constexpr std::uint64_t kMaxCount = 0xffffffffU;
  return static_cast<std::uint32_t>(std::min(count, kMaxCount));
}

}  // namespace

class MeshInspector::Impl {
 public:
  Impl(std::span<const double> points, std::span<const std::uint32_t> tetrahedra,
       std::span<const std::uint32_t> regions) {
    mesh_.points.assign(points.begin(), points.end());
    mesh_.tetrahedra.assign(tetrahedra.begin(), tetrahedra.end());
    mesh_.regions.assign(regions.begin(), regions.end());
  }

  bool advance(std::uint32_t budget);

  [[nodiscard]] double fraction() const {
    const double within = verifier_ ? verifier_->fraction() : 0.0;
    return (static_cast<double>(stage_) + within) / static_cast<double>(Stage::kDone);
  }
  [[nodiscard]] const MeshInspection& result() const { return out_; }

 private:
  enum class Stage : std::uint8_t { kNodes, kElements, kBoundary, kVerify, kSurvey, kDone };

  [[nodiscard]] Stage readNodes();
  void numberRegions();
  /// Returns whether all tetrahedra are done.
  bool measureElements(std::uint32_t budget);
  void measureEdges(std::size_t element);
  void takeBoundary();
  void takeDefects();
  void beginSurvey();

  VolumeMesh mesh_;  ///< its regions are indices in regionIds_
  std::vector<std::uint32_t> regionIds_;
  Stage stage_ = Stage::kNodes;
  std::size_t nextElement_ = 0;
  double edgeSum_ = 0.0;
  std::optional<BoundaryFinder> boundary_;
  SurfaceMesh surface_;    ///< the boundary with its positions
  SurfaceMesh withWalls_;  ///< the boundary and the interfaces
  std::optional<MeshVerifier> verifier_;
  std::optional<SizeField> field_;
  std::optional<QualityAnalysis> survey_;
  MeshInspection out_;
};

bool MeshInspector::Impl::advance(std::uint32_t budget) {
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
      beginSurvey();
      break;
    case Stage::kSurvey:
      if (!survey_->advance(budget)) break;
      out_.quality = survey_->summary();
      out_.statistics = survey_->statistics();
      for (RegionStatistics& own : out_.statistics.regions) own.region = regionIds_[own.region];
      stage_ = Stage::kDone;
      break;
    case Stage::kDone:
      break;
  }
  return stage_ == Stage::kDone;
}

MeshInspector::Impl::Stage MeshInspector::Impl::readNodes() {
  out_.isReadable = isReadable(mesh_);
  if (!out_.isReadable) return Stage::kDone;
  mesh_.regions.resize(mesh_.tetrahedra.size() / 4, 0);
  numberRegions();
  out_.tetrahedra = static_cast<std::uint32_t>(mesh_.tetrahedra.size() / 4);
  countNodes(mesh_, out_);
  return Stage::kElements;
}

/// Regions may have any tag, and statistics are stored by index.
void MeshInspector::Impl::numberRegions() {
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

bool MeshInspector::Impl::measureElements(std::uint32_t budget) {
  const std::size_t last =
      nextElement_ + std::min<std::size_t>(out_.tetrahedra - nextElement_, budget);
  for (; nextElement_ < last; ++nextElement_) {
    turnElement(mesh_, nextElement_, out_);
    measureEdges(nextElement_);
  }
  if (nextElement_ < out_.tetrahedra) return false;
  out_.meanEdge = edgeSum_ / (6.0 * out_.tetrahedra);
  return true;
}

void MeshInspector::Impl::measureEdges(std::size_t element) {
  const std::array<Vec3, 4> p = cornersOf(mesh_, element);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double length = glm::length(p[j] - p[i]);
      edgeSum_ += length;
      const bool isFirst = element == 0 && i == 0 && j == 1;
      out_.shortestEdge = isFirst ? length : std::min(out_.shortestEdge, length);
      out_.longestEdge = std::max(out_.longestEdge, length);
    }
  }
}

void MeshInspector::Impl::takeBoundary() {
  out_.boundary = boundary_->take();
  const std::vector<std::uint32_t> walls = boundary_->takeWalls();
  boundary_.reset();
  withWalls_.triangles = out_.boundary.triangles;
  withWalls_.triangles.insert(withWalls_.triangles.end(), walls.begin(), walls.end());
  surface_ = out_.boundary;
  surface_.points = mesh_.points;
  for (std::uint32_t& region : out_.boundary.trianglePatch) region = regionIds_[region];
  verifier_.emplace(mesh_, surface_);
  stage_ = Stage::kVerify;
}

void MeshInspector::Impl::takeDefects() {
  const MeshDefects& defects = verifier_->defects();
  out_.duplicateTetrahedra = narrowed(defects.duplicateTetrahedra);
  out_.nonManifoldFaces = narrowed(defects.nonManifoldFaces);
  out_.overlappingFaces = narrowed(defects.overlappingFaces);
  out_.coincidentNodes = narrowed(defects.coincidentNodes);
  verifier_.reset();
  surface_ = {};
}

void MeshInspector::Impl::beginSurvey() {
  if (!(out_.meanEdge > 0.0)) {
    stage_ = Stage::kDone;
    return;
  }
  field_ = SizeField::uniform(out_.meanEdge);
  survey_.emplace(mesh_, withWalls_, *field_);
  stage_ = Stage::kSurvey;
}

MeshInspector::MeshInspector(std::span<const double> points,
                             std::span<const std::uint32_t> tetrahedra,
                             std::span<const std::uint32_t> regions)
    : impl_(std::make_unique<Impl>(points, tetrahedra, regions)) {}
MeshInspector::MeshInspector(MeshInspector&&) noexcept = default;
MeshInspector& MeshInspector::operator=(MeshInspector&&) noexcept = default;
MeshInspector::~MeshInspector() = default;

bool MeshInspector::advance(std::uint32_t budget) { return impl_->advance(std::max(budget, 1U)); }
double MeshInspector::fraction() const { return impl_->fraction(); }
const MeshInspection& MeshInspector::result() const { return impl_->result(); }

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
