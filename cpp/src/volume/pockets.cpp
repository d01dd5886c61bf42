#include "volume/pockets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/sort.h"
#include "geom/measure.h"
#include "geom/predicates.h"
#include "topology/disjoint_sets.h"

namespace tetrafront {
namespace {

/// Returns six times the volume that the faces enclose, positive if they are seen from inside.
double enclosedVolume(const Front& front, const std::vector<FaceId>& faces) {
  const Vec3 origin = front.node(front.face(faces.front()).nodes[0]);
  double volume = 0.0;
  for (const FaceId face : faces) {
    const NodeTriple& n = front.face(face).nodes;
    volume -= sixVolumesBelow(origin, front.node(n[0]), front.node(n[1]), front.node(n[2]));
  }
  return volume;
}

struct Component {
  std::vector<FaceId> faces;
  Box box{};
  bool isIsland = false;
};

bool encloses(const Box& outer, const Box& inner) {
  for (int k = 0; k < 3; ++k) {
    if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
  }
  return true;
}

Component describe(const Front& front, std::vector<FaceId> faces) {
  Component component;
  component.faces = std::move(faces);
  component.box = front.boxOf(component.faces.front());
  for (const FaceId face : component.faces) {
    for (const NodeId node : front.face(face).nodes) component.box.include(front.node(node));
  }
  component.isIsland = enclosedVolume(front, component.faces) <= 0.0;
  return component;
}

std::vector<Component> findComponents(const Front& front, std::span<const FaceId> active) {
  std::vector<NodeId> nodes;
  nodes.reserve(3 * active.size());
  for (const FaceId face : active) {
    const NodeTriple& n = front.face(face).nodes;
    nodes.insert(nodes.end(), n.begin(), n.end());
  }
  sortUnique(nodes);
  DisjointSets sets(nodes.size());
  const auto compact = [&](FaceId face, int corner) {
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), front.face(face).nodes[corner]);
    return static_cast<std::uint32_t>(at - nodes.begin());
  };
  for (const FaceId face : active) {
    sets.join(compact(face, 0), compact(face, 1));
    sets.join(compact(face, 0), compact(face, 2));
  }
  std::map<std::uint32_t, std::vector<FaceId>> facesOfSet;
  for (const FaceId face : active) facesOfSet[sets.find(compact(face, 0))].push_back(face);
  std::vector<Component> components;
  for (auto& entry : facesOfSet) components.push_back(describe(front, std::move(entry.second)));
  return components;
}

/// Planes of a pocket's faces with unit normals, its centre and its mean edge length.
struct HalfSpaces {
  std::vector<Vec3> normals;
  std::vector<Vec3> positions;
  Vec3 centre{0.0};
  double meanEdge = 0.0;

  /// Returns the smallest signed distance of `p` from a plane, and sets `worst` to that plane.
  double minDistance(const Vec3& p, std::size_t& worst) const {
    double distance = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const double d = glm::dot(normals[i], p - positions[i]);
      if (d >= distance) continue;
      distance = d;
      worst = i;
    }
    return distance;
  }
};

HalfSpaces halfSpacesOf(const Front& front, const Pocket& pocket) {
  HalfSpaces spaces;
  for (const FaceId face : pocket.faces) {
    const NodeTriple& n = front.face(face).nodes;
    const Vec3& a = front.node(n[0]);
    const Vec3 normal = glm::cross(front.node(n[1]) - a, front.node(n[2]) - a);
    const double length = std::sqrt(glm::dot(normal, normal));
    spaces.normals.push_back(length > 0.0 ? normal * (1.0 / length) : normal);
    spaces.positions.push_back(a);
    spaces.centre = spaces.centre + a + front.node(n[1]) + front.node(n[2]);
    spaces.meanEdge += static_cast<double>(front.face(face).size);
  }
  const auto count = static_cast<double>(pocket.faces.size());
  spaces.centre = spaces.centre * (1.0 / (3.0 * count));
  spaces.meanEdge /= count;
  return spaces;
}

