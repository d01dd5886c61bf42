#include "surface/shared_strips.h"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <span>
#include <utility>

#include "base/sort.h"

namespace tetrafront {

namespace {

/// Two numbers of which the first is looked up.
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// The second numbers of the pairs that begin with `first`.
auto secondsOf(const std::vector<Pair>& pairs, std::uint32_t first) {
  const auto [from, to] = std::ranges::equal_range(pairs, first, {}, &Pair::first);
  return std::ranges::subrange(from, to) | std::views::values;
}

/// Which patch has which node on its lines, looked up by either.
class JointTable {
 public:
  JointTable(const Model& model, const DividedLines& lines) {
    for (std::uint32_t patch = 0; patch < model.patches.size(); ++patch)
      for (const Loop& loop : model.patches[patch].loops)
        for (const OrientedLine& line : loop)
          for (const std::uint32_t node : lines.nodes[line.line])
            nodesOfPatches_.emplace_back(patch, node);
    sortUnique(nodesOfPatches_);
    patchesAtNodes_.reserve(nodesOfPatches_.size());
    for (const auto& [patch, node] : nodesOfPatches_) patchesAtNodes_.emplace_back(node, patch);
    stableSort(patchesAtNodes_);
  }

  /// The other patches that have all nodes of the joint.
  [[nodiscard]] std::vector<std::uint32_t> othersAt(const Joint& joint) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t patch : secondsOf(patchesAtNodes_, joint.nodes[0])) {
      const auto has = [&](std::uint32_t node) {
        return std::ranges::binary_search(nodesOfPatches_, Pair(patch, node));
      };
      if (patch != joint.patch && std::ranges::all_of(joint.nodes, has)) found.push_back(patch);
    }
    return found;
  }

  void appendCommon(std::uint32_t patch, std::uint32_t other,
                    std::vector<std::uint32_t>& nodes) const {
    std::ranges::set_intersection(secondsOf(nodesOfPatches_, patch),
                                  secondsOf(nodesOfPatches_, other), std::back_inserter(nodes));
  }

 private:
  std::vector<Pair> nodesOfPatches_;  ///< patch, node
  std::vector<Pair> patchesAtNodes_;  ///< node, patch
};

}  // namespace

void collectJoints(std::uint32_t patch, const PlanarMesh& mesh, std::vector<Joint>& joints) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = mesh.triangles[t + k];
      const std::uint32_t to = mesh.triangles[t + (k + 1) % 3];
      // The other triangle has the edge the other way round.
      if (from > to || !mesh.joinsLines(from, to)) continue;
      joints.push_back({patch, {mesh.aliases[from], mesh.aliases[to], mesh.aliases[to]}});
    }
  }
  if (mesh.triangles.size() == 3)
    joints.push_back({patch,
                      {mesh.aliases[mesh.triangles[0]], mesh.aliases[mesh.triangles[1]],
                       mesh.aliases[mesh.triangles[2]]}});
}

std::vector<std::vector<std::uint32_t>> findNodesToPart(const Model& model,
                                                        const DividedLines& lines,
                                                        const std::vector<Joint>& joints) {
  std::vector<std::vector<std::uint32_t>> parted(model.patches.size());
  if (joints.empty()) return parted;
  const JointTable incidence(model, lines);
  std::vector<Pair> meetings;  // the first joins nodes that both have
  for (const Joint& joint : joints)
    for (const std::uint32_t other : incidence.othersAt(joint))
      meetings.emplace_back(joint.patch, other);
  sortUnique(meetings);
  for (const auto& [patch, other] : meetings) {
    if (model.patches[patch].type == PatchType::kPlanar) continue;
    if (std::ranges::binary_search(meetings, Pair(other, patch)))
      incidence.appendCommon(patch, other, parted[patch]);
  }
  for (std::vector<std::uint32_t>& nodes : parted) sortUnique(nodes);
  return parted;
}

}  // namespace tetrafront
