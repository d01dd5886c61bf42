#pragma once

/// @file The surroundings of one base face, gathered once and used for all of its candidates: the
/// active faces near it and their nodes. Nodes have local indices and separate x, y and z arrays,
/// so that half-space tests run in flat loops.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/vec3.h"
#include "volume/front.h"
#include "volume/search_region.h"
#include "volume/unit_space.h"

namespace tetrafront {

/// Index of a node in a Neighbourhood. The base face's nodes are 0, 1 and 2.
using LocalNode = std::uint32_t;
using LocalTriple = std::array<LocalNode, 3>;

/// A gathered face that shares an edge with the base face.
struct AdjacentFace {
  std::uint32_t face;  ///< local index of the face
  LocalNode apex;      ///< the node off the edge
  LocalNode from;      ///< the edge in the orientation of the face: apex, from, to
  LocalNode to;

  /// Neighbours with consistent orientation pass their common edge in opposite directions. A face
  /// that passes it in the direction of the base has its empty side on the other side.
  [[nodiscard]] bool isNeighbour() const { return from == (to + 1) % 3; }
  /// The base node that is not on the edge.
  [[nodiscard]] LocalNode third() const { return 3 - from - to; }
};

class Neighbourhood {
 public:
  /// Gathers the active faces that may overlap the region. `reach` is another position used in
  /// tests; it only widens the error bound.
  void gather(const Front& front, const NodeTriple& base, const SearchRegion& region,
              const Vec3& reach);

  /// Sets the space of unitPosition() and unitX() to unitZ(). Call it after each gather().
  void mapTo(const UnitSpace& space);

  [[nodiscard]] std::size_t nodeCount() const { return nodeCount_; }
  [[nodiscard]] std::size_t faceCount() const { return faceCount_; }
  [[nodiscard]] NodeId nodeId(LocalNode local) const { return nodeIds_[local]; }
  [[nodiscard]] FaceId faceId(std::size_t local) const { return faceIds_[local]; }
  [[nodiscard]] const LocalTriple& face(std::size_t local) const { return faces_[local]; }
  /// The adjacent faces in the order in which they were gathered.
  [[nodiscard]] std::span<const AdjacentFace> adjacentFaces() const { return adjacent_; }
  [[nodiscard]] Vec3 position(LocalNode local) const { return {x_[local], y_[local], z_[local]}; }
  [[nodiscard]] const double* x() const { return x_.data(); }
  [[nodiscard]] const double* y() const { return y_.data(); }
  [[nodiscard]] const double* z() const { return z_.data(); }

  // Coordinates of the nodes in unit space; without stretching, the same arrays as x(), y() and
  // z().
  [[nodiscard]] const double* unitX() const { return unit_[0]; }
  [[nodiscard]] const double* unitY() const { return unit_[1]; }
  [[nodiscard]] const double* unitZ() const { return unit_[2]; }
  [[nodiscard]] Vec3 unitPosition(LocalNode local) const {
    return {unit_[0][local], unit_[1][local], unit_[2][local]};
  }

  /// Stores the position of a node that does not exist yet and returns its local index,
  /// nodeCount().
  LocalNode setNewNode(const Vec3& position);

  /// Upper bound of the error of any orient3d determinant over these nodes, evaluated by three
  /// differences, a cross product and a dot product.
  [[nodiscard]] double determinantError() const { return determinantError_; }

 private:
  class LocalNumbering;
  std::size_t dropFarFaces(const Front& front, const SearchRegion& region, std::size_t count);
  void reserve(std::size_t nodesOfFront, std::size_t faces);
  void boundErrors(const Vec3& reach);

  std::vector<std::uint32_t> found_;
  // The arrays only grow. Their used lengths are kept here, which saves a capacity check per entry.
  std::size_t nodeCount_ = 0;
  std::size_t faceCount_ = 0;
  std::vector<FaceId> faceIds_;
  std::vector<LocalTriple> faces_;
  std::vector<AdjacentFace> adjacent_;
  std::vector<NodeId> nodeIds_;
  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<double> z_;
  std::array<std::vector<double>, 3> mapped_;  ///< used in stretched spaces only
  std::array<const double*, 3> unit_{};
  /// Local index of a node; valid if the stamp is the current one.
  struct LocalEntry {
    std::uint32_t stamp = 0;
    LocalNode local = 0;
  };
  std::vector<LocalEntry> entries_;
  std::uint32_t stamp_ = 0;
  double determinantError_ = 0.0;
};

}  // namespace tetrafront
