#include "remesh/remesh_sizes.h"

#include <algorithm>

#include "field/tensor_limits.h"

namespace tetrafront {

double RemeshSizes::sizeAt(const Vec3& position, Hint& hint) const {
  return cappedAt(position, given_.targetSizeAt(position, hint.field), hint);
}

double RemeshSizes::sizeNear(const Vec3& position, Hint& hint) const {
  const double given = given_.targetSizeAt(position, hint.field);
  if (!shape_) return given;
  const double ofSite = shape_->coneAt(position, hint.site);
  return std::min(given, std::max(ofSite, cusps_.leastAt(position)));
}

SymmetricTensor RemeshSizes::tensorAt(const Vec3& position, Hint& hint) const {
  const SymmetricTensor tensor = given_.targetTensorAt(position, hint.field);
  if (!shape_) return tensor;
  const SizeSites::Value value = ofShape(position, hint);
  const Vec3& axis = axes_[shape_->givenIndexOf(value.site)];
  const double along = largestPossible(tensor);
  if (axis == Vec3(0.0) || along <= value.size) return cappedTo(tensor, value.size);
  const Vec3& a = axis;
  SymmetricTensor limit = SymmetricTensor::isotropic(value.size);
  limit.accumulate({a.x * a.x, a.y * a.y, a.z * a.z, a.x * a.y, a.x * a.z, a.y * a.z},
                   along - value.size);
  return limitedBy(tensor, limit);
}

double RemeshSizes::cappedAt(const Vec3& position, double size, Hint& hint) const {
  return shape_ ? std::min(size, ofShape(position, hint).size) : size;
}

SizeSites::Value RemeshSizes::ofShape(const Vec3& position, Hint& hint) const {
  SizeSites::Value value = shape_->at(position, hint.site);
  hint.site = value.site;
  value.size = std::max(value.size, cusps_.leastAt(position));
  return value;
}

}  // namespace tetrafront
