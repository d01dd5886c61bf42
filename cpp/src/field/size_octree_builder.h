#pragma once

/// @file Builds a SizeOctree in slices, depth first. A cell starts with the values at its corners;
/// splitting it evaluates the centre and the 18 positions between the corners. Small cells pass on
/// the list of the cones that can reach them.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/task.h"
#include "field/size_octree.h"
#include "field/size_sites.h"
#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// The smallest sizes that a front can make near a surface with edges of length h_i at x_i:
///
///     max_i h_i - descent |x - x_i|.
///
/// A front cannot follow a jump of the size.
struct SizeDescent {
  double descent = 0.0;  ///< decrease per unit of distance, > 0
  double minSize = 0.0;  ///< smaller values are not used and need not be exact
};

class SizeOctreeBuilder {
 public:
  /// Parameters as of SizeOctree; they need not outlive the call. O(n log n) for n triangles.
  SizeOctreeBuilder(std::span<const Vec3> points, std::span<const std::uint32_t> triangles,
                    double growth, double cap);

  /// The same with a given edge length at each point; `cap` > 0.
  SizeOctreeBuilder(std::span<const Vec3> points, std::span<const double> lengths, double growth,
                    double cap);

  /// The smallest sizes near positions with edges of these lengths, > 0. O(n log n): away from the
  /// positions, the width of a cell is a fraction of their edge lengths.
  SizeOctreeBuilder(std::span<const Vec3> positions, std::span<const double> lengths,
                    const SizeDescent& rule);

  // Frames point to lists in this object, so it cannot be copied or moved.
  SizeOctreeBuilder(const SizeOctreeBuilder&) = delete;
  SizeOctreeBuilder& operator=(const SizeOctreeBuilder&) = delete;

  /// Visits about `budget` cells; returns true when finished. There are up to three cells per
  /// triangle.
  bool advance(std::uint32_t budget) { return job_.advance(budget); }

  /// Returns the tree, once, after advance() has returned true.
  [[nodiscard]] SizeOctree take();

 private:
  using Value = SizeSites::Value;
  using List = std::vector<SiteId>;
  struct Cell {
    std::uint32_t node = 0;
    int level = 0;
    Vec3 lower{0.0};
    std::array<Value, 8> corners;
  };
  /// The children of a split cell. `reaching`: the cones that reach the cell, or null if there are
  /// too many.
  struct Frame {
    std::array<Cell, 8> children;
    std::size_t next = 0;
    const List* reaching = nullptr;
  };
  /// Known bounds of the field in a cell.
  struct Extremes {
    double min = 0.0;         ///< minimum over the samples, or over the whole cell
    double max = 0.0;         ///< upper bound
    double sampledMin = 0.0;  ///< minimum over the samples
    double bend = 0.0;        ///< difference between the centre and the mean of the corners

    [[nodiscard]] Extremes loweredTo(double size) const {
      return {std::min(min, size), max, sampledMin, bend};
    }
  };

  Task<> build(Work& work);
  void growFrom(std::span<const Vec3> points, std::span<const double> sizes, double growth,
                double cap);
  void placeRoot(std::span<const Vec3> points, std::span<const double> sizes);
  void refineRoot();
  void refine(const Cell& cell, const List* reaching);
  void split(const Cell& cell, const Value& centre, const List* reaching);
  void close(const Cell& cell);
  [[nodiscard]] double width(int level) const;
  [[nodiscard]] Value sample(const Vec3& position, SiteId guess, const List* reaching) const;
  [[nodiscard]] Extremes extremesAt(const Cell& cell, double middle) const;
  [[nodiscard]] bool descentIsFine(const Cell& cell, const Value& centre) const;
  [[nodiscard]] double estimatedReach(const Value& nearest, double limit) const;
  static bool isFine(double width, const Extremes& sizes);
  /// Returns the value to store in the tree.
  [[nodiscard]] double stored(const Value& value) const {
    return rule_ ? -value.size : std::min(value.size, tree_.cap_);
  }
  /// Returns the edge length at the site.
  [[nodiscard]] double lengthAt(SiteId site) const {
    return rule_ ? -sites_->sizeOf(site) : sites_->sizeOf(site);
  }

  SizeOctree tree_;
  std::optional<SizeSites> sites_;
  std::optional<SizeDescent> rule_;
  double edge_ = 0.0;
  std::vector<Frame> open_;
  std::array<List, SizeOctree::kMaxLevel + 1> lists_;  ///< lists of the cells being split, by level
  Job<> job_{[this](Work& work) { return build(work); }};  ///< the last: it uses the others
};

/// Returns h_i of SizeOctree: the mean edge length at each node, averaged twice (half its own
/// value, half the mean of its neighbours); 0 at nodes without triangles. Edges are measured with
/// `views`, one tensor per node; in space if it is empty.
[[nodiscard]] std::vector<double> averagedEdgeLengths(std::span<const Vec3> points,
                                                      std::span<const std::uint32_t> triangles,
                                                      std::span<const SymmetricTensor> views = {});

}  // namespace tetrafront
