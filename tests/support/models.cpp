#include "support/models.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include "support/random.h"

namespace tetrafront::testing {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Number of spline pieces per circle, for any number of arcs.
constexpr int kCirclePieces = 24;

/// Returns two orthonormal vectors that span a random plane.
std::pair<Vec3, Vec3> randomPlane(Random& random) {
  Vec3 u = random.inBox();
  while (glm::length(u) < 0.1) u = random.inBox();
  u = glm::normalize(u);
  Vec3 v = glm::cross(u, random.inBox());
  while (glm::length(v) < 0.1) v = glm::cross(u, random.inBox());
  return {u, glm::normalize(v)};
}

double shoelace(const std::vector<Vec2>& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return 0.5 * std::fabs(sum);
}

std::vector<Vec2> starPolygon(Random& random, const Vec2& centre, double low, double high,
                              int corners) {
  std::vector<Vec2> polygon;
  const double first = random.between(0.0, kTurn);
  for (int i = 0; i < corners; ++i) {
    const double angle = first + kTurn * (i + random.between(-0.2, 0.2)) / corners;
    const double radius = random.between(low, high);
    polygon.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

/// Returns a randomly bent line from a to b, of a type that the patch type accepts.
std::vector<Vec3> randomLine(Random& random, const Vec3& a, const Vec3& b, double bend,
                             PatchType patch, LineType& type) {
  const bool parabolic =
      patch == PatchType::kIsoparametricTriangle || patch == PatchType::kSerendipity;
  type = parabolic ? LineType::kParabolic : static_cast<LineType>(random.integer(0, 2));
  const int inner = type == LineType::kStraight    ? 0
                    : type == LineType::kParabolic ? 1
                                                   : random.integer(2, 4);
  std::vector<Vec3> positions{a};
  for (int i = 1; i <= inner; ++i)
    positions.push_back(a + (static_cast<double>(i) / (inner + 1)) * (b - a) +
                        random.inBox(bend / (inner == 1 ? 1 : 2)));
  positions.push_back(b);
  return positions;
}

/// Returns one patch over a polygon; lines are drawn in random directions.
Model randomPatchOver(Random& random, std::span<const Vec3> corners, double bend, PatchType patch) {
  ModelBuilder builder;
  Loop loop;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    LineType type{};
    std::vector<Vec3> positions =
        randomLine(random, corners[i], corners[(i + 1) % corners.size()], bend, patch, type);
    const bool reversed = random.coin();
    if (reversed) std::ranges::reverse(positions);
    loop.push_back({builder.line(type, positions), reversed});
  }
  builder.patch(patch, {loop});
  return builder.model;
}

Model randomQuadrilateral(PatchType type, std::uint64_t seed, double bend) {
  Random random(seed);
  const double width = random.between(0.7, 3.0);
  const double taper = random.between(0.4, 1.6);
  const std::array<Vec3, 4> corners{random.inBox(bend), Vec3(width, 0, 0) + random.inBox(bend),
                                    Vec3(0.5 * width * (1 + taper), 1, 0) + random.inBox(bend),
                                    Vec3(0.5 * width * (1 - taper), 1, 0) + random.inBox(bend)};
  return randomPatchOver(random, corners, bend, type);
}

/// Returns a solid with one patch per face; faces share the lines between their corners.
Model randomSolid(Random& random, std::span<const Vec3> corners,
                  std::span<const std::vector<int>> faces, double bend, PatchType patch) {
  ModelBuilder builder;
  std::map<std::pair<int, int>, std::uint32_t> lines;
  const auto join = [&](int from, int to) {
    const std::pair<int, int> ends = std::minmax(from, to);
    const auto known = lines.find(ends);
    if (known != lines.end()) return OrientedLine{known->second, from > to};
    LineType type{};
    const std::vector<Vec3> positions =
        randomLine(random, corners[ends.first], corners[ends.second], bend, patch, type);
    lines[ends] = builder.line(type, positions);
    return OrientedLine{lines[ends], from > to};
  };
  for (const std::vector<int>& face : faces) {
    Loop loop;
    for (std::size_t k = 0; k < face.size(); ++k)
      loop.push_back(join(face[k], face[(k + 1) % face.size()]));
    builder.patch(patch, {loop});
  }
  return builder.model;
}

}  // namespace

std::uint32_t ModelBuilder::point(const Vec3& position) {
  const auto found = std::ranges::find(model.points, position);
  const auto index = static_cast<std::uint32_t>(found - model.points.begin());
  if (found == model.points.end()) model.points.push_back(position);
  return index;
}

std::uint32_t ModelBuilder::line(LineType type, const std::vector<Vec3>& positions) {
  Line drawn{type, {}};
  for (const Vec3& position : positions) drawn.points.push_back(point(position));
  model.lines.push_back(std::move(drawn));
  return static_cast<std::uint32_t>(model.lines.size() - 1);
}

OrientedLine ModelBuilder::straight(const Vec3& from, const Vec3& to) {
  const std::uint32_t a = point(from);
  const std::uint32_t b = point(to);
  for (std::uint32_t i = 0; i < model.lines.size(); ++i) {
    const Line& drawn = model.lines[i];
    if (drawn.type != LineType::kStraight) continue;
    if (drawn.points[0] == a && drawn.points[1] == b) return {i, false};
    if (drawn.points[0] == b && drawn.points[1] == a) return {i, true};
  }
  return {line(LineType::kStraight, {from, to}), false};
}

Loop ModelBuilder::polygon(const std::vector<Vec3>& corners) {
  Loop loop;
  for (std::size_t i = 0; i < corners.size(); ++i)
    loop.push_back(straight(corners[i], corners[(i + 1) % corners.size()]));
  return loop;
}

Loop ModelBuilder::circle(const Vec3& centre, double radius, int arcs, const Vec3& u,
                          const Vec3& v) {
  Loop loop;
  const int pieces = kCirclePieces / arcs;
  for (int arc = 0; arc < arcs; ++arc) {
    std::vector<Vec3> positions;
    for (int i = 0; i <= pieces; ++i) {
      const int step = (arc * pieces + i) % (arcs * pieces);
      const double angle = kTurn * step / (arcs * pieces);
      positions.push_back(centre + radius * std::cos(angle) * u + radius * std::sin(angle) * v);
    }
    loop.push_back({line(LineType::kSpline, positions), false});
  }
  return loop;
}

OrientedLine ModelBuilder::exactCircle(const Vec3& centre, double radius, const Vec3& u,
                                       const Vec3& v) {
  const Vec3 start = centre + radius * u;
  return {line(LineType::kCircle, {start, centre + radius * v, centre - radius * u, start}), false};
}

void ModelBuilder::patch(PatchType type, std::vector<Loop> loops) {
  model.patches.push_back({type, std::move(loops)});
}

Model polygonModel(const std::vector<std::vector<Vec3>>& loops) {
  ModelBuilder builder;
  std::vector<Loop> drawn;
  for (const std::vector<Vec3>& corners : loops) drawn.push_back(builder.polygon(corners));
  builder.patch(PatchType::kPlanar, std::move(drawn));
  return builder.model;
}

std::vector<Vec3> squareCorners(const Vec3& corner, double edge) {
  return {corner, corner + Vec3(edge, 0, 0), corner + Vec3(edge, edge, 0),
          corner + Vec3(0, edge, 0)};
}

Model randomCoonsModel(std::uint64_t seed, double bend) {
  return randomQuadrilateral(PatchType::kCoons, seed, bend);
}

Model randomTriangleModel(PatchType type, std::uint64_t seed, double bend) {
  Random random(seed);
  const double width = random.between(0.7, 2.0);
  const std::array<Vec3, 3> corners{
      random.inBox(bend), Vec3(width, 0, 0) + random.inBox(bend),
      Vec3(width * random.between(-0.2, 1.2), random.between(0.7, 1.5), 0) + random.inBox(bend)};
  return randomPatchOver(random, corners, bend, type);
}

Model randomCurvedModel(PatchType type, std::uint64_t seed, double bend) {
  const bool triangle =
      type == PatchType::kIsoparametricTriangle || type == PatchType::kBarnhillGregoryNielson;
  return triangle ? randomTriangleModel(type, seed, bend) : randomQuadrilateral(type, seed, bend);
}

Model randomPolygonModel(std::uint64_t seed, double& area) {
  Random random(seed);
  const auto [u, v] = randomPlane(random);
  const Vec3 origin = random.inBox(3.0);
  std::vector<std::vector<Vec2>> loops{
      starPolygon(random, Vec2(0.0), 0.7, 1.3, random.integer(3, 12))};
  // A star polygon with few corners may pass near its centre, so holes are small and close to the
  // centre.
  const int holes = loops.front().size() < 5 ? 0 : random.integer(0, 4);
  for (int hole = 0; hole < holes; ++hole) {
    const Vec2 centre((hole & 1) != 0 ? 0.17 : -0.17, (hole & 2) != 0 ? 0.17 : -0.17);
    loops.push_back(starPolygon(random, centre, 0.05, 0.13, random.integer(3, 7)));
  }
  area = 0.0;
  std::vector<std::vector<Vec3>> positions;
  for (std::vector<Vec2>& loop : loops) {
    area += positions.empty() ? shoelace(loop) : -shoelace(loop);
    if (random.coin()) std::ranges::reverse(loop);
    std::vector<Vec3>& corners = positions.emplace_back();
    for (const Vec2& corner : loop) corners.push_back(origin + corner.x * u + corner.y * v);
  }
  return polygonModel(positions);
}

Model boxModel(const Vec3& low, const Vec3& high) {
  const auto corner = [&](int i) {
    return Vec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                (i & 4) != 0 ? high.z : low.z);
  };
  ModelBuilder builder;
  const std::array<std::array<int, 4>, 6> faces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const std::array<int, 4>& face : faces)
    builder.patch(
        PatchType::kPlanar,
        {builder.polygon({corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])})});
  return builder.model;
}

