#include "support/planes.h"

#include <array>
#include <cmath>
#include <fstream>
#include <ios>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "base/fingerprint.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

FrontOrder orderNamed(const std::string& name) {
  if (name == "smallest-first") return FrontOrder::kSmallestFirst;
  if (name == "first-in") return FrontOrder::kFirstIn;
  return name == "random" ? FrontOrder::kRandom : FrontOrder::kLayered;
}

/// Adds a loop around a centre, with a radius per corner.
void addLoop(const Vec2& centre, const std::vector<double>& radii, Plane& plane) {
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(radii.size());
    plane.points.push_back(centre.x + radii[i] * std::cos(angle));
    plane.points.push_back(centre.y + radii[i] * std::sin(angle));
  }
  plane.loops.push_back(static_cast<std::uint32_t>(radii.size()));
}

}  // namespace

PlaneFill fillOf(const Plane& plane) {
  return fillPlane(plane.points, plane.loops, plane.grid, plane.options, plane.experiment);
}

std::string fingerprintOf(const PlaneFill& fill) {
  Fingerprint fingerprint;
  fingerprint.add(fill.points);
  fingerprint.add(fill.triangles);
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << fingerprint.value();
  return text.str();
}

std::vector<StoredPlane> storedPlanes() {
  std::vector<StoredPlane> planes;
  std::ifstream file(TETRAFRONT_PLANES);
  std::string line;
  while (std::getline(file, line)) {
    StoredPlane stored;
    stored.line = line.substr(0, line.rfind(' '));
    stored.fingerprint = line.substr(line.rfind(' ') + 1);
    std::istringstream words(line);
    std::string order;
    std::string boundary;
    std::string improve;
    PlaneOptions& options = stored.plane.options;
    std::size_t loops = 0;
    words >> stored.name >> order >> options.seed >> boundary >> improve >> options.size >> loops;
    options.order = orderNamed(order);
    options.divide = boundary == "divided";
    options.improve = improve == "improved";
    for (std::size_t loop = 0; loop < loops; ++loop) {
      std::uint32_t count = 0;
      words >> count;
      stored.plane.loops.push_back(count);
      for (std::uint32_t i = 0; i < 2 * count; ++i) words >> stored.plane.points.emplace_back();
    }
    std::size_t sources = 0;
    words >> sources;
    for (std::size_t i = 0; i < sources; ++i) {
      SizeSource& source = stored.plane.grid.sources.emplace_back();
      words >> source.points[0].x >> source.points[0].y >> source.size >> source.distance >>
          source.growth;
    }
    if (words) planes.push_back(std::move(stored));
  }
  return planes;
}

void storePlanes(const std::vector<StoredPlane>& planes) {
  std::ofstream file(TETRAFRONT_PLANES);
  for (const StoredPlane& stored : planes) file << stored.line << ' ' << stored.fingerprint << '\n';
}

Plane randomPlane(std::uint64_t seed, int holes) {
  Random random(seed);
  Plane plane;
  std::vector<double> radii(static_cast<std::size_t>(random.integer(3, 24)));
  for (double& radius : radii) radius = random.between(4.0, 8.0);
  if (radii.size() < 6) radii.resize(6, 5.0);
  addLoop({0.0, 0.0}, radii, plane);
  // Holes lie in a row within the circle that every such polygon contains.
  for (int hole = 0; hole < holes; ++hole) {
    const double x = -2.2 + 4.4 * (hole + 0.5) / holes;
    std::vector<double> small(static_cast<std::size_t>(random.integer(3, 8)));
    for (double& radius : small) radius = random.between(0.5, 0.95) * 2.0 / holes;
    addLoop({x, random.between(-0.3, 0.3)}, small, plane);
  }
  plane.options.size = random.between(0.2, 3.0);
  return plane;
}

}  // namespace tetrafront::testing
