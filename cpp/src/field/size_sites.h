#pragma once

/// @file The lower envelope of cones h_i + growth |x - x_i|, evaluated by branch and bound over a
/// tree of boxes along a Morton curve. Brute force over all nodes would dominate everything else
/// on graded surfaces.

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

class SizeSites {
 public:
  /// Nodes whose size is 0 are left out. At least one size must be > 0.
  SizeSites(std::span<const Vec3> points, std::span<const double> sizes, double growth);

  [[nodiscard]] double growth() const { return growth_; }
  [[nodiscard]] double sizeOf(std::uint32_t site) const { return sites_[site].size; }

  struct Value {
    double size = 0.0;
    std::uint32_t site = 0;  ///< which cone is lowest: a good first guess for places nearby
  };

  /// min_i h_i + growth |x - x_i|, at most kSlack + kMerge above the true minimum. `guess` is any site.
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

  /// The least value in the range, or `limit` if that is less; at most kSlack too high.
  [[nodiscard]] double leastIn(const Range& range, double limit) const;

 private:
  struct Site {
    Vec3 place;
    double size;
  };
  struct Box {
    Vec3 lower;
    Vec3 upper;
    double size;         ///< smallest below
    double diagonal;     ///< of the box
    std::uint32_t site;  ///< one with that size
  };

  [[nodiscard]] double cone(std::uint32_t site, const Vec3& place) const;
  [[nodiscard]] double cone(std::uint32_t site, const Range& range) const;
  [[nodiscard]] bool liesBelow(double size, double squaredDistance, double limit) const;
  [[nodiscard]] double squaredDistance(std::uint32_t box, const Range& range) const;
  void buildBoxes();

  /// A branch is not opened for less than this relative gain. Bounds the work at places that are
  /// equally far from everything, such as the centre of a sphere.
  static constexpr double kSlack = 0.03;
  /// Nor is one whose sites agree this well, seen from so far: its smallest stands for all.
  static constexpr double kMerge = 0.03;
  static constexpr std::uint32_t kSitesPerLeaf = 8;

  double growth_;
  std::vector<Site> sites_;
  std::vector<Box> boxes_;  ///< a complete binary tree: children of b are 2b+1 and 2b+2
  std::uint32_t firstLeaf_ = 0;

  template <class Visit>
  void visitBoxes(const Range& range, const double& limit, const double& merge, Visit visit) const;
};

}  // namespace tetrafront
