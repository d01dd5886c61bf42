#include "surface/shared_strips.h"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <utility>

#include "base/sort.h"

namespace tetrafront {

namespace {

using PatchNode = std::pair<PatchId, NodeId>;
using NodePatch = std::pair<NodeId, PatchId>;
using PatchPair = std::pair<PatchId, PatchId>;

/// The second entries of the sorted pairs that begin with `first`.
template <class First, class Second>
auto secondsOf(const std::vector<std::pair<First, Second>>& pairs, First first) {
  const auto [from, to] =
      std::ranges::equal_range(pairs, first, {}, &std::pair<First, Second>::first);
  return std::ranges::subrange(from, to) | std::views::values;
}

/// The nodes on the lines of each patch, and the patches at each of these nodes.
class LineNodeTable {
 public:
  LineNodeTable(const Model& model, const DividedLines& lines) {
    for (std::size_t patch = 0; patch < model.patches.size(); ++patch)
      for (const Loop& loop : model.patches[patch].loops)
        for (const OrientedLine& line : loop)
          for (const NodeId node : lines.nodes[line.line])
            nodesOfPatches_.emplace_back(PatchId(patch), node);
    sortUnique(nodesOfPatches_);
    patchesAtNodes_.reserve(nodesOfPatches_.size());
    for (const auto& [patch, node] : nodesOfPatches_) patchesAtNodes_.emplace_back(node, patch);
    stableSort(patchesAtNodes_);
  }

  /// The other patches that have all nodes of the chord.
  [[nodiscard]] std::vector<PatchId> otherPatchesAt(const Chord& chord) const {
    std::vector<PatchId> found;
    for (const PatchId patch : secondsOf(patchesAtNodes_, chord.nodes[0])) {
      const auto hasNode = [&](NodeId node) {
        return std::ranges::binary_search(nodesOfPatches_, PatchNode(patch, node));
      };
      if (patch != chord.patch && std::ranges::all_of(chord.nodes, hasNode)) found.push_back(patch);
    }
    return found;
  }

  void appendCommonNodes(PatchId patch, PatchId other, std::vector<NodeId>& nodes) const {
    std::ranges::set_intersection(secondsOf(nodesOfPatches_, patch),
                                  secondsOf(nodesOfPatches_, other), std::back_inserter(nodes));
  }

 private:
  std::vector<PatchNode> nodesOfPatches_;
  std::vector<NodePatch> patchesAtNodes_;
};

}  // namespace

void collectChords(PatchId patch, const PlanarMesh& mesh, std::vector<Chord>& chords) {
  const auto nodeOf = [&](PlanarNodeId node) { return mesh.surfaceNodes[node.index()]; };
  for (const PlanarMesh::Triangle& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const PlanarNodeId from = triangle[k];
      const PlanarNodeId to = triangle[(k + 1) % 3];
      // The other triangle visits the edge in the opposite direction.
      if (from > to || !mesh.isChord(from, to)) continue;
      chords.push_back({patch, {nodeOf(from), nodeOf(to), nodeOf(to)}});
    }
  }
  if (mesh.triangles.size() == 1) {
    const auto [a, b, c] = mesh.triangles.front();
    chords.push_back({patch, {nodeOf(a), nodeOf(b), nodeOf(c)}});
  }
}

std::vector<std::vector<NodeId>> findNodesToSeparate(const Model& model, const DividedLines& lines,
                                                     const std::vector<Chord>& chords) {
  std::vector<std::vector<NodeId>> separated(model.patches.size());
  if (chords.empty()) return separated;
  const LineNodeTable table(model, lines);
  std::vector<PatchPair> overlaps;  // the first patch has a chord between nodes of the second
  for (const Chord& chord : chords)
    for (const PatchId other : table.otherPatchesAt(chord))
      overlaps.emplace_back(chord.patch, other);
  sortUnique(overlaps);
  for (const auto& [patch, other] : overlaps) {
    if (model.patches[patch.index()].type == PatchType::kPlanar) continue;
    if (std::ranges::binary_search(overlaps, PatchPair(other, patch)))
      table.appendCommonNodes(patch, other, separated[patch.index()]);
  }
  for (std::vector<NodeId>& nodes : separated) sortUnique(nodes);
  return separated;
}

}  // namespace tetrafront
