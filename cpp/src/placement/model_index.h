#pragma once

/// @file Finds the place on the faces, edges and vertices of a TrimmedModel that is nearest to a position.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "model/model_numbers.h"
#include "model/parametric.h"
#include "search/box_tree.h"
#include "tetrafront/node_placement.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// A place on a face of the model.
struct FacePlace {
  std::uint32_t face = 0;
  Vec3 position{0.0};
};

/// A place on an edge of the model, or at its vertex.
struct EdgePlace {
  std::uint32_t edge = 0;
  Vec3 position{0.0};
};

class ModelIndex {
 public:
  /// Both must outlive this. `sag`: how far triangles and straight pieces of edges may be from the model. O(n log n) for n
  /// triangles.
  ModelIndex(const ReadModel& read, const ModelTriangles& triangles, double sag);

  /// Returns the place on a face, at most `reach` away, whose normal is similar to a unit normal; zero: any. `only`: the faces
  /// that are asked for, ascending; empty: all.
  [[nodiscard]] std::optional<FacePlace> nearestOnFace(
      const Vec3& position, const Vec3& normal, double reach,
      std::span<const std::uint32_t> only = {}) const;

  /// Returns the place on an edge, at most `reach` away, whose tangent is similar to a unit direction or its opposite; zero:
  /// any. Seams of closed faces are no edges here. `only`: the edge that is asked for.
  [[nodiscard]] std::optional<EdgePlace> nearestOnEdge(
      const Vec3& position, const Vec3& direction, double reach,
      std::optional<std::uint32_t> only = std::nullopt) const;

  /// Returns the vertex of an edge that is at most `reach` away.
  [[nodiscard]] std::optional<Vec3> nearestVertex(const Vec3& position, double reach) const;

 private:
  /// A straight piece between two positions of an edge.
  struct Segment {
    std::uint32_t edge;
    double from;  ///< parameter of the curve
    double to;
    Vec3 start;
    Vec3 end;
  };

  void addTriangles();
  void addEdges();
  void addSegments(std::uint32_t edge);
  [[nodiscard]] Vec3 pointOf(std::uint32_t node) const;
  [[nodiscard]] Vec2 parametersOf(std::uint32_t node) const;
  [[nodiscard]] std::span<const std::uint32_t, 3> nodesOf(std::uint32_t triangle) const {
    return std::span(triangles_->triangles).subspan(std::size_t{3} * triangle).first<3>();
  }

  const ReadModel* read_;
  const ModelTriangles* triangles_;
  double sag_;
  std::vector<std::uint32_t> indexed_;  ///< triangles of valid faces, by items of the tree
  std::vector<ParameterBox> boxes_;     ///< per face: around the nodes of its triangles
  BoxTree triangleTree_;
  std::vector<Segment> segments_;
  BoxTree segmentTree_;
  std::vector<Vec3> vertices_;
  BoxTree vertexTree_;
};

}  // namespace tetrafront
