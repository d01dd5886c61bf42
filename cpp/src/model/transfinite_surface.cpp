#include "model/transfinite_surface.h"

namespace tetrafront {

// ---- Barnhill-Gregory-Nielson --------------------------------------------------------------------

BarnhillGregoryNielsonSurface::BarnhillGregoryNielsonSurface(std::span<const OrientedCurve> loop)
    : lines_{loop[0], loop[1], loop[2]} {}

SurfacePoint BarnhillGregoryNielsonSurface::evaluate(const Vec2& unit) const {
  const double xi = unit.x;
  const double eta = unit.y;
  const Vec3& p1 = lines_[0].start();
  // A line at xi or 1 - xi moves with xi; a line at eta or 1 - eta moves with eta.
  const Curve::Sample f1Xi = lines_[0].sample(xi);
  const Curve::Sample f1Eta = lines_[0].sample(1.0 - eta);
  const Curve::Sample f2Xi = lines_[1].sample(1.0 - xi);
  const Curve::Sample f2Eta = lines_[1].sample(eta);
  const Curve::Sample f3Xi = lines_[2].sample(xi);
  const Curve::Sample f3Eta = lines_[2].sample(1.0 - eta);
  const Vec3 otherAtXi = f1Xi.position + f3Xi.position;
  const Vec3 otherAtEta = f1Eta.position + f3Eta.position;

  SurfacePoint result;
  result.position =
      ((xi * f2Eta.position + eta * f2Xi.position) + (f1Xi.position + f3Eta.position)) -
      (eta * otherAtXi + xi * otherAtEta) - ((1.0 - xi) - eta) * p1;
  result.alongXi = ((f2Eta.position - eta * f2Xi.derivative) + f1Xi.derivative) -
                   (eta * (f1Xi.derivative + f3Xi.derivative) + otherAtEta) + p1;
  result.alongEta = ((xi * f2Eta.derivative + f2Xi.position) - f3Eta.derivative) -
                    (otherAtXi - xi * (f1Eta.derivative + f3Eta.derivative)) + p1;
  return result;
}

// ---- Coons ---------------------------------------------------------------------------------------

CoonsSurface::CoonsSurface(std::span<const OrientedCurve> loop)
    : lines_{loop[0], loop[1], loop[2].reverse(), loop[3].reverse()} {}

SurfacePoint CoonsSurface::evaluate(const Vec2& unit) const {
  const double xi = unit.x;
  const double eta = unit.y;
  const Curve::Sample f1 = lines_[0].sample(xi);
  const Curve::Sample f2 = lines_[1].sample(eta);
  const Curve::Sample f3 = lines_[2].sample(xi);
  const Curve::Sample f4 = lines_[3].sample(eta);
  const Vec3& a = lines_[0].start();
  const Vec3& b = lines_[1].start();
  const Vec3& c = lines_[1].end();
  const Vec3& d = lines_[2].start();
  const double xi1 = 1.0 - xi;
  const double eta1 = 1.0 - eta;

  SurfacePoint result;
  result.position =
      ((eta1 * f1.position + eta * f3.position) + (xi * f2.position + xi1 * f4.position)) -
      ((xi1 * eta1) * a + (xi * eta1) * b + (xi * eta) * c + (eta * xi1) * d);
  result.alongXi = ((eta1 * f1.derivative + eta * f3.derivative) + (f2.position - f4.position)) -
                   (eta1 * (b - a) + eta * (c - d));
  result.alongEta = ((f3.position - f1.position) + (xi * f2.derivative + xi1 * f4.derivative)) -
                    (xi1 * (d - a) + xi * (c - b));
  return result;
}

}  // namespace tetrafront
