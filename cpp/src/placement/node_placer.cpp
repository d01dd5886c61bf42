#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/task.h"
#include "base/tool_job.h"
#include "boundary/self_intersection.h"
#include "geom/angles.h"
#include "geom/coordinates.h"
#include "model/model_numbers.h"
#include "placement/model_index.h"
#include "search/box_tree.h"
#include "tetrafront/node_placement.h"
#include "topology/edge_table.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {

namespace {

/// Cosine of the angle between two triangles from which on their edge is sharp, as for remeshing. With groups, it does not count:
/// coarse triangles of a curved face meet at larger angles.
constexpr double kSharpCosine = cosineOfDegrees(40.0);
/// Cosine of the angle by which a line turns at a corner.
constexpr double kCornerCosine = cosineOfDegrees(50.0);
/// Largest move of a node, and distance of the middle of an edge from its place / length of the longest edge.
constexpr double kReach = 0.5;
/// The same for a corner, which is near its vertex or near none.
constexpr double kCornerReach = 0.25;
/// Cosine of the angle by which a move may turn a triangle, and its shape after / before a move, for triangles with a height below
/// kPoorShape of their longest edge.
constexpr double kLargestTurn = 0.5;
constexpr double kWorseShape = 0.8;
constexpr double kPoorShape = 0.2;
/// Distance of the nearest place from the middle of an edge / its length, up to which the edge counts as straight: above
/// the rounding of coordinates, and far below any bend that matters.
constexpr double kStraight = 1e-10;
/// Length of an edge after / before the moves of its ends, below which it is too short.
constexpr double kShorter = 0.5;
/// Cosine of the angle between two triangles at an edge above which they form a wedge that elements cannot fill well.
constexpr double kWedgeCosine = cosineOfDegrees(20.0);
constexpr int kMaxRounds = 20;
/// Pairs of triangles that intersect, found per round.
constexpr std::size_t kMaxPairs = 10'000;

struct PlacementInput {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> groups;
  std::vector<double> model;
  ModelTriangles triangles;
  double reach = 0.0;
};

/// What a node lies on: a face, an edge of the model or one of its vertices.
enum class NodeKind : std::uint8_t { kOnFace, kOnLine, kAtCorner };

struct MeshEdge {
  NodeId low;
  NodeId high;
  std::uint32_t firstTriangle = 0;  ///< in the list of the triangles at all edges
  std::uint32_t triangleCount = 0;
  bool isLine = false;
  Vec3 normal{0.0};  ///< mean of the normals of its triangles
};

Vec3 unit(const Vec3& vector) {
  const double length = glm::length(vector);
  return length > 0.0 ? vector / length : Vec3(0.0);
}

class Placement {
 public:
  Placement(const PlacementInput& input, const ModelIndex& index)
      : mesh_(input.mesh),
        groups_(input.groups),
        reach_(input.reach),
        index_(index),
        points_(pointsOf(input.mesh)),
        given_(points_) {}

  void classify();
  void place(std::size_t first, std::size_t last);
  /// Places nodes of faces whose mean normal is similar to none of the model's by the normals of the triangles at them, at the
  /// nearest place.
  void placeApexes(std::size_t first, std::size_t last);
  /// Moves nodes back until no triangles intersect that did not before.
  Task<> untangle(Work& work);
  void bend(std::size_t first, std::size_t last);
  [[nodiscard]] std::size_t edgeCount() const { return edges_.size(); }
  [[nodiscard]] NodePlacement take();

 private:
  struct Node {
    NodeKind kind = NodeKind::kOnFace;
    bool isUsed = false;
    bool isPlaced = false;
    std::uint32_t lineEdges = 0;
    std::uint32_t edge = TrimmedFace::kNone;  ///< of the model, if the node is placed on one
    Vec3 normal{0.0};                         ///< sum over the triangles
    Vec3 direction{0.0};                      ///< of its line
    double longest = 0.0;                     ///< longest edge
    double apexMove = 0.0;                    ///< if the node is placed by placeApexes(): how far
  };

