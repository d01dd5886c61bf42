#pragma once

/// @file Everything around one base face, gathered once and used for all of its candidates: the
/// active faces near it, and their nodes under local numbers with their coordinates side by side,
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

/// Positions in a Neighbourhood. The base face's nodes are 0, 1, 2.
using LocalNode = std::uint32_t;
using LocalTriple = std::array<LocalNode, 3>;

/// A gathered face that stands on a side of the base face: it has the side's two nodes, and one more.
struct AdjacentFace {
  std::uint32_t face;  ///< position among the gathered ones
  LocalNode apex;      ///< the node besides the side's
  LocalNode from;      ///< the side, as the face walks it: after the apex come from, to
  LocalNode to;

  /// Neighbours walk their common side in opposite directions. One that walks it as the base does
  /// looks the other way.
  [[nodiscard]] bool isNeighbour() const { return from == (to + 1) % 3; }
  /// The base node that is not on the side.
  [[nodiscard]] LocalNode third() const { return 3 - from - to; }
};

class Neighbourhood {
 public:
  /// Gathers the active faces that may meet what is in the region. `reach` is a further position that
  /// tests will use; it only widens the error bound.
  void gather(const Front& front, const NodeTriple& base, const SearchRegion& region,
              const Vec3& reach);

  /// Sets the space of unitPosition() and its kin; to be called after each gather().
  void mapTo(const UnitSpace& space);

  [[nodiscard]] std::size_t nodeCount() const { return nodeCount_; }
  [[nodiscard]] std::size_t faceCount() const { return faceCount_; }
  [[nodiscard]] NodeId nodeId(LocalNode local) const { return nodeIds_[local]; }
  [[nodiscard]] FaceId faceId(std::size_t local) const { return faceIds_[local]; }
  [[nodiscard]] const LocalTriple& face(std::size_t local) const { return faces_[local]; }
  /// In the order in which they were gathered.
  [[nodiscard]] std::span<const AdjacentFace> adjacentFaces() const { return adjacent_; }
  [[nodiscard]] Vec3 position(LocalNode local) const { return {x_[local], y_[local], z_[local]}; }
  [[nodiscard]] const double* x() const { return x_.data(); }
  [[nodiscard]] const double* y() const { return y_.data(); }
  [[nodiscard]] const double* z() const { return z_.data(); }

  // The nodes in unit space; the same arrays as above where that is plain space.
  [[nodiscard]] const double* unitX() const { return unit_[0]; }
  [[nodiscard]] const double* unitY() const { return unit_[1]; }
  [[nodiscard]] const double* unitZ() const { return unit_[2]; }
  [[nodiscard]] Vec3 unitPosition(LocalNode local) const {
    return {unit_[0][local], unit_[1][local], unit_[2][local]};
  }

  /// A position beside the gathered nodes for a node that does not exist yet; its local number is
  /// nodeCount().
  LocalNode setNewNode(const Vec3& position);

  /// No orient3d determinant over these nodes is wrong by more than this, however evaluated by
  /// three differences, a cross and a dot product.
  [[nodiscard]] double determinantError() const { return determinantError_; }

 private:
  class LocalNumbering;
  std::size_t dropFarFaces(const Front& front, const SearchRegion& region, std::size_t count);
  void reserve(std::size_t nodesOfFront, std::size_t faces);
  void boundErrors(const Vec3& reach);

  std::vector<std::uint32_t> found_;
  // The arrays only grow; what is in use is counted here, which spares a capacity check per entry.
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
  /// Local number of a node, valid where its stamp is the current one.
  struct Mark {
    std::uint32_t stamp = 0;
    LocalNode local = 0;
  };
  std::vector<Mark> marks_;
  std::uint32_t stamp_ = 0;
  double determinantError_ = 0.0;
};

}  // namespace tetrafront
