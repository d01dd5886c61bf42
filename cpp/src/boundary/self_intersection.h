#pragma once

/// @file Every pair of triangles that meet where they should not, by the exact test of
/// geom/intersect.h. Pairs without a common node are found by their boxes (triangle_pairs.h), those
/// with one among the triangles at that node: of the thousands of needles around the tip of a cone
/// every two have boxes that meet, but few look into the same direction.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "search/box_tree.h"
#include "search/incidence.h"
#include "boundary/boundary_report.h"
#include "boundary/triangle_pairs.h"

namespace tetrafront {

/// In slices. O(n log n) for surfaces whose triangles have few others near them. Of surfaces that meet
/// themselves in more places than kMaxFound, and than the report lists, about so many are found, and the
/// report says that there may be more.
class SelfIntersectionCheck {
 public:
  /// Triangles flagged in `ignored` take no part. `tree`: of triangleBoxes(). Everything must outlive
  /// this.
  SelfIntersectionCheck(const SurfaceMesh& mesh, std::span<const std::uint8_t> ignored,
                        const BoxTree& tree, BoundaryReport& report);

  /// Goes on for what costs about as much as `budget` triangles; true when finished and reported, in the
  /// triangles' order.
  bool advance(std::uint32_t budget);

  [[nodiscard]] double fraction() const;

 private:
  /// After so many findings the rest would only cost time: some surfaces meet themselves in as
  /// many places as there are pairs.
  static constexpr std::size_t kMaxFound = 100000;
  /// Up to so many triangles at a node are tested each against each.
  static constexpr std::size_t kFew = 16;

  enum class Stage : std::uint8_t { kCount, kList, kNodes, kPairs, kReport };

  [[nodiscard]] bool hasFoundEnough() const {
    return found_.size() >= std::max(kMaxFound, report_.maxDiagnostics());
  }
  /// Finds who stands at each node; true when finished.
  bool listTriangles(std::uint32_t budget);
  bool testNodes(std::uint32_t budget);
  /// Of the triangles at the node; returns how many it took.
  std::uint32_t testFew();
  std::uint32_t testMany(std::uint32_t budget);
  void testOnce(std::uint32_t a, std::uint32_t b);
  void testPair(std::uint32_t a, std::uint32_t b);
  bool report(std::uint32_t budget);

  const SurfaceMesh& mesh_;
  std::span<const std::uint8_t> ignored_;
  BoundaryReport& report_;
  Stage stage_ = Stage::kCount;
  std::uint32_t next_ = 0;  ///< corner, node or entry of the stage
  Incidence atNode_;
  /// The triangles at a node with many by the directions in which they are seen from it.
  struct Directions {
    explicit Directions(std::vector<Box> seen) : boxes(std::move(seen)), tree(boxes) {}

    std::vector<Box> boxes;
    BoxTree tree;
    std::uint32_t next = 0;
  };
  std::optional<Directions> directions_;
  TrianglePairs pairs_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found_;  ///< lower triangle first
};

/// The box of each triangle.
[[nodiscard]] std::vector<Box> triangleBoxes(const SurfaceMesh& mesh);

}  // namespace tetrafront
