#pragma once

/// @file Solids as trimmed models, with their exact measures.

#include <functional>
#include <string>
#include <vector>

#include "tetrafront/trimmed_model.h"

namespace tetrafront::testing {

struct TrimmedSolid {
  std::string name;
  TrimmedModel model;
  double area = 0.0;
  double volume = 0.0;
  long eulerCharacteristic = 2;
  /// Per face: the distance of a position from its surface, by a formula of its own.
  std::vector<std::function<double(const Vec3&)>> distances;
};

TrimmedSolid trimmedBox(const Vec3& low, const Vec3& high);
TrimmedSolid trimmedCylinder(double radius, double height);
/// A cone with the upper radius `top`; with an apex if it is 0.
TrimmedSolid trimmedCone(double bottom, double top, double height);
TrimmedSolid trimmedSphere(double radius);
TrimmedSolid trimmedTorus(double radius, double minorRadius);
/// A square plate with a hole through its middle.
TrimmedSolid trimmedPlate(double width, double thickness, double holeRadius);
/// As trimmedCylinder() and trimmedSphere(), with rational splines for all curved surfaces and edges.
TrimmedSolid nurbsCylinder(double radius, double height);
TrimmedSolid nurbsSphere(double radius);
/// The area between a polynomial curve y(x) and the x axis from 0 to 1, extruded along z.
TrimmedSolid extrudedProfile(double height);
/// A polynomial curve r(z) from z = 0 to 1 turned about the z axis, closed by two discs.
TrimmedSolid revolvedProfile();

/// All of the above.
std::vector<TrimmedSolid> trimmedSolids();

/// The model in the numbers that readModel() reads.
std::vector<double> numbersOf(const TrimmedModel& model);

}  // namespace tetrafront::testing
