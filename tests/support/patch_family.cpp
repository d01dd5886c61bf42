#include "support/patch_family.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "model/check_model.h"
#include "model/resolved_model.h"
#include "support/models.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/surface_measures.h"

namespace tetrafront::testing {

namespace {

/// A random patch that folds, touches itself or is degenerate is drawn again, at most this many
/// times.
constexpr std::uint64_t kMaxDraws = 100;
/// Degrees. Other tests cover cusps.
constexpr double kLeastCorner = 5.0;

/// A flat trapezoid of paper that is bent and twisted.
class Paper {
 public:
  explicit Paper(Random& random)
      : width_(random.between(0.6, 2.5)),
        taper_(random.between(0.15, 1.0)),
        skew_(random.between(-0.4, 0.4)),
        bend_(random.between(0.0, std::numbers::pi)),
        twist_(random.coin() ? random.between(-1.5, 1.5) : 0.0),
        alongHeight_(random.coin()) {}

  [[nodiscard]] Vec3 at(double u, double v) const {
    double x = (u - 0.5) * width_ * (1.0 + (taper_ - 1.0) * v) + skew_ * (v - 0.5);
    double y = v - 0.5;
    double z = 0.0;
    double& bent = alongHeight_ ? y : x;
    const double curvature = bend_ / (alongHeight_ ? 1.0 : width_ + std::fabs(skew_));
    if (curvature > 1e-6) {
      z = (1.0 - std::cos(bent * curvature)) / curvature;
      bent = std::sin(bent * curvature) / curvature;
    }
    const double angle = twist_ * (v - 0.5);
    return {std::cos(angle) * x - std::sin(angle) * z, y,
            std::sin(angle) * x + std::cos(angle) * z};
  }

