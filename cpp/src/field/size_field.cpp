#include "field/size_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "field/tensor_limits.h"
#include "geom/cube_root.h"

namespace tetrafront {

SizeField SizeField::uniform(double size) { return {std::in_place_type<double>, size}; }
SizeField SizeField::fromGrid(GridLocator locator) {
  return {std::in_place_type<GridLocator>, std::move(locator)};
}
SizeField SizeField::fromOctree(SizeOctree octree) {
  return {std::in_place_type<SizeOctree>, std::move(octree)};
}

void SizeField::addSources(std::span<const SizeSource> sources) {
  std::vector<SizeSource> all(sources_.all().begin(), sources_.all().end());
  all.insert(all.end(), sources.begin(), sources.end());
  sources_ = SizeSources(all);
}

void SizeField::capTo(SizeOctree ceiling) { ceiling_ = std::move(ceiling); }

void SizeField::raiseTo(SizeOctree floor) { floor_ = std::move(floor); }

void SizeField::capSizes(double everywhere, std::vector<double> ofRegions) {
  cap_ = everywhere > 0.0 ? everywhere : std::numeric_limits<double>::infinity();
  regionCaps_ = std::move(ofRegions);
}

double SizeField::capOf(std::uint32_t region) const {
  if (region >= regionCaps_.size() || !(regionCaps_[region] > 0.0)) return cap_;
  return std::min(cap_, regionCaps_[region]);
}

double SizeField::raiseFactorAt(const Vec3& position, double meanSize) const {
  return floor_ ? std::max(1.0, floor_->sizeAt(position) / meanSize) : 1.0;
}

double SizeField::sizeAt(const Vec3& position, FieldHint& hint) const {
  const double size = targetSizeAt(position, hint);
  return floor_ ? std::max(size, floor_->sizeAt(position)) : size;
}

SymmetricTensor SizeField::tensorAt(const Vec3& position, FieldHint& hint) const {
  const SymmetricTensor tensor = targetTensorAt(position, hint);
  return floor_ ? tensor.scaledBy(raiseFactorAt(position, meanSizeOf(tensor))) : tensor;
}

double SizeField::targetSizeAt(const Vec3& position, FieldHint& hint) const {
  double size = baseSizeAt(position, hint);
  if (ceiling_) size = std::min(size, ceiling_->sizeAt(position));
  size = std::min(size, capOf(hint.region));
  return sources_.empty() ? size : sources_.cappedSize(position, size);
}

double SizeField::baseSizeAt(const Vec3& position, FieldHint& hint) const {
  if (const auto* octree = std::get_if<SizeOctree>(&base_)) return octree->sizeAt(position);
  if (const auto* size = std::get_if<double>(&base_)) return *size;
  const auto& grid = std::get<GridLocator>(base_);
  return grid.sizeAt(locate(grid, position, hint));
}

bool SizeField::isStretched() const {
  const auto* grid = std::get_if<GridLocator>(&base_);
  return grid != nullptr && grid->isStretched();
}

SymmetricTensor SizeField::targetTensorAt(const Vec3& position, FieldHint& hint) const {
  const auto* grid = std::get_if<GridLocator>(&base_);
  if (grid == nullptr) return SymmetricTensor::isotropic(targetSizeAt(position, hint));
  SymmetricTensor tensor = grid->tensorAt(locate(*grid, position, hint));
  if (ceiling_) {
    tensor = tensor.scaledBy(std::min(1.0, ceiling_->sizeAt(position) / meanSizeOf(tensor)));
  }
  const double cap = capOf(hint.region);
  if (std::isfinite(cap)) {
    tensor = tensor.scaledBy(std::min(1.0, cap / cubeRoot(tensor.determinant())));
  }
  if (sources_.empty()) return tensor;
  return cappedTo(tensor, sources_.cappedSize(position, largestPossible(tensor)));
}

bool SizeField::covers(const Vec3& position, FieldHint& hint) const {
  const auto* grid = std::get_if<GridLocator>(&base_);
  return grid == nullptr || locate(*grid, position, hint).inside;
}

GridLocator::Location SizeField::locate(const GridLocator& grid, const Vec3& position,
                                        FieldHint& hint) {
  const GridLocator::Location location = grid.locate(position, hint.tetrahedron);
  hint.tetrahedron = location.tetrahedron;
  return location;
}

}  // namespace tetrafront
