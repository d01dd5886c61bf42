#pragma once

/// @file Does a new element break a given face? (Löhner & Parikh 1988, section 6, "Checking the
/// intersection of faces".) Their three layers, each some ten times dearer than the one before:
/// (a) boxes, done when the neighbourhood is gathered; (b) local element co-ordinates: a face
/// whose nodes all lie outside one side of the element cannot cross it; (c) the analysis of what
/// is left. Where they use tolerances, (c) here decides by exact signs alone, by how many nodes
/// face and element share:
///
///   3  the face is a side of the element; no crossing
///   2  they turn about a common edge: crossing iff the third node is in the element's wedge there
///   1  cones at the common node: crossing iff a node of the face is in the element's cone, or the
///      face's sector cuts a side of the cone
///   0  crossing iff they have any point in common
///
/// Touching counts as crossing, except in what is shared.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"
#include "volume/neighbourhood.h"

namespace tetrafront {

class CrossingTest {
 public:
  /// Work done, for the statistics the paper gives.
  struct Counters {
    std::uint64_t facesTested = 0;
    std::uint64_t facesAnalysed = 0;
  };

  /// Without `filters`, layer (b) and its counterpart on single signs are left out: all gathered
  /// faces are analysed, by orient3d alone. The answers are the same.
  CrossingTest(const Neighbourhood& around, bool filters) : around_(around), filters_(filters) {}

  /// Fixes the base face (nodes 0 1 2 of the neighbourhood). Once per gathered neighbourhood.
  void setBase();

  /// Fixes the fourth node of the element. The element must have positive volume.
  void setApex(LocalNode apex);

  /// Strictly behind the base face: no apex.
  [[nodiscard]] bool isBehindBase(LocalNode node) const {
    return (baseMask_[node] & kBaseBit) != 0;
  }

  /// Exact sign of the volume of base and apex.
  [[nodiscard]] int volumeSign(LocalNode apex) const;

  /// The first gathered face that the element crosses, or kNoFace.
  static constexpr std::size_t kNoFace = static_cast<std::size_t>(-1);
  [[nodiscard]] std::size_t firstCrossedFace();

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  static constexpr std::uint8_t kBaseBit = 8;
  /// Nodes face and element share: position in the element of each face node, or kNotShared.
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
  /// Signs of the element's corners against the face's plane; shared ones are 0.
  [[nodiscard]] Signs cornerSigns(const LocalTriple& face, const Shared& shared) const;
  /// +1 on the element's side of its side `side` (opposite corner `side`), exact.
  [[nodiscard]] int faceSign(int side, LocalNode node) const;
  [[nodiscard]] int orient(LocalNode a, LocalNode b, LocalNode c, LocalNode d) const;

  /// The sign of a determinant over gathered nodes, where its double proves it; else 0.
  [[nodiscard]] int provenSign(double determinant) const;

  const Neighbourhood& around_;
  bool filters_;
  std::array<LocalNode, 4> corners_{0, 1, 2, 0};
  std::array<Vec3, 4> normals_;  ///< inward, of the element's sides
  std::vector<std::uint8_t> baseMask_;
  /// Bit i: strictly outside side i; corners count as outside of the sides that hold them.
  std::vector<std::uint8_t> mask_;
  Counters counters_;
};

}  // namespace tetrafront
