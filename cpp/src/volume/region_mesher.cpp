#include "volume/region_mesher.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

#include "base/sort.h"
#include "volume/stall_diagnostic.h"

namespace tetrafront {
namespace {

/// Returns the pairs of regions with a common interface, the higher region first, ascending and
/// unique.
std::vector<std::array<std::uint32_t, 2>> interfaceNeighbours(const SurfaceMesh& boundary) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t t = 0; t < boundary.triangles.size() / 3; ++t) {
    if (!boundary.isInterface(t)) continue;
    const auto [low, high] =
        std::minmax(boundary.triangleRegions[2 * t], boundary.triangleRegions[2 * t + 1]);
    pairs.push_back({high, low});
  }
  sortUnique(pairs);
  return pairs;
}

std::uint32_t regionCount(const SurfaceMesh& boundary) {
  std::uint32_t count = 1;
  for (const std::uint32_t region : boundary.triangleRegions) {
    if (region != SurfaceMesh::kNoRegion) count = std::max(count, region + 1);
  }
  return count;
}

/// Gives each region, in order, the first pass that none of its neighbours has. Two or three passes
/// nearly always suffice.
std::vector<std::uint32_t> assignPasses(const SurfaceMesh& boundary) {
  std::vector<std::uint32_t> passOf(regionCount(boundary), 0);
  const auto pairs = interfaceNeighbours(boundary);
  std::vector<std::uint32_t> taken;
  for (std::size_t i = 0, j = 0; i < pairs.size(); i = j) {
    taken.clear();
    for (; j < pairs.size() && pairs[j][0] == pairs[i][0]; ++j)
      taken.push_back(passOf[pairs[j][1]]);
    std::uint32_t pass = 0;
    while (std::ranges::find(taken, pass) != taken.end()) ++pass;
    passOf[pairs[i][0]] = pass;
  }
  return passOf;
}

/// Appends the mesh of one pass, which has the same boundary nodes.
void append(VolumeMesh& mesh, VolumeMesh part, std::size_t boundaryNodes) {
  if (mesh.points.empty()) {
    mesh = std::move(part);
    return;
  }
  const auto newNodes = static_cast<std::uint32_t>(mesh.points.size() / 3 - boundaryNodes);
  const auto indexOf = [&](std::uint32_t node) {
    return node < boundaryNodes ? node : node + newNodes;
  };
  mesh.points.insert(mesh.points.end(),
                     part.points.begin() + static_cast<std::ptrdiff_t>(3 * boundaryNodes),
                     part.points.end());
  mesh.regions.insert(mesh.regions.end(), part.regions.begin(), part.regions.end());
  std::ranges::transform(part.tetrahedra, std::back_inserter(mesh.tetrahedra), indexOf);
  std::ranges::transform(part.front, std::back_inserter(mesh.front), indexOf);
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

}  // namespace

template <class Trace>
BasicRegionMesher<Trace>::BasicRegionMesher(const SurfaceMesh& boundary, const SizeField& field,
                                            const MeshOptions& options, Trace trace)
    : boundary_(boundary),
      field_(field),
      options_(options),
      passOf_(assignPasses(boundary)),
      trace_(trace) {
  passCount_ = *std::ranges::max_element(passOf_) + 1;
  begin(0);
}

template <class Trace>
void BasicRegionMesher<Trace>::begin(std::uint32_t pass) {
  pass_ = pass;
  MeshOptions options = options_;
  options.maxTetrahedra -=
      std::min(options.maxTetrahedra, static_cast<std::uint32_t>(filled_.tetrahedra.size() / 4));
  current_.reset();
  if (passCount_ > 1) passBoundary_ = boundaryOf(pass);
  waitingFaces_ = 0;
  for (const std::uint32_t region : boundary_.triangleRegions) {
    waitingFaces_ += region != SurfaceMesh::kNoRegion && passOf_[region] > pass ? 1 : 0;
  }
  current_.emplace(passCount_ > 1 ? passBoundary_.surface : boundary_, field_, options);
  current_->trace() = trace_;
}

template <class Trace>
typename BasicRegionMesher<Trace>::PassBoundary BasicRegionMesher<Trace>::boundaryOf(
    std::uint32_t pass) const {
  PassBoundary result;
  result.surface.points = boundary_.points;
  for (std::uint32_t t = 0; t < boundary_.triangles.size() / 3; ++t) {
    const std::uint32_t* nodes = &boundary_.triangles[3 * std::size_t{t}];
    for (std::size_t half = 0; half < 2; ++half) {
      const std::uint32_t region = boundary_.triangleRegions[2 * std::size_t{t} + half];
      if (region == SurfaceMesh::kNoRegion || passOf_[region] != pass) continue;
      result.surface.triangles.insert(result.surface.triangles.end(),
                                      {nodes[0], nodes[1 + half], nodes[2 - half]});
      result.surface.triangleRegions.insert(result.surface.triangleRegions.end(),
                                            {region, SurfaceMesh::kNoRegion});
      result.triangleOf.push_back(t);
    }
  }
  return result;
}

