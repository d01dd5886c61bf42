#pragma once

/// @file Fills a SizeOctree in slices. Cells are split depth first. Every cell arrives with the
/// values at its corners; a split adds the 18 places between them and the centre. Small cells hand
/// down the list of the cones that reach them.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "field/size_octree.h"
#include "field/size_sites.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class SizeOctreeBuilder {
 public:
  /// Arguments as of SizeOctree; they need not outlive the call. O(triangles log triangles).
  SizeOctreeBuilder(std::span<const Vec3> points, std::span<const std::uint32_t> triangles,
                    double growth, double cap, double descent = 0.0);
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
    double least;   ///< of the samples, or in the whole cell
    double most;    ///< an upper bound
    double lowest;  ///< of the samples
    double bend;    ///< how far the centre is from the mean of the corners

    [[nodiscard]] Extremes loweredTo(double size) const {
      return {std::min(least, size), most, lowest, bend};
    }
  };

  void refineRoot();
  void refine(const Cell& cell, const List* reaching);
  void split(const Cell& cell, const Value& centre, const List* reaching);
  void close(const Cell& cell);
  [[nodiscard]] double width(int level) const;
  [[nodiscard]] Value sample(const Vec3& place, std::uint32_t guess, const List* reaching) const;
  [[nodiscard]] Extremes extremesAt(const Cell& cell, const Value& centre) const;
  [[nodiscard]] double estimatedReach(const Value& nearest, double most) const;
  static bool isFine(double width, const Extremes& sizes);
  /// `nearer`: for a place that much nearer to the site.
  [[nodiscard]] double limited(const Value& value, double nearer = 0.0) const;
  [[nodiscard]] bool descentIsFine(const Cell& cell, const Value& centre) const;

  SizeOctree tree_;
  std::optional<SizeSites> sites_;
  double descentPerGrowth_;  ///< 0: the field jumps to the cap at once
  double edge_ = 0.0;
  bool hasBegun_ = false;
  std::vector<Frame> open_;
  std::array<List, SizeOctree::kMaxLevel + 1> lists_;  ///< of the cells being split, by level
};

/// h_i of SizeOctree: the mean length of the edges at each node, averaged twice (half its own
/// value, half the mean of its neighbours'); 0 at nodes of no triangle.
[[nodiscard]] std::vector<double> averagedEdgeLengths(std::span<const Vec3> points,
                                                      std::span<const std::uint32_t> triangles);

}  // namespace tetrafront
