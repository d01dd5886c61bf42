#pragma once

/// @file Flat arrays passed between C++ and JavaScript, always as copies: a view into the heap
/// becomes invalid when memory grows.

#include <emscripten/val.h>

#include <cstdint>
#include <vector>

namespace tetrafront::border {

// Declare the types, so that the generated .d.ts states them instead of `any`.
EMSCRIPTEN_DECLARE_VAL_TYPE(Float64Array)
EMSCRIPTEN_DECLARE_VAL_TYPE(Uint32Array)
EMSCRIPTEN_DECLARE_VAL_TYPE(Uint8Array)

/// Returns the elements of a JavaScript typed array, which must hold numbers of type T.
template <class T>
[[nodiscard]] std::vector<T> copyIn(const emscripten::val& array) {
  return emscripten::convertJSArrayToNumberVector<T>(array);
}

/// Returns a new JavaScript array of class `arrayClass` with the same numbers.
template <class T>
[[nodiscard]] emscripten::val copyOut(const char* arrayClass, const std::vector<T>& values) {
  const emscripten::val view{emscripten::typed_memory_view(values.size(), values.data())};
  return emscripten::val::global(arrayClass).new_(view);
}

[[nodiscard]] inline Float64Array copyOut(const std::vector<double>& values) {
  return Float64Array{copyOut("Float64Array", values)};
}

[[nodiscard]] inline Uint32Array copyOut(const std::vector<std::uint32_t>& values) {
  return Uint32Array{copyOut("Uint32Array", values)};
}

[[nodiscard]] inline Uint8Array copyOut(const std::vector<std::uint8_t>& values) {
  return Uint8Array{copyOut("Uint8Array", values)};
}

}  // namespace tetrafront::border
