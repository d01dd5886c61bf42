#include "surface/hole_filling.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "base/sort.h"
#include "geom/predicates.h"
#include "surface/corner_fans.h"
#include "surface/edge_table.h"
#include "surface/surface_access.h"

namespace tetrafront {
namespace {

/// A closed chain of different nodes, in the direction of the half-edge it was begun with.
using Rim = std::vector<std::uint32_t>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edgeBetween(std::uint32_t a, std::uint32_t b) { return std::minmax(a, b); }

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
    const auto first = std::lower_bound(ends_.begin(), ends_.end(), Edge{fan, 0U});
    const auto last =
        std::upper_bound(first, ends_.end(), Edge{fan, std::numeric_limits<std::uint32_t>::max()});
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
  std::vector<Edge> ends_;           ///< fan and position in open_, sorted
  std::vector<std::uint8_t> isWalked_;
  std::vector<std::uint8_t> isOnStack_;  ///< per node, while a chain is split
};

/// The triangulation of least area of one rim.
class LeastArea {
 public:
  template <class Exists>
  LeastArea(const SurfaceMesh& mesh, const Rim& rim, const Exists& edgeExists)
      : rim_(rim), count_(rim.size()), cost_(count_ * count_, 0.0), apex_(count_ * count_, 0) {
    for (std::size_t span = 2; span < count_; ++span) {
      for (std::size_t i = 0; i + span < count_; ++i) {
        const std::size_t j = i + span;
        const bool isRim = span == count_ - 1;
        cost_[at(i, j)] = std::numeric_limits<double>::infinity();
        if (isRim || !edgeExists(rim[i], rim[j])) choose(mesh, i, j);
      }
    }
  }

  [[nodiscard]] bool exists() const {
    return count_ >= 3 && cost_[at(0, count_ - 1)] < std::numeric_limits<double>::infinity();
  }

  /// Calls `use(a, b, c)` for every triangle, turned against the rim's direction.
  template <class Use>
  void forEach(const Use& use) const {
    std::vector<std::pair<std::size_t, std::size_t>> spans{{0, count_ - 1}};
    while (!spans.empty()) {
      const auto [i, j] = spans.back();
      spans.pop_back();
      if (j - i < 2) continue;
      const std::size_t k = apex_[at(i, j)];
      use(rim_[j], rim_[k], rim_[i]);
      spans.emplace_back(k, j);
      spans.emplace_back(i, k);
    }
  }

 private:
  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return i * count_ + j; }

  void choose(const SurfaceMesh& mesh, std::size_t i, std::size_t j) {
    const Vec3 a = pointOf(mesh, rim_[i]);
    const Vec3 b = pointOf(mesh, rim_[j]);
    for (std::size_t k = i + 1; k < j; ++k) {
      const double rest = cost_[at(i, k)] + cost_[at(k, j)];
      if (!(rest < cost_[at(i, j)])) continue;
      const Vec3 c = pointOf(mesh, rim_[k]);
      const double cost = rest + glm::length(glm::cross(b - a, c - a));
      if (!(cost < cost_[at(i, j)]) || collinear(a, b, c)) continue;
      cost_[at(i, j)] = cost;
      apex_[at(i, j)] = k;
    }
  }

  const Rim& rim_;
  std::size_t count_;
  std::vector<double> cost_;
  std::vector<std::size_t> apex_;
};

/// The edges of a mesh that grows: those it had, sorted, and those that were added.
class EdgeSet {
 public:
  explicit EdgeSet(const SurfaceMesh& mesh) {
    known_.reserve(mesh.triangles.size());
    for (std::uint32_t h = 0; h < mesh.triangles.size(); ++h) {
      known_.push_back(edgeBetween(mesh.triangles[h], mesh.triangles[nextCorner(h)]));
    }
    stableSort(known_);
  }

  [[nodiscard]] bool holds(std::uint32_t a, std::uint32_t b) const {
    const Edge edge = edgeBetween(a, b);
    return std::binary_search(known_.begin(), known_.end(), edge) || added_.contains(edge);
  }

  void add(std::uint32_t a, std::uint32_t b) {
    if (!holds(a, b)) added_.insert(edgeBetween(a, b));
  }

 private:
  std::vector<Edge> known_;
  std::set<Edge> added_;
};

}  // namespace

class HoleFiller::Impl {
 public:
  Impl(SurfaceMesh& mesh, std::uint32_t mostEdges)
      : mesh_(mesh), mostEdges_(mostEdges), existing_(mesh) {
    const EdgeTable edges(mesh.triangles, mesh.points.size() / 3, {});
    rims_ = RimWalk(mesh, edges).rims();
  }

  bool advance(std::uint32_t budget) {
    for (std::size_t edges = 0; edges < budget && next_ < rims_.size(); ++next_) {
      edges += rims_[next_].size();
      fill(rims_[next_]);
    }
    return next_ == rims_.size();
  }

  [[nodiscard]] const std::vector<FilledHole>& filled() const { return filled_; }

 private:
  void fill(const Rim& rim) {
    if (rim.size() < 3 || rim.size() > mostEdges_) return;
    const LeastArea least(mesh_, rim,
                          [&](std::uint32_t a, std::uint32_t b) { return existing_.holds(a, b); });
    if (!least.exists()) return;
    const auto first = static_cast<std::uint32_t>(mesh_.triangles.size() / 3);
    least.forEach([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
      existing_.add(a, b);
      existing_.add(b, c);
      existing_.add(c, a);
    });
    filled_.push_back({first, static_cast<std::uint32_t>(mesh_.triangles.size() / 3) - first});
  }

  SurfaceMesh& mesh_;
  std::uint32_t mostEdges_;
  EdgeSet existing_;
  std::vector<Rim> rims_;
  std::size_t next_ = 0;
  std::vector<FilledHole> filled_;
};

HoleFiller::HoleFiller(SurfaceMesh& mesh, std::uint32_t mostEdges)
    : impl_(std::make_unique<Impl>(mesh, mostEdges)) {}
HoleFiller::HoleFiller(HoleFiller&&) noexcept = default;
HoleFiller& HoleFiller::operator=(HoleFiller&&) noexcept = default;
HoleFiller::~HoleFiller() = default;

bool HoleFiller::advance(std::uint32_t budget) { return impl_->advance(budget); }
const std::vector<FilledHole>& HoleFiller::filled() const { return impl_->filled(); }

}  // namespace tetrafront
