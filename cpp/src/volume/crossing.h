#pragma once

/// @file Tests whether a new element crosses a given face (Löhner & Parikh 1988, section 6,
/// "Checking the intersection of faces"). The paper's test has three layers, each about ten times
/// as expensive as the previous one:
///
/// (a) boxes, eq. (7): done when the neighbourhood is gathered;
/// (b) local element coordinates: a face whose nodes all lie outside one plane of the element cannot cross it;
/// (c) the analysis of the faces that are left.
///
/// In (c), the paper intersects sides with faces within a tolerance, eq. (1) to (5). Here (c) uses exact signs only, by
/// the number of nodes that face and element share:
///
///   3  the face is one of the element's: no crossing
///   2  common edge: crossing iff the third node is in the element's wedge at the edge
///   1  common node: crossing iff a node of the face is in the element's cone at the common node, or the
///      face's sector cuts a face of the cone
///   0  crossing iff they have any point in common
///
/// Touching counts as crossing, except in the shared nodes and edges.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"
#include "volume/neighbourhood.h"

namespace tetrafront {

class CrossingTest {
 public:
  /// Work done, for comparison with the paper's statistics.
  struct Counters {
    std::uint64_t facesTested = 0;
    std::uint64_t facesAnalysed = 0;
  };

  /// Without `filters`, layer (b) and the sign filter in doubles are skipped: all gathered faces
  /// are analysed by orient3d alone. The answers are the same.
  CrossingTest(const Neighbourhood& around, bool filters) : around_(around), filters_(filters) {}

  /// Prepares for the base face, nodes 0 1 2 of the neighbourhood. Call it after each gather().
  void setBase();

  /// Prepares for the element of base and apex, which must have positive volume.
  void setApex(LocalNode apex);

  /// Returns true only if the node is strictly behind the base face and therefore cannot be its
  /// apex.
  [[nodiscard]] bool isBehindBase(LocalNode node) const {
    return (baseMask_[node] & kBaseBit) != 0;
  }

  /// Returns the exact sign of the volume of base and apex.
  [[nodiscard]] int volumeSign(LocalNode apex) const;

  /// Returns the first gathered face that the element crosses; none if it crosses no face.
  [[nodiscard]] FaceId firstCrossedFace();

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  static constexpr std::uint8_t kBaseBit = 8;
  /// Per node of a face: the corner of the element that it is, or kNotShared.
  static constexpr int kNotShared = -1;
  using Shared = std::array<int, 3>;
  using Signs = std::array<int, 4>;

  void maskNodes();
  [[nodiscard]] bool crosses(const LocalTriple& face) const;
  [[nodiscard]] bool crossesAtEdge(const LocalTriple& face, const Shared& shared) const;
  [[nodiscard]] bool crossesAtNode(const LocalTriple& face, int faceCorner, int elementCorner,
                                   const Signs& corners) const;
  [[nodiscard]] bool crossesApart(const LocalTriple& face, const Signs& corners) const;
  [[nodiscard]] bool sectorsOverlap(LocalNode v, LocalNode w, int centre, int offPlane,
                                    const std::array<int, 2>& rays) const;
  [[nodiscard]] bool segmentIntersectsTriangle(LocalNode from, LocalNode to,
                                               const LocalTriple& triangle) const;
  /// Signs of the element's corners relative to the face's plane; 0 for shared corners.
  [[nodiscard]] Signs cornerSigns(const LocalTriple& face, const Shared& shared) const;
  /// Exact sign of a node relative to plane `plane` of the element, the one opposite that corner;
  /// +1 on the element's side.
  [[nodiscard]] int faceSign(int plane, LocalNode node) const;
  [[nodiscard]] int orient(LocalNode a, LocalNode b, LocalNode c, LocalNode d) const;

  /// Returns the sign of a determinant over gathered nodes if its double value proves it, else 0.
  [[nodiscard]] int provenSign(double determinant) const;

  const Neighbourhood& around_;
  bool filters_;
  std::array<LocalNode, 4> corners_{0, 1, 2, 0};
  std::array<Vec3, 4> normals_;  ///< of the element's planes, inward
  std::vector<std::uint8_t> baseMask_;
  /// Bit i: strictly outside plane i. Corners count as outside of the planes that contain them.
  std::vector<std::uint8_t> mask_;
  Counters counters_;
};

}  // namespace tetrafront
