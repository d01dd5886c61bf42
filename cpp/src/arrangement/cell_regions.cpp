#include "arrangement/cell_regions.h"

#include <algorithm>
#include <cstddef>

#include "tetrafront/mesh.h"

namespace tetrafront {

void addWinding(RegionWindings& windings, std::uint32_t region, std::int64_t number) {
  if (region == SurfaceMesh::kNoRegion) return;
  const auto place =
      std::ranges::lower_bound(windings, region, {}, &RegionWindings::value_type::first);
  if (place == windings.end() || place->first != region) {
    windings.insert(place, {region, number});
    return;
  }
  place->second += number;
  if (place->second == 0) windings.erase(place);
}

void CellRegions::addWall(std::uint32_t before, std::uint32_t behind,
                          std::span<const PartOwner> owners) {
  Wall wall{before, behind, {}};
  for (const PartOwner& owner : owners) {
    const std::int64_t number = owner.isReversed ? -1 : 1;
    addWinding(wall.step, sides_[2 * owner.triangle.index()], number);
    addWinding(wall.step, sides_[2 * owner.triangle.index() + 1], -number);
  }
  walls_.push_back(std::move(wall));
}

bool CellRegions::find(std::vector<Known> known) {
  std::vector<std::vector<std::uint32_t>> wallsOf(windings_.size());
  for (std::uint32_t w = 0; w < walls_.size(); ++w) {
    wallsOf[walls_[w].before].push_back(w);
    if (walls_[w].behind != walls_[w].before) wallsOf[walls_[w].behind].push_back(w);
  }
  std::vector<std::uint8_t> isKnown(windings_.size(), 0);
  std::vector<std::uint32_t> found;
  for (Known& one : known) {
    isKnown[one.cell] = 1;
    windings_[one.cell] = std::move(one.windings);
    found.push_back(one.cell);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::uint32_t here = found[i];
    for (const std::uint32_t w : wallsOf[here]) {
      const bool isBefore = walls_[w].before == here;
      const std::uint32_t beyond = isBefore ? walls_[w].behind : walls_[w].before;
      RegionWindings expected = windings_[here];
      for (const auto& [region, number] : walls_[w].step) {
        addWinding(expected, region, isBefore ? number : -number);
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
  countCells();
  return true;
}

void CellRegions::countCells() {
  for (const RegionWindings& windings : windings_) {
    for (std::size_t i = 0; i < windings.size(); ++i) {
      if (windings[i].second <= 0) continue;
      ++cellsIn_[windings[i].first];
      for (std::size_t k = i + 1; k < windings.size(); ++k) {
        if (windings[k].second > 0) ++cellsInBoth_[{windings[i].first, windings[k].first}];
      }
    }
  }
}

bool CellRegions::isWithin(std::uint32_t inner, std::uint32_t outer) const {
  const auto both = cellsInBoth_.find({std::min(inner, outer), std::max(inner, outer)});
  if (both == cellsInBoth_.end()) return false;
  return both->second == cellsIn_.at(inner) && both->second < cellsIn_.at(outer);
}

std::vector<std::uint32_t> CellRegions::regionsOf(std::uint32_t cell) const {
  std::vector<std::uint32_t> regions;
  for (const auto& [region, winding] : windings_[cell]) {
    if (winding > 0) regions.push_back(region);
  }
  const auto containsNone = [&](std::uint32_t outer) {
    return std::ranges::none_of(regions,
                                [&](std::uint32_t inner) { return isWithin(inner, outer); });
  };
  const auto owner = std::ranges::find_if(regions, containsNone);
  if (owner != regions.end()) std::rotate(regions.begin(), owner, owner + 1);
  return regions;
}

}  // namespace tetrafront
