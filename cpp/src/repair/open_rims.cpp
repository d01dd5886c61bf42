#include "repair/open_rims.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base/sort.h"
#include "boundary/corner_fans.h"

namespace tetrafront {
namespace {

/// A fan and the position of an open edge at it.
using End = std::pair<std::uint32_t, std::uint32_t>;

/// Follows open edges from fan to fan: where a surface touches itself in a node, each of its fans
/// has a rim of its own.
class RimWalk {
 public:
  RimWalk(const SurfaceMesh& mesh, const EdgeTable& edges)
      : mesh_(mesh),
        fans_(cornerFans(mesh.triangles, edges)),
        isOnStack_(mesh.points.size() / 3, 0) {
    for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
      const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
      if (halfEdges.size() == 1) open_.push_back(halfEdges[0]);
    }
    for (std::uint32_t i = 0; i < open_.size(); ++i) {
      ends_.push_back({fans_[open_[i]], i});
      ends_.push_back({fans_[nextCorner(open_[i])], i});
    }
    stableSort(ends_);
    isWalked_.assign(open_.size(), 0);
  }

  /// All closed chains, by their first open edges; open ones, which end at crowded edges, are left
  /// out.
  [[nodiscard]] std::vector<Rim> rims() {
    std::vector<Rim> found;
    for (std::uint32_t i = 0; i < open_.size(); ++i) {
      if (isWalked_[i] != 0) continue;
      if (const std::optional<Rim> chain = walkFrom(i)) splitAtRepeats(*chain, found);
    }
    return found;
  }

 private:
  [[nodiscard]] std::optional<Rim> walkFrom(std::uint32_t start) {
    Rim chain;
    std::uint32_t edge = start;
    std::uint32_t fan = fans_[open_[start]];
    do {
      isWalked_[edge] = 1;
      const std::uint32_t from = fans_[open_[edge]];
      const std::uint32_t to = fans_[nextCorner(open_[edge])];
      chain.push_back(mesh_.triangles[fan]);
      fan = from == fan ? to : from;
      const std::optional<std::uint32_t> next = otherAt(fan, edge);
      if (!next) return std::nullopt;
      edge = *next;
    } while (isWalked_[edge] == 0);
    if (edge != start) return std::nullopt;
    return chain;
  }

  /// The other open edge of a fan that has two.
  [[nodiscard]] std::optional<std::uint32_t> otherAt(std::uint32_t fan, std::uint32_t edge) const {
    const auto first = std::lower_bound(ends_.begin(), ends_.end(), End{fan, 0U});
    const auto last =
        std::upper_bound(first, ends_.end(), End{fan, std::numeric_limits<std::uint32_t>::max()});
    if (last - first != 2) return std::nullopt;
    return first->second == edge ? (first + 1)->second : first->second;
  }

  /// A chain that comes by a node twice is that of two holes which touch there.
  void splitAtRepeats(const Rim& chain, std::vector<Rim>& out) {
    Rim stack;
    for (const std::uint32_t node : chain) {
      if (isOnStack_[node] != 0) {
        const auto before = std::ranges::find(stack.rbegin(), stack.rend(), node).base() - 1;
        out.emplace_back(before, stack.end());
        for (const std::uint32_t popped : out.back()) isOnStack_[popped] = 0;
        stack.erase(before, stack.end());
      }
      isOnStack_[node] = 1;
      stack.push_back(node);
    }
    for (const std::uint32_t node : stack) isOnStack_[node] = 0;
    out.push_back(std::move(stack));
  }

  const SurfaceMesh& mesh_;
  std::vector<std::uint32_t> fans_;
  std::vector<std::uint32_t> open_;  ///< half-edges
  std::vector<End> ends_;            ///< positions in open_, sorted
  std::vector<std::uint8_t> isWalked_;
  std::vector<std::uint8_t> isOnStack_;  ///< per node, while a chain is split
};

}  // namespace

std::vector<Rim> openRims(const SurfaceMesh& mesh, const EdgeTable& edges) {
  return RimWalk(mesh, edges).rims();
}

}  // namespace tetrafront
