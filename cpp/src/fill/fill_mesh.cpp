#include "fill/fill_mesh.h"

#include <algorithm>

#include "base/sort.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
void FillMesh::begin(const NodeQuad& nodes) {
  FillTet first;
  first.nodes = nodes;
  tets_.assign(1, first);
  stamps_.assign(1, 0);
  tetAt_.assign(points.size(), TetId());
  for (const NodeId node : nodes) tetAt_[node.index()] = TetId(0U);
}

NodeTriple FillMesh::innerFace(TetId tet, std::uint32_t corner) const {
  const NodeQuad& n = tets_[tet.index()].nodes;
  const auto& [a, b, c] = kFaceCorners[corner];
  return {n[a], n[c], n[b]};
}

std::uint32_t FillMesh::cornerOf(TetId tet, NodeId node) const {
  const NodeQuad& n = tets_[tet.index()].nodes;
  return static_cast<std::uint32_t>(std::find(n.begin(), n.end(), node) - n.begin());
}

void FillMesh::spread(TetId seed, const std::array<NodeId, 2>& nodes, std::vector<TetId>& result) {
  result.clear();
  if (seed.isNone()) return;
  const std::uint32_t mark = nextStamp();
  result.push_back(seed);
  stamp(seed, mark);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const FillTet& t = tets_[result[i].index()];
    for (std::uint32_t k = 0; k < 4; ++k) {
      const TetId next = t.across[k].tet;
      if (next.isNone() || t.nodes[k] == nodes[0] || t.nodes[k] == nodes[1]) continue;
      if (hasStamp(next, mark)) continue;
      stamp(next, mark);
      result.push_back(next);
    }
  }
}

void FillMesh::markFacet(TetId tet, std::uint32_t corner, FacetId facet) {
  FillTet& t = tets_[tet.index()];
  t.facet[corner] = facet;
  const TetFace beyond = t.across[corner];
  if (!beyond.isNone()) tets_[beyond.tet.index()].facet[beyond.corner] = facet;
}

void FillMesh::collectOuterFaces(std::span<const TetId> old, NodeId lost) {
  const std::uint32_t mark = nextStamp();
  for (const TetId t : old) stamp(t, mark);
  for (const TetId id : old) {
    const FillTet& t = tets_[id.index()];
    for (std::uint32_t k = 0; k < 4; ++k) {
      const TetFace beyond = t.across[k];
      if (!beyond.isNone() && hasStamp(beyond.tet, mark)) continue;
      const NodeTriple nodes = innerFace(id, k);
      if (beyond.isNone() && contains(nodes, lost)) continue;
      slots_.push_back({sorted(nodes), {}, beyond, t.facet[k]});
    }
  }
}

void FillMesh::collectFreshFaces(std::span<const NodeQuad> fresh) {
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const auto& [a, b, c] = kFaceCorners[k];
      slots_.push_back(
          {sorted(std::array{fresh[i][a], fresh[i][b], fresh[i][c]}), {TetId(i), k}, {}, {}});
    }
  }
}

/// Each face must occur exactly twice, at least once in a fresh tetrahedron.
bool FillMesh::facesPair() const {
  if (slots_.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < slots_.size(); i += 2) {
    if (slots_[i].key != slots_[i + 1].key) return false;
    if (i > 0 && slots_[i].key == slots_[i - 1].key) return false;
    if (slots_[i].face.isNone() && slots_[i + 1].face.isNone()) return false;
  }
  return true;
}

TetId FillMesh::takeSlot() {
  if (!freeSlots_.empty()) {
    const TetId slot = freeSlots_.back();
    freeSlots_.pop_back();
    return slot;
  }
  tets_.emplace_back();
  stamps_.push_back(0);
  return TetId(tets_.size() - 1);
}

bool FillMesh::replace(std::span<const TetId> old, std::span<const NodeQuad> fresh, NodeId lost,
                       std::span<const BoundaryFace> boundary) {
  slots_.clear();
  collectOuterFaces(old, lost);
  for (const BoundaryFace& f : boundary) slots_.push_back({sorted(f.nodes), {}, {}, f.facet});
  collectFreshFaces(fresh);
  stableSort(slots_, [](const FaceSlot& p, const FaceSlot& q) {
    if (p.key != q.key) return p.key < q.key;
    return p.face.tet < q.face.tet;
  });
  if (!facesPair()) return false;
  for (const TetId t : old) {
    for (const NodeId node : tets_[t.index()].nodes) tetAt_[node.index()] = TetId();
    tets_[t.index()] = FillTet{};
    freeSlots_.push_back(t);
  }
  tetAt_.resize(points.size());
  freshIds_.clear();
  for (const NodeQuad& nodes : fresh) {
    const TetId id = takeSlot();
    freshIds_.push_back(id);
    tets_[id.index()].nodes = nodes;
    for (const NodeId node : nodes) tetAt_[node.index()] = id;
  }
  for (std::size_t i = 0; i < slots_.size(); i += 2) {
    // The face of a fresh tetrahedron sorts before an outer one, whose tetrahedron is none.
    const FaceSlot& one = slots_[i];
    const FaceSlot& two = slots_[i + 1];
    const TetFace face{freshIds_[one.face.tet.index()], one.face.corner};
    const TetFace other =
        two.face.isNone() ? two.outside : TetFace{freshIds_[two.face.tet.index()], two.face.corner};
    tets_[face.tet.index()].across[face.corner] = other;
    tets_[face.tet.index()].facet[face.corner] = two.facet;
    if (!other.isNone()) tets_[other.tet.index()].across[other.corner] = face;
  }
  return true;
}

void FillMesh::keep(const std::vector<std::uint8_t>& kept) {
  for (std::size_t i = 0; i < tets_.size(); ++i) {
    if (!isLive(TetId(i))) continue;
    if (kept[i] == 0) continue;
    for (TetFace& beyond : tets_[i].across) {
      if (!beyond.isNone() && kept[beyond.tet.index()] == 0) beyond = {};
    }
  }
  std::fill(tetAt_.begin(), tetAt_.end(), TetId());
  for (std::size_t i = 0; i < tets_.size(); ++i) {
    if (!isLive(TetId(i))) continue;
    if (kept[i] == 0) {
      tets_[i] = FillTet{};
      freeSlots_.emplace_back(i);
      continue;
    }
    for (const NodeId node : tets_[i].nodes) tetAt_[node.index()] = TetId(i);
  }
}

std::vector<NodeId> FillMesh::neighboursIn(std::span<const TetId> star, NodeId node) const {
  std::vector<NodeId> neighbours;
  for (const TetId t : star) {
    for (const NodeId other : tets_[t.index()].nodes) {
      if (other != node) neighbours.push_back(other);
    }
  }
  sortUnique(neighbours);
  return neighbours;
}

void FillMesh::separate(std::span<const TetId> sector, NodeId node, NodeId own) {
  tetAt_.resize(points.size());
  for (const TetId t : sector) {
    tets_[t.index()].nodes[cornerOf(t, node)] = own;
    tetAt_[own.index()] = t;
  }
}

}  // namespace tetrafront
