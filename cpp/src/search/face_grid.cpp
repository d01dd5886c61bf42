#include "search/face_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace tetrafront {
namespace {

constexpr std::int32_t kCellsPerBlock = 4;  // per axis
constexpr int kKeyBits = 19;                // per axis; coordinates that wrap share a block, which
constexpr std::uint64_t kKeyMask = (1U << kKeyBits) - 1;  // only costs box comparisons
constexpr std::size_t kInitialTable = 256;

/// Per axis: bits of the cells of a block whose coordinate is in [from, to].
struct RangeMasks {
  std::uint64_t mask[3][kCellsPerBlock][kCellsPerBlock] = {};

  constexpr RangeMasks() {
    for (int from = 0; from < kCellsPerBlock; ++from) {
      for (int to = from; to < kCellsPerBlock; ++to) {
        for (int cell = 0; cell < 64; ++cell) {
          const int coordinate[3] = {cell / 16, cell / 4 % 4, cell % 4};
          for (int axis = 0; axis < 3; ++axis) {
            if (coordinate[axis] >= from && coordinate[axis] <= to) {
              mask[axis][from][to] |= std::uint64_t{1} << cell;
            }
          }
        }
      }
    }
  }
};
constexpr RangeMasks kRangeMasks;

std::uint32_t cellInBlock(std::int32_t x, std::int32_t y, std::int32_t z) {
  return static_cast<std::uint32_t>((x & 3) * 16 + (y & 3) * 4 + (z & 3));
}

/// Returns the key of the block that contains the cell. The arithmetic shift rounds towards minus
/// infinity.
std::uint64_t blockKey(int level, std::int32_t x, std::int32_t y, std::int32_t z) {
  const auto part = [](std::int32_t cell) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(cell >> 2)) & kKeyMask;
  };
  return static_cast<std::uint64_t>(level) << (3 * kKeyBits) | part(x) << (2 * kKeyBits) |
         part(y) << kKeyBits | part(z);
}

/// Tests whether a block is between two cells, from its key, whose parts may wrap.
class BlockRange {
 public:
  BlockRange(const std::array<std::int32_t, 3>& from, const std::array<std::int32_t, 3>& to) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t first = from[axis] >> 2;
      first_[axis] = static_cast<std::uint64_t>(first) & kKeyMask;
      further_[axis] = static_cast<std::uint64_t>((to[axis] >> 2) - first);
    }
  }
  [[nodiscard]] bool mayHold(std::uint64_t key) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint64_t part = key >> ((2 - axis) * kKeyBits) & kKeyMask;
      if (((part - first_[axis]) & kKeyMask) > further_[axis]) return false;
    }
    return true;
  }

 private:
  std::array<std::uint64_t, 3> first_{};
  std::array<std::uint64_t, 3> further_{};
};

/// Multiplicative hash. Takes the high bits, because the low bits of the product do not depend on
/// x.
std::size_t slotOf(std::uint64_t key, std::size_t tableSize) {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;
  return static_cast<std::size_t>((key * kGolden) >> 32) & (tableSize - 1);
}

}  // namespace

FaceGrid::FaceGrid(double baseSize, const Vec3& origin)
    : baseSize_(baseSize), origin_(origin), table_(kInitialTable, HashEntry{0, kNoIndex}) {
  double size = baseSize;
  for (int level = kBaseLevel; level < kLevels; ++level, size *= 2.0) cellSize_[level] = size;
  size = baseSize * 0.5;
  for (int level = kBaseLevel - 1; level >= 0; --level, size *= 0.5) cellSize_[level] = size;
  for (int level = 0; level < kLevels; ++level) inverseCellSize_[level] = 1.0 / cellSize_[level];
}

int FaceGrid::levelOf(const Box& box) const {
  int exponent = 0;
  std::frexp(static_cast<double>(box.largestExtent()) / baseSize_, &exponent);
  return std::clamp(kBaseLevel + exponent, 0, kLevels - 1);
}

std::int32_t FaceGrid::cellCoordinate(double value, int axis, int level) const {
  constexpr double kLimit = 1 << 30;
  const double cell = std::floor((value - origin_[axis]) * inverseCellSize_[level]);
  return static_cast<std::int32_t>(std::clamp(cell, -kLimit, kLimit));
}