  void addEdge(std::span<const HalfEdgeId> halfEdges);
  void addDirections();
  [[nodiscard]] Vec3 normalOf(TriangleId triangle) const;
  [[nodiscard]] std::optional<Vec3> placeOf(const Vec3& position, Node& node) const;
  [[nodiscard]] std::optional<Vec3> middleOf(const MeshEdge& edge) const;
  [[nodiscard]] std::optional<Vec3> nearestOnFace(const Vec3& position, const Vec3& normal,
                                                  double reach) const {
    if (normal == Vec3(0.0)) return std::nullopt;
    const std::optional<FacePlace> place = index_.nearestOnFace(position, unit(normal), reach);
    return place ? std::optional(place->position) : std::nullopt;
  }
  void unfold();
  [[nodiscard]] bool isFolded(TriangleId triangle) const;
  [[nodiscard]] bool isPinched(const MeshEdge& edge) const;
  [[nodiscard]] double cosineBetween(const MeshEdge& edge, std::span<const Vec3> points,
                                     TriangleId one, TriangleId other) const;
  [[nodiscard]] std::span<const TriangleId> trianglesAt(const MeshEdge& edge) const {
    return std::span(trianglesAtEdges_).subspan(edge.firstTriangle, edge.triangleCount);
  }
  bool moveBackFarthest(std::span<const NodeId> nodes);
  void moveBack(NodeId node);

  const SurfaceMesh& mesh_;
  std::span<const std::uint32_t> groups_;
  double reach_;
  const ModelIndex& index_;
  std::vector<Vec3> points_;
  std::vector<Vec3> given_;
  std::vector<Node> nodes_;
  std::vector<MeshEdge> edges_;
  std::vector<TriangleId> trianglesAtEdges_;
  NodePlacement result_;
};

std::array<Vec3, 3> cornersAt(const SurfaceMesh& mesh, std::span<const Vec3> points,
                              TriangleId triangle) {
  const auto [a, b, c] = nodesOf(mesh, triangle);
  return {points[a.index()], points[b.index()], points[c.index()]};
}

Vec3 areaVectorOf(const std::array<Vec3, 3>& corners) {
  return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

Vec3 Placement::normalOf(TriangleId triangle) const {
  return unit(areaVectorOf(cornersAt(mesh_, given_, triangle)));
}

void Placement::classify() {
  nodes_.assign(points_.size(), {});
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh_))) {
    for (const NodeId node : nodesOf(mesh_, t)) {
      nodes_[node.index()].isUsed = true;
      nodes_[node.index()].normal += normalOf(t);
    }
  }
  const EdgeTable table(mesh_.triangles, nodes_.size(), {});
  for (const EdgeId edge : IdRange<EdgeId>(table.edgeCount())) addEdge(table.halfEdgesOf(edge));
  addDirections();
}

void Placement::addEdge(std::span<const HalfEdgeId> halfEdges) {
  const auto [from, to, apex] = tetrafront::nodesOf(mesh_.triangles, halfEdges.front());
  MeshEdge edge{std::min(from, to), std::max(from, to)};
  const TriangleId first = triangleOf(halfEdges.front());
  edge.normal = normalOf(first);
  edge.firstTriangle = static_cast<std::uint32_t>(trianglesAtEdges_.size());
  edge.triangleCount = static_cast<std::uint32_t>(halfEdges.size());
  for (const HalfEdgeId halfEdge : halfEdges) trianglesAtEdges_.push_back(triangleOf(halfEdge));
  edge.isLine = halfEdges.size() != 2;
  if (!edge.isLine) {
    const TriangleId other = triangleOf(halfEdges.back());
    edge.isLine = groups_.empty() ? glm::dot(edge.normal, normalOf(other)) < kSharpCosine
                                  : groups_[first.index()] != groups_[other.index()];
    edge.normal += normalOf(other);
  }
  const double length = glm::length(given_[to.index()] - given_[from.index()]);
  for (const NodeId end : {from, to}) {
    Node& node = nodes_[end.index()];
    node.longest = std::max(node.longest, length);
    node.lineEdges += edge.isLine ? 1 : 0;
  }
  edges_.push_back(edge);
}

