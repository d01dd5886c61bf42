#include "remesh/piece_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/sort.h"

namespace tetrafront {
namespace {

constexpr std::uint32_t kInnerLevels = PieceCells::kLevels - 1;
/// Least width of a cell / diagonal of the surface: numbers of cells have 32 bits.
constexpr double kMinWidth = 0x1p-31;
static_assert(3 * kInnerLevels <= std::numeric_limits<std::uint32_t>::digits);

}  // namespace

PieceCells::PieceCells(const ReferenceSurface& reference, double width)
    : reference_(reference), width_(std::max(width, kMinWidth * reference.diagonal())) {
  lowest_.fill(std::numeric_limits<std::int64_t>::max());
  for (const ReferenceSurface::Piece& piece : reference_.pieces()) {
    const Cell cell = cellOf(piece);
    for (std::size_t k = 0; k < 3; ++k) lowest_[k] = std::min(lowest_[k], cell[k] >> kInnerLevels);
  }
}

PieceCells::Cell PieceCells::cellOf(const ReferenceSurface::Piece& piece) const {
  Cell cell{};
  for (int k = 0; k < 3; ++k) {
    cell[static_cast<std::size_t>(k)] =
        static_cast<std::int64_t>(std::floor(piece.centroid[k] / width_));
  }
  return cell;
}

PieceCells::Slot PieceCells::slotOf(std::uint32_t piece, std::uint32_t key, double rank) const {
  const Cell cell = cellOf(reference_.pieces()[piece]);
  std::array<std::uint64_t, 3> widest{};
  for (std::size_t k = 0; k < 3; ++k) {
    widest[k] = static_cast<std::uint32_t>((cell[k] >> kInnerLevels) - lowest_[k]);
  }
  std::uint32_t inner = 0;
  for (std::uint32_t level = kInnerLevels; level-- > 0;) {
    for (const std::int64_t coordinate : cell) {
      inner = 2 * inner + static_cast<std::uint32_t>(coordinate >> level & 1);
    }
  }
  return {std::uint64_t{key} << 32 | widest[0], widest[1] << 32 | widest[2], inner, piece, rank};
}

void PieceCells::sort(std::vector<Slot>& slots) {
  stableSort(slots, [](const Slot& a, const Slot& b) {
    return std::tie(a.keyAndX, a.yAndZ, a.inner, b.rank) <
           std::tie(b.keyAndX, b.yAndZ, b.inner, a.rank);
  });
}

std::uint32_t PieceCells::levelOfDifference(const Slot& a, const Slot& b) {
  if (a.keyAndX != b.keyAndX || a.yAndZ != b.yAndZ) return 0;
  const auto differing = static_cast<std::uint32_t>(std::bit_width(a.inner ^ b.inner));
  return kLevels - (differing + 2) / 3;
}

std::size_t PieceCells::endOfCell(std::span<const Slot> slots, std::size_t first,
                                  std::uint32_t level) {
  std::size_t end = first + 1;
  while (end < slots.size() && levelOfDifference(slots[first], slots[end]) > level) ++end;
  return end;
}

}  // namespace tetrafront
