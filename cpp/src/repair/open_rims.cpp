#include "repair/open_rims.h"

#include <algorithm>
#include <optional>
#include <span>

#include "base/sort.h"
#include "topology/corner_fans.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Follows open edges from fan to fan: at a node where the surface touches itself, each fan has its own rim.
class RimWalk {
 public:
  RimWalk(const SurfaceMesh& mesh, const EdgeTable& edges)
      : mesh_(mesh), fans_(cornerFans(mesh.triangles, edges)), isOnStack_(countNodes(mesh), 0) {
    for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
      const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
      if (halfEdges.size() == 1) open_.push_back(halfEdges[0]);
    }
    for (std::size_t i = 0; i < open_.size(); ++i) {
      ends_.push_back({firstFanOf(OpenEdgeId(i)), OpenEdgeId(i)});
      ends_.push_back({lastFanOf(OpenEdgeId(i)), OpenEdgeId(i)});
    }
    stableSort(ends_);
    isVisited_.assign(open_.size(), 0);
  }

  [[nodiscard]] std::vector<Rim> rims() {
    std::vector<Rim> found;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (isVisited_[i] != 0) continue;
      if (const std::optional<Rim> chain = walkFrom(OpenEdgeId(i))) splitAtRepeats(*chain, found);
    }
    return found;
  }

 private:
  /// Addresses an entry of open_.
  using OpenEdgeId = Id<struct OpenEdgeTag>;

  /// An end of an open edge.
  struct End {
    HalfEdgeId fan;  ///< lowest corner of the fan there
    OpenEdgeId edge;
    friend auto operator<=>(const End&, const End&) = default;
  };

  [[nodiscard]] HalfEdgeId firstFanOf(OpenEdgeId edge) const {
    return fans_[open_[edge.index()].index()];
  }
  [[nodiscard]] HalfEdgeId lastFanOf(OpenEdgeId edge) const {
    return fans_[nextOf(open_[edge.index()]).index()];
  }

  /// Returns the closed chain that begins with an open edge, or nothing if it ends at a non-manifold edge.
  [[nodiscard]] std::optional<Rim> walkFrom(OpenEdgeId start) {
    Rim chain;
    OpenEdgeId edge = start;
    HalfEdgeId fan = firstFanOf(start);
    do {
      isVisited_[edge.index()] = 1;
      chain.emplace_back(mesh_.triangles[fan.index()]);
      fan = firstFanOf(edge) == fan ? lastFanOf(edge) : firstFanOf(edge);
      const std::optional<OpenEdgeId> next = otherAt(fan, edge);
      if (!next) return std::nullopt;
      edge = *next;
    } while (isVisited_[edge.index()] == 0);
    if (edge != start) return std::nullopt;
    return chain;
  }

  /// Returns the other open edge of a fan that has two.
  [[nodiscard]] std::optional<OpenEdgeId> otherAt(HalfEdgeId fan, OpenEdgeId edge) const {
    const auto ends = std::ranges::equal_range(ends_, fan, {}, &End::fan);
    if (ends.size() != 2) return std::nullopt;
    return ends[0].edge == edge ? ends[1].edge : ends[0].edge;
  }

  /// A chain that visits a node twice belongs to two holes that touch there.
  void splitAtRepeats(const Rim& chain, std::vector<Rim>& out) {
    Rim stack;
    for (const NodeId node : chain) {
      if (isOnStack_[node.index()] != 0) {
        const auto before = std::ranges::find(stack.rbegin(), stack.rend(), node).base() - 1;
        out.emplace_back(before, stack.end());
        for (const NodeId popped : out.back()) isOnStack_[popped.index()] = 0;
        stack.erase(before, stack.end());
      }
      isOnStack_[node.index()] = 1;
      stack.push_back(node);
    }
    for (const NodeId node : stack) isOnStack_[node.index()] = 0;
    out.push_back(std::move(stack));
  }

  const SurfaceMesh& mesh_;
  std::vector<HalfEdgeId> fans_;  ///< per corner
  std::vector<HalfEdgeId> open_;
  std::vector<End> ends_;                ///< sorted
  std::vector<std::uint8_t> isVisited_;  ///< per entry of open_
  std::vector<std::uint8_t> isOnStack_;  ///< per node, while a chain is split
};

}  // namespace

std::vector<Rim> openRims(const SurfaceMesh& mesh, const EdgeTable& edges) {
  return RimWalk(mesh, edges).rims();
}

}  // namespace tetrafront