/// A node of a line has its direction; it is a corner where the line turns, ends, or meets others.
void Placement::addDirections() {
  std::vector<Vec3> firstAlong(nodes_.size(), Vec3(0.0));
  for (const MeshEdge& edge : edges_) {
    if (!edge.isLine) continue;
    const Vec3 along = unit(given_[edge.high.index()] - given_[edge.low.index()]);
    const auto add = [&](NodeId id, const Vec3& away) {
      Node& node = nodes_[id.index()];
      Vec3& first = firstAlong[id.index()];
      if (node.kind == NodeKind::kOnFace) {
        node.kind = node.lineEdges == 2 ? NodeKind::kOnLine : NodeKind::kAtCorner;
        first = away;
      } else if (node.kind == NodeKind::kOnLine) {
        node.direction = unit(away - first);
        if (!(-glm::dot(away, first) >= kCornerCosine)) node.kind = NodeKind::kAtCorner;
      }
    };
    add(edge.low, along);
    add(edge.high, -along);
  }
}

std::optional<Vec3> Placement::placeOf(const Vec3& position, Node& node) const {
  const double reach = std::min(kReach * node.longest, reach_);
  if (node.kind == NodeKind::kOnFace) {
    return nearestOnFace(position, node.normal, reach);
  }
  if (node.kind == NodeKind::kAtCorner) {
    const std::optional<Vec3> vertex =
        index_.nearestVertex(position, std::min(kCornerReach * node.longest, reach_));
    if (vertex) return vertex;
  }
  const Vec3 direction = node.kind == NodeKind::kOnLine ? node.direction : Vec3(0.0);
  std::optional<EdgePlace> place = index_.nearestOnEdge(position, direction, reach);
  if (!place) place = index_.nearestOnEdge(position, Vec3(0.0), reach);
  if (!place) return nearestOnFace(position, node.normal, reach);
  node.edge = place->edge;
  return place->position;
}

void Placement::place(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    Node& node = nodes_[i];
    if (!node.isUsed || !isFinite(given_[i])) continue;
    const std::optional<Vec3> place = placeOf(given_[i], node);
    if (!place) continue;
    node.isPlaced = true;
    points_[i] = inExactRange(*place);
  }
}

void Placement::placeApexes(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const TriangleId triangle(static_cast<std::uint32_t>(i));
    for (const NodeId id : nodesOf(mesh_, triangle)) {
      Node& node = nodes_[id.index()];
      const Vec3& given = given_[id.index()];
      const bool isAnApex = !node.isPlaced || node.apexMove > 0.0;
      if (!isAnApex || node.kind != NodeKind::kOnFace || !isFinite(given)) continue;
      const double reach = std::min(kReach * node.longest, reach_);
      const std::optional<Vec3> place = nearestOnFace(given, normalOf(triangle), reach);
      if (!place) continue;
      const double move = glm::length(*place - given);
      if (node.isPlaced && move >= node.apexMove) continue;
      node.isPlaced = true;
      node.apexMove = move;
      points_[id.index()] = inExactRange(*place);
    }
  }
}

/// Returns whether moves have turned a triangle, or made it much thinner.
bool Placement::isFolded(TriangleId triangle) const {
  const std::array<Vec3, 3> before = cornersAt(mesh_, given_, triangle);
  const std::array<Vec3, 3> after = cornersAt(mesh_, points_, triangle);
  if (before == after) return false;
  const Vec3 old = areaVectorOf(before);
  const Vec3 now = areaVectorOf(after);
  if (!(glm::dot(old, now) > kLargestTurn * glm::length(old) * glm::length(now))) return true;
  const auto shapeOf = [](const std::array<Vec3, 3>& corners, const Vec3& area) {
    const std::uint32_t k = longestEdgeOf(corners);
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    return glm::length(area) / glm::dot(edge, edge);
  };
  const double shape = shapeOf(after, now);
  return shape < kPoorShape && shape < kWorseShape * shapeOf(before, old);
}

