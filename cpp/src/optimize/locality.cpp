#include "optimize/locality.h"

#include <algorithm>
#include <numeric>

#include "base/ids.h"

namespace tetrafront {

MortonReordering::MortonReordering(const VolumeMesh& mesh, std::size_t boundaryNodes)
    : mesh_(mesh),
      centroids_(mesh.regions.size()),
      sort_(centroids_),
      newId_(mesh.points.size() / 3, kNoIndex) {
  std::iota(newId_.begin(), newId_.begin() + static_cast<std::ptrdiff_t>(boundaryNodes), 0U);
  ordered_.front = mesh.front;
  ordered_.points.reserve(mesh.points.size());
  ordered_.points.assign(mesh.points.begin(),
                         mesh.points.begin() + static_cast<std::ptrdiff_t>(3 * boundaryNodes));
}

bool MortonReordering::advance(std::size_t budget) {
  if (stage_ == Stage::kSort) {
    if (!sort_.advance(budget)) return false;
    order_ = sort_.take();
    centroids_ = {};
    ordered_.tetrahedra.reserve(mesh_.tetrahedra.size());
    ordered_.regions.reserve(mesh_.regions.size());
    stage_ = Stage::kCopy;
    return false;
  }
  const std::size_t count = mesh_.regions.size();
  const std::size_t last = next_ + std::min(budget, count - next_);
  for (; next_ < last; ++next_) {
    if (stage_ == Stage::kCentroids) {
      addCentroid(next_);
    } else {
      copyElement(order_[next_]);
    }
  }
  if (next_ < count) return false;
  if (stage_ == Stage::kCopy) return true;
  next_ = 0;
  stage_ = Stage::kSort;
  return false;
}

void MortonReordering::addCentroid(std::size_t element) {
  Vec3 sum(0.0);
  for (std::size_t k = 0; k < 4; ++k) {
    const double* at = &mesh_.points[3 * std::size_t{mesh_.tetrahedra[4 * element + k]}];
    sum += Vec3(at[0], at[1], at[2]);
  }
  centroids_[element] = sum * 0.25;
}

/// Appends the element and those of its nodes that no earlier element has.
void MortonReordering::copyElement(std::size_t element) {
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t node = mesh_.tetrahedra[4 * element + k];
    if (newId_[node] == kNoIndex) {
      newId_[node] = static_cast<std::uint32_t>(ordered_.points.size() / 3);
      const double* at = &mesh_.points[3 * node];
      ordered_.points.insert(ordered_.points.end(), at, at + 3);
    }
    ordered_.tetrahedra.push_back(newId_[node]);
  }
  ordered_.regions.push_back(mesh_.regions[element]);
}

VolumeMesh alongMortonCurve(const VolumeMesh& mesh, std::size_t boundaryNodes) {
  MortonReordering reordering(mesh, boundaryNodes);
  while (!reordering.advance(mesh.regions.size())) {
  }
  return reordering.take();
}

}  // namespace tetrafront
