#pragma once

/// @file Names, types and meanings of the values of diagnostics. wasm/constants.cpp prints this table for the package,
/// where the values become named fields.

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "tetrafront/status.h"

namespace tetrafront {

/// How a number in Diagnostic::values is read.
enum class ValueType : std::uint8_t {
  kNumber = 0,
  kFlag = 1,    ///< 1 for true, 0 for false
  kOption = 2,  ///< a CheckedOption
};

/// One value of a diagnostic.
struct DiagnosticValue {
  std::string_view name;     ///< in the package
  std::string_view meaning;  ///< one or two sentences; lengths are in model units
  ValueType type = ValueType::kNumber;
  bool isOptional = false;  ///< only values behind which all others are optional too
};

/// Values of a diagnostic, in the order of Diagnostic::values.
class DiagnosticValues {
 public:
  constexpr DiagnosticValues(std::initializer_list<DiagnosticValue> values) {
    for (const DiagnosticValue& value : values) list_.at(size_++) = value;
  }

  [[nodiscard]] constexpr const DiagnosticValue* begin() const { return list_.data(); }
  [[nodiscard]] constexpr const DiagnosticValue* end() const { return list_.data() + size_; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  /// Returns the number of values that every such diagnostic has.
  [[nodiscard]] constexpr std::size_t required() const {
    std::size_t count = 0;
    for (const DiagnosticValue& value : *this) count += value.isOptional ? 0 : 1;
    return count;
  }

 private:
  static constexpr std::size_t kMaxValues = 3;
  std::array<DiagnosticValue, kMaxValues> list_{};
  std::size_t size_ = 0;
};

namespace detail {

constexpr DiagnosticValue count(std::string_view meaning) { return {"count", meaning}; }

constexpr DiagnosticValue optional(DiagnosticValue value) {
  value.isOptional = true;
  return value;
}

}  // namespace detail

/// Returns the values of a diagnostic of this code; empty if it has none. The switch has no default, so that a code
/// without an entry does not compile.
constexpr DiagnosticValues valuesOf(DiagnosticCode code) {
  using detail::count;
  using detail::optional;
  switch (code) {
    case DiagnosticCode::kNotFinite:
      return {{"coordinate",
               "The invalid coordinate, which may be NaN or infinite; 0 if all points lie at the "
               "origin."},
              optional(count("Number of such nodes, for surfaces only."))};
    case DiagnosticCode::kIndexOutOfRange:
      return {{"index", "The index that does not exist."},
              optional(count("Number of such indices, for surfaces only."))};
    case DiagnosticCode::kWrongPointCount:
      return {{"points", "Number of points of the line."}};
    case DiagnosticCode::kWrongLineCount:
      return {{"lines", "Number of lines of the outer loop."},
              {"required", "Number that the type of the patch requires."}};
    case DiagnosticCode::kWrongLoopCount:
      return {{"loops", "Number of loops of the patch."}};
    case DiagnosticCode::kNotPlanar:
      return {{"distance", "Largest distance from the plane."}};
    case DiagnosticCode::kHoleOffPatch:
      return {{"distance", "Largest distance from the patch."}};
    case DiagnosticCode::kOptionOutOfRange:
      return {{"option", "The option.", ValueType::kOption},
              {"given", "Value as it reached the engine."}};
    case DiagnosticCode::kPatchesIntersect:
      return {count("Always 1: each pair of patches has its own diagnostic.")};
    case DiagnosticCode::kSizeOutOfRange:
      return {{"size", "The invalid size, as given."}};
    case DiagnosticCode::kStretchingOutOfRange:
      return {{"stretching", "The invalid stretching, as given."}};
    case DiagnosticCode::kSecondStretchingOutOfRange:
      return {
          {"stretching", "The second stretching, as given."},
          {"cosine", "Cosine of the angle between the two directions; 0 without two directions."}};
    case DiagnosticCode::kOutsideBackgroundGrid:
      return {optional(count("Number of positions outside, if they were counted."))};
    case DiagnosticCode::kTooManyElements:
      return {
          {"expected", "Estimated number, of tetrahedra, or of triangles if a triangle is named."},
          {"limit", "Largest permitted number."}};
    case DiagnosticCode::kSourceOutOfRange:
      return {{"size", "Size of the source, as given."},
              {"distance", "Distance of the source, as given or by default."},
              {"growth", "Growth of the source, as given or by default."}};
    case DiagnosticCode::kSizeTooLarge:
      return {{"size", "Smallest size."}, {"extent", "Largest extent of the model."}};
    case DiagnosticCode::kOpenEdge:
      return {count("Number of open edges.")};
    case DiagnosticCode::kDanglingSheet:
      return {count("Number of triangles of the sheets.")};
    case DiagnosticCode::kInconsistentOrientation:
      return {count("Number of edges at which a component cannot be oriented.")};
    case DiagnosticCode::kSelfIntersection:
      return {count("Number of pairs of triangles."),
              optional({"isLowerBound",
                        "Whether there may be more pairs, because the search was ended early.",
                        ValueType::kFlag})};
    case DiagnosticCode::kDuplicateTriangle:
      return {optional(
          count("Number of such triangles; missing for tetrahedra of a background grid."))};
    case DiagnosticCode::kDegenerateTriangle:
      return {count("Number of such triangles.")};
    case DiagnosticCode::kZeroVolume:
      return {count("Number of shells that enclose nothing.")};
    case DiagnosticCode::kReorientedPatch:
      return {optional({"flipped", "Number of flipped triangles, for a given surface only."}),
              optional({"triangles",
                        "Number of all triangles of the component, for a given surface only."})};
    case DiagnosticCode::kCoincidentNodes:
      return {count("Number of pairs of nodes.")};
    case DiagnosticCode::kNestedRegions:
      return {{"regions", "Number of regions in the future mesh."},
              {"cavities", "Number of cavities in the future mesh."}};
    case DiagnosticCode::kSurfaceContact:
      return {{"edges", "Number of edges at which the surface touches itself."},
              {"nodes", "Number of nodes at which it does, other than those of such edges."}};
    case DiagnosticCode::kFlippedTriangle:
      return {{"isBetweenRegions",
               "Whether the triangle would be an interface with `innerShells: \"regions\"`.",
               ValueType::kFlag},
              count("Number of such triangles.")};
    case DiagnosticCode::kCoarseSurface:
      return {{"triangles", "Number of triangles with edges above twice the target length."},
              {"lengthRatio", "Longest edge / target length there."}};
    case DiagnosticCode::kInconsistentRegions:
      return {count("Number of such triangles.")};
    case DiagnosticCode::kUnresolvedSurface:
      return {
          {"reason",
           "1: nothing is enclosed; 2: most of the area encloses nothing; 3: too many pairs of "
           "triangles intersect; 4: the attempts came to their limit; 5: rounding made triangles "
           "intersect again in each attempt; 6: what is enclosed has no valid boundary."},
          count("Number of intersecting pairs in the last attempt."),
          {"limit",
           "Largest number of pairs (3), or of triangles and pairs in all attempts (4); 0 "
           "otherwise."}};
    case DiagnosticCode::kLargeTetrahedra:
      return {count("Number of tetrahedra above their largest permitted volume."),
              {"volumeRatio", "Largest volume / permitted volume."}};
    case DiagnosticCode::kStalled:
      return {{"faces", "Number of faces left in the front."}};
    case DiagnosticCode::kVerificationFailed:
      return {count("Number of defects.")};
    case DiagnosticCode::kDegenerateTetrahedron:
      return {count("Number of such tetrahedra.")};
    case DiagnosticCode::kNonManifoldFace:
      return {count("Number of such faces.")};
    case DiagnosticCode::kOverlappingTetrahedra:
      return {count("Number of such pairs.")};
    case DiagnosticCode::kCoincidentPoints:
    case DiagnosticCode::kCollinearPoints:
    case DiagnosticCode::kOpenCircle:
    case DiagnosticCode::kMisplacedSection:
    case DiagnosticCode::kZeroLengthLine:
    case DiagnosticCode::kWrongLineType:
    case DiagnosticCode::kLoopNotClosed:
    case DiagnosticCode::kLoopsIntersect:
    case DiagnosticCode::kEmptyModel:
    case DiagnosticCode::kDegeneratePatch:
    case DiagnosticCode::kHoleOutside:
    case DiagnosticCode::kLineSelfIntersection:
    case DiagnosticCode::kDuplicateLines:
    case DiagnosticCode::kEmptyBackgroundGrid:
    case DiagnosticCode::kDegenerateBackgroundTetrahedron:
    case DiagnosticCode::kDuplicatePoints:
      break;
  }
  return {};
}

}  // namespace tetrafront