/// Returns whether moves have made an edge much shorter, or the angle at it much more acute.
bool Placement::isPinched(const MeshEdge& edge) const {
  const auto lengthIn = [&](const std::vector<Vec3>& points) {
    return glm::length(points[edge.high.index()] - points[edge.low.index()]);
  };
  if (lengthIn(points_) < kShorter * lengthIn(given_)) return true;
  const std::span<const TriangleId> triangles = trianglesAt(edge);
  // Where several regions meet, two triangles must not pass each other, which would exchange what is between them.
  const bool areOrdered = triangles.size() > 2;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double cosine = cosineBetween(edge, points_, triangles[i], triangles[k]);
      const double before = cosineBetween(edge, given_, triangles[i], triangles[k]);
      if (areOrdered && std::max(cosine, before) > kWedgeCosine) return true;
      if (cosine > kWedgeCosine && cosine > before) return true;
    }
  }
  return false;
}

/// Cosine of the angle between two triangles at an edge; 1 if they lie on each other.
double Placement::cosineBetween(const MeshEdge& edge, std::span<const Vec3> points, TriangleId one,
                                TriangleId other) const {
  const Vec3& low = points[edge.low.index()];
  const Vec3 along = unit(points[edge.high.index()] - low);
  const auto awayFrom = [&](TriangleId t) {
    Vec3 sum(0.0);
    for (const NodeId node : nodesOf(mesh_, t)) {
      if (node != edge.low && node != edge.high) sum = points[node.index()] - low;
    }
    return unit(sum - glm::dot(sum, along) * along);
  };
  return glm::dot(awayFrom(one), awayFrom(other));
}

/// Moves the node back that has moved farthest. Returns false if none has moved.
bool Placement::moveBackFarthest(std::span<const NodeId> nodes) {
  NodeId farthest{};
  double most = 0.0;
  for (const NodeId node : nodes) {
    const double moved = glm::length(points_[node.index()] - given_[node.index()]);
    if (!(moved > most)) continue;
    most = moved;
    farthest = node;
  }
  if (farthest.isNone()) return false;
  moveBack(farthest);
  return true;
}

void Placement::moveBack(NodeId node) {
  points_[node.index()] = given_[node.index()];
  nodes_[node.index()].isPlaced = false;
}

Task<> Placement::untangle(Work& work) {
  SurfaceMesh moved = mesh_;
  const std::vector<std::uint8_t> ignored(countTriangles(mesh_), 0);
  for (int round = 0; round < kMaxRounds; ++round) {
    unfold();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      for (int k = 0; k < 3; ++k) moved.points[3 * i + static_cast<std::size_t>(k)] = points_[i][k];
    }
    const std::vector<Box> boxes = triangleBoxes(moved);
    const BoxTree tree{std::span<const Box>(boxes)};
    const std::vector<IntersectingPair> pairs =
        co_await findSelfIntersections(work, moved, ignored, tree, kMaxPairs);
    bool isChanged = false;
    for (const auto& [low, high] : pairs) {
      for (const TriangleId t : {low, high}) {
        for (const NodeId node : nodesOf(mesh_, t)) {
          if (points_[node.index()] == given_[node.index()]) continue;
          moveBack(node);
          isChanged = true;
        }
      }
    }
    if (!isChanged) co_return;
  }
  // Where rounds do not suffice, the given surface is better than one that intersects itself.
  for (const NodeId node : IdRange<NodeId>(points_.size())) moveBack(node);
}

/// Moves nodes back until no triangle is folded and no edge pinched: of their nodes, the one that has moved farthest.
void Placement::unfold() {
  // Ends, because each round moves a node back.
  for (bool isChanged = true; isChanged;) {
    isChanged = false;
    for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh_))) {
      if (!isFolded(t)) continue;
      isChanged = moveBackFarthest(nodesOf(mesh_, t)) || isChanged;
    }
    for (const MeshEdge& edge : edges_) {
      if (!isPinched(edge)) continue;
      std::vector<NodeId> nodes{edge.low, edge.high};
      for (const TriangleId t : trianglesAt(edge)) {
        const NodeTriple corners = nodesOf(mesh_, t);
        nodes.insert(nodes.end(), corners.begin(), corners.end());
      }
      isChanged = moveBackFarthest(nodes) || isChanged;
    }
  }
}

