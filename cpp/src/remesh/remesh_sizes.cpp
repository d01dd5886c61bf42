#include "remesh/remesh_sizes.h"

#include <algorithm>

namespace tetrafront {

double RemeshSizes::sizeAt(const Vec3& position, Hint& hint) const {
  return cappedAt(position, given_.targetSizeAt(position, hint.field), hint);
}

SymmetricTensor RemeshSizes::tensorAt(const Vec3& position, Hint& hint) const {
  const SymmetricTensor tensor = given_.targetTensorAt(position, hint.field);
  const double size = meanSizeOf(tensor);
  const double capped = cappedAt(position, size, hint);
  return capped < size ? tensor.scaledBy(capped / size) : tensor;
}

double RemeshSizes::cappedAt(const Vec3& position, double size, Hint& hint) const {
  if (!shape_) return size;
  const SizeSites::Value value = shape_->at(position, hint.site);
  hint.site = value.site;
  return std::min(size, value.size);
}

}  // namespace tetrafront
