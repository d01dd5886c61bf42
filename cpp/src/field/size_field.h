#pragma once

/// @file The size field: the element size at a position (steps F1, F3, F7). A background grid, a
/// uniform size or the surface's own edges define it; sources cap it; the triangles of a given
/// surface raise it where they allow no smaller elements. A concrete class without virtual calls,
/// because it is queried several times per element.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "base/ids.h"
#include "field/grid_locator.h"
#include "field/size_octree.h"
#include "field/size_sources.h"
#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Tetrahedron in which the last query ended and the next walk begins. Keep one per caller or per
/// front face.
struct FieldHint {
  static constexpr std::uint32_t kAnyRegion = 0xffffffffU;
  GridTetId tetrahedron{0U};
  std::uint32_t region = kAnyRegion;  ///< region whose sizes are queried
};

/// Queries change nothing but their hint, which is where a search begins: no result depends on it.
class SizeField {
 public:
  static SizeField uniform(double size);
  static SizeField fromGrid(GridLocator locator);
  static SizeField fromOctree(SizeOctree octree);

  /// Adds sources, which must have passed checkSizeSources(), to the existing ones.
  void addSources(std::span<const SizeSource> sources);

  /// Caps sizes by those that grow from a surface's own edges. Stretched elements keep their shape,
  /// as in raiseTo().
  void capTo(SizeOctree ceiling);

  /// Raises sizes to the smallest that the surface's triangles allow. In a stretched field, all
  /// axes are scaled by one factor, so that the root mean square of the principal sizes reaches
  /// this minimum.
  void raiseTo(SizeOctree floor);

  /// Caps sizes everywhere, and by region where the hint of a query names one. Stretched elements keep their shape and get
  /// the volume of an element of this size. `ofRegions` may have fewer entries than there are regions; 0: no cap.
  void capSizes(double everywhere, std::vector<double> ofRegions);
  [[nodiscard]] bool hasRegionCaps() const { return !regionCaps_.empty(); }
  /// Returns the smallest cap of the region and everywhere; infinite without one.
  [[nodiscard]] double capOf(std::uint32_t region) const;
  /// Returns the region with the smaller cap; the first one if they are the same.
  [[nodiscard]] std::uint32_t tighterOf(std::uint32_t region, std::uint32_t other) const {
    return capOf(other) < capOf(region) ? other : region;
  }

  /// Returns the edge length to be made at `position`, > 0. Outside a background grid, it is the value
  /// at the nearest point of the nearest tetrahedron; use covers() to detect this case.
  [[nodiscard]] double sizeAt(const Vec3& position, FieldHint& hint) const;

  /// Whether sizes depend on the direction anywhere. If not, sizeAt() is sufficient.
  [[nodiscard]] bool isStretched() const;

  /// Returns the size tensor H at `position`; outside a background grid as sizeAt().
  [[nodiscard]] SymmetricTensor tensorAt(const Vec3& position, FieldHint& hint) const;

  /// Returns the target size, without raising it to the achievable one.
  [[nodiscard]] double targetSizeAt(const Vec3& position, FieldHint& hint) const;
  [[nodiscard]] SymmetricTensor targetTensorAt(const Vec3& position, FieldHint& hint) const;

  [[nodiscard]] bool isRaised() const { return floor_.has_value(); }
  /// Returns raised size / target size, >= 1. `meanSize` is meanSizeOf() the target tensor
  /// there.
  [[nodiscard]] double raiseFactorAt(const Vec3& position, double meanSize) const;

  /// Returns false if `position` is outside the background grid by more than rounding and its coverage
  /// margin; always true without a background grid.
  [[nodiscard]] bool covers(const Vec3& position, FieldHint& hint) const;

  template <class Self, class Visit>
  static void visitMembers(Self& self, Visit& visit) {
    visit(self.base_, self.sources_, self.ceiling_, self.floor_, self.cap_, self.regionCaps_);
  }

 private:
  using Base = std::variant<double, GridLocator, SizeOctree>;
  template <class Kind>
  SizeField(std::in_place_type_t<Kind> kind, Kind base) : base_(kind, std::move(base)) {}
  [[nodiscard]] double baseSizeAt(const Vec3& position, FieldHint& hint) const;
  static GridLocator::Location locate(const GridLocator& grid, const Vec3& position,
                                      FieldHint& hint);

  Base base_;
  SizeSources sources_;
  std::optional<SizeOctree> ceiling_;
  std::optional<SizeOctree> floor_;
  double cap_ = std::numeric_limits<double>::infinity();
  std::vector<double> regionCaps_;
};

}  // namespace tetrafront
