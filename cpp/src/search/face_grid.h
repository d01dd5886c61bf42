#pragma once

/// @file Finds the faces of the front near a box. A loose hash grid with one level per power of two
/// of the face's extent: a face is stored in the cell of its centre, on the level whose cells are
/// at least as large as the face. A query visits the cells that its box touches when enlarged by
/// half a cell. Serves steps F5.2 and F5.3 together: the faces are the obstacles, and their nodes
/// are the candidates. It replaces the paper's octree, which needs 8 to 14 dependent loads per
/// query; this grid needs about ten independent ones (docs/DESIGN.md, choices).
///
/// Layout: hash of a block of 4 x 4 x 4 cells -> occupancy mask and 64 list heads -> chunks of four
/// faces with their boxes, so that a query touches few cache lines. A cell holds about two faces,
/// and a chunk takes two lines.

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "geom/box.h"
#include "search/box_overlap.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class FaceGrid {
 public:
  /// `baseSize`: typical extent of a face; any positive value is correct. Keys are relative to
  /// `origin`.
  FaceGrid(double baseSize, const Vec3& origin);

  /// O(1). `face` must not be in the grid.
  void insert(std::uint32_t face, const Box& box);

  /// O(1). `face` must be in the grid.
  void remove(std::uint32_t face);

  /// Gives a face that is in the grid another box. O(1); faster than removing and inserting if the face moves little.
  void update(std::uint32_t face, const Box& box);

  /// Writes the faces whose boxes overlap `box` to `faces`, which only grows, and returns their
  /// number. The order depends on the sequence of calls, never on addresses.
  std::size_t query(const Box& box, std::vector<std::uint32_t>& faces) const;

 private:
  static constexpr int kLevels = 64;
  static constexpr int kBaseLevel = 32;

  struct alignas(64) Chunk {
    BoxQuad boxes;
    std::uint32_t count = 0;
    std::uint32_t next = kNoIndex;
  };
  struct Block {
    std::uint64_t key;
    std::uint64_t occupied;
    std::array<std::uint32_t, 64> heads;
  };
  struct HashEntry {
    std::uint64_t key;
    std::uint32_t block;
  };
  /// Where a face is stored.
  struct Slot {
    std::uint32_t chunk;
    std::uint32_t blockAndCell;
    std::uint8_t entry;  ///< in the chunk
    std::uint8_t level;
  };
  /// Cells per axis, inclusive.
  struct CellRange {
    std::array<std::int32_t, 3> from;
    std::array<std::int32_t, 3> to;
  };

  [[nodiscard]] int levelOf(const Box& box) const;
  /// Returns the cell of the centre.
  [[nodiscard]] std::array<std::int32_t, 3> cellOf(const Box& box, int level) const;
  [[nodiscard]] std::int32_t cellCoordinate(double value, int axis, int level) const;
  [[nodiscard]] std::uint32_t findBlock(std::uint64_t key) const;
  std::uint32_t findOrMakeBlock(int level, std::uint64_t key);
  void growTable();
  // These write the faces they find, beginning at `end`, and return the new end.
  std::uint32_t* queryLevel(int level, const Box& box, std::uint32_t* end) const;
  std::uint32_t* queryWholeLevel(int level, const CellRange& cells, const BoxOverlap& overlap,
                                 std::uint32_t* end) const;
  std::uint32_t* queryBlock(const Block& block, const CellRange& cells, std::int32_t x,
                            std::int32_t y, std::int32_t z, const BoxOverlap& overlap,
                            std::uint32_t* end) const;
  std::uint32_t* queryChunks(std::uint32_t chunk, const BoxOverlap& overlap,
                             std::uint32_t* end) const;

  double baseSize_;
  Vec3 origin_;
  std::array<double, kLevels> cellSize_{};
  std::array<double, kLevels> inverseCellSize_{};
  std::array<std::uint32_t, kLevels> facesOnLevel_{};
  std::size_t faceCount_ = 0;
  std::array<std::vector<std::uint32_t>, kLevels> blocksOnLevel_;
  std::vector<HashEntry> table_;
  std::uint32_t usedEntries_ = 0;
  std::vector<Block> blocks_;
  std::vector<Chunk> chunks_;
  std::vector<std::uint32_t> freeChunks_;
  std::vector<Slot> slots_;
};

}  // namespace tetrafront
