#include "remesh/centred.h"

#include "boundary/centred_surface.h"

namespace tetrafront {

namespace {

void move(SpaceCurve& curve, const Vec3& by) {
  curve.frame.origin += by;
  for (Vec3& pole : curve.spline.poles) pole += by;
}

}  // namespace

BackgroundGrid relativeTo(const Vec3& centre, const BackgroundGrid& grid) {
  BackgroundGrid moved = grid;
  for (BackgroundNode& node : moved.nodes) node.position -= centre;
  for (SizeSource& source : moved.sources) {
    for (Vec3& point : source.points) point -= centre;
  }
  return moved;
}

TrimmedModel relativeTo(const Vec3& centre, TrimmedModel model) {
  if (centre == Vec3(0.0)) return model;
  for (Vec3& vertex : model.vertices) vertex -= centre;
  for (SpaceCurve& curve : model.curves) move(curve, -centre);
  for (FaceSurface& surface : model.surfaces) {
    surface.frame.origin -= centre;
    for (Vec3& pole : surface.spline.poles) pole -= centre;
    move(surface.profile, -centre);
  }
  return model;
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
