#pragma once

/// @file The lower envelope of cones h_i + growth |x - x_i|, evaluated by branch and bound over a
/// tree of boxes along a Morton curve. Brute force over all nodes would dominate everything else
/// on graded surfaces. With all h_i negative it is an upper envelope turned over.
///
/// Single precision, relative to the centre and the extent of the sites: half the memory, and
/// its error is far below the slack that is granted anyway.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "search/morton.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class SizeSites {
 public:
  /// Nodes whose size is 0 are left out; at least one must not be. No value will be above the true one by
  /// much more than the share `slack` of it, or of the size of the site it comes from if that is
  /// further from 0; work grows with the inverse.
  SizeSites(std::span<const Vec3> points, std::span<const double> sizes, double growth,
            float slack = kSlack);
  SizeSites(const SizeSites&) = delete;
  SizeSites& operator=(const SizeSites&) = delete;

  /// Puts `budget` sites in order, each of which is come to thirteen times; true when all are. Nothing
  /// else may be asked before.
  bool advance(std::size_t budget);

  [[nodiscard]] double growth() const { return growth_; }
  [[nodiscard]] double sizeOf(std::uint32_t site) const { return sites_[site].size * extent_; }

  struct Value {
    double size = 0.0;
    std::uint32_t site = 0;  ///< which cone is lowest: a good first guess for places nearby
  };

  /// min_i h_i + growth |x - x_i|, up to the slack. `guess` is any site; a far one costs more.
  [[nodiscard]] Value at(const Vec3& place, std::uint32_t guess) const;

  /// The same over a list of sites, exactly. One step per site.
  [[nodiscard]] Value at(const Vec3& place, std::uint32_t guess,
                         std::span<const std::uint32_t> list) const;

  /// An axis-parallel box.
  struct Range {
    Vec3 lower;
    Vec3 upper;
  };

  /// Puts the sites into `list` whose cone falls below `limit` somewhere in the range, and returns
  /// the least value met there, or `limit`. Gives up, leaving the list longer than `maxCount`.
  double collect(const Range& range, double limit, std::size_t maxCount,
                 std::vector<std::uint32_t>& list) const;

  /// The same among the sites of a longer list.
  double collect(const Range& range, double limit, std::span<const std::uint32_t> among,
                 std::vector<std::uint32_t>& list) const;

  /// The least value in the range, or `limit` if that is less; up to the slack. `guess` is any site.
  [[nodiscard]] double leastIn(const Range& range, double limit, std::uint32_t guess) const;

 private:
  struct Site {
    std::array<float, 3> place;
    float size;
  };
  /// A box of places, or one place.
  struct Reach {
    std::array<float, 3> low;
    std::array<float, 3> high;
  };
  /// The two boxes below a node of the tree, side by side: one cache line.
  struct alignas(64) Children {
    std::array<std::array<float, 2>, 3> low;
    std::array<std::array<float, 2>, 3> high;
    std::array<float, 2> size;      ///< smallest in the box
    std::array<float, 2> diagonal;  ///< of the box
  };

  [[nodiscard]] std::array<float, 3> inward(const Vec3& place) const;
  [[nodiscard]] Reach inward(const Range& range) const;
  [[nodiscard]] float inward(double size) const { return static_cast<float>(size / extent_); }
  [[nodiscard]] float cone(std::uint32_t site, const Reach& reach) const;
  [[nodiscard]] float toleranceOf(float value, std::uint32_t site) const;
  void improve(const Reach& reach, float& best, std::uint32_t& site) const;
  [[nodiscard]] bool liesBelow(float size, float squaredDistance, float limit) const;
  void beginTree();
  void takeSites(std::size_t first, std::size_t last);
  void include(std::size_t node, const Reach& reach, float size, std::uint32_t site);
  void join(std::size_t node);
  template <class Visit>
  void visitBoxes(const Reach& reach, const float& limit, const float& merge, Visit visit) const;

  static constexpr float kSlack = 0.03F;
  static constexpr std::uint32_t kSitesPerLeaf = 8;

  /// A branch is not opened for less than this gain, as a share. Bounds the work at places that are
  /// equally far from everything, such as the centre of a sphere. Nor is one whose sites agree this
  /// well, seen from so far: its smallest stands for all.
  float slack_;
  double growth_;
  float squaredGrowth_;
  Vec3 centre_{0.0};
  double extent_ = 1.0;
  std::vector<Site> sites_;
  /// Of the inner nodes of a complete binary tree; the children of node n are 2n+1 and 2n+2.
  std::vector<Children> children_;
  std::vector<std::uint32_t> smallest_;  ///< per node of the tree: its site with the smallest size
  std::uint32_t firstLeaf_ = 0;

  enum class Stage : std::uint8_t { kSort, kTake, kJoin, kReady };
  /// What is needed until the tree stands.
  struct Building {
    std::vector<Vec3> places;
    std::vector<double> sizes;
    std::optional<MortonSort> sort;
    std::vector<std::uint32_t> order;
    std::size_t next = 0;
    std::vector<Reach> boxes;     ///< per node of the tree
    std::vector<float> smallest;  ///< per node of the tree: the size of its smallest site
  };
  Stage stage_ = Stage::kSort;
  Building building_;
};

}  // namespace tetrafront
