#include "adapt/poor_list.h"

#include <span>

#include "base/sort.h"

namespace tetrafront {

Task<std::vector<PoorElement>> listPoor(Work& work, const AdaptMesh& mesh, double limit) {
  /// Elements that are only read, per unit.
  constexpr std::size_t kReadPerUnit = 8;
  std::vector<PoorElement> poor;
  co_await work.forEachId<TetId>(
      mesh.elements.size(),
      [&](TetId id) {
        const AdaptElement& element = mesh.element(id);
        if (element.isAlive() && element.quality < limit) poor.push_back({element.quality, id});
      },
      kReadPerUnit);
  SlicedSort sort{std::span<PoorElement>(poor),
                  [](const PoorElement& a, const PoorElement& b) { return a.quality < b.quality; }};
  co_await work.finish(sort);
  co_return poor;
}

}  // namespace tetrafront
