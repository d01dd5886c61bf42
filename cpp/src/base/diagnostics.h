#pragma once

/// @file Makes diagnostics, and answers questions about lists of them.

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "base/ids.h"
#include "tetrafront/diagnostic_values.h"
#include "tetrafront/status.h"

namespace tetrafront {
namespace detail {

template <class Value>
consteval bool isOfType(ValueType type) {
  switch (type) {
    case ValueType::kFlag:
      return std::is_same_v<Value, bool>;
    case ValueType::kOption:
      return std::is_same_v<Value, CheckedOption>;
    case ValueType::kNumber:
      break;
  }
  return !std::is_same_v<Value, bool> && !std::is_same_v<Value, CheckedOption>;
}

/// Whether the code has values of these types, before `further` others.
template <DiagnosticCode kCode, class... Values>
consteval bool hasValues(std::size_t further) {
  const DiagnosticValues named = valuesOf(kCode);
  const std::size_t count = sizeof...(Values) + further;
  if (count < named.required() || count > named.size()) return false;
  [[maybe_unused]] const DiagnosticValue* value = named.begin();
  return (isOfType<Values>((value++)->type) && ...);
}

template <class... Values>
Diagnostic made(DiagnosticCode code, Values... values) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.values = {static_cast<double>(values)...};
  return diagnostic;
}

}  // namespace detail

[[nodiscard]] inline Entity entityOf(PointId id) { return {EntityKind::kPoint, id.value}; }
[[nodiscard]] inline Entity entityOf(LineId id) { return {EntityKind::kLine, id.value}; }
[[nodiscard]] inline Entity entityOf(PatchId id) { return {EntityKind::kPatch, id.value}; }
[[nodiscard]] inline Entity entityOf(NodeId id) { return {EntityKind::kSurfaceNode, id.value}; }
[[nodiscard]] inline Entity entityOf(TriangleId id) { return {EntityKind::kTriangle, id.value}; }
[[nodiscard]] inline Entity entityOf(TetId id) { return {EntityKind::kTetrahedron, id.value}; }
[[nodiscard]] inline Entity entityOf(SourceId id) { return {EntityKind::kSource, id.value}; }
[[nodiscard]] inline Entity entityOf(GridNodeId id) {
  return {EntityKind::kBackgroundNode, id.value};
}
[[nodiscard]] inline Entity entityOf(GridTetId id) {
  return {EntityKind::kBackgroundTetrahedron, id.value};
}

/// Returns the patch, then the lines.
[[nodiscard]] inline std::vector<Entity> patchAndLines(PatchId patch,
                                                       std::span<const LineId> lines) {
  std::vector<Entity> entities{entityOf(patch)};
  for (const LineId line : lines) entities.push_back(entityOf(line));
  return entities;
}

/// Makes a diagnostic of severity kError with its values, which must be those of valuesOf(kCode).
template <DiagnosticCode kCode, class... Values>
[[nodiscard]] Diagnostic diagnose(Values... values) {
  static_assert(detail::hasValues<kCode, Values...>(0), "these are not the values of this code");
  return detail::made(kCode, values...);
}

/// Makes a diagnostic of severity kError with all values of valuesOf(kCode) but the last one, a count that BoundaryReport adds.
template <DiagnosticCode kCode, class... Values>
[[nodiscard]] Diagnostic diagnoseCounted(Values... values) {
  static_assert(detail::hasValues<kCode, Values..., std::size_t>(0),
                "these are not the values of this code before its count");
  return detail::made(kCode, values...);
}

/// Returns an estimate as it is reported: at most 10^15, also if it overflowed.
[[nodiscard]] inline double cappedCount(double expected) {
  constexpr double kMaxCount = 1e15;
  return expected < kMaxCount ? expected : kMaxCount;
}

/// Makes a diagnostic of the code kTooManyElements.
[[nodiscard]] inline Diagnostic tooManyElements(double expected, double limit) {
  return diagnose<DiagnosticCode::kTooManyElements>(cappedCount(expected), limit);
}

/// True if at least one of the diagnostics is an error, not a warning.
[[nodiscard]] inline bool anyError(std::span<const Diagnostic> diagnostics) {
  return std::ranges::any_of(diagnostics, [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::kError;
  });
}

}  // namespace tetrafront
