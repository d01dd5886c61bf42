#include "search/morton.h"

#include <algorithm>

#include "base/free_memory.h"

namespace tetrafront {
namespace {

/// Spreads the lowest 20 bits to every third bit.
std::uint64_t spreadBits(std::uint64_t v) {
  v = (v | (v << 32U)) & 0x001f00000000ffffU;
  v = (v | (v << 16U)) & 0x001f0000ff0000ffU;
  v = (v | (v << 8U)) & 0x100f00f00f00f00fU;
  v = (v | (v << 4U)) & 0x10c30c30c30c30c3U;
  return (v | (v << 2U)) & 0x1249249249249249U;
}

}  // namespace

bool MortonSort::advance(std::size_t budget) {
  const std::size_t last = next_ + std::min(budget, positions_.size() - next_);
  switch (stage_) {
    case Stage::kBound:
      bound(next_, last);
      break;
    case Stage::kCode:
      code(next_, last);
      break;
    case Stage::kSort:
      sort(next_, last);
      break;
    case Stage::kName:
      for (std::size_t i = next_; i < last; ++i) order_.push_back(keys_[i].index);
      break;
    case Stage::kDone:
      return true;
  }
  next_ = last;
  if (next_ == positions_.size()) endStage();
  return stage_ == Stage::kDone;
}

void MortonSort::endStage() {
  next_ = 0;
  switch (stage_) {
    case Stage::kBound:
      keys_.reserve(positions_.size());
      stage_ = Stage::kCode;
      break;
    case Stage::kCode:
      for (auto& begins : begins_) {
        for (std::size_t digit = 1; digit < kDigits; ++digit) begins[digit] += begins[digit - 1];
      }
      sorted_.resize(keys_.size());
      stage_ = Stage::kSort;
      break;
    case Stage::kSort:
      keys_.swap(sorted_);
      if (++pass_ < kPasses) break;
      freeMemory(sorted_);
      order_.reserve(keys_.size());
      stage_ = Stage::kName;
      break;
    case Stage::kName:
      freeMemory(keys_);
      stage_ = Stage::kDone;
      break;
    case Stage::kDone:
      break;
  }
}

void MortonSort::bound(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    for (int a = 0; a < 3; ++a) {
      lower_[a] = std::min(lower_[a], positions_[i][a]);
      upper_[a] = std::max(upper_[a], positions_[i][a]);
    }
  }
}

/// Computes the codes and counts their digits.
void MortonSort::code(std::size_t first, std::size_t last) {
  const double extent = std::max({upper_.x - lower_.x, upper_.y - lower_.y, upper_.z - lower_.z});
  const double cells = static_cast<double>((1U << kBitsPerAxis) - 1U);
  const double scale = extent > 0.0 ? cells / extent : 0.0;
  for (std::size_t i = first; i < last; ++i) {
    std::uint64_t code = 0;
    for (int a = 0; a < 3; ++a) {
      const double cell = std::min((positions_[i][a] - lower_[a]) * scale, cells);
      code |= spreadBits(static_cast<std::uint64_t>(cell)) << static_cast<unsigned>(a);
    }
    keys_.push_back({code, static_cast<std::uint32_t>(i)});
    for (unsigned pass = 0; pass < kPasses; ++pass) {
      ++begins_[pass][digitOf(keys_.back(), pass) + 1];
    }
  }
}

/// Sorts by one digit, the lowest first; keeps the order of equal ones.
void MortonSort::sort(std::size_t first, std::size_t last) {
  auto& begins = begins_[pass_];
  for (std::size_t i = first; i < last; ++i) sorted_[begins[digitOf(keys_[i], pass_)]++] = keys_[i];
}

std::vector<std::uint32_t> mortonOrder(std::span<const Vec3> positions) {
  MortonSort sort(positions);
  while (!sort.advance(positions.size())) {
  }
  return sort.take();
}

}  // namespace tetrafront
