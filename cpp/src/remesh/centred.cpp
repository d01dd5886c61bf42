#include "remesh/centred.h"

#include "boundary/centred_surface.h"

namespace tetrafront {

BackgroundGrid relativeTo(const Vec3& centre, const BackgroundGrid& grid) {
  BackgroundGrid moved = grid;
  for (BackgroundNode& node : moved.nodes) node.position -= centre;
  for (SizeSource& source : moved.sources) {
    for (Vec3& point : source.points) point -= centre;
  }
  return moved;
}

void moveBack(const Vec3& centre, SurfaceRemesh& result) {
  if (centre == Vec3(0.0)) return;
  shift(result.points, centre);
  for (MergedDetail& detail : result.mergedDetails) {
    detail.from += centre;
    detail.onto += centre;
  }
}

}  // namespace tetrafront
