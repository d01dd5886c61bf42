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

/// The same for the three ways to begin a triangle, different for its two sides.
Triple beginningLowest(Triple t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

Vec3 placeOf(const VolumeMesh& mesh, std::uint32_t node) {
  return {mesh.points[3 * std::size_t{node}], mesh.points[3 * std::size_t{node} + 1],
          mesh.points[3 * std::size_t{node} + 2]};
}

/// In double where that is beyond doubt.
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
  std::map<std::array<double, 3>, std::uint32_t> places;
  const std::set<std::uint32_t> used(mesh.tetrahedra.begin(), mesh.tetrahedra.end());
  for (const std::uint32_t node : used) {
    const Vec3 p = placeOf(mesh, node);
    const auto [at, isNew] = places.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, node);
    if (!isNew) return sentence("nodes ", at->second, " and ", node, " are at one place");
  }
  return {};
}

std::string complaintAboutTopology(const VolumeMesh& mesh, const SurfaceMesh& surface) {
  std::set<std::array<std::uint32_t, 4>> tetrahedra;
  std::set<Triple> unmatched;
  for (std::size_t t = 0; t < mesh.tetrahedra.size() / 4; ++t) {
    std::array<std::uint32_t, 4> n;
    std::copy_n(&mesh.tetrahedra[4 * t], 4, n.begin());
    for (const Triple& face : {Triple{n[1], n[2], n[3]}, Triple{n[0], n[3], n[2]},
                               Triple{n[0], n[1], n[3]}, Triple{n[0], n[2], n[1]}}) {
      const Triple other = beginningLowest({face[0], face[2], face[1]});
      if (unmatched.erase(other) == 1) continue;
      if (!unmatched.insert(beginningLowest(face)).second) {
        return sentence("two tetrahedra on one side of face ", face[0], " ", face[1], " ", face[2]);
      }
    }
    std::sort(n.begin(), n.end());
    if (!tetrahedra.insert(n).second) return sentence("tetrahedron ", t, " is a repetition");
  }
  std::set<Triple> wanted;
  for (std::size_t h = 0; h < surface.triangles.size(); h += 3) {
    wanted.insert(beginningLowest(
        {surface.triangles[h], surface.triangles[h + 1], surface.triangles[h + 2]}));
  }
  if (wanted == unmatched) return {};
  std::size_t missing = 0;
  for (const Triple& t : wanted) missing += unmatched.count(t) == 0 ? 1 : 0;
  return sentence("boundary differs: ", missing, " of ", wanted.size(), " triangles missing, ",
                  unmatched.size() + missing - wanted.size(), " faces too many");
}

std::string complaintAboutVolumes(const VolumeMesh& mesh, const SurfaceMesh& surface) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size() / 4; ++t) {
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = placeOf(mesh, mesh.tetrahedra[4 * t + k]);
    if (volumeSign(p) <= 0) return sentence("volume of tetrahedron ", t, " is not positive");
    sum += glm::dot(p[1] - p[0], glm::cross(p[2] - p[0], p[3] - p[0])) / 6.0;
  }
  const double wanted = enclosedVolume(surface);
  if (std::fabs(sum - wanted) <= 1e-10 * std::fabs(wanted)) return {};
  return sentence("volumes sum to ", sum, " instead of ", wanted);
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
