#pragma once

/// @file Quick proofs that triangles do not intersect, for the common case of neighbours on a smooth surface. They replace
/// most of the exact tests: one plane can separate a triangle from all new ones, where the tests look at each pair.
///
/// A proof holds in spite of rounding: a sign counts only if its value is far above the error bound. Without a proof,
/// nothing is known.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/intersect.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class SeparationProof {
 public:
  /// Begins with other new triangles, which must remain while proofs are asked for.
  void begin(std::span<const NumberedTriangle> triangles);

  /// Returns true if no two of the new triangles intersect, beyond the nodes and edges that they share: they form one fan
  /// around a common node, and in some direction of view no two cover each other.
  [[nodiscard]] bool areApart();

  /// Returns true if the triangle intersects none of the new ones, beyond the nodes and edges that it shares: a plane
  /// separates them.
  [[nodiscard]] bool isApart(const NumberedTriangle& other) const;

 private:
  struct Node {
    std::uint32_t index;
    Vec3 position;
  };
  /// The edge of a triangle of the fan that is opposite the common node.
  struct Spread {
    std::uint32_t from;
    std::uint32_t to;
    Vec3 toFrom;  ///< from the common node
    Vec3 toTo;
  };

  [[nodiscard]] bool collectSpreads(std::uint32_t centre);
  [[nodiscard]] bool areTurning() const;
  [[nodiscard]] bool coversOnce() const;
  /// For each corner of a triangle: its index in nodes_, or kNoIndex.
  using NodeIndices = std::array<std::uint32_t, 3>;

  [[nodiscard]] NodeIndices indicesOf(const NumberedTriangle& other) const;
  [[nodiscard]] bool isBeyond(const NumberedTriangle& other, const NodeIndices& indices,
                              const Vec3& origin, const Vec3& normal, double margin) const;
  [[nodiscard]] bool isApartAlong(const Vec3& direction, const std::array<Vec3, 3>& corners) const;
  [[nodiscard]] bool isFarFrom(const NumberedTriangle& other) const;

  std::span<const NumberedTriangle> triangles_;
  std::vector<Node> nodes_;  ///< of the new triangles, each once
  std::vector<std::uint32_t>
      indexOf_;         ///< per node of the surface: its index in nodes_, or kNoIndex
  Vec3 centre_{0.0};    ///< mean of the nodes
  double reach_ = 0.0;  ///< largest distance of a node from the centre
  Vec3 normal_{0.0};    ///< sum of the normals
  std::vector<Spread> spreads_;
};

}  // namespace tetrafront
