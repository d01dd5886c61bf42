#pragma once

/// @file Cells of nested grids that the pieces of a surface lie in.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "remesh/reference_surface.h"

namespace tetrafront {

/// Sorts the pieces of a surface by a key and by the cells of their centroids. The cells of the last level have a given width,
/// those of each other level are twice as wide as those of the next.
class PieceCells {
 public:
  static constexpr std::uint32_t kLevels = 5;

  /// Where a piece is, in few bytes, because sorting takes most of the time.
  struct Slot {
    std::uint64_t keyAndX = 0;  ///< key, and a coordinate of the widest cell
    std::uint64_t yAndZ = 0;    ///< the other coordinates of the widest cell
    std::uint32_t inner = 0;    ///< the smaller cells in the widest one, three bits per level
    std::uint32_t piece = 0;
    double rank = 0.0;
  };

  /// `reference` must outlive this. `width`: of the narrowest cells, > 0; at least 2^-31 of the diagonal is taken. O(pieces).
  PieceCells(const ReferenceSurface& reference, double width);

  [[nodiscard]] double widthAt(std::uint32_t level) const {
    return static_cast<double>(1U << (kLevels - 1 - level)) * width_;
  }
  /// Returns the slot of a piece in the order of keys.
  [[nodiscard]] Slot slotOf(std::uint32_t piece, std::uint32_t key, double rank) const;
  /// Sorts by key, cell of each level, and decreasing rank. O(n log n).
  static void sort(std::vector<Slot>& slots);
  /// Returns the first level at which the slots have different cells, or keys; kLevels if there is none.
  [[nodiscard]] static std::uint32_t levelOfDifference(const Slot& a, const Slot& b);
  /// Returns the end of the slots that have the cell of the first one at a level. O(their number).
  [[nodiscard]] static std::size_t endOfCell(std::span<const Slot> slots, std::size_t first,
                                             std::uint32_t level);

 private:
  using Cell = std::array<std::int64_t, 3>;
  [[nodiscard]] Cell cellOf(const ReferenceSurface::Piece& piece) const;

  const ReferenceSurface& reference_;
  double width_;
  Cell lowest_{};  ///< of the widest cells
};

}  // namespace tetrafront
