#include "fill/cone.h"

#include <algorithm>
#include <cmath>

#include "geom/insphere.h"
#include "geom/measure.h"

namespace tetrafront {

double shapeOf(const ExactPoints& points, const NodeQuad& n) {
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const Vec3 edge = points.position(n[j]) - points.position(n[i]);
      squares += glm::dot(edge, edge);
    }
  }
  if (!(squares > 0.0)) return 0.0;
  const Vec3& a = points.position(n[0]);
  const double volume =
      sixVolumesBelow(a, points.position(n[3]), points.position(n[1]), points.position(n[2]));
  const double ratio = volume / (squares * std::sqrt(squares));
  return 432.0 * ratio * std::fabs(ratio);
}

bool Cone::make(NodeId apex, std::span<const TetId> cavity, const ConeRules& rules) {
  return plan(apex, cavity, rules) && commit();
}

bool Cone::plan(NodeId apex, std::span<const TetId> cavity, const ConeRules& rules) {
  apex_ = apex;
  lost_ = rules.lost;
  boundary_ = rules.boundary;
  stamp_ = mesh_.nextStamp();
  cavity_.clear();
  faces_.clear();
  for (const TetId t : cavity) enter(t);
  return grow(rules) && collect(rules) && !losesNodes(rules.lost) && !losesEdges();
}

bool Cone::commit() { return mesh_.replace(cavity_, fresh_, lost_, boundary_); }

void Cone::enter(TetId tet) {
  mesh_.stamp(tet, stamp_);
  cavity_.push_back(tet);
}

bool Cone::grow(const ConeRules& rules) {
  for (std::size_t i = 0; i < cavity_.size(); ++i) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (!look({cavity_[i], k}, rules)) return false;
    }
  }
  return true;
}

/// Decides about one face of the cavity: it bounds the cavity, lies inside it, or the tetrahedron
/// behind it joins.
bool Cone::look(TetFace face, const ConeRules& rules) {
  const FillTet& t = mesh_.tet(face.tet);
  const TetFace beyond = t.across[face.corner];
  const bool marked = !t.facet[face.corner].isNone();
  if (!beyond.isNone() && mesh_.hasStamp(beyond.tet, stamp_)) return !marked;
  const NodeTriple nodes = mesh_.innerFace(face.tet, face.corner);
  if (beyond.isNone() && contains(nodes, rules.lost)) return true;
  const bool mayPass = !beyond.isNone() && !marked && cavity_.size() < rules.maxCavity;
  if (contains(nodes, apex_)) {
    // The face remains as a face of a new tetrahedron.
    faces_.push_back(face);
    return true;
  }
  if (mesh_.points.orient(nodes[0], nodes[1], nodes[2], apex_) > 0) {
    if (mayPass && rules.delaunay && isInCircumsphere(beyond)) {
      enter(beyond.tet);
    } else {
      faces_.push_back(face);
    }
    return true;
  }
  if (!mayPass) return false;
  enter(beyond.tet);
  return true;
}

bool Cone::isInCircumsphere(TetFace beyond) const {
  const NodeQuad& n = mesh_.tet(beyond.tet).nodes;
  const ExactPoints& points = mesh_.points;
  return isInsideSphere(
      {points.position(n[0]), points.position(n[1]), points.position(n[2]), points.position(n[3])},
      points.position(apex_));
}

/// Builds the new tetrahedra.
bool Cone::collect(const ConeRules& rules) {
  fresh_.clear();
  for (const TetFace& face : faces_) {
    const TetFace beyond = mesh_.tet(face.tet).across[face.corner];
    // The face was visible before the tetrahedron behind it joined.
    if (!beyond.isNone() && mesh_.hasStamp(beyond.tet, stamp_)) {
      if (!mesh_.tet(face.tet).facet[face.corner].isNone()) return false;
      continue;
    }
    const NodeTriple n = mesh_.innerFace(face.tet, face.corner);
    if (!contains(n, apex_)) fresh_.push_back({n[0], n[1], n[2], apex_});
  }
  for (const BoundaryFace& face : rules.boundary) {
    const auto& n = face.nodes;
    if (contains(n, apex_)) continue;
    if (mesh_.points.orient(n[0], n[1], n[2], apex_) <= 0) return false;
    fresh_.push_back({n[0], n[1], n[2], apex_});
  }
  return !fresh_.empty();
}

/// Tells whether a node would be left without a tetrahedron: a node of the cavity that no outer
/// face uses.
bool Cone::losesNodes(NodeId lost) {
  nodeStamps_.resize(mesh_.points.size(), 0);
  for (const auto& nodes : fresh_) {
    for (const NodeId node : nodes) nodeStamps_[node.index()] = stamp_;
  }
  return std::any_of(cavity_.begin(), cavity_.end(), [&](TetId t) {
    const NodeQuad& nodes = mesh_.tet(t).nodes;
    return std::any_of(nodes.begin(), nodes.end(), [&](NodeId node) {
      return node != lost && node != apex_ && nodeStamps_[node.index()] != stamp_;
    });
  });
}

bool Cone::losesEdges() const {
  if (constraints_.empty()) return false;
  for (const TetId t : cavity_) {
    const NodeQuad& n = mesh_.tet(t).nodes;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        if (!constraints_.contains(n[i], n[j])) continue;
        if (std::none_of(fresh_.begin(), fresh_.end(), [&](const auto& nodes) {
              return contains(nodes, n[i]) && contains(nodes, n[j]);
            })) {
          return true;
        }
      }
    }
  }
  return false;
}

double Cone::minShape() const {
  double smallest = 1.0;
  for (const auto& nodes : fresh_) smallest = std::min(smallest, shapeOf(mesh_.points, nodes));
  return smallest;
}

}  // namespace tetrafront
