#include "field/size_field.h"

#include <algorithm>
#include <utility>

#include "field/tensor_limits.h"

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

void SizeField::cutTo(SizeOctree ceiling) { ceiling_ = std::move(ceiling); }

void SizeField::liftTo(SizeOctree floor) { floor_ = std::move(floor); }

double SizeField::liftAt(const Vec3& place, double meanSize) const {
  return floor_ ? std::max(1.0, floor_->sizeAt(place) / meanSize) : 1.0;
}

double SizeField::sizeAt(const Vec3& place, FieldHint& hint) const {
  const double size = wantedSizeAt(place, hint);
  return floor_ ? std::max(size, floor_->sizeAt(place)) : size;
}

SymmetricTensor SizeField::tensorAt(const Vec3& place, FieldHint& hint) const {
  const SymmetricTensor tensor = wantedTensorAt(place, hint);
  return floor_ ? tensor.scaledBy(liftAt(place, meanSizeOf(tensor))) : tensor;
}

double SizeField::wantedSizeAt(const Vec3& place, FieldHint& hint) const {
  double size = baseSizeAt(place, hint);
  if (ceiling_) size = std::min(size, ceiling_->sizeAt(place));
  return sources_.empty() ? size : sources_.cappedSize(place, size);
}

double SizeField::baseSizeAt(const Vec3& place, FieldHint& hint) const {
  if (const auto* octree = std::get_if<SizeOctree>(&base_)) return octree->sizeAt(place);
  if (const auto* size = std::get_if<double>(&base_)) return *size;
  const auto& grid = std::get<GridLocator>(base_);
  return grid.sizeAt(locate(grid, place, hint));
}

bool SizeField::isStretched() const {
  const auto* grid = std::get_if<GridLocator>(&base_);
  return grid != nullptr && grid->isStretched();
}

SymmetricTensor SizeField::wantedTensorAt(const Vec3& place, FieldHint& hint) const {
  const auto* grid = std::get_if<GridLocator>(&base_);
  if (grid == nullptr) return SymmetricTensor::isotropic(wantedSizeAt(place, hint));
  SymmetricTensor tensor = grid->tensorAt(locate(*grid, place, hint));
  if (ceiling_) {
    tensor = tensor.scaledBy(std::min(1.0, ceiling_->sizeAt(place) / meanSizeOf(tensor)));
  }
  if (sources_.empty()) return tensor;
  return cappedTo(tensor, sources_.cappedSize(place, largestPossible(tensor)));
}

bool SizeField::covers(const Vec3& place, FieldHint& hint) const {
  const auto* grid = std::get_if<GridLocator>(&base_);
  return grid == nullptr || locate(*grid, place, hint).inside;
}

GridLocator::Location SizeField::locate(const GridLocator& grid, const Vec3& place,
                                        FieldHint& hint) const {
  const GridLocator::Location location = grid.locate(place, hint.tetrahedron);
  hint.tetrahedron = location.tetrahedron;
  ++walked_.queries;
  walked_.steps += location.steps;
  return location;
}

}  // namespace tetrafront
