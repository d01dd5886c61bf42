#include "remesh/given_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "geom/measure.h"
#include "model/edge_curve.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Steps in which an edge is sampled to find the part nearest to a node.
constexpr std::size_t kEdgeSteps = 48;

using NodePair = std::pair<NodeId, NodeId>;

/// Returns the sides between kept and other triangles, each once.
std::vector<NodePair> sidesAround(std::span<const std::uint8_t> isKept, const SurfaceMesh& given) {
  std::map<NodePair, bool> isShared;
  const auto visit = [&](bool kept, const auto& use) {
    for (const TriangleId t : IdRange<TriangleId>(isKept.size())) {
      if ((isKept[t.index()] != 0) != kept) continue;
      const NodeTriple nodes = nodesOf(given, t);
      for (std::size_t k = 0; k < 3; ++k) use(NodePair(std::minmax(nodes[k], nodes[(k + 1) % 3])));
    }
  };
  visit(true, [&](const NodePair& side) { isShared.try_emplace(side, false); });
  visit(false, [&](const NodePair& side) {
    if (const auto entry = isShared.find(side); entry != isShared.end()) entry->second = true;
  });
  std::vector<NodePair> sides;
  for (const auto& [side, shared] : isShared) {
    if (shared) sides.push_back(side);
  }
  return sides;
}

/// An edge with samples, to find the parameters of positions on it.
class EdgeFinder {
 public:
  EdgeFinder(const TrimmedModel& model, const TrimmedEdge& edge, double reach)
      : curve_(model, edge), edge_(&edge), spaceCurve_(&model.curves[*edge.curve]), reach_(reach) {
    for (std::size_t i = 0; i <= kEdgeSteps; ++i)
      samples_.push_back(curve_.position(static_cast<double>(i) / kEdgeSteps));
    low_ = high_ = samples_.front();
    double longest = 0.0;
    for (std::size_t i = 1; i < samples_.size(); ++i) {
      low_ = glm::min(low_, samples_[i]);
      high_ = glm::max(high_, samples_[i]);
      longest = std::max(longest, glm::length(samples_[i] - samples_[i - 1]));
    }
    low_ -= Vec3(longest + reach);
    high_ += Vec3(longest + reach);
  }

  /// Returns the parameter of a position on the edge; none if it is not there.
  [[nodiscard]] std::optional<double> parameterOf(const Vec3& position) const {
    if (glm::any(glm::lessThan(position, low_)) || glm::any(glm::greaterThan(position, high_)))
      return std::nullopt;
    if (glm::length(position - samples_.front()) <= reach_) return 0.0;
    if (glm::length(position - samples_.back()) <= reach_) return 1.0;
    const auto nearest = std::ranges::min_element(
        samples_, {}, [&](const Vec3& sample) { return glm::length(sample - position); });
    const auto step = static_cast<double>(nearest - samples_.begin()) / kEdgeSteps;
    const double own = closestParameterFrom(*spaceCurve_, edge_->first, edge_->last, position,
                                            curve_.parameterAt(step));
    const double t = (own - edge_->first) / (edge_->last - edge_->first);
    if (!(t > 0.0 && t < 1.0) || glm::length(curve_.position(t) - position) > reach_)
      return std::nullopt;
    return t;
  }

  [[nodiscard]] Vec3 position(double t) const { return curve_.position(t); }
  [[nodiscard]] bool isClosed() const { return edge_->start == edge_->end; }

 private:
  EdgeCurve curve_;
  const TrimmedEdge* edge_;
  const SpaceCurve* spaceCurve_;
  double reach_;
  std::vector<Vec3> samples_;
  Vec3 low_{0.0};
  Vec3 high_{0.0};
};

/// A side on an edge, in the direction of the edge.
struct SideOnEdge {
  double from;
  double to;
  NodeId first;
  NodeId last;
};

/// Returns a side where it lies on an edge; none if it does not.
std::optional<SideOnEdge> placedOn(const EdgeFinder& edge, const NodePair& side,
                                   const SurfaceMesh& given) {
  std::optional<double> from = edge.parameterOf(pointOf(given, side.first));
  std::optional<double> to = edge.parameterOf(pointOf(given, side.second));
  if (!from || !to) return std::nullopt;
  // The vertex of a closed edge is at both of its ends.
  if (edge.isClosed() && *from == 0.0 && *to > 0.5) from = 1.0;
  if (edge.isClosed() && *to == 0.0 && *from > 0.5) to = 1.0;
  if (*from == *to) return std::nullopt;
  if (*from < *to) return SideOnEdge{*from, *to, side.first, side.second};
  return SideOnEdge{*to, *from, side.second, side.first};
}

/// Returns the stations of sides on an edge; none if they do not cover the edge.
std::optional<EdgeStations> chained(std::vector<SideOnEdge> sides) {
  std::ranges::sort(sides, {}, &SideOnEdge::from);
  EdgeStations stations{{0.0}, {sides.front().first}};
  for (const SideOnEdge& side : sides) {
    if (side.from != stations.parameters.back() || side.first != stations.nodes.back())
      return std::nullopt;
    stations.parameters.push_back(side.to);
    stations.nodes.push_back(side.last);
  }
  if (stations.parameters.back() != 1.0) return std::nullopt;
  return stations;
}

