#pragma once

/// @file One box against many: the comparison of the face grid's innermost loop, four lanes at
/// once where the machine has them. All variants give the same answers.

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace tetrafront {

/// Boxes are given by pointers to three floats; a fourth float behind them must be readable and
/// is ignored.
class BoxOverlap {
 public:
#if defined(__SSE2__)
  BoxOverlap(const float* low, const float* high)
      : low_(_mm_setr_ps(low[0], low[1], low[2], 0.0F)),
        high_(_mm_setr_ps(high[0], high[1], high[2], 0.0F)) {}

  [[nodiscard]] bool meets(const float* low, const float* high) const {
    const __m128 apart =
        _mm_or_ps(_mm_cmpgt_ps(_mm_load_ps(low), high_), _mm_cmplt_ps(_mm_load_ps(high), low_));
    return (_mm_movemask_ps(apart) & kThreeLanes) == 0;
  }

 private:
  static constexpr int kThreeLanes = 7;
  __m128 low_;
  __m128 high_;
#elif defined(__wasm_simd128__)
  BoxOverlap(const float* low, const float* high)
      : low_(wasm_f32x4_make(low[0], low[1], low[2], 0.0F)),
        high_(wasm_f32x4_make(high[0], high[1], high[2], 0.0F)) {}

  [[nodiscard]] bool meets(const float* low, const float* high) const {
    const v128_t apart = wasm_v128_or(wasm_f32x4_gt(wasm_v128_load(low), high_),
                                      wasm_f32x4_lt(wasm_v128_load(high), low_));
    return (wasm_i32x4_bitmask(apart) & kThreeLanes) == 0;
  }

 private:
  static constexpr int kThreeLanes = 7;
  v128_t low_;
  v128_t high_;
#else
  BoxOverlap(const float* low, const float* high) : low_(low), high_(high) {}

  [[nodiscard]] bool meets(const float* low, const float* high) const {
    for (int k = 0; k < 3; ++k) {
      if (low[k] > high_[k] || high[k] < low_[k]) return false;
    }
    return true;
  }

 private:
  const float* low_;
  const float* high_;
#endif
};

}  // namespace tetrafront