std::array<std::int32_t, 3> FaceGrid::cellOf(const Box& box, int level) const {
  std::array<std::int32_t, 3> cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const double centre =
        0.5 * (static_cast<double>(box.low[axis]) + static_cast<double>(box.high[axis]));
    cell[axis] = cellCoordinate(centre, axis, level);
  }
  return cell;
}

std::uint32_t FaceGrid::findBlock(std::uint64_t key) const {
  std::size_t slot = slotOf(key, table_.size());
  while (table_[slot].block != kNoIndex) {
    if (table_[slot].key == key) return table_[slot].block;
    slot = (slot + 1) & (table_.size() - 1);
  }
  return kNoIndex;
}

std::uint32_t FaceGrid::findOrMakeBlock(int level, std::uint64_t key) {
  const std::uint32_t found = findBlock(key);
  if (found != kNoIndex) return found;
  if (2 * (usedEntries_ + 1) > table_.size()) growTable();
  std::size_t slot = slotOf(key, table_.size());
  while (table_[slot].block != kNoIndex) slot = (slot + 1) & (table_.size() - 1);
  const auto block = static_cast<std::uint32_t>(blocks_.size());
  blocks_.emplace_back();
  blocks_.back().key = key;
  blocks_.back().occupied = 0;
  blocks_.back().heads.fill(kNoIndex);
  blocksOnLevel_[level].push_back(block);
  table_[slot] = {key, block};
  ++usedEntries_;
  return block;
}

void FaceGrid::growTable() {
  std::vector<HashEntry> old(table_.size() * 2, HashEntry{0, kNoIndex});
  old.swap(table_);
  for (const HashEntry& entry : old) {
    if (entry.block == kNoIndex) continue;
    std::size_t slot = slotOf(entry.key, table_.size());
    while (table_[slot].block != kNoIndex) slot = (slot + 1) & (table_.size() - 1);
    table_[slot] = entry;
  }
}

void FaceGrid::insert(std::uint32_t face, const Box& box) {
  const int level = levelOf(box);
  const std::array<std::int32_t, 3> cell = cellOf(box, level);
  const std::uint32_t blockId = findOrMakeBlock(level, blockKey(level, cell[0], cell[1], cell[2]));
  const std::uint32_t inBlock = cellInBlock(cell[0], cell[1], cell[2]);
  Block& block = blocks_[blockId];
  block.occupied |= std::uint64_t{1} << inBlock;
  std::uint32_t& head = block.heads[inBlock];
  if (head == kNoIndex || chunks_[head].count == BoxQuad::kCount) {
    std::uint32_t fresh = 0;
    if (freeChunks_.empty()) {
      fresh = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    } else {
      fresh = freeChunks_.back();
      freeChunks_.pop_back();
    }
    chunks_[fresh].next = head;
    head = fresh;
  }
  Chunk& chunk = chunks_[head];
  chunk.boxes.set(chunk.count, box, face);
  if (face >= slots_.size()) slots_.resize(std::max<std::size_t>(face + 1, slots_.size() * 3 / 2));
  slots_[face] = {head, blockId << 6 | inBlock, static_cast<std::uint8_t>(chunk.count),
                  static_cast<std::uint8_t>(level)};
  ++chunk.count;
  ++facesOnLevel_[level];
  ++faceCount_;
}

void FaceGrid::remove(std::uint32_t face) {
  const Slot slot = slots_[face];
  Block& block = blocks_[slot.blockAndCell >> 6];
  const std::uint32_t inBlock = slot.blockAndCell & 63U;
  std::uint32_t& head = block.heads[inBlock];
  Chunk& first = chunks_[head];
  // The last entry of the list moves to the free slot.
  const std::uint32_t last = --first.count;
  const std::uint32_t lastFace = first.boxes.names[last];
  chunks_[slot.chunk].boxes.copy(slot.entry, first.boxes, last);
  first.boxes.clear(last);
  slots_[lastFace].chunk = slot.chunk;
  slots_[lastFace].entry = slot.entry;
  --facesOnLevel_[slot.level];
  --faceCount_;
  if (first.count > 0) return;
  freeChunks_.push_back(head);
  head = first.next;
  if (head == kNoIndex) block.occupied &= ~(std::uint64_t{1} << inBlock);
}

