#include "quality/mesh_boundary.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "base/sort.h"
#include "geom/tetrahedron.h"

namespace tetrafront {
namespace {

/// The faces of a b c d (mesh.h) by index.
using Nodes = std::array<std::uint32_t, 3>;

Nodes faceOf(const VolumeMesh& mesh, std::size_t owner) {
  Nodes nodes{};
  for (std::size_t k = 0; k < 3; ++k)
    nodes[k] = mesh.tetrahedra[owner / 4 * 4 + kFaceCorners[owner % 4][k]];
  return nodes;
}

Nodes sortedFaceOf(const VolumeMesh& mesh, std::size_t owner) {
  auto [a, b, c] = faceOf(mesh, owner);
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

}  // namespace

BoundaryFinder::BoundaryFinder(const VolumeMesh& mesh)
    : mesh_(&mesh),
      begins_(mesh.points.size() / 3 + 1, 0),
      partOf_(mesh.tetrahedra.size(), Part::kNone) {}

bool BoundaryFinder::advance(std::uint32_t budget) {
  const std::size_t nodes = mesh_->points.size() / 3;
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
    case Stage::kPlace:
      place(next_, last);
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
  if (last == end) goOn(static_cast<Stage>(static_cast<std::uint8_t>(stage_) + 1));
  return stage_ == Stage::kDone;
}

void BoundaryFinder::goOn(Stage stage) {
  stage_ = stage;
  next_ = 0;
  if (stage == Stage::kPlace) {
    std::uint32_t begin = 0;
    for (std::uint32_t& bucket : begins_) begin += std::exchange(bucket, begin);
    faces_.resize(mesh_->tetrahedra.size());
  }
  if (stage == Stage::kMatch) {
    // The insertion slot of each bucket is now its end, where the next bucket begins.
    std::move_backward(begins_.begin(), begins_.end() - 1, begins_.end());
    begins_.front() = 0;
  }
}

void BoundaryFinder::count(std::size_t first, std::size_t last) {
  for (std::size_t owner = first; owner < last; ++owner) ++begins_[sortedFaceOf(*mesh_, owner)[0]];
}

void BoundaryFinder::place(std::size_t first, std::size_t last) {
  for (std::size_t owner = first; owner < last; ++owner) {
    const Nodes nodes = sortedFaceOf(*mesh_, owner);
    faces_[begins_[nodes[0]]++] = {nodes[1], nodes[2], static_cast<std::uint32_t>(owner)};
  }
}

void BoundaryFinder::match(std::size_t firstNode, std::size_t lastNode) {
  const auto isSame = [](const Face& a, const Face& b) {
    return a.middle == b.middle && a.highest == b.highest;
  };
  for (std::size_t node = firstNode; node < lastNode; ++node) {
    Face* const begin = faces_.data() + begins_[node];
    Face* const end = faces_.data() + begins_[node + 1];
    sortFew(std::span(begin, end), [](const Face& a, const Face& b) {
      return std::tie(a.middle, a.highest, a.owner) < std::tie(b.middle, b.highest, b.owner);
    });
    for (const Face* face = begin; face != end; ++face) {
      if (face != begin && isSame(face[-1], face[0])) continue;
      if (face + 1 == end || !isSame(face[0], face[1])) {
        partOf_[face->owner] = Part::kBoundary;
      } else if (regionOf(face[0].owner) != regionOf(face[1].owner)) {
        partOf_[face->owner] = Part::kWall;
      }
    }
  }
}

void BoundaryFinder::collect(std::size_t first, std::size_t last) {
  for (std::size_t owner = first; owner < last; ++owner) {
    if (partOf_[owner] == Part::kNone) continue;
    const bool isInterface = partOf_[owner] == Part::kWall;
    const Nodes nodes = faceOf(*mesh_, owner);
    std::vector<std::uint32_t>& triangles = isInterface ? walls_ : boundary_.triangles;
    triangles.insert(triangles.end(), nodes.begin(), nodes.end());
    if (!isInterface) boundary_.trianglePatch.push_back(regionOf(owner));
  }
}

std::uint32_t BoundaryFinder::regionOf(std::size_t owner) const {
  return mesh_->regions.empty() ? 0 : mesh_->regions[owner / 4];
}

}  // namespace tetrafront
