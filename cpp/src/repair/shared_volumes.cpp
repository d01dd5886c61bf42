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
    for (const auto& [other, isAround] : cell.others) {
      const std::pair pair{cell.owner, other};
      SharedVolume& shared = byPair[pair];
      shared.first = pair.first;
      shared.second = pair.second;
      shared.isNested = isAround;
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
