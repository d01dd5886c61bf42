#pragma once

/// @file The lower envelope of the cones h_i + growth |x - x_i|, evaluated by branch and bound over
/// a tree of boxes along a Morton curve. Visiting all nodes would dominate the run time on graded
/// surfaces. With negative h_i, it yields the negative of an upper envelope.
///
/// Single precision, relative to the centre and the extent of the sites: it halves the memory, and
/// its error is far below the slack.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Index of a site in the order of the Morton curve.
using SiteId = Id<struct SiteTag>;

class SizeSites {
 public:
  /// Ignores nodes of size 0; at least one other must exist. A result exceeds the true value by
  /// about the fraction `slack` of it, or of the size of its site if that is larger in magnitude.
  /// The work grows with 1 / slack.
  SizeSites(std::span<const Vec3> points, std::span<const double> sizes, double growth,
            float slack = kSlack);
  SizeSites(const SizeSites&) = delete;
  SizeSites& operator=(const SizeSites&) = delete;
  SizeSites(SizeSites&&) = default;
  SizeSites& operator=(SizeSites&&) = default;

  /// Sorts the sites; visits each thirteen times. Await it once, before any other call.
  Task<> build(Work& work, std::size_t visitsPerUnit);

  [[nodiscard]] double growth() const { return growth_; }
  [[nodiscard]] double sizeOf(SiteId site) const { return sites_[site.index()].size * extent_; }

  /// Index of the site among the given ones that are not ignored.
  [[nodiscard]] std::uint32_t givenIndexOf(SiteId site) const { return order_[site.index()]; }

  struct Value {
    double size = 0.0;
    SiteId site{0U};  ///< site of the lowest cone: a good guess for nearby positions
  };

  /// Returns min_i h_i + growth |x - x_i|, up to the slack. `guess` is any site; a far one costs
  /// more.
  [[nodiscard]] Value at(const Vec3& position, SiteId guess) const;

  /// Returns h_i + growth |x - x_i| of one site, an upper bound of the size at the position.
  [[nodiscard]] double coneAt(const Vec3& position, SiteId site) const;

  /// The same over a list of sites, exactly. O(n) for n sites of the list.
  [[nodiscard]] Value at(const Vec3& position, SiteId guess, std::span<const SiteId> list) const;

  /// An axis-parallel box.
  struct Range {
    Vec3 lower;
    Vec3 upper;
  };

  /// Puts the sites into `list` whose cones fall below `limit` in the range, and returns their
  /// minimum there, or `limit`. Stops with a list longer than `maxCount` if there are more.
  double collect(const Range& range, double limit, std::size_t maxCount,
                 std::vector<SiteId>& list) const;

  /// The same among the sites of a longer list.
  double collect(const Range& range, double limit, std::span<const SiteId> among,
                 std::vector<SiteId>& list) const;

  /// Returns the minimum in the range, or `limit` if that is less; up to the slack. `guess` is any
  /// site.
  [[nodiscard]] double minIn(const Range& range, double limit, SiteId guess) const;

 private:
  struct Site {
    std::array<float, 3> position;
    float size;
  };
  /// A box of positions, or one position.
  struct Reach {
    std::array<float, 3> low;
    std::array<float, 3> high;
  };
  /// The two child boxes of a node, contiguous: one cache line.
  struct alignas(64) Children {
    std::array<std::array<float, 2>, 3> low;
    std::array<std::array<float, 2>, 3> high;
    std::array<float, 2> size;      ///< smallest size in the box
    std::array<float, 2> diagonal;  ///< diagonal of the box
  };

  [[nodiscard]] std::array<float, 3> inward(const Vec3& position) const;
  [[nodiscard]] Reach inward(const Range& range) const;
  [[nodiscard]] float inward(double size) const { return static_cast<float>(size / extent_); }
  [[nodiscard]] float cone(SiteId site, const Reach& reach) const;
  [[nodiscard]] float toleranceOf(float value, SiteId site) const;
  void improve(const Reach& reach, float& best, SiteId& site) const;
  [[nodiscard]] bool liesBelow(float size, float squaredDistance, float limit) const;
  void beginTree(std::size_t count);
  void addSite(std::uint32_t given);
  void include(std::size_t node, const Reach& reach, float size, SiteId site);
  void join(std::size_t node);
  template <class Visit>
  void visitBoxes(const Reach& reach, const float& limit, const float& merge, Visit visit) const;

  static constexpr float kSlack = 0.03F;
  static constexpr std::uint32_t kSitesPerLeaf = 8;

  /// Relative gain below which a branch is not opened. It bounds the work at positions equally far
  /// from everything, such as the centre of a sphere. If the cones of a branch differ by less than
  /// this at the position, the site of smallest size stands for all of them.
  float slack_;
  double growth_;
  float squaredGrowth_;
  Vec3 centre_{0.0};
  double extent_ = 1.0;
  std::vector<Site> sites_;
  std::vector<std::uint32_t> order_;  ///< per site: its index among the given ones
  /// Children of the inner nodes of a complete binary tree; the children of node n are 2n+1 and
  /// 2n+2.
  std::vector<Children> children_;
  std::vector<SiteId> smallest_;  ///< per node of the tree: site of smallest size
  std::uint32_t firstLeaf_ = 0;

  /// Data needed only while the tree is built.
  struct Building {
    std::vector<Vec3> positions;
    std::vector<double> sizes;
    std::vector<Reach> boxes;     ///< per node of the tree
    std::vector<float> smallest;  ///< per node of the tree: smallest size
  };
  Building building_;
};

}  // namespace tetrafront
