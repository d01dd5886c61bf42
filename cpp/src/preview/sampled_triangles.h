#pragma once

/// @file The triangles of a sampled model, with ray queries for the gaps between opposite patches.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "search/box_tree.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

struct SampledTriangle {
  std::array<Vec3, 3> corners;
  Vec3 centroid;
  Vec3 normal;  ///< unit; zero if the triangle is degenerate

  explicit SampledTriangle(const std::array<Vec3, 3>& c);
};

class SampledTriangles {
 public:
  void add(const std::array<Vec3, 3>& corners) { triangles_.emplace_back(corners); }
  /// Prepares the ray queries for the triangles added so far.
  void buildTree();

  [[nodiscard]] std::size_t size() const { return triangles_.size(); }
  [[nodiscard]] const SampledTriangle& operator[](std::size_t i) const { return triangles_[i]; }

  /// Returns the distance from a triangle along a unit vector to the next one, if that is below `reach`, if the two are roughly
  /// parallel, and if the gap is inside the model.
  [[nodiscard]] std::optional<double> gapAlong(const SampledTriangle& triangle,
                                               const Vec3& direction, double reach) const;

 private:
  [[nodiscard]] bool isInside(const Vec3& position) const;

  std::vector<SampledTriangle> triangles_;
  BoxTree tree_;
};

}  // namespace tetrafront