Model sphereModel(double radius) {
  constexpr int kSteps = 8;
  const auto corner = [](int c) {
    return Vec3((c & 1) != 0 ? 1 : -1, (c & 2) != 0 ? 1 : -1, (c & 4) != 0 ? 1 : -1);
  };
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  ModelBuilder builder;
  std::map<std::pair<int, int>, std::uint32_t> lines;
  for (const auto& face : kFaces) {
    Loop loop;
    for (std::size_t k = 0; k < 4; ++k) {
      const int from = face[k];
      const int to = face[(k + 1) % 4];
      const std::pair<int, int> ends = std::minmax(from, to);
      if (!lines.contains(ends)) {
        std::vector<Vec3> positions;
        for (int i = 0; i <= kSteps; ++i) {
          const double t = static_cast<double>(i) / kSteps;
          const Vec3 chord = corner(ends.first) * (1.0 - t) + corner(ends.second) * t;
          positions.push_back(radius * glm::normalize(chord));
        }
        lines[ends] = builder.line(LineType::kSpline, positions);
      }
      loop.push_back({lines[ends], from > to});
    }
    builder.patch(PatchType::kCoons, {loop});
  }
  return builder.model;
}

Model torusModel(double majorRadius, double minorRadius) {
  constexpr int kAround = 8;
  constexpr int kAcross = 4;
  constexpr int kSteps = 8;
  // Compute positions by eighths of a patch, so that neighbours have equal corners, bit for bit.
  const auto at = [&](int i, int j) {
    const double u = kTurn * (i % (kAround * kSteps)) / (kAround * kSteps);
    const double v = kTurn * (j % (kAcross * kSteps)) / (kAcross * kSteps);
    const double distance = majorRadius + minorRadius * std::cos(v);
    return Vec3(distance * std::cos(u), distance * std::sin(u), minorRadius * std::sin(v));
  };
  ModelBuilder builder;
  std::array<std::array<std::uint32_t, kAcross>, kAround> along{};
  std::array<std::array<std::uint32_t, kAcross>, kAround> across{};
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      std::vector<Vec3> first;
      std::vector<Vec3> second;
      for (int k = 0; k <= kSteps; ++k) {
        first.push_back(at(kSteps * i + k, kSteps * j));
        second.push_back(at(kSteps * i, kSteps * j + k));
      }
      along[i][j] = builder.line(LineType::kSpline, first);
      across[i][j] = builder.line(LineType::kSpline, second);
    }
  }
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      builder.patch(PatchType::kCoons, {{{along[i][j], false},
                                         {across[(i + 1) % kAround][j], false},
                                         {along[i][(j + 1) % kAcross], true},
                                         {across[i][j], true}}});
    }
  }
  return builder.model;
}

