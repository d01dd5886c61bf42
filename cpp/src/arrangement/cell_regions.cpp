#include "arrangement/cell_regions.h"

#include <algorithm>

#include "tetrafront/mesh.h"

namespace tetrafront {
namespace {

using Windings = std::vector<std::pair<std::uint32_t, std::int64_t>>;

void addTo(Windings& windings, std::uint32_t region, std::int64_t number) {
  if (region == SurfaceMesh::kNoRegion) return;
  const auto place = std::ranges::lower_bound(windings, region, {}, &Windings::value_type::first);
  if (place == windings.end() || place->first != region) {
    windings.insert(place, {region, number});
    return;
  }
  place->second += number;
  if (place->second == 0) windings.erase(place);
}

}  // namespace

void CellRegions::addWall(std::uint32_t before, std::uint32_t behind,
                          std::span<const PartOwner> owners) {
  Wall wall{before, behind, {}};
  for (const PartOwner& owner : owners) {
    const std::int64_t number = owner.isReversed ? -1 : 1;
    addTo(wall.step, sides_[2 * owner.triangle.index()], number);
    addTo(wall.step, sides_[2 * owner.triangle.index() + 1], -number);
  }
  walls_.push_back(std::move(wall));
}

bool CellRegions::find(std::span<const std::uint32_t> outside) {
  std::vector<std::vector<std::uint32_t>> wallsOf(windings_.size());
  for (std::uint32_t w = 0; w < walls_.size(); ++w) {
    wallsOf[walls_[w].before].push_back(w);
    if (walls_[w].behind != walls_[w].before) wallsOf[walls_[w].behind].push_back(w);
  }
  std::vector<std::uint8_t> isKnown(windings_.size(), 0);
  std::vector<std::uint32_t> found(outside.begin(), outside.end());
  for (const std::uint32_t cell : found) isKnown[cell] = 1;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::uint32_t here = found[i];
    for (const std::uint32_t w : wallsOf[here]) {
      const bool isBefore = walls_[w].before == here;
      const std::uint32_t beyond = isBefore ? walls_[w].behind : walls_[w].before;
      Windings expected = windings_[here];
      for (const auto& [region, number] : walls_[w].step) {
        addTo(expected, region, isBefore ? number : -number);
      }
      if (isKnown[beyond] != 0) {
        if (windings_[beyond] != expected) return false;
        continue;
      }
      isKnown[beyond] = 1;
      windings_[beyond] = std::move(expected);
      found.push_back(beyond);
    }
  }
  return true;
}

std::vector<std::uint32_t> CellRegions::regionsOf(std::uint32_t cell) const {
  std::vector<std::uint32_t> regions;
  for (const auto& [region, winding] : windings_[cell]) {
    if (winding > 0) regions.push_back(region);
  }
  return regions;
}

std::uint32_t CellRegions::lowestOf(std::uint32_t cell) const {
  for (const auto& [region, winding] : windings_[cell]) {
    if (winding > 0) return region;
  }
  return SurfaceMesh::kNoRegion;
}

}  // namespace tetrafront