/// Searches for the position deepest inside all half-spaces, by steps of decreasing length away
/// from the worst one.
Vec3 deepestPosition(const HalfSpaces& spaces) {
  constexpr int kSteps = 300;
  constexpr double kFirstStep = 0.3;  // of the mean side
  constexpr double kShrink = 0.975;
  Vec3 current = spaces.centre;
  Vec3 best = current;
  std::size_t worst = 0;
  double bestDepth = spaces.minDistance(current, worst);
  double step = kFirstStep * spaces.meanEdge;
  for (int i = 0; i < kSteps; ++i, step *= kShrink) {
    current = current + spaces.normals[worst] * step;
    const double depth = spaces.minDistance(current, worst);
    if (depth <= bestDepth) continue;
    bestDepth = depth;
    best = current;
  }
  return best;
}

bool isInsideElement(const Front& front, const NodeTriple& base, const Vec3& apex, const Vec3& p) {
  const Vec3& a = front.node(base[0]);
  const Vec3& b = front.node(base[1]);
  const Vec3& c = front.node(base[2]);
  return orient3d(a, b, c, p) >= 0 && orient3d(p, b, c, apex) >= 0 &&
         orient3d(a, p, c, apex) >= 0 && orient3d(a, b, p, apex) >= 0;
}

/// Returns true if another face lies inside the pocket. Other faces are entirely inside or outside,
/// so one node of each decides.
bool hasForeignFace(const Front& front, const Pocket& pocket, const Vec3& apex) {
  Box box = front.boxOf(pocket.faces.front());
  for (const FaceId face : pocket.faces) {
    for (const NodeId node : front.face(face).nodes) box.include(front.node(node));
  }
  std::vector<std::uint32_t> near;
  const std::size_t count = front.facesNear(box, near);
  for (std::size_t i = 0; i < count; ++i) {
    const FaceId other(near[i]);
    if (std::binary_search(pocket.faces.begin(), pocket.faces.end(), other)) continue;
    const Vec3& position = front.node(front.face(other).nodes[0]);
    for (const FaceId face : pocket.faces) {
      if (isInsideElement(front, front.face(face).nodes, apex, position)) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Pocket> findPockets(const Front& front) {
  return findPockets(front, front.activeFaces());
}

std::vector<Pocket> findPockets(const Front& front, std::span<const FaceId> faces) {
  std::vector<Component> components = findComponents(front, faces);
  DisjointSets sets(components.size());
  for (std::uint32_t i = 0; i < components.size(); ++i) {
    if (!components[i].isIsland) continue;
    for (std::uint32_t j = 0; j < components.size(); ++j) {
      if (!components[j].isIsland && encloses(components[j].box, components[i].box))
        sets.join(i, j);
    }
  }
  std::map<std::uint32_t, Pocket> pockets;
  for (std::uint32_t i = 0; i < components.size(); ++i) {
    Pocket& pocket = pockets[sets.find(i)];
    pocket.isSingle = pocket.faces.empty() && !components[i].isIsland;
    pocket.faces.insert(pocket.faces.end(), components[i].faces.begin(), components[i].faces.end());
  }
  std::vector<Pocket> result;
  for (auto& entry : pockets) {
    stableSort(entry.second.faces);
    result.push_back(std::move(entry.second));
  }
  return result;
}

std::optional<Vec3> findStarPoint(const Front& front, const Pocket& pocket) {
  const Vec3 position = deepestPosition(halfSpacesOf(front, pocket));
  for (const FaceId face : pocket.faces) {
    const NodeTriple& n = front.face(face).nodes;
    if (orient3d(front.node(n[0]), front.node(n[1]), front.node(n[2]), position) <= 0) return {};
  }
  if (hasForeignFace(front, pocket, position)) return {};
  return position;
}

bool fillFromStarPoint(Front& front, Elements& elements, const Pocket& pocket) {
  if (!pocket.isSingle) return false;
  const std::optional<Vec3> position = findStarPoint(front, pocket);
  if (!position) return false;
  std::uint16_t layer = 0;
  for (const FaceId face : pocket.faces) {
    for (const NodeId node : front.face(face).nodes) layer = std::max(layer, front.layer(node));
  }
  const NodeId apex = front.addNode(*position, layer, front.face(pocket.faces.front()).hint);
  for (const FaceId face : pocket.faces) {
    const FrontFace& f = front.face(face);
    elements.add({f.nodes[0], f.nodes[1], f.nodes[2], apex}, f.region);
    front.removeFace(face);
  }
  return true;
}

}  // namespace tetrafront
