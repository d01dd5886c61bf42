#include "field/size_field.h"

#include <utility>

namespace tetrafront {

SizeField SizeField::uniform(double size) { return SizeField(Source(size)); }
SizeField SizeField::fromGrid(GridLocator locator) { return SizeField(Source(std::move(locator))); }
SizeField SizeField::fromOctree(SizeOctree octree) { return SizeField(Source(std::move(octree))); }

double SizeField::sizeAt(const Vec3& place, FieldHint& hint) const {
  if (const auto* octree = std::get_if<SizeOctree>(&source_)) return octree->sizeAt(place);
  if (const auto* size = std::get_if<double>(&source_)) return *size;
  const auto& grid = std::get<GridLocator>(source_);
  const GridLocator::Location location = grid.locate(place, hint.tetrahedron);
  hint.tetrahedron = location.tetrahedron;
  return grid.sizeAt(location);
}

bool SizeField::isStretched() const {
  const auto* grid = std::get_if<GridLocator>(&source_);
  return grid != nullptr && grid->isStretched();
}

SymmetricTensor SizeField::tensorAt(const Vec3& place, FieldHint& hint) const {
  const auto* grid = std::get_if<GridLocator>(&source_);
  if (grid == nullptr) return SymmetricTensor::isotropic(sizeAt(place, hint));
  const GridLocator::Location location = grid->locate(place, hint.tetrahedron);
  hint.tetrahedron = location.tetrahedron;
  return grid->tensorAt(location);
}

bool SizeField::covers(const Vec3& place, FieldHint& hint) const {
  const auto* grid = std::get_if<GridLocator>(&source_);
  if (grid == nullptr) return true;
  const GridLocator::Location location = grid->locate(place, hint.tetrahedron);
  hint.tetrahedron = location.tetrahedron;
  return location.inside;
}

}  // namespace tetrafront