template <class Trace>
MeshStatus BasicRegionMesher<Trace>::advance(std::uint32_t budget) {
  const MeshStatus status = current_->advance(budget);
  if (status != MeshStatus::kDone || pass_ + 1 == passCount_) return status;
  append(filled_, current_->mesh(), boundary_.points.size() / 3);
  recovery_ = sum(recovery_, current_->recovery());
  counters_ = sum(counters_, current_->counters());
  openShareBefore_ += std::min(current_->openShare(), 1.0);
  begin(pass_ + 1);
  return MeshStatus::kRunning;
}

/// Triangles of a pass become triangles of the whole boundary, or in a drawn model their patches.
template <class Trace>
void BasicRegionMesher<Trace>::nameForUser(std::vector<Entity>& entities) const {
  const bool isDrawn = !boundary_.sides.empty();
  for (Entity& entity : entities) {
    if (entity.kind != EntityKind::kTriangle) continue;
    if (passCount_ > 1) entity.index = passBoundary_.triangleOf[entity.index];
    if (isDrawn) entity = {EntityKind::kPatch, boundary_.trianglePatch[entity.index]};
  }
  const auto isRepeated = [](const Entity& a, const Entity& b) {
    return a.kind == b.kind && a.index == b.index;
  };
  entities.erase(std::ranges::unique(entities, isRepeated).begin(), entities.end());
}

template <class Trace>
std::vector<Diagnostic> BasicRegionMesher<Trace>::diagnostics() const {
  std::vector<Diagnostic> diagnostics = current_->diagnostics();
  const std::size_t filledBefore = filled_.tetrahedra.size() / 4;
  for (Diagnostic& diagnostic : diagnostics) {
    nameForUser(diagnostic.entities);
    if (diagnostic.code != DiagnosticCode::kTooManyElements) continue;
    for (double& count : diagnostic.values) count += static_cast<double>(filledBefore);
  }
  return diagnostics;
}

template <class Trace>
std::uint32_t BasicRegionMesher<Trace>::nodeCount() const {
  if (filled_.points.empty()) return current_->nodeCount();
  return current_->nodeCount() +
         static_cast<std::uint32_t>((filled_.points.size() - boundary_.points.size()) / 3);
}

template <class Trace>
std::uint32_t BasicRegionMesher<Trace>::tetrahedronCount() const {
  return current_->tetrahedronCount() + static_cast<std::uint32_t>(filled_.tetrahedra.size() / 4);
}

template <class Trace>
double BasicRegionMesher<Trace>::sectionFraction() const {
  return current_->isRecovering() ? current_->recoveryFraction() : current_->frontFraction();
}

template <class Trace>
double BasicRegionMesher<Trace>::openShare() const {
  return (openShareBefore_ + std::min(current_->openShare(), 1.0)) / passCount_;
}

/// Returns the triangles of regions of later passes, as a front sees them.
template <class Trace>
std::vector<std::uint32_t> BasicRegionMesher<Trace>::facesOfLaterPasses() const {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t pass = pass_ + 1; pass < passCount_; ++pass) {
    const SurfaceMesh surface = boundaryOf(pass).surface;
    for (std::size_t t = 0; t < surface.triangles.size() / 3; ++t) {
      for (const NodeId node : frontFaceOf(surface, t)) faces.push_back(node.value);
    }
  }
  return faces;
}

template <class Trace>
VolumeMesh BasicRegionMesher<Trace>::mesh() const {
  return completed(filled_);
}

template <class Trace>
VolumeMesh BasicRegionMesher<Trace>::take() {
  return completed(std::exchange(filled_, {}));
}

/// Appends the elements of this pass, and the faces of later ones to the front.
template <class Trace>
VolumeMesh BasicRegionMesher<Trace>::completed(VolumeMesh mesh) const {
  append(mesh, current_->mesh(), boundary_.points.size() / 3);
  const std::vector<std::uint32_t> waiting = facesOfLaterPasses();
  mesh.front.insert(mesh.front.end(), waiting.begin(), waiting.end());
  return mesh;
}

template <class Trace>
std::vector<double> BasicRegionMesher<Trace>::frontCorners() const {
  std::vector<double> corners;
  corners.reserve(9 * std::size_t{frontFaceCount()});
  current_->appendFront(corners);
  for (const std::uint32_t node : facesOfLaterPasses()) {
    const auto first = boundary_.points.begin() + 3 * static_cast<std::ptrdiff_t>(node);
    corners.insert(corners.end(), first, first + 3);
  }
  return corners;
}

template <class Trace>
RecoverySummary BasicRegionMesher<Trace>::recovery() const {
  return sum(recovery_, current_->recovery());
}

template <class Trace>
FrontCounters BasicRegionMesher<Trace>::counters() const {
  return sum(counters_, current_->counters());
}

template class BasicRegionMesher<NullTrace>;
template class BasicRegionMesher<RecordingTrace>;

std::unique_ptr<VolumeStage> makeStage(const SurfaceMesh& boundary, const SizeField& field,
                                       const MeshOptions& options, StepRecorder& /*recorder*/,
                                       const FrontExperiment& /*experiment*/) {
  return std::make_unique<RegionMesher>(boundary, field, options);
}

}  // namespace tetrafront
