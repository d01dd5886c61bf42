#pragma once

/// @file Fills a SizeOctree in slices. Cells are split depth first. Every cell arrives with the
/// values at its corners; a split adds the 18 places between them and the centre. Small cells hand
/// down the list of the cones that reach them.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "field/size_octree.h"
#include "field/size_sites.h"
#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// The least sizes that a front can make beside places of a surface whose edges have length h_i:
///
///     max_i h_i - descent |x - x_i|.
///
/// A front cannot follow a jump.
struct SizeDescent {
  double descent = 0.0;  ///< per unit of distance, > 0
  double least = 0.0;    ///< below this nobody asks: values there need not be exact
};

class SizeOctreeBuilder {
 public:
  /// Arguments as of SizeOctree; they need not outlive the call. O(triangles log triangles).
  SizeOctreeBuilder(std::span<const Vec3> points, std::span<const std::uint32_t> triangles,
                    double growth, double cap);

  /// The same for edges as long as given at each point; `cap` > 0.
  SizeOctreeBuilder(std::span<const Vec3> points, std::span<const double> lengths, double growth,
                    double cap);

  /// The least sizes beside places with edges of those lengths, > 0. O(n log n): away from them a
  /// cell is a share of their edges.
  SizeOctreeBuilder(std::span<const Vec3> places, std::span<const double> lengths,
                    const SizeDescent& rule);

  // Frames point to lists in here.
  SizeOctreeBuilder(const SizeOctreeBuilder&) = delete;
  SizeOctreeBuilder& operator=(const SizeOctreeBuilder&) = delete;

  /// Works on for about `budget` cells, of which there are up to two or three per triangle; true
  /// when finished.
  bool advance(std::uint32_t budget);

  /// The finished tree; once, after advance() has returned true.
  [[nodiscard]] SizeOctree take();

 private:
  using Value = SizeSites::Value;
  using List = std::vector<std::uint32_t>;
  struct Cell {
    std::uint32_t node = 0;
    int level = 0;
    Vec3 lower{0.0};
    std::array<Value, 8> corners;
  };
  /// The children of a cell that was split. `reaching`: the cones that reach it, or null if they
  /// are too many.
  struct Frame {
    std::array<Cell, 8> children;
    std::size_t next = 0;
    const List* reaching = nullptr;
  };
  /// What is known of the field in a cell.
  struct Extremes {
    double least = 0.0;   ///< of the samples, or in the whole cell
    double most = 0.0;    ///< an upper bound
    double lowest = 0.0;  ///< of the samples
    double bend = 0.0;    ///< how far the centre is from the mean of the corners

    [[nodiscard]] Extremes loweredTo(double size) const {
      return {std::min(least, size), most, lowest, bend};
    }
  };

  void growFrom(std::span<const Vec3> points, std::span<const double> sizes, double growth,
                double cap);
  void placeRoot(std::span<const Vec3> points, std::span<const double> sizes);
  void refineRoot();
  void refine(const Cell& cell, const List* reaching);
  void split(const Cell& cell, const Value& centre, const List* reaching);
  void close(const Cell& cell);
  [[nodiscard]] double width(int level) const;
  [[nodiscard]] Value sample(const Vec3& place, std::uint32_t guess, const List* reaching) const;
  [[nodiscard]] Extremes extremesAt(const Cell& cell, double middle) const;
  [[nodiscard]] bool descentIsFine(const Cell& cell, const Value& centre) const;
  [[nodiscard]] double estimatedReach(const Value& nearest, double most) const;
  static bool isFine(double width, const Extremes& sizes);
  /// What the tree is to hold.
  [[nodiscard]] double held(const Value& value) const {
    return rule_ ? -value.size : std::min(value.size, tree_.cap_);
  }
  /// The length of edges at the site.
  [[nodiscard]] double lengthAt(std::uint32_t site) const {
    return rule_ ? -sites_->sizeOf(site) : sites_->sizeOf(site);
  }

  SizeOctree tree_;
  std::optional<SizeSites> sites_;
  std::optional<SizeDescent> rule_;
  double edge_ = 0.0;
  bool hasBegun_ = false;
  std::vector<Frame> open_;
  std::array<List, SizeOctree::kMaxLevel + 1> lists_;  ///< of the cells being split, by level
};

/// h_i of SizeOctree: the mean length of the edges at each node, averaged twice (half its own
/// value, half the mean of its neighbours'); 0 at nodes of no triangle. `views`: edges are as long as
/// the views of their nodes make them; empty: as they are.
[[nodiscard]] std::vector<double> averagedEdgeLengths(std::span<const Vec3> points,
                                                      std::span<const std::uint32_t> triangles,
                                                      std::span<const SymmetricTensor> views = {});

}  // namespace tetrafront
