#pragma once

/// @file The target size of the triangles that the remesher makes: the given size field, capped by the sizes that the shape
/// asks for.

#include <optional>
#include <utility>

#include "field/size_field.h"
#include "field/size_sites.h"
#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class RemeshSizes {
 public:
  explicit RemeshSizes(SizeField given) : given_(std::move(given)) {}

  /// Caps sizes by those that grow from the sites. In a stretched field, all axes are scaled by one factor.
  void capTo(SizeSites sites) { shape_ = std::move(sites); }

  /// Where the last query was. Keep one per node: near queries are faster.
  struct Hint {
    FieldHint field;
    SiteId site{0U};
  };
  [[nodiscard]] bool isStretched() const { return given_.isStretched(); }
  [[nodiscard]] double sizeAt(const Vec3& position, Hint& hint) const;
  [[nodiscard]] SymmetricTensor tensorAt(const Vec3& position, Hint& hint) const;

 private:
  [[nodiscard]] double cappedAt(const Vec3& position, double size, Hint& hint) const;

  SizeField given_;
  std::optional<SizeSites> shape_;
};

}  // namespace tetrafront