 private:
  double width_;
  double taper_;
  double skew_;
  double bend_;
  double twist_;
  bool alongHeight_;
};

/// Returns a slightly bent line drawn on the paper from one corner to the next.
std::vector<Vec3> edgeOfPaper(Random& random, const Paper& paper, const Vec2& from, const Vec2& to,
                              LineType& type) {
  const int draw = random.integer(0, 5);
  if (type != LineType::kParabolic && draw < 2)
    type = draw == 0 ? LineType::kStraight : LineType::kParabolic;
  const int pieces = type == LineType::kStraight ? 1 : type == LineType::kParabolic ? 2 : 6;
  const double sway = random.between(-0.12, 0.12);
  const Vec2 across(from.y - to.y, to.x - from.x);
  std::vector<Vec3> positions;
  for (int i = 0; i <= pieces; ++i) {
    const bool inner = i > 0 && i < pieces;
    const double t = (i + (inner ? random.between(-0.15, 0.15) : 0.0)) / pieces;
    Vec2 on = from + t * (to - from) + (4.0 * sway * t * (1.0 - t)) * across;
    if (i == pieces) on = to;
    positions.push_back(paper.at(on.x, on.y));
  }
  return positions;
}

Model paperPatch(PatchType type, Random& random) {
  const Paper paper(random);
  const bool triangle =
      type == PatchType::kIsoparametricTriangle || type == PatchType::kBarnhillGregoryNielson;
  const bool parabolic =
      type == PatchType::kIsoparametricTriangle || type == PatchType::kSerendipity;
  std::vector<Vec2> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  if (triangle) corners = {{0, 0}, {1, 0}, {random.between(0.2, 0.8), 1}};
  ModelBuilder builder;
  Loop loop;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    LineType line = parabolic ? LineType::kParabolic : LineType::kSpline;
    std::vector<Vec3> positions =
        edgeOfPaper(random, paper, corners[i], corners[(i + 1) % corners.size()], line);
    const bool reversed = random.coin();
    if (reversed) std::ranges::reverse(positions);
    loop.push_back({builder.line(line, positions), reversed});
  }
  builder.patch(type, {loop});
  return std::move(builder.model);
}

// ---- planar ------------------------------------------------------------------------------------

/// Returns a star-shaped loop of bent lines.
Loop bentLoop(Random& random, ModelBuilder& builder, const Vec2& centre, double low, double high,
              int corners, double bend) {
  std::vector<Vec2> positions;
  const double first = random.between(0.0, 6.28);
  for (int i = 0; i < corners; ++i) {
    const double angle = first + 6.283185307179586 * (i + random.between(-0.2, 0.2)) / corners;
    positions.push_back(centre +
                        random.between(low, high) * Vec2(std::cos(angle), std::sin(angle)));
  }
  Loop loop;
  for (int i = 0; i < corners; ++i) {
    const Vec2 a = positions[i];
    const Vec2 b = positions[(i + 1) % corners];
    const Vec2 across(b.y - a.y, a.x - b.x);
    const double bulge = random.between(-bend, bend);
    const auto type = static_cast<LineType>(random.integer(0, 2));
    const int pieces = type == LineType::kStraight ? 1 : type == LineType::kParabolic ? 2 : 4;
    std::vector<Vec3> line;
    for (int k = 0; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      Vec2 at = a + t * (b - a) + (4.0 * bulge * t * (1.0 - t)) * across;
      if (k == pieces) at = b;
      line.emplace_back(at.x, at.y, 0.25);
    }
    const bool reversed = random.coin();
    if (reversed) std::ranges::reverse(line);
    loop.push_back({builder.line(type, line), reversed});
  }
  return loop;
}

Model planarPatch(Random& random) {
  ModelBuilder builder;
  std::vector<Loop> loops{
      bentLoop(random, builder, Vec2(0.0), 0.8, 1.3, random.integer(3, 8), 0.3)};
  const int holes = loops.front().size() < 5 ? 0 : random.integer(0, 3);
  for (int hole = 0; hole < holes; ++hole) {
    const Vec2 centre((hole & 1) != 0 ? 0.3 : -0.3, (hole & 2) != 0 ? 0.3 : -0.2);
    loops.push_back(bentLoop(random, builder, centre, 0.1, 0.22, random.integer(3, 6), 0.3));
  }
  builder.patch(PatchType::kPlanar, std::move(loops));
  return std::move(builder.model);
}

double angleBetween(const Vec3& a, const Vec3& b) {
  const double cosine = glm::dot(a, b) / (glm::length(a) * glm::length(b));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

/// Returns true if no two lines meet at an angle below kLeastCorner; random lines may even cross at
/// a corner.
bool cornersAreOpen(const Model& model) {
  const ResolvedModel resolved(model);
  for (const Loop& loop : model.patches.front().loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 before = resolved.curve(loop[i]).sample(1.0).derivative;
      const Vec3 after = resolved.curve(loop[(i + 1) % loop.size()]).sample(0.0).derivative;
      if (angleBetween(-before, after) < kLeastCorner) return false;
    }
  }
  return true;
}

/// Returns the edge of a square with the area of a regular polygon (or a circle) that has the same
/// number of corners and the same perimeter as the patch.
double widthOf(const Model& model) {
  const ResolvedModel resolved(model);
  double perimeter = 0.0;
  const Loop& outer = model.patches.front().loops.front();
  for (const OrientedLine& line : outer) perimeter += resolved.curve(line).length();
  const double share = outer.size() == 3 ? 0.219 : outer.size() == 4 ? 0.25 : 0.27;
  return share * perimeter;
}

// ---- measures ----------------------------------------------------------------------------------

double distanceFromSide(const Vec3& position, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double t = std::clamp(glm::dot(position - from, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(position - (from + t * along));
}

/// 2 x inradius / circumradius.
double radiusRatio(const std::array<double, 3>& edges) {
  const auto [a, b, c] = edges;
  return (b + c - a) * (c + a - b) * (a + b - c) / (a * b * c);
}

using Sides = std::map<std::uint32_t, std::vector<std::uint32_t>>;

/// Returns the boundary nodes with their neighbours along the boundary.
Sides neighboursAlongSides(const SurfaceMesh& mesh) {
  Sides sides;
  for (std::size_t i = 0; i < mesh.sides.size(); i += 2) {
    sides[mesh.sides[i]].push_back(mesh.sides[i + 1]);
    sides[mesh.sides[i + 1]].push_back(mesh.sides[i]);
  }
  return sides;
}

/// Returns for each boundary node the angle between its sides, inside the patch.
std::map<std::uint32_t, double> cornerAngles(const SurfaceMesh& mesh, const Sides& sides) {
  std::map<std::uint32_t, double> angles;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::size_t t = i - i % 3;
    if (!sides.contains(mesh.triangles[i])) continue;
    const Vec3 here = pointOf(mesh, mesh.triangles[i]);
    angles[mesh.triangles[i]] +=
        angleBetween(pointOf(mesh, mesh.triangles[t + (i + 1) % 3]) - here,
                     pointOf(mesh, mesh.triangles[t + (i + 2) % 3]) - here);
  }
  return angles;
}

}  // namespace

FamilyMember patchOfFamily(PatchType type, std::uint64_t seed) {
  for (std::uint64_t draw = 0; draw < kMaxDraws; ++draw) {
    Random random(1000 * seed + draw);
    const double elements = random.between(8.0, 40.0);
    FamilyMember member{type == PatchType::kPlanar ? planarPatch(random) : paperPatch(type, random),
                        0.0};
    if (!diagnoseModel(member.model).empty() || !cornersAreOpen(member.model)) continue;
    member.size = widthOf(member.model) / elements;
    return member;
  }
  return {};
}

PatchQuality measureQuality(const SurfaceMesh& mesh, double size) {
  constexpr double kSharpCorner = 40.0;
  const SurfaceMeasures all = measure(mesh, SizeField::uniform(size));
  PatchQuality quality;
  quality.closed = all.borderEdges == mesh.sideLine.size() && all.nonManifoldEdges == 0;
  quality.minAngleOfAll = all.minAngle;
  quality.meanEdge = all.meanEdgeRatio;
  std::vector<double> lengths;
  for (const auto& [nodes, uses] : countEdges(mesh))
    lengths.push_back(glm::length(pointOf(mesh, nodes.first) - pointOf(mesh, nodes.second)) / size);
  std::ranges::sort(lengths);
  quality.shortEdge = lengths[lengths.size() / 40];
  quality.longEdge = lengths[lengths.size() - 1 - lengths.size() / 40];

  const Sides sides = neighboursAlongSides(mesh);
  const std::map<std::uint32_t, double> corners = cornerAngles(mesh, sides);
  std::size_t free = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    bool sharp = false;
    bool across = false;
    double least = 180.0;
    std::array<double, 3> edges{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t + k];
      const std::uint32_t b = mesh.triangles[t + (k + 1) % 3];
      const std::uint32_t c = mesh.triangles[t + (k + 2) % 3];
      edges[k] = glm::length(pointOf(mesh, b) - pointOf(mesh, a));
      least = std::min(least, angleBetween(pointOf(mesh, b) - pointOf(mesh, a),
                                           pointOf(mesh, c) - pointOf(mesh, a)));
      const auto onBoundary = sides.find(a);
      if (onBoundary == sides.end()) continue;
      sharp = sharp || corners.at(a) < kSharpCorner;
      const auto& next = onBoundary->second;
      across = across || (sides.contains(c) && std::ranges::find(next, b) != next.end() &&
                          std::ranges::find(next, c) == next.end() &&
                          std::ranges::find(sides.at(b), c) == sides.at(b).end() &&
                          distanceFromSide(pointOf(mesh, c), pointOf(mesh, a), pointOf(mesh, b)) <
                              0.5 * size);
    }
    if (sharp || across) {
      ++quality.forced;
      continue;
    }
    ++free;
    quality.minAngle = std::min(quality.minAngle, least);
    quality.meanRadiusRatio += radiusRatio(edges);
  }
  quality.meanRadiusRatio /= static_cast<double>(free);
  return quality;
}

}  // namespace tetrafront::testing
