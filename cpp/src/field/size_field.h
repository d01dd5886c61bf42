#pragma once

/// @file The size field: what the background grid, a uniform size or the surface's own edges ask
/// for at a place (steps F1, F3, F7), cut down to what sources ask for, and lifted where the
/// triangles of a given surface allow no smaller elements. One concrete class without virtual calls,
/// as it is asked several times per element.

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "field/grid_locator.h"
#include "field/size_octree.h"
#include "field/size_sources.h"
#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Where the last query ended; a walk begins there. One per caller or per front face.
struct FieldHint {
  std::uint32_t tetrahedron = 0;
};

/// How far the queries of a background grid had to walk.
struct WalkCount {
  std::uint64_t queries = 0;
  std::uint64_t steps = 0;  ///< from one tetrahedron to the next
};

class SizeField {
 public:
  static SizeField uniform(double size);
  static SizeField fromGrid(GridLocator locator);
  static SizeField fromOctree(SizeOctree octree);

  /// Adds sources, which must have passed checkSizeSources(), to what there is.
  void addSources(std::span<const SizeSource> sources);

  /// Cuts sizes down to those that grow from a surface's own edges. Stretched elements keep their
  /// shape, as in liftTo().
  void cutTo(SizeOctree ceiling);

  /// Lifts sizes to what can be had beside a surface's triangles. Stretched elements keep their
  /// shape: all axes grow alike, until the mean square of the principal sizes is no smaller.
  void liftTo(SizeOctree floor);

  /// Edge length to be made at `place`, > 0. Outside a background grid: the value at the nearest
  /// point of the nearest tetrahedron met; whoever must not accept that asks covers() first.
  [[nodiscard]] double sizeAt(const Vec3& place, FieldHint& hint) const;

  /// Whether sizes depend on the direction anywhere. If not, sizeAt() says all.
  [[nodiscard]] bool isStretched() const;

  /// The size tensor H at `place`; outside a background grid as sizeAt().
  [[nodiscard]] SymmetricTensor tensorAt(const Vec3& place, FieldHint& hint) const;

  /// What is wanted, whether it can be had or not: the same without the lifting.
  [[nodiscard]] double wantedSizeAt(const Vec3& place, FieldHint& hint) const;
  [[nodiscard]] SymmetricTensor wantedTensorAt(const Vec3& place, FieldHint& hint) const;

  [[nodiscard]] bool isLifted() const { return floor_.has_value(); }
  /// Size to be made over wanted size, >= 1. `meanSize`: meanSizeOf() the tensor wanted there.
  [[nodiscard]] double liftAt(const Vec3& place, double meanSize) const;

  /// False if `place` is outside the background grid by more than rounding; always true for the
  /// other kinds.
  [[nodiscard]] bool covers(const Vec3& place, FieldHint& hint) const;

  /// Of all queries so far.
  [[nodiscard]] WalkCount walkCount() const { return walked_; }

 private:
  using Base = std::variant<double, GridLocator, SizeOctree>;
  template <class Kind>
  SizeField(std::in_place_type_t<Kind> kind, Kind base) : base_(kind, std::move(base)) {}
  [[nodiscard]] double baseSizeAt(const Vec3& place, FieldHint& hint) const;
  GridLocator::Location locate(const GridLocator& grid, const Vec3& place, FieldHint& hint) const;

  Base base_;
  SizeSources sources_;
  std::optional<SizeOctree> ceiling_;
  std::optional<SizeOctree> floor_;
  mutable WalkCount walked_;  ///< a measurement, which no answer depends on
};

}  // namespace tetrafront