/// Edges that faces of the model use.
std::vector<std::uint8_t> usedEdges(const TrimmedModel& model) {
  std::vector<std::uint8_t> isUsed(model.edges.size(), 0);
  for (const TrimmedFace& face : model.faces) {
    for (const std::vector<Coedge>& loop : face.loops) {
      for (const Coedge& coedge : loop)
        isUsed[coedge.edge] = model.edges[coedge.edge].curve.has_value() ? 1 : 0;
    }
  }
  return isUsed;
}

/// Divides triangles at the nodes on their sides.
class SideDivider {
 public:
  explicit SideDivider(SurfaceMesh& mesh) : mesh_(&mesh) {}

  void add(NodeId from, NodeId to, std::span<const NodeId> between) {
    if (between.empty()) return;
    between_[{from, to}].assign(between.begin(), between.end());
    between_[{to, from}].assign(between.rbegin(), between.rend());
  }

  /// Appends a triangle in parts. Returns their number.
  std::size_t append(const NodeTriple& triangle) {
    std::vector<NodeTriple> pending{triangle};
    std::size_t count = 0;
    while (!pending.empty()) {
      const NodeTriple next = pending.back();
      pending.pop_back();
      if (divide(next, pending)) continue;
      for (const NodeId node : next) mesh_->triangles.push_back(node.value);
      ++count;
    }
    return count;
  }

 private:
  /// Divides a triangle at the middle one of the nodes on a side. Returns false if there are none.
  bool divide(const NodeTriple& triangle, std::vector<NodeTriple>& parts) {
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId from = triangle[k];
      const NodeId to = triangle[(k + 1) % 3];
      const NodeId opposite = triangle[(k + 2) % 3];
      const auto entry = between_.find({from, to});
      if (entry == between_.end()) continue;
      const std::vector<NodeId> nodes = entry->second;
      const std::span<const NodeId> all(nodes);
      const std::size_t middle = nodes.size() / 2;
      add(from, nodes[middle], all.first(middle));
      add(nodes[middle], to, all.subspan(middle + 1));
      parts.push_back({from, nodes[middle], opposite});
      parts.push_back({nodes[middle], to, opposite});
      return true;
    }
    return false;
  }

  SurfaceMesh* mesh_;
  std::map<NodePair, std::vector<NodeId>> between_;
};

}  // namespace

std::optional<std::vector<EdgeStations>> stationsAround(std::span<const std::uint8_t> isKept,
                                                        const SurfaceMesh& given,
                                                        const TrimmedModel& model, double reach) {
  const std::vector<std::uint8_t> isUsed = usedEdges(model);
  std::vector<std::pair<std::size_t, EdgeFinder>> finders;
  for (std::size_t e = 0; e < model.edges.size(); ++e) {
    if (isUsed[e] != 0) finders.emplace_back(e, EdgeFinder(model, model.edges[e], reach));
  }
  std::map<std::size_t, std::vector<SideOnEdge>> onEdges;
  for (const NodePair& side : sidesAround(isKept, given)) {
    const Vec3 middle = 0.5 * (pointOf(given, side.first) + pointOf(given, side.second));
    double nearest = std::numeric_limits<double>::infinity();
    std::optional<std::pair<std::size_t, SideOnEdge>> best;
    for (const auto& [e, finder] : finders) {
      const std::optional<SideOnEdge> placed = placedOn(finder, side, given);
      if (!placed) continue;
      const double t = 0.5 * (placed->from + placed->to);
      const double distance = glm::length(finder.position(t) - middle);
      if (distance >= nearest) continue;
      nearest = distance;
      best.emplace(e, *placed);
    }
    if (!best) return std::nullopt;
    onEdges[best->first].push_back(best->second);
  }
  std::vector<EdgeStations> stations(model.edges.size());
  for (auto& [e, sides] : onEdges) {
    std::optional<EdgeStations> own = chained(std::move(sides));
    if (!own) return std::nullopt;
    stations[e] = std::move(*own);
  }
  return stations;
}

std::vector<TriangleId> appendGiven(std::span<const std::uint8_t> isKept, const SurfaceMesh& given,
                                    std::span<const EdgeStations> stations,
                                    const DividedLines& lines, SurfaceMesh& mesh) {
  std::map<NodeId, NodeId> nodeOf;
  SideDivider divider(mesh);
  for (std::size_t e = 0; e < stations.size(); ++e) {
    const EdgeStations& own = stations[e];
    const std::span<const NodeId> nodes(lines.nodes[e]);
    const std::vector<double>& parameters = lines.divisions[e].parameters;
    std::size_t before = 0;
    for (std::size_t i = 0; i < own.nodes.size(); ++i) {
      const auto at = std::ranges::lower_bound(parameters, own.parameters[i]);
      const auto index = static_cast<std::size_t>(at - parameters.begin());
      nodeOf.try_emplace(own.nodes[i], nodes[index]);
      if (i > 0)
        divider.add(nodes[before], nodes[index], nodes.subspan(before + 1, index - before - 1));
      before = index;
    }
  }
  std::vector<TriangleId> origins;
  for (const TriangleId t : IdRange<TriangleId>(isKept.size())) {
    if (isKept[t.index()] == 0) continue;
    NodeTriple triangle = nodesOf(given, t);
    for (NodeId& node : triangle) {
      const auto [entry, isNew] = nodeOf.try_emplace(node, NodeId(countNodes(mesh)));
      if (isNew) {
        const Vec3 position = pointOf(given, node);
        mesh.points.insert(mesh.points.end(), {position.x, position.y, position.z});
      }
      node = entry->second;
    }
    origins.insert(origins.end(), divider.append(triangle), t);
  }
  return origins;
}

}  // namespace tetrafront
