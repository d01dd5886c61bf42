#include "quality/mesh_boundary.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "base/mesh_access.h"
#include "base/sort.h"
#include "geom/tetrahedron.h"

namespace tetrafront {
namespace {

/// Returns the nodes counter-clockwise as seen from outside the element (mesh.h).
NodeTriple nodesOf(const VolumeMesh& mesh, ElementFace face) {
  const NodeQuad nodes = nodesOf(mesh, face.tet());
  const auto& [a, b, c] = kFaceCorners[face.corner()];
  return {nodes[a], nodes[b], nodes[c]};
}

/// Returns the face with an index below four times the number of elements.
ElementFace faceAt(std::size_t index) { return {TetId(index / 4), index % 4}; }

NodeTriple sortedNodesOf(const VolumeMesh& mesh, ElementFace face) {
  auto [a, b, c] = nodesOf(mesh, face);
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

}  // namespace

BoundaryFinder::BoundaryFinder(const VolumeMesh& mesh)
    : mesh_(&mesh),
      begins_(countNodes(mesh) + 1, 0),
      partOf_(mesh.tetrahedra.size(), Part::kNone) {}

bool BoundaryFinder::advance(std::uint32_t budget) {
  const std::size_t nodes = countNodes(*mesh_);
  const std::size_t faces = mesh_->tetrahedra.size();
  const std::size_t end = stage_ == Stage::kMatch ? nodes : faces;
  // Tetrahedra have four faces each. There are fewer nodes, but each is the lowest of many faces.
  const std::size_t share =
      stage_ == Stage::kMatch ? budget / 4 : 4 * std::min<std::size_t>(budget, faces / 4);
  const std::size_t last = next_ + std::min(end - next_, std::max(share, std::size_t{1}));
  switch (stage_) {
    case Stage::kCount:
      count(next_, last);
      break;
    case Stage::kInsert:
      insert(next_, last);
      break;
    case Stage::kMatch:
      match(next_, last);
      break;
    case Stage::kCollect:
      collect(next_, last);
      break;
    case Stage::kDone:
      return true;
  }
  next_ = last;
  if (last == end) begin(static_cast<Stage>(static_cast<std::uint8_t>(stage_) + 1));
  return stage_ == Stage::kDone;
}

void BoundaryFinder::begin(Stage stage) {
  stage_ = stage;
  next_ = 0;
  if (stage == Stage::kInsert) {
    std::uint32_t sum = 0;
    for (std::uint32_t& bucket : begins_) sum += std::exchange(bucket, sum);
    faces_.resize(mesh_->tetrahedra.size());
  }
  if (stage == Stage::kMatch) {
    // The insertion slot of each bucket is now its end, where the next bucket begins.
    std::move_backward(begins_.begin(), begins_.end() - 1, begins_.end());
    begins_.front() = 0;
  }
}

void BoundaryFinder::count(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    ++begins_[sortedNodesOf(*mesh_, faceAt(i))[0].index()];
  }
}

void BoundaryFinder::insert(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const auto [lowest, middle, highest] = sortedNodesOf(*mesh_, faceAt(i));
    faces_[begins_[lowest.index()]++] = {middle, highest, faceAt(i)};
  }
}

void BoundaryFinder::match(std::size_t firstNode, std::size_t lastNode) {
  const auto isSame = [](const Face& a, const Face& b) {
    return a.middle == b.middle && a.highest == b.highest;
  };
  for (std::size_t node = firstNode; node < lastNode; ++node) {
    const std::span<Face> faces(faces_.data() + begins_[node], faces_.data() + begins_[node + 1]);
    sortFew(faces, [](const Face& a, const Face& b) {
      return std::tie(a.middle, a.highest, a.owner) < std::tie(b.middle, b.highest, b.owner);
    });
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (i > 0 && isSame(faces[i - 1], faces[i])) continue;
      Part& part = partOf_[faces[i].owner.index()];
      if (i + 1 == faces.size() || !isSame(faces[i], faces[i + 1])) {
        part = Part::kBoundary;
      } else if (regionOf(faces[i].owner) != regionOf(faces[i + 1].owner)) {
        part = Part::kInterface;
      }
    }
  }
}

void BoundaryFinder::collect(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    if (partOf_[i] == Part::kNone) continue;
    const bool isInterface = partOf_[i] == Part::kInterface;
    std::vector<std::uint32_t>& triangles = isInterface ? interfaces_ : boundary_.triangles;
    for (const NodeId node : nodesOf(*mesh_, faceAt(i))) triangles.push_back(node.value);
    if (!isInterface) boundary_.trianglePatch.push_back(regionOf(faceAt(i)));
  }
}

std::uint32_t BoundaryFinder::regionOf(ElementFace face) const {
  return mesh_->regions.empty() ? 0 : mesh_->regions[face.tet().index()];
}

}  // namespace tetrafront
