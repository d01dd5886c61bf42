#include "support/mesh_validator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "support/exact_oracle.h"
#include "support/shapes.h"

namespace tetrafront::testing {
namespace {

using Triple = std::array<std::uint32_t, 3>;

/// Rotates the lowest node to the front: the result depends on the orientation, but not on the
/// first node.
Triple beginningLowest(Triple t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

Vec3 positionOf(const VolumeMesh& mesh, std::uint32_t node) {
  return {mesh.points[3 * std::size_t{node}], mesh.points[3 * std::size_t{node} + 1],
          mesh.points[3 * std::size_t{node} + 2]};
}

/// Returns the sign of the volume; uses doubles if they are certain, and exact arithmetic
/// otherwise.
int volumeSign(const std::array<Vec3, 4>& p) {
  const Vec3 u = p[1] - p[0];
  const Vec3 v = p[2] - p[0];
  const Vec3 w = p[3] - p[0];
  const double det = glm::dot(u, glm::cross(v, w));
  const double size = std::sqrt(glm::dot(u, u) * glm::dot(v, v) * glm::dot(w, w));
  if (std::fabs(det) > 1e-13 * size) return det > 0.0 ? 1 : -1;
  return oracleOrient3d(p[0], p[1], p[2], p[3]);
}

template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

std::string complaintAboutNumbers(const VolumeMesh& mesh, const SurfaceMesh& surface) {
  if (mesh.tetrahedra.empty()) return "no tetrahedra";
  if (mesh.points.size() % 3 != 0 || mesh.tetrahedra.size() % 4 != 0) return "odd array sizes";
  for (const double x : mesh.points) {
    if (!std::isfinite(x)) return "coordinate not finite";
  }
  for (const std::uint32_t node : mesh.tetrahedra) {
    if (node >= mesh.points.size() / 3) return sentence("index out of range: ", node);
  }
  if (surface.points.size() > mesh.points.size()) return "fewer nodes than the surface has";
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    if (surface.points[i] != mesh.points[i]) return sentence("surface node moved: ", i / 3);
  }
  std::map<std::array<double, 3>, std::uint32_t> positions;
  const std::set<std::uint32_t> used(mesh.tetrahedra.begin(), mesh.tetrahedra.end());
  for (const std::uint32_t node : used) {
    const Vec3 p = positionOf(mesh, node);
    const auto [at, isNew] = positions.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, node);
    if (!isNew) return sentence("nodes ", at->second, " and ", node, " are at one position");
  }
  return {};
}

Triple reversed(const Triple& t) { return beginningLowest({t[0], t[2], t[1]}); }

/// Returns the faces that the tetrahedra at the surface should have, seen from outside, each with
/// the region of its tetrahedron. An interface has two entries. Without regions in the surface, no
/// region is set.
std::map<Triple, std::uint32_t> expectedFaces(const SurfaceMesh& surface) {
  std::map<Triple, std::uint32_t> expected;
  for (std::size_t t = 0; t < triangleCount(surface); ++t) {
    const std::uint32_t* n = &surface.triangles[3 * t];
    const Triple face = beginningLowest({n[0], n[1], n[2]});
    const bool isKnown = !surface.triangleRegions.empty();
    expected.emplace(face, isKnown ? surface.triangleRegions[2 * t] : SurfaceMesh::kNoRegion);
    if (surface.isInterface(t))
      expected.emplace(reversed(face), surface.triangleRegions[2 * t + 1]);
  }
  return expected;
}

std::string complaintAboutTopology(const VolumeMesh& mesh, const SurfaceMesh& surface) {
  const std::map<Triple, std::uint32_t> expected = expectedFaces(surface);
  const bool knowsRegions = !surface.triangleRegions.empty();
  std::set<std::array<std::uint32_t, 4>> tetrahedra;
  std::map<Triple, std::uint32_t> unmatched;
  for (std::size_t t = 0; t < mesh.tetrahedra.size() / 4; ++t) {
    std::array<std::uint32_t, 4> n;
    std::copy_n(&mesh.tetrahedra[4 * t], 4, n.begin());
    const std::uint32_t region = knowsRegions ? mesh.regions.at(t) : SurfaceMesh::kNoRegion;
    for (const Triple& corners : {Triple{n[1], n[2], n[3]}, Triple{n[0], n[3], n[2]},
                                  Triple{n[0], n[1], n[3]}, Triple{n[0], n[2], n[1]}}) {
      const Triple face = beginningLowest(corners);
      const auto other = unmatched.find(reversed(face));
      const bool isInterface = expected.contains(face) && expected.contains(reversed(face));
      if (other != unmatched.end() && !isInterface) {
        if (other->second != region) return sentence("regions meet within: tetrahedron ", t);
        unmatched.erase(other);
      } else if (!unmatched.emplace(face, region).second) {
        return sentence("two tetrahedra on one side of face ", face[0], " ", face[1], " ", face[2]);
      }
    }
    std::sort(n.begin(), n.end());
    if (!tetrahedra.insert(n).second) return sentence("tetrahedron ", t, " is a repetition");
  }
  if (expected == unmatched) return {};
  std::size_t missing = 0;
  std::size_t misplaced = 0;
  for (const auto& [face, region] : expected) {
    const auto found = unmatched.find(face);
    missing += found == unmatched.end() ? 1 : 0;
    misplaced += found != unmatched.end() && found->second != region ? 1 : 0;
  }
  return sentence("boundary differs: ", missing, " of ", expected.size(), " triangles missing, ",
                  unmatched.size() + missing - expected.size(), " faces too many, ", misplaced,
                  " in another region");
}

bool areClose(double a, double b) { return std::fabs(a - b) <= 1e-10 * std::fabs(b); }

std::string complaintAboutVolumes(const VolumeMesh& mesh, const SurfaceMesh& surface) {
  double sum = 0.0;
  std::map<std::uint32_t, double> ofRegion;
  for (std::size_t t = 0; t < mesh.tetrahedra.size() / 4; ++t) {
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = positionOf(mesh, mesh.tetrahedra[4 * t + k]);
    if (volumeSign(p) <= 0) return sentence("volume of tetrahedron ", t, " is not positive");
    const double volume = glm::dot(p[1] - p[0], glm::cross(p[2] - p[0], p[3] - p[0])) / 6.0;
    sum += volume;
    if (!surface.triangleRegions.empty()) ofRegion[mesh.regions.at(t)] += volume;
  }
  if (surface.triangleRegions.empty()) {
    const double expected = enclosedVolume(surface);
    return areClose(sum, expected) ? ""
                                   : sentence("volumes sum to ", sum, " instead of ", expected);
  }
  const std::vector<double> expected = regionVolumes(surface);
  if (expected.size() != ofRegion.size()) return sentence(ofRegion.size(), " regions are filled");
  for (const auto& [region, volume] : ofRegion) {
    if (areClose(volume, expected.at(region))) continue;
    return sentence("region ", region, " has the volume ", volume, " instead of ",
                    expected[region]);
  }
  return {};
}

}  // namespace

std::string complaintAbout(const VolumeMesh& mesh, const SurfaceMesh& surface) {
  for (const auto& check : {complaintAboutNumbers, complaintAboutVolumes, complaintAboutTopology}) {
    std::string complaint = check(mesh, surface);
    if (!complaint.empty()) return complaint;
  }
  return {};
}

}  // namespace tetrafront::testing
