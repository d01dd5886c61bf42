#include "volume/region_mesher.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

#include "base/sort.h"

namespace tetrafront {
namespace {

/// Regions that have a wall in common, the higher first, ascending and each pair once.
std::vector<std::array<std::uint32_t, 2>> interfaceNeighbours(const SurfaceMesh& boundary) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t t = 0; t < boundary.triangles.size() / 3; ++t) {
    if (!boundary.isWall(t)) continue;
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

/// Each region in order gets the first turn that no neighbour has: nearly always two or three do.
std::vector<std::uint32_t> assignPasses(const SurfaceMesh& boundary) {
  std::vector<std::uint32_t> passOf(regionCount(boundary), 0);
  const auto pairs = interfaceNeighbours(boundary);
  std::vector<std::uint32_t> taken;
  for (std::size_t i = 0, j = 0; i < pairs.size(); i = j) {
    taken.clear();
    for (; j < pairs.size() && pairs[j][0] == pairs[i][0]; ++j)
      taken.push_back(passOf[pairs[j][1]]);
    std::uint32_t turn = 0;
    while (std::ranges::find(taken, turn) != taken.end()) ++turn;
    passOf[pairs[i][0]] = turn;
  }
  return passOf;
}

/// Adds what one turn has made, whose boundary nodes are the same.
void append(VolumeMesh& mesh, VolumeMesh part, std::size_t boundaryNodes) {
  if (mesh.points.empty()) {
    mesh = std::move(part);
    return;
  }
  const auto further = static_cast<std::uint32_t>(mesh.points.size() / 3 - boundaryNodes);
  const auto numberOf = [&](std::uint32_t node) {
    return node < boundaryNodes ? node : node + further;
  };
  mesh.points.insert(mesh.points.end(),
                     part.points.begin() + static_cast<std::ptrdiff_t>(3 * boundaryNodes),
                     part.points.end());
  mesh.regions.insert(mesh.regions.end(), part.regions.begin(), part.regions.end());
  std::ranges::transform(part.tetrahedra, std::back_inserter(mesh.tetrahedra), numberOf);
  std::ranges::transform(part.front, std::back_inserter(mesh.front), numberOf);
}

RecoverySummary sum(const RecoverySummary& a, const RecoverySummary& b) {
  return {a.relaxed + b.relaxed, a.starred + b.starred, a.reopened + b.reopened,
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

RegionMesher::RegionMesher(const SurfaceMesh& boundary, const SizeField& field,
                           const MeshOptions& options)
    : boundary_(boundary), field_(field), options_(options), passOf_(assignPasses(boundary)) {
  passCount_ = *std::ranges::max_element(passOf_) + 1;
  begin(0);
}

void RegionMesher::begin(std::uint32_t turn) {
  pass_ = turn;
  MeshOptions options = options_;
  options.maxTetrahedra -=
      std::min(options.maxTetrahedra, static_cast<std::uint32_t>(filled_.tetrahedra.size() / 4));
  current_.reset();
  if (passCount_ > 1) passBoundary_ = boundaryOf(turn);
  waiting_ = 0;
  for (const std::uint32_t region : boundary_.triangleRegions) {
    waiting_ += region != SurfaceMesh::kNoRegion && passOf_[region] > turn ? 1 : 0;
  }
  current_.emplace(passCount_ > 1 ? passBoundary_ : boundary_, field_, options);
}

/// All nodes, and the triangles around this turn's regions, turned outward.
SurfaceMesh RegionMesher::boundaryOf(std::uint32_t turn) const {
  SurfaceMesh cells;
  cells.points = boundary_.points;
  for (std::size_t t = 0; t < boundary_.triangles.size() / 3; ++t) {
    const std::uint32_t* nodes = &boundary_.triangles[3 * t];
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t region = boundary_.triangleRegions[2 * t + side];
      if (region == SurfaceMesh::kNoRegion || passOf_[region] != turn) continue;
      cells.triangles.insert(cells.triangles.end(), {nodes[0], nodes[1 + side], nodes[2 - side]});
      cells.triangleRegions.insert(cells.triangleRegions.end(), {region, SurfaceMesh::kNoRegion});
    }
  }
  return cells;
}

MeshStatus RegionMesher::advance(std::uint32_t budget) {
  const MeshStatus status = current_->advance(budget);
  if (status != MeshStatus::kDone || pass_ + 1 == passCount_) return status;
  append(filled_, current_->mesh(), boundary_.points.size() / 3);
  recovery_ = sum(recovery_, current_->recovery());
  counters_ = sum(counters_, current_->counters());
  openShareBefore_ += std::min(current_->openShare(), 1.0);
  begin(pass_ + 1);
  return MeshStatus::kRunning;
}

std::vector<Diagnostic> RegionMesher::diagnostics() const {
  std::vector<Diagnostic> diagnostics = current_->diagnostics();
  const std::size_t filledBefore = filled_.tetrahedra.size() / 4;
  for (Diagnostic& one : diagnostics) {
    if (one.code != DiagnosticCode::kTooManyElements) continue;
    for (double& count : one.values) count += static_cast<double>(filledBefore);
  }
  return diagnostics;
}

std::uint32_t RegionMesher::nodeCount() const {
  if (filled_.points.empty()) return current_->nodeCount();
  return current_->nodeCount() +
         static_cast<std::uint32_t>((filled_.points.size() - boundary_.points.size()) / 3);
}

std::uint32_t RegionMesher::tetrahedronCount() const {
  return current_->tetrahedronCount() + static_cast<std::uint32_t>(filled_.tetrahedra.size() / 4);
}

double RegionMesher::sectionFraction() const {
  return current_->isRecovering() ? current_->recoveryFraction() : current_->frontFraction();
}

double RegionMesher::openShare() const {
  return (openShareBefore_ + std::min(current_->openShare(), 1.0)) / passCount_;
}

/// Of the regions whose turn comes later: their triangles as a front sees them.
std::vector<std::uint32_t> RegionMesher::waitingFaces() const {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t turn = pass_ + 1; turn < passCount_; ++turn) {
    const SurfaceMesh cells = boundaryOf(turn);
    for (std::size_t h = 0; h < cells.triangles.size(); h += 3) {
      faces.insert(faces.end(),
                   {cells.triangles[h], cells.triangles[h + 2], cells.triangles[h + 1]});
    }
  }
  return faces;
}

VolumeMesh RegionMesher::mesh() const { return completed(filled_); }

VolumeMesh RegionMesher::take() { return completed(std::exchange(filled_, {})); }

/// With this turn's elements and the faces that wait.
VolumeMesh RegionMesher::completed(VolumeMesh mesh) const {
  append(mesh, current_->mesh(), boundary_.points.size() / 3);
  const std::vector<std::uint32_t> waiting = waitingFaces();
  mesh.front.insert(mesh.front.end(), waiting.begin(), waiting.end());
  return mesh;
}

RecoverySummary RegionMesher::recovery() const { return sum(recovery_, current_->recovery()); }

FrontCounters RegionMesher::counters() const { return sum(counters_, current_->counters()); }

}  // namespace tetrafront