std::optional<Vec3> Placement::middleOf(const MeshEdge& edge) const {
  const Node& low = nodes_[edge.low.index()];
  const Node& high = nodes_[edge.high.index()];
  if (!low.isPlaced || !high.isPlaced) return std::nullopt;
  const Vec3 chord = points_[edge.high.index()] - points_[edge.low.index()];
  const Vec3 middle = points_[edge.low.index()] + 0.5 * chord;
  const double reach = kReach * glm::length(chord);
  if (!edge.isLine) return nearestOnFace(middle, edge.normal, reach);
  std::optional<std::uint32_t> only;
  if (low.edge == high.edge && low.edge != TrimmedFace::kNone) only = low.edge;
  const std::optional<EdgePlace> place = index_.nearestOnEdge(middle, unit(chord), reach, only);
  if (!place) return std::nullopt;
  return place->position;
}

void Placement::bend(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const MeshEdge& edge = edges_[i];
    const std::optional<Vec3> middle = middleOf(edge);
    if (!middle) continue;
    const Vec3& low = points_[edge.low.index()];
    const Vec3& high = points_[edge.high.index()];
    const double bend = glm::length(*middle - 0.5 * (low + high));
    if (!(bend > kStraight * glm::length(high - low))) continue;
    result_.curvedEdges.insert(result_.curvedEdges.end(), {edge.low.value, edge.high.value});
    const Vec3 exact = inExactRange(*middle);
    result_.middles.insert(result_.middles.end(), {exact.x, exact.y, exact.z});
  }
}

NodePlacement Placement::take() {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].isPlaced) {
      ++result_.placed;
    } else if (nodes_[i].isUsed) {
      result_.unplaced.push_back(static_cast<std::uint32_t>(i));
    }
    result_.largestMove = std::max(result_.largestMove, glm::length(points_[i] - given_[i]));
    result_.points.insert(result_.points.end(), {points_[i].x, points_[i].y, points_[i].z});
  }
  return std::move(result_);
}

Task<NodePlacement> placeNodes(Work& work, PlacementInput& input) {
  NodePlacement none;
  none.points = input.mesh.points;
  const std::uint32_t count = countNodes(input.mesh);
  const std::optional<ReadModel> read = readModel(input.model);
  const bool areNodes =
      std::ranges::all_of(input.mesh.triangles, [&](std::uint32_t node) { return node < count; });
  if (!read || !areNodes) {
    for (std::uint32_t node = 0; node < count; ++node) none.unplaced.push_back(node);
    co_return none;
  }
  co_await work.yield();
  const ModelIndex index(*read, input.triangles, input.reach);
  if (input.groups.size() != countTriangles(input.mesh)) input.groups.clear();
  Placement placement(input, index);
  co_await work.yield();
  placement.classify();
  work.beginPart(0.45);
  co_await work.forEachBlock(
      count, [&](std::size_t first, std::size_t last) { placement.place(first, last); });
  work.beginPart(0.5);
  co_await work.forEachBlock(countTriangles(input.mesh), [&](std::size_t first, std::size_t last) {
    placement.placeApexes(first, last);
  });
  work.beginPart(0.7);
  co_await placement.untangle(work);
  work.beginPart(1.0);
  co_await work.forEachBlock(placement.edgeCount(), [&](std::size_t first, std::size_t last) {
    placement.bend(first, last);
  });
  co_return placement.take();
}

PlacementInput inputFor(std::span<const double> points, std::span<const std::uint32_t> triangles,
                        std::span<const std::uint32_t> groups, std::span<const double> model,
                        const ModelTriangles& modelTriangles, double reach) {
  PlacementInput input;
  input.reach = reach;
  input.mesh.points.assign(points.begin(), points.end());
  input.mesh.triangles.assign(triangles.begin(), triangles.end());
  input.groups.assign(groups.begin(), groups.end());
  input.model.assign(model.begin(), model.end());
  input.triangles = modelTriangles;
  return input;
}

}  // namespace

NodePlacer::NodePlacer(std::span<const double> points, std::span<const std::uint32_t> triangles,
                       std::span<const std::uint32_t> groups, std::span<const double> model,
                       const ModelTriangles& modelTriangles, double reach)
    : SlicedTool(makeToolJob<NodePlacement>(
          inputFor(points, triangles, groups, model, modelTriangles, reach), placeNodes)) {}

}  // namespace tetrafront