Model randomBentBox(std::uint64_t seed, double bend, PatchType type) {
  Random random(seed);
  const Vec3 edges(random.between(0.6, 2), random.between(0.6, 2), random.between(0.6, 2));
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[i] = edges * Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1) + random.inBox(bend);
  const std::array<std::vector<int>, 6> faces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  return randomSolid(random, corners, faces, 0.5 * bend, type);
}

Model randomBentTetrahedron(std::uint64_t seed, double bend, PatchType type) {
  Random random(seed);
  std::array<Vec3, 4> corners{Vec3(0, 0, 0), Vec3(1.6, 0, 0), Vec3(0.7, 1.4, 0),
                              Vec3(0.8, 0.5, 1.3)};
  for (Vec3& corner : corners) corner += random.inBox(bend);
  const std::array<std::vector<int>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {3, 2, 0}}};
  return randomSolid(random, corners, faces, bend, type);
}

Model bracketModel() {
  constexpr double kThickness = 0.4;
  constexpr double kFillet = 0.3;
  constexpr double kFilletEnd = kThickness + kFillet;
  constexpr int kPieces = 8;
  ModelBuilder builder;
  const std::array<Vec2, 7> profile{Vec2(0.0, 0.0),
                                    Vec2(2.0, 0.0),
                                    Vec2(2.0, kThickness),
                                    Vec2(kFilletEnd, kThickness),
                                    Vec2(kThickness, kFilletEnd),
                                    Vec2(kThickness, 1.5),
                                    Vec2(0.0, 1.5)};
  constexpr std::size_t kFilletFrom = 3;
  const auto at = [](const Vec2& position, double y) { return Vec3(position.x, y, position.y); };
  const auto ends = [&](double y) {
    Loop loop;
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const Vec3 from = at(profile[i], y);
      const Vec3 to = at(profile[(i + 1) % profile.size()], y);
      if (i != kFilletFrom) {
        loop.push_back(builder.straight(from, to));
        continue;
      }
      std::vector<Vec3> positions{from};
      for (int k = 1; k < kPieces; ++k) {
        const double angle = 0.25 * kTurn * k / kPieces;
        positions.push_back(
            at(Vec2(kFilletEnd - kFillet * std::sin(angle), kFilletEnd - kFillet * std::cos(angle)),
               y));
      }
      positions.push_back(to);
      loop.push_back({builder.line(LineType::kSpline, positions), false});
    }
    builder.patch(PatchType::kPlanar, {loop});
    return loop;
  };
  const Loop front = ends(0.0);
  const Loop back = ends(1.0);
  // Adds the patches inside a hole of four arcs that runs along `through`.
  const auto hole = [&](const Vec3& centre, const Vec3& u, const Vec3& v, const Vec3& through) {
    constexpr double kRadius = 0.22;
    constexpr int kArcs = 4;
    const Loop near = builder.circle(centre, kRadius, kArcs, u, v);
    const Loop far = builder.circle(centre + through, kRadius, kArcs, u, v);
    const auto firstPoint = [&](const Loop& circle, int i) {
      const std::uint32_t line = circle[static_cast<std::size_t>(i % kArcs)].line;
      return builder.model.points[builder.model.lines[line].points.front()];
    };
    for (int i = 0; i < kArcs; ++i) {
      const auto arc = static_cast<std::size_t>(i);
      const OrientedLine here = builder.straight(firstPoint(near, i), firstPoint(far, i));
      const OrientedLine next = builder.straight(firstPoint(near, i + 1), firstPoint(far, i + 1));
      builder.patch(
          PatchType::kCoons,
          {{near[arc], next, {far[arc].line, !far[arc].reversed}, {here.line, !here.reversed}}});
    }
    return std::array<Loop, 2>{near, far};
  };
  const auto flat = hole({1.4, 0.5, 0.0}, {1, 0, 0}, {0, 1, 0}, {0, 0, kThickness});
  const auto upright = hole({0.0, 0.5, 1.1}, {0, 1, 0}, {0, 0, 1}, {kThickness, 0, 0});
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Vec2& from = profile[i];
    const Vec2& to = profile[(i + 1) % profile.size()];
    std::vector<Loop> loops{{front[i],
                             builder.straight(at(to, 0.0), at(to, 1.0)),
                             {back[i].line, !back[i].reversed},
                             builder.straight(at(from, 1.0), at(from, 0.0))}};
    if (i == 0) loops.push_back(flat[0]);
    if (i == 2) loops.push_back(flat[1]);
    if (i == 4) loops.push_back(upright[1]);
    if (i == 6) loops.push_back(upright[0]);
    builder.patch(i == kFilletFrom ? PatchType::kCoons : PatchType::kPlanar, loops);
  }
  return std::move(builder.model);
}

Model seamedTube(double radius, double height) {
  ModelBuilder builder;
  const Loop bottom = builder.circle({0, 0, 0}, radius, 1);
  const Loop top = builder.circle({0, 0, height}, radius, 1);
  const OrientedLine seam = builder.straight({radius, 0, 0}, {radius, 0, height});
  builder.patch(PatchType::kCoons, {{bottom[0], seam, {top[0].line, true}, {seam.line, true}}});
  return builder.model;
}

}  // namespace tetrafront::testing
