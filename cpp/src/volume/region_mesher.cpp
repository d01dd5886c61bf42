#include "volume/region_mesher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "base/sort.h"
#include "sizing/memory_limit.h"
#include "topology/surface_access.h"
#include "volume/stall_diagnostic.h"

namespace tetrafront {
namespace {

/// Share of the time of lattices in the time of the front beside them.
constexpr double kLatticeShare = 0.1;

/// Returns per region the sides of triangles that face it.
std::vector<std::vector<std::uint32_t>> halvesOfRegions(const SurfaceMesh& boundary) {
  std::vector<std::vector<std::uint32_t>> halves(1);
  for (std::uint32_t half = 0; half < boundary.triangleRegions.size(); ++half) {
    const std::uint32_t region = boundary.triangleRegions[half];
    if (region == SurfaceMesh::kNoRegion) continue;
    if (region >= halves.size()) halves.resize(region + 1);
    halves[region].push_back(half);
  }
  return halves;
}

/// Returns the nodes of a side of a triangle, counter-clockwise as seen from outside the region.
std::array<std::uint32_t, 3> nodesOfHalf(const SurfaceMesh& boundary, std::uint32_t half) {
  const std::uint32_t* nodes = &boundary.triangles[3 * std::size_t{half / 2}];
  const std::size_t isFront = half % 2;
  return {nodes[0], nodes[1 + isFront], nodes[2 - isFront]};
}

RecoverySummary sum(const RecoverySummary& a, const RecoverySummary& b) {
  return {a.relaxed + b.relaxed, a.starred + b.starred, a.remeshed + b.remeshed,
          a.filled + b.filled, a.steinerPoints + b.steinerPoints};
}

FrontCounters sum(const FrontCounters& a, const FrontCounters& b) {
  return {a.pops + b.pops,
          a.gatheredFaces + b.gatheredFaces,
          a.candidatesTried + b.candidatesTried,
          a.facesTested + b.facesTested,
          a.facesAnalysed + b.facesAnalysed,
          a.exactPredicates + b.exactPredicates};
}

/// Adds a lattice to what the front has made beside it: the rim to the elements, for the optimizer, and the core apart.
RegionMesh withLattice(RegionMesh whole, const LatticeInterior& lattice, std::uint32_t region) {
  if (lattice.isEmpty()) return whole;
  TetMesh& mesh = whole.mesh;
  const std::size_t boundary = whole.boundaryNodes;
  // Fixed nodes come first; the front has those of the hull after those of the boundary.
  mesh.points.insert(mesh.points.begin() + static_cast<std::ptrdiff_t>(boundary),
                     lattice.points.begin(), lattice.points.begin() + lattice.fixed);
  const auto inserted = [&](auto& all) {
    for (auto& nodes : all) {
      for (NodeId& node : nodes) {
        if (node.index() >= boundary) node = NodeId(node.value + lattice.fixed);
      }
    }
  };
  inserted(mesh.tetrahedra);
  inserted(mesh.front);

  const std::size_t firstInRim = mesh.points.size();
  mesh.points.insert(mesh.points.end(), lattice.points.begin() + lattice.firstInRim(),
                     lattice.points.end());
  for (NodeQuad nodes : lattice.rim) {
    for (NodeId& node : nodes) {
      node = NodeId(node.value < lattice.firstInRim()
                        ? boundary + node.index()
                        : firstInRim + (node.index() - lattice.firstInRim()));
    }
    mesh.tetrahedra.push_back(nodes);
  }
  mesh.regions.resize(mesh.tetrahedra.size(), region);
  mesh.isFixed = firstFixed(boundary + lattice.fixed, mesh.points.size());

  whole.core = lattice.core;
  whole.coreRegion = region;
  return whole;
}

}  // namespace

RegionMesher::RegionMesher(const SurfaceMesh& boundary, const SizeField& field,
                           const MeshOptions& options, const FrontMaker& maker)
    : boundary_(boundary),
      field_(field),
      options_(options),
      maker_(maker),
      halvesOf_(halvesOfRegions(boundary)) {
  filled_.boundary = pointsOf(boundary);
}

Task<MeshStatus> RegionMesher::run(Work& work, double frontShare) {
  std::size_t all = 0;
  for (const auto& halves : halvesOf_) all += halves.size();
  double shareOfFronts = 0.0;  // of the regions begun, by their triangles
  double openShare = 0.0;      // faces left to recovery, per triangle
  double done = 0.0;
  const auto endOfFronts = [&] {
    return frontShare * shareOfFronts + (1.0 - frontShare) * openShare;
  };
  for (std::uint32_t region = 0; region < halvesOf_.size(); ++region) {
    begin(region);
    // The end of a slice shows that the progress of the exact fill begins again.
    co_await work.yield();
    const double share = static_cast<double>(halvesOf_[region].size()) /
                         static_cast<double>(std::max<std::size_t>(all, 1));
    shareOfFronts += share;
    if (options_.interior == Interior::kLattice && !options_.exactFillOnly) {
      work.beginPart(std::lerp(done, endOfFronts(), kLatticeShare));
      co_await makeLattice(work);
    }
    MeshStatus status = MeshStatus::kStalled;
    while (status == MeshStatus::kStalled) {
      beginFront();
      work.beginPart(endOfFronts());
      const bool isGood = co_await current_->advanceFront(work);
      if (!isGood) co_return current_->status();
      openShare += share * std::min(current_->openShare(), 1.0);
      done = endOfFronts();
      work.beginPart(done);
      const MeshStatus closed = co_await current_->recover(work);
      status = closed;
      // The front may fail at a lattice alone.
      if (lattice_.isEmpty()) break;
      if (status == MeshStatus::kStalled) lattice_ = {};
    }
    if (status != MeshStatus::kDone) co_return status;
    latticeCount_ += static_cast<std::uint32_t>(lattice_.tetrahedronCount());
    if (region + 1 == halvesOf_.size()) co_return status;
    endRegion();
  }
  co_return MeshStatus::kDone;
}

/// Begins with the boundary of a region.
void RegionMesher::begin(std::uint32_t region) {
  region_ = region;
  current_.reset();
  lattice_ = {};
  regionBoundary_ = {};
  if (!isOne()) boundaryOf(region);
}

Task<> RegionMesher::makeLattice(Work& work) {
  LatticeInterior lattice = co_await makeLatticeInterior(work, ownBoundary(), field_, region_);
  lattice_ = std::move(lattice);
}

/// Begins the front of a region, between its boundary and its lattice.
void RegionMesher::beginFront() {
  MeshOptions options = options_;
  const std::size_t others = filled_.tetrahedronCount() + lattice_.tetrahedronCount();
  options.maxTetrahedra -= std::min(options.maxTetrahedra, static_cast<std::uint32_t>(others));
  options.maxTetrahedra =
      std::min(options.maxTetrahedra, frontElementsBeside(kAddressableBytes, others));
  const NodeNames names{isOne() ? std::span<const std::uint32_t>() : regionBoundary_.nodeOf,
                        static_cast<std::uint32_t>(boundaryNodes())};
  current_.reset();
  withHull_ = {};
  if (!lattice_.isEmpty()) addHull();
  current_.emplace(lattice_.isEmpty() ? ownBoundary() : withHull_, field_, options, maker_, names);
}

/// Makes the boundary of the region with the hull of its lattice.
void RegionMesher::addHull() {
  const SurfaceMesh& own = ownBoundary();
  withHull_.points = own.points;
  withHull_.triangles = own.triangles;
  withHull_.triangleRegions = own.triangleRegions;
  const std::uint32_t shift = countNodes(own) - lattice_.firstOnHull();
  for (std::uint32_t node = lattice_.firstOnHull(); node < lattice_.firstInRim(); ++node) {
    const Vec3& p = lattice_.points[node];
    withHull_.points.insert(withHull_.points.end(), {p.x, p.y, p.z});
  }
  for (const NodeTriple& nodes : lattice_.hull) {
    for (const NodeId node : nodes) withHull_.triangles.push_back(node.value + shift);
    withHull_.triangleRegions.insert(withHull_.triangleRegions.end(),
                                     {region_, SurfaceMesh::kNoRegion});
  }
}

/// Returns what the front has made of the region.
RegionMesh RegionMesher::regionOf(TetMesh mesh) const {
  return {.mesh = std::move(mesh),
          .nodeOf = regionBoundary_.nodeOf,
          .boundaryNodes = ownBoundaryNodes(),
          .core = {},
          .coreRegion = 0};
}

void RegionMesher::endRegion() {
  recovery_ = sum(recovery_, current_->recovery());
  counters_ = sum(counters_, current_->counters());
  filled_.regions.push_back(withLattice(regionOf(current_->take()), lattice_, region_));
  lattice_ = {};
}

void RegionMesher::boundaryOf(std::uint32_t region) {
  auto& [surface, nodeOf, triangleOf] = regionBoundary_;
  for (const std::uint32_t half : halvesOf_[region]) {
    const auto nodes = nodesOfHalf(boundary_, half);
    surface.triangles.insert(surface.triangles.end(), nodes.begin(), nodes.end());
    surface.triangleRegions.insert(surface.triangleRegions.end(), {region, SurfaceMesh::kNoRegion});
    triangleOf.push_back(half / 2);
  }
  nodeOf = surface.triangles;
  sortUnique(nodeOf);
  for (const std::uint32_t node : nodeOf) {
    const auto first = boundary_.points.begin() + 3 * static_cast<std::ptrdiff_t>(node);
    surface.points.insert(surface.points.end(), first, first + 3);
  }
  for (std::uint32_t& node : surface.triangles) {
    node = static_cast<std::uint32_t>(std::ranges::lower_bound(nodeOf, node) - nodeOf.begin());
  }
}

/// Triangles and nodes of the region become those of the whole boundary; in a drawn model, triangles become patches.
void RegionMesher::nameForUser(std::vector<Entity>& entities) const {
  const bool isDrawn = !boundary_.sides.empty();
  // The hull of a lattice is not the user's.
  std::erase_if(entities, [this](const Entity& entity) {
    return (entity.kind == EntityKind::kSurfaceNode && entity.index >= ownBoundaryNodes()) ||
           (entity.kind == EntityKind::kTriangle && entity.index >= countTriangles(ownBoundary()));
  });
  for (Entity& entity : entities) {
    if (entity.kind == EntityKind::kSurfaceNode && !isOne()) {
      entity.index = regionBoundary_.nodeOf[entity.index];
    }
    if (entity.kind != EntityKind::kTriangle) continue;
    if (!isOne()) entity.index = regionBoundary_.triangleOf[entity.index];
    if (isDrawn) entity = {EntityKind::kPatch, boundary_.trianglePatch[entity.index]};
  }
  const auto isRepeated = [](const Entity& a, const Entity& b) {
    return a.kind == b.kind && a.index == b.index;
  };
  entities.erase(std::ranges::unique(entities, isRepeated).begin(), entities.end());
}

std::vector<Diagnostic> RegionMesher::diagnostics() const {
  if (!current_) return {};
  std::vector<Diagnostic> diagnostics = current_->diagnostics();
  const std::size_t filledBefore = filled_.tetrahedronCount();
  for (Diagnostic& diagnostic : diagnostics) {
    nameForUser(diagnostic.entities);
    if (diagnostic.code != DiagnosticCode::kTooManyElements) continue;
    for (double& count : diagnostic.values) count += static_cast<double>(filledBefore);
  }
  return diagnostics;
}

std::uint32_t RegionMesher::nodeCount() const {
  const std::size_t known = filled_.nodeCount() + lattice_.nodeCount() - lattice_.onHull;
  if (!current_) return static_cast<std::uint32_t>(known);
  return static_cast<std::uint32_t>(known - ownBoundaryNodes()) + current_->nodeCount();
}

std::uint32_t RegionMesher::tetrahedronCount() const {
  const std::uint32_t own = current_ ? current_->tetrahedronCount() : 0;
  return own + static_cast<std::uint32_t>(filled_.tetrahedronCount() + lattice_.tetrahedronCount());
}

std::uint32_t RegionMesher::frontFaceCount() const {
  std::size_t waiting = 0;
  for (std::size_t region = current_ ? region_ + 1 : region_; region < halvesOf_.size(); ++region) {
    waiting += halvesOf_[region].size();
  }
  return static_cast<std::uint32_t>(waiting) + (current_ ? current_->frontFaceCount() : 0);
}

/// Returns the triangles of regions that have not begun, as a front sees them.
std::vector<NodeTriple> RegionMesher::waitingFaces() const {
  std::vector<NodeTriple> faces;
  for (std::size_t region = current_ ? region_ + 1 : region_; region < halvesOf_.size(); ++region) {
    for (const std::uint32_t half : halvesOf_[region]) {
      const auto [a, b, c] = nodesOfHalf(boundary_, half);
      faces.push_back({NodeId(a), NodeId(c), NodeId(b)});
    }
  }
  return faces;
}

RegionMeshes RegionMesher::meshes() const {
  RegionMeshes meshes = filled_;
  if (current_) {
    meshes.regions.push_back(withLattice(regionOf(current_->mesh()), lattice_, region_));
  }
  meshes.waiting = waitingFaces();
  return meshes;
}

RegionMeshes RegionMesher::take() {
  if (current_) endRegion();
  filled_.waiting = waitingFaces();
  return std::exchange(filled_, {});
}

std::vector<double> RegionMesher::frontCorners() const {
  std::vector<double> corners;
  corners.reserve(9 * std::size_t{frontFaceCount()});
  if (current_) current_->appendFront(corners);
  for (const NodeTriple& face : waitingFaces()) {
    for (const NodeId node : face) {
      const Vec3 p = pointOf(boundary_, node);
      corners.insert(corners.end(), {p.x, p.y, p.z});
    }
  }
  return corners;
}

RecoverySummary RegionMesher::recovery() const {
  return current_ ? sum(recovery_, current_->recovery()) : recovery_;
}

FrontCounters RegionMesher::counters() const {
  return current_ ? sum(counters_, current_->counters()) : counters_;
}

}  // namespace tetrafront
