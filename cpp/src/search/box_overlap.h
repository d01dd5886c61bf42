#pragma once

/// @file Compares one box with many: the innermost loop of the face grid (Löhner & Parikh 1988, eq. (7),
/// with the distance 0). Compares four boxes at once if the machine has SIMD. All variants give the same
/// results in the same order.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geom/box.h"

#if defined(__SSSE3__)
#include <tmmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace tetrafront {

/// Four boxes and their names, contiguous. Initially, the boxes overlap nothing.
struct alignas(16) BoxQuad {
  static constexpr std::size_t kCount = 4;
  static constexpr float kFar = std::numeric_limits<float>::infinity();
  template <class Value>
  using Lanes = std::array<Value, kCount>;

  std::array<Lanes<float>, 3> low{{{kFar, kFar, kFar, kFar},  //
                                   {kFar, kFar, kFar, kFar},
                                   {kFar, kFar, kFar, kFar}}};
  std::array<Lanes<float>, 3> high{
      {{-kFar, -kFar, -kFar, -kFar}, {-kFar, -kFar, -kFar, -kFar}, {-kFar, -kFar, -kFar, -kFar}}};
  Lanes<std::uint32_t> names{};

  void set(std::size_t lane, const Box& box, std::uint32_t name) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis][lane] = box.low[axis];
      high[axis][lane] = box.high[axis];
    }
    names[lane] = name;
  }
  void copy(std::size_t lane, const BoxQuad& from, std::size_t fromLane) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis][lane] = from.low[axis][fromLane];
      high[axis][lane] = from.high[axis][fromLane];
    }
    names[lane] = from.names[fromLane];
  }
  /// Replaces the box by one that overlaps nothing.
  void clear(std::size_t lane) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis][lane] = kFar;
      high[axis][lane] = -kFar;
    }
  }
};

class BoxOverlap {
 public:
  /// Number of entries that append() may write beyond those it keeps.
  static constexpr std::size_t kSlack = BoxQuad::kCount;

#if defined(__SSSE3__)
  explicit BoxOverlap(const Box& box)
      : x_{_mm_set1_ps(box.low[0]), _mm_set1_ps(box.high[0])},
        y_{_mm_set1_ps(box.low[1]), _mm_set1_ps(box.high[1])},
        z_{_mm_set1_ps(box.low[2]), _mm_set1_ps(box.high[2])} {}

  /// Writes the names of the boxes that overlap this one, beginning at `end`; returns the new end.
  std::uint32_t* append(const BoxQuad& boxes, std::uint32_t* end) const {
    const __m128 apart = _mm_or_ps(_mm_or_ps(apartAlong(boxes, 0, x_), apartAlong(boxes, 1, y_)),
                                   apartAlong(boxes, 2, z_));
    const auto overlapping = static_cast<std::size_t>(_mm_movemask_ps(apart)) ^ kAll;
    const auto* names = reinterpret_cast<const __m128i*>(boxes.names.data());
    const auto* permutation = reinterpret_cast<const __m128i*>(kPacking[overlapping].data());
    // Store all four and keep only those that overlap: branches would be unpredictable.
    _mm_storeu_si128(reinterpret_cast<__m128i*>(end),
                     _mm_shuffle_epi8(_mm_load_si128(names), _mm_load_si128(permutation)));
    return end + kSetSize[overlapping];
  }

 private:
  struct Range {
    __m128 low;
    __m128 high;
  };
  static __m128 apartAlong(const BoxQuad& boxes, std::size_t axis, const Range& range) {
    return _mm_or_ps(_mm_cmpgt_ps(_mm_load_ps(boxes.low[axis].data()), range.high),
                     _mm_cmplt_ps(_mm_load_ps(boxes.high[axis].data()), range.low));
  }
  Range x_;
  Range y_;
  Range z_;
#elif defined(__wasm_simd128__)
  explicit BoxOverlap(const Box& box)
      : x_{wasm_f32x4_splat(box.low[0]), wasm_f32x4_splat(box.high[0])},
        y_{wasm_f32x4_splat(box.low[1]), wasm_f32x4_splat(box.high[1])},
        z_{wasm_f32x4_splat(box.low[2]), wasm_f32x4_splat(box.high[2])} {}

  std::uint32_t* append(const BoxQuad& boxes, std::uint32_t* end) const {
    const v128_t apart = wasm_v128_or(
        wasm_v128_or(apartAlong(boxes, 0, x_), apartAlong(boxes, 1, y_)), apartAlong(boxes, 2, z_));
    const auto overlapping = static_cast<std::size_t>(wasm_i32x4_bitmask(apart)) ^ kAll;
    const v128_t permutation = wasm_v128_load(kPacking[overlapping].data());
    wasm_v128_store(end, wasm_i8x16_swizzle(wasm_v128_load(boxes.names.data()), permutation));
    return end + kSetSize[overlapping];
  }

 private:
  struct Range {
    v128_t low;
    v128_t high;
  };
  static v128_t apartAlong(const BoxQuad& boxes, std::size_t axis, const Range& range) {
    return wasm_v128_or(wasm_f32x4_gt(wasm_v128_load(boxes.low[axis].data()), range.high),
                        wasm_f32x4_lt(wasm_v128_load(boxes.high[axis].data()), range.low));
  }
  Range x_;
  Range y_;
  Range z_;
#else
  explicit BoxOverlap(const Box& box) : box_(box) {}

  std::uint32_t* append(const BoxQuad& boxes, std::uint32_t* end) const {
    for (std::size_t lane = 0; lane < BoxQuad::kCount; ++lane) {
      bool apart = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        apart = apart || boxes.low[axis][lane] > box_.high[axis] ||
                boxes.high[axis][lane] < box_.low[axis];
      }
      *end = boxes.names[lane];
      end += apart ? 0 : 1;
    }
    return end;
  }

 private:
  Box box_;
#endif

#if defined(__SSSE3__) || defined(__wasm_simd128__)
  /// Sets of lanes are bit masks.
  static constexpr std::size_t kAll = (1U << BoxQuad::kCount) - 1;
  struct alignas(16) BytePermutation : std::array<std::uint8_t, 16> {};

  /// Per set of lanes: the source index of each byte in a shuffle that moves these lanes to the
  /// front.
  static constexpr std::array<BytePermutation, kAll + 1> kPacking = [] {
    std::array<BytePermutation, kAll + 1> packing{};
    for (std::size_t set = 0; set <= kAll; ++set) {
      std::size_t filled = 0;
      for (std::size_t lane = 0; lane < BoxQuad::kCount; ++lane) {
        if ((set >> lane & 1U) == 0) continue;
        for (std::size_t byte = 0; byte < 4; ++byte) {
          packing[set][filled++] = static_cast<std::uint8_t>(4 * lane + byte);
        }
      }
    }
    return packing;
  }();
  static constexpr std::array<std::uint8_t, kAll + 1> kSetSize{0, 1, 1, 2, 1, 2, 2, 3,
                                                               1, 2, 2, 3, 2, 3, 3, 4};
#endif
};

}  // namespace tetrafront