void FaceGrid::update(std::uint32_t face, const Box& box) {
  const Slot slot = slots_[face];
  const int level = levelOf(box);
  const std::array<std::int32_t, 3> cell = cellOf(box, level);
  const bool staysInCell =
      level == slot.level && cellInBlock(cell[0], cell[1], cell[2]) == (slot.blockAndCell & 63U) &&
      blockKey(level, cell[0], cell[1], cell[2]) == blocks_[slot.blockAndCell >> 6].key;
  if (staysInCell) {
    chunks_[slot.chunk].boxes.set(slot.entry, box, face);
    return;
  }
  remove(face);
  insert(face, box);
}

std::size_t FaceGrid::query(const Box& box, std::vector<std::uint32_t>& faces) const {
  // Reserve space for all faces and for the slack of append(), so the loops need no checks.
  if (faces.size() < faceCount_ + BoxOverlap::kSlack) faces.resize(2 * faceCount_ + 64);
  std::uint32_t* end = faces.data();
  for (int level = 0; level < kLevels; ++level) {
    if (facesOnLevel_[level] > 0) end = queryLevel(level, box, end);
  }
  return static_cast<std::size_t>(end - faces.data());
}

std::uint32_t* FaceGrid::queryLevel(int level, const Box& box, std::uint32_t* end) const {
  const BoxOverlap overlap(box);
  // The last level also holds larger faces.
  const double margin =
      level + 1 < kLevels ? 0.5 * cellSize_[level] : std::numeric_limits<double>::infinity();
  CellRange cells{};
  double blocksInRange = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    cells.from[axis] = cellCoordinate(static_cast<double>(box.low[axis]) - margin, axis, level);
    cells.to[axis] = cellCoordinate(static_cast<double>(box.high[axis]) + margin, axis, level);
    blocksInRange *= (cells.to[axis] >> 2) - (cells.from[axis] >> 2) + 1;
  }
  if (blocksInRange > static_cast<double>(blocksOnLevel_[level].size())) {
    return queryWholeLevel(level, cells, overlap, end);
  }
  for (std::int32_t x = cells.from[0] & ~3; x <= cells.to[0]; x += kCellsPerBlock) {
    for (std::int32_t y = cells.from[1] & ~3; y <= cells.to[1]; y += kCellsPerBlock) {
      for (std::int32_t z = cells.from[2] & ~3; z <= cells.to[2]; z += kCellsPerBlock) {
        const std::uint32_t block = findBlock(blockKey(level, x, y, z));
        if (block != kNoIndex) end = queryBlock(blocks_[block], cells, x, y, z, overlap, end);
      }
    }
  }
  return end;
}

/// Queries all blocks of a level. Used for large boxes, which cover more blocks than the level has.
std::uint32_t* FaceGrid::queryWholeLevel(int level, const CellRange& cells,
                                         const BoxOverlap& overlap, std::uint32_t* end) const {
  const BlockRange range(cells.from, cells.to);
  for (const std::uint32_t id : blocksOnLevel_[level]) {
    const Block& block = blocks_[id];
    if (block.occupied == 0 || !range.mayHold(block.key)) continue;
    for (std::uint64_t rest = block.occupied; rest != 0; rest &= rest - 1) {
      end = queryChunks(block.heads[std::countr_zero(rest)], overlap, end);
    }
  }
  return end;
}

std::uint32_t* FaceGrid::queryBlock(const Block& block, const CellRange& cells, std::int32_t x,
                                    std::int32_t y, std::int32_t z, const BoxOverlap& overlap,
                                    std::uint32_t* end) const {
  const std::array<std::int32_t, 3> corner{x, y, z};
  std::uint64_t rest = block.occupied;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int32_t from = std::max(cells.from[axis] - corner[axis], 0);
    const std::int32_t to = std::min(cells.to[axis] - corner[axis], kCellsPerBlock - 1);
    rest &= kRangeMasks.mask[axis][from][to];
  }
  for (; rest != 0; rest &= rest - 1) {
    end = queryChunks(block.heads[std::countr_zero(rest)], overlap, end);
  }
  return end;
}

std::uint32_t* FaceGrid::queryChunks(std::uint32_t chunk, const BoxOverlap& overlap,
                                     std::uint32_t* end) const {
  for (; chunk != kNoIndex; chunk = chunks_[chunk].next) {
    end = overlap.append(chunks_[chunk].boxes, end);
  }
  return end;
}

}  // namespace tetrafront
