#pragma once

/// @file The target size of the triangles that the remesher makes: the given size field, capped by the sizes that the shape
/// asks for.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "field/size_field.h"
#include "field/size_sites.h"
#include "field/size_tensor.h"
#include "remesh/cusps.h"
#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class RemeshSizes {
 public:
  explicit RemeshSizes(SizeField given) : given_(std::move(given)) {}

  /// Names the region whose cap in the size field applies to each smooth patch.
  void setRegions(std::vector<std::uint32_t> ofPatches) { regions_ = std::move(ofPatches); }
  [[nodiscard]] bool hasRegions() const { return !regions_.empty(); }
  /// Returns the region of a smooth patch, for FieldHint::region.
  [[nodiscard]] std::uint32_t regionOf(SmoothPatchId patch) const {
    return hasRegions() ? regions_[patch.index()] : FieldHint::kAnyRegion;
  }
  /// Returns the one of both regions with the smaller cap.
  [[nodiscard]] std::uint32_t tighterOf(std::uint32_t region, std::uint32_t other) const {
    return given_.tighterOf(region, other);
  }
  [[nodiscard]] double capOf(std::uint32_t region) const { return given_.capOf(region); }

  /// Caps sizes by those that grow from the sites. In a stretched field, the sizes in all directions are capped, but those
  /// along the axis of the site. `axes`: as in ShapeSizes.
  void capTo(SizeSites sites, std::vector<Vec3> axes) {
    shape_ = std::move(sites);
    axes_ = std::move(axes);
  }
  /// Sizes of the shape are no smaller than these.
  void raiseTo(CuspSizes cusps) { cusps_ = std::move(cusps); }

  [[nodiscard]] double leastAt(const Vec3& position) const { return cusps_.leastAt(position); }

  /// Where the last query was. Keep one per node: near queries are faster.
  struct Hint {
    FieldHint field;
    SiteId site{0U};
  };
  [[nodiscard]] bool isStretched() const { return given_.isStretched(); }
  [[nodiscard]] double sizeAt(const Vec3& position, Hint& hint) const;
  /// As sizeAt(), for a position near the last query: of the sizes that the shape asks for, only those around the last site
  /// count. The result exceeds sizeAt() by at most twice the growth times the distance from the last query. O(1) for
  /// the shape.
  [[nodiscard]] double sizeNear(const Vec3& position, Hint& hint) const;
  [[nodiscard]] SymmetricTensor tensorAt(const Vec3& position, Hint& hint) const;

 private:
  [[nodiscard]] SizeSites::Value ofShape(const Vec3& position, Hint& hint) const;
  [[nodiscard]] double cappedAt(const Vec3& position, double size, Hint& hint) const;

  SizeField given_;
  std::vector<std::uint32_t> regions_;  ///< per smooth patch; empty if no region has a cap
  std::optional<SizeSites> shape_;
  std::vector<Vec3> axes_;  ///< per given site of `shape_`
  CuspSizes cusps_;
};

}  // namespace tetrafront
