#include "repair/shared_volumes.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace tetrafront {

std::vector<SharedVolume> findSharedVolumes(std::span<const SharedCell> cells) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, SharedVolume> byPair;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> largest;
  for (const SharedCell& cell : cells) {
    for (std::size_t other = 1; other < cell.regions.size(); ++other) {
      const std::pair pair{cell.regions[0], cell.regions[other]};
      SharedVolume& shared = byPair[pair];
      shared.first = pair.first;
      shared.second = pair.second;
      shared.volume += cell.volume;
      if (largest[pair] >= cell.volume) continue;
      largest[pair] = cell.volume;
      shared.depth = cell.width;
      shared.position = cell.position;
    }
  }
  std::vector<SharedVolume> found;
  for (const auto& [pair, shared] : byPair) {
    if (shared.volume > 0.0) found.push_back(shared);
  }
  return found;
}

}  // namespace tetrafront
