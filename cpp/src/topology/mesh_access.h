#pragma once

/// @file Typed access to the flat arrays of meshes.

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/tetrahedron.h"

namespace tetrafront {

inline std::uint32_t countNodes(const SurfaceMesh& mesh) {
  return static_cast<std::uint32_t>(mesh.points.size() / 3);
}

inline std::uint32_t countNodes(const VolumeMesh& mesh) {
  return static_cast<std::uint32_t>(mesh.points.size() / 3);
}

inline std::uint32_t countTriangles(const SurfaceMesh& mesh) {
  return static_cast<std::uint32_t>(mesh.triangles.size() / 3);
}

inline std::uint32_t countTetrahedra(const VolumeMesh& mesh) {
  return static_cast<std::uint32_t>(mesh.tetrahedra.size() / 4);
}

inline Vec3 pointOf(const SurfaceMesh& mesh, NodeId node) {
  const std::size_t i = 3 * node.index();
  return {mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
}

inline Vec3 pointOf(const VolumeMesh& mesh, NodeId node) {
  const std::size_t i = 3 * node.index();
  return {mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
}

inline NodeQuad nodesOf(const VolumeMesh& mesh, TetId tet) {
  const std::size_t i = 4 * tet.index();
  return {NodeId(mesh.tetrahedra[i]), NodeId(mesh.tetrahedra[i + 1]),
          NodeId(mesh.tetrahedra[i + 2]), NodeId(mesh.tetrahedra[i + 3])};
}

/// Returns the nodes of a face, counter-clockwise as seen from outside the element (mesh.h).
inline NodeTriple nodesOf(const VolumeMesh& mesh, ElementFace face) {
  const NodeQuad nodes = nodesOf(mesh, face.tet());
  const auto& [a, b, c] = kFaceCorners[face.corner()];
  return {nodes[a], nodes[b], nodes[c]};
}

inline NodeTriple nodesOf(const SurfaceMesh& mesh, TriangleId triangle) {
  const std::size_t i = 3 * triangle.index();
  return {NodeId(mesh.triangles[i]), NodeId(mesh.triangles[i + 1]), NodeId(mesh.triangles[i + 2])};
}

template <class Node>
bool hasRepeatedNode(const std::array<Node, 3>& nodes) {
  return nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[2] == nodes[0];
}

inline std::array<Vec3, 3> cornersOf(const SurfaceMesh& mesh, TriangleId triangle) {
  const auto [a, b, c] = nodesOf(mesh, triangle);
  return {pointOf(mesh, a), pointOf(mesh, b), pointOf(mesh, c)};
}

inline std::array<Vec3, 4> cornersOf(const VolumeMesh& mesh, TetId tet) {
  const auto [a, b, c, d] = nodesOf(mesh, tet);
  return {pointOf(mesh, a), pointOf(mesh, b), pointOf(mesh, c), pointOf(mesh, d)};
}

}  // namespace tetrafront
