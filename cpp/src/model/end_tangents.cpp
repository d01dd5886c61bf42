#include "model/end_tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/ids.h"
#include "base/sort.h"
#include "model/hermite_cubics.h"
#include "model/resolved_model.h"

namespace tetrafront {

namespace {

/// Cosine of the largest turn of a line that goes on at a point: 45 degrees.
constexpr double kLargestTurn = 0.7071067811865476;
/// Cosine of the largest angle between the planes of neighbouring patches without an edge: 80 degrees. An octahedron (70.5
/// degrees) becomes a smooth shape, a cube keeps its edges.
constexpr double kSharpEdge = 0.17364817766693033;
/// Sine of the angle above which two tangents define a plane, or two planes a direction: 0.6 degrees.
constexpr double kMinSine = 0.01;
/// A tangent that would lose more than this share of its length in the plane stays where it is.
constexpr double kMaxLoss = 0.8;
/// More lines that end at one point are not compared with each other: there is no order among so many.
constexpr std::size_t kMaxEndsAtPoint = 64;

/// An end of a line: 2 line for its start, 2 line + 1 for its end.
using End = std::uint32_t;

Vec3 unitOrZero(const Vec3& vector) {
  // Squares of large or small components are out of range.
  const double largest = std::max({std::fabs(vector.x), std::fabs(vector.y), std::fabs(vector.z)});
  if (!(largest > 0.0)) return Vec3(0.0);
  return glm::normalize(vector / largest);
}

bool takesTangents(const Line& line) {
  return (line.type == LineType::kSpline || line.type == LineType::kHermite) &&
         line.points.front() != line.points.back();
}

std::optional<Vec3> givenTangent(const Line& line, const Vec3& tangent) {
  if (!takesTangents(line)) return std::nullopt;
  const Vec3 unit = unitOrZero(tangent);
  if (unit == Vec3(0.0)) return std::nullopt;
  return unit;
}

class TangentSolver {
 public:
  TangentSolver(const Model& model, std::span<const std::uint8_t> usableLines,
                std::vector<EndTangents>& tangents)
      : model_(&model),
        usable_(usableLines.begin(), usableLines.end()),
        tangents_(&tangents),
        isFree_(2 * model.lines.size(), 0),
        isMoved_(2 * model.lines.size(), 0),
        directions_(2 * model.lines.size(), Vec3(0.0)) {}

  /// Finds the free ends; returns false if there are none.
  bool findFreeEnds() {
    bool any = false;
    for (std::size_t i = 0; i < model_->lines.size(); ++i) {
      const Line& line = model_->lines[i];
      if (usable_[i] == 0 || line.type != LineType::kHermite || !takesTangents(line)) continue;
      const EndTangents& given = (*tangents_)[i];
      isFree_[2 * i] = given.start ? 0 : 1;
      isFree_[2 * i + 1] = given.end ? 0 : 1;
      any = any || !given.start || !given.end;
    }
    return any;
  }

  void solve() {
    countUses();
    findDirections();
    findCorners();
    continueLines();
    findFans();
    moveIntoPlanes();
    for (std::size_t i = 0; i < model_->lines.size(); ++i) {
      if (isMoved_[2 * i] != 0) (*tangents_)[i].start = directions_[2 * i];
      if (isMoved_[2 * i + 1] != 0) (*tangents_)[i].end = -directions_[2 * i + 1];
    }
  }

 private:
  /// The corner of a smooth patch between two of its lines.
  struct Corner {
    std::array<End, 2> ends;  ///< of the line before it, and of the line after it
    Vec3 normal{0.0};         ///< zero if the lines have one direction
  };
  struct Link {
    std::uint32_t corner;
    double sign;  ///< -1 if the two patches have opposite orientations
  };

  [[nodiscard]] const Line& lineOf(End end) const { return model_->lines[end / 2]; }
  [[nodiscard]] std::uint32_t pointOf(End end) const {
    return end % 2 == 0 ? lineOf(end).points.front() : lineOf(end).points.back();
  }
  [[nodiscard]] Vec3 positionOf(End end) const { return model_->points[pointOf(end)]; }
  /// The point of the line next to its end.
  [[nodiscard]] Vec3 neighbourOf(End end) const {
    const std::vector<std::uint32_t>& points = lineOf(end).points;
    return model_->points[end % 2 == 0 ? points[1] : points[points.size() - 2]];
  }

  /// Counts the patches at each line, and lists the planar ones: tangents must not leave their planes.
  void countUses() {
    uses_.assign(model_->lines.size(), 0);
    planes_.resize(model_->lines.size());
    for (std::uint32_t p = 0; p < model_->patches.size(); ++p) {
      const Patch& patch = model_->patches[p];
      for (const Loop& loop : patch.loops) {
        for (const OrientedLine& line : loop) {
          if (line.line >= uses_.size()) continue;
          ++uses_[line.line];
          if (patch.type == PatchType::kPlanar) planes_[line.line].push_back(p);
        }
      }
    }
  }

  /// Directions at the ends, away from their points, as far as they are known: natural ones at free ends.
  void findDirections() {
    for (std::size_t i = 0; i < model_->lines.size(); ++i) {
      if (usable_[i] == 0) continue;
      const Line& line = model_->lines[i];
      const Curve curve(line.type, pointsOf(*model_, line), (*tangents_)[i]);
      directions_[2 * i] = unitOrZero(curve.derivative(0.0));
      directions_[2 * i + 1] = -unitOrZero(curve.derivative(1.0));
    }
  }

  // ---- lines that continue each other ------------------------------------------------------------

  void continueLines() {
    std::vector<std::pair<std::uint32_t, End>> atPoints;
    for (End end = 0; end < isFree_.size(); ++end)
      if (isFree_[end] != 0) atPoints.emplace_back(pointOf(end), end);
    stableSort(atPoints);
    std::vector<End> ends;
    for (std::size_t i = 0, j = 0; i < atPoints.size(); i = j) {
      ends.clear();
      for (; j < atPoints.size() && atPoints[j].first == atPoints[i].first; ++j)
        ends.push_back(atPoints[j].second);
      if (ends.size() > 1 && ends.size() <= kMaxEndsAtPoint) continueAt(ends);
    }
  }

  void continueAt(std::span<const End> ends) {
    std::vector<std::optional<std::size_t>> best(ends.size());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      double least = -kLargestTurn;
      for (std::size_t k = 0; k < ends.size(); ++k) {
        const double cosine = glm::dot(directions_[ends[i]], directions_[ends[k]]);
        if (k == i || cosine >= least || !mayContinue(ends[i], ends[k])) continue;
        least = cosine;
        best[i] = k;
      }
    }
    for (std::size_t i = 0; i < ends.size(); ++i)
      if (best[i] && *best[i] > i && best[*best[i]] == i) join(ends[i], ends[*best[i]]);
  }

  [[nodiscard]] bool mayContinue(End a, End b) const {
    return planes_[a / 2] == planes_[b / 2] && std::ranges::find(beside_[a], b) == beside_[a].end();
  }

  void join(End a, End b) {
    const Vec3 toA = neighbourOf(a) - positionOf(a);
    const Vec3 fromB = positionOf(b) - neighbourOf(b);
    const double stepA = glm::length(toA);
    const double stepB = glm::length(fromB);
    const Vec3 tangent = unitOrZero(besselSlope(fromB / stepB, stepB, toA / stepA, stepA));
    if (tangent == Vec3(0.0)) return;
    directions_[a] = tangent;
    directions_[b] = -tangent;
    isMoved_[a] = 1;
    isMoved_[b] = 1;
  }

  // ---- smooth patches around a point ---------------------------------------------------------------

  void findCorners() {
    beside_.resize(isFree_.size());
    for (const Patch& patch : model_->patches) {
      const std::size_t count = patch.type == PatchType::kGregory ? 4 : 3;
      if (!isSmooth(patch.type) || patch.loops.empty() || patch.loops.front().size() != count)
        continue;
      const Loop& loop = patch.loops.front();
      if (!std::ranges::all_of(loop, [&](const OrientedLine& line) {
            return line.line < usable_.size() && usable_[line.line] != 0;
          }))
        continue;
      for (std::size_t i = 0; i < count; ++i) {
        const OrientedLine& before = loop[(i + count - 1) % count];
        const Corner corner{{2 * before.line + (before.reversed ? 0U : 1U),
                             2 * loop[i].line + (loop[i].reversed ? 1U : 0U)}};
        if (pointOf(corner.ends[0]) != pointOf(corner.ends[1])) continue;
        corners_.push_back(corner);
        beside_[corner.ends[0]].push_back(corner.ends[1]);
        beside_[corner.ends[1]].push_back(corner.ends[0]);
      }
    }
  }

  void findFans() {
    for (Corner& corner : corners_) {
      const Vec3 normal = glm::cross(directions_[corner.ends[1]], directions_[corner.ends[0]]);
      if (glm::length(normal) > kMinSine) corner.normal = glm::normalize(normal);
    }
    struct CornerEnd {
      End end;
      std::uint32_t corner;
      std::uint32_t role;  // index in Corner::ends
    };
    std::vector<CornerEnd> sides;
    for (std::uint32_t c = 0; c < corners_.size(); ++c)
      for (std::uint32_t role = 0; role < 2; ++role)
        sides.push_back({corners_[c].ends[role], c, role});
    stableSort(sides, [](const CornerEnd& a, const CornerEnd& b) { return a.end < b.end; });
    links_.resize(corners_.size());
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
      while (j < sides.size() && sides[j].end == sides[i].end) ++j;
      if (j - i != 2 || uses_[sides[i].end / 2] != 2) continue;
      const CornerEnd& a = sides[i];
      const CornerEnd& b = sides[i + 1];
      const double sign = a.role != b.role ? 1.0 : -1.0;
      const Vec3& normalA = corners_[a.corner].normal;
      const Vec3& normalB = corners_[b.corner].normal;
      const bool areKnown = normalA != Vec3(0.0) && normalB != Vec3(0.0);
      if (areKnown && sign * glm::dot(normalA, normalB) < kSharpEdge) continue;
      links_[a.corner].push_back({b.corner, sign});
      links_[b.corner].push_back({a.corner, sign});
    }
  }

  void moveIntoPlanes() {
    planesAt_.resize(isFree_.size());
    std::vector<double> signs(corners_.size(), 0.0);
    std::vector<std::uint32_t> fan;
    for (std::uint32_t first = 0; first < corners_.size(); ++first) {
      if (signs[first] != 0.0) continue;
      fan = {first};
      signs[first] = 1.0;
      for (std::size_t i = 0; i < fan.size(); ++i) {
        for (const Link& link : links_[fan[i]]) {
          if (signs[link.corner] != 0.0) continue;
          signs[link.corner] = signs[fan[i]] * link.sign;
          fan.push_back(link.corner);
        }
      }
      if (fan.size() > 1) addPlane(fan, signs);
    }
    for (End end = 0; end < planesAt_.size(); ++end) moveEnd(end);
  }

  [[nodiscard]] bool isMovable(End end) const {
    return isFree_[end] != 0 && planes_[end / 2].empty();
  }

  void addPlane(std::span<const std::uint32_t> fan, std::span<const double> signs) {
    Vec3 normal(0.0);
    std::vector<End> ends;
    for (const std::uint32_t corner : fan) {
      normal += signs[corner] * corners_[corner].normal;
      for (const End end : corners_[corner].ends) ends.push_back(end);
    }
    normal = unitOrZero(planeThroughFixed(normal, ends));
    if (normal == Vec3(0.0)) return;
    stableSort(ends);
    ends.erase(std::ranges::unique(ends).begin(), ends.end());
    for (const End end : ends) planesAt_[end].push_back(normal);
  }

  /// Returns the normal of the plane that contains the tangents that cannot move, near the given normal.
  [[nodiscard]] Vec3 planeThroughFixed(const Vec3& normal, std::span<const End> ends) const {
    const Vec3* first = nullptr;
    Vec3 widest(0.0);
    for (const End end : ends) {
      if (isMovable(end)) continue;
      if (first == nullptr) first = &directions_[end];
      const Vec3 across = glm::cross(*first, directions_[end]);
      if (glm::length(across) > glm::length(widest)) widest = across;
    }
    if (first == nullptr) return normal;
    if (glm::length(widest) > kMinSine) return glm::dot(widest, normal) < 0.0 ? -widest : widest;
    return normal - glm::dot(normal, *first) * *first;
  }

  void moveEnd(End end) {
    const std::vector<Vec3>& normals = planesAt_[end];
    if (normals.empty() || !isMovable(end)) return;
    Vec3 direction = directions_[end];
    // An edge between two fans runs along both planes.
    const Vec3 along = normals.size() == 2 ? glm::cross(normals[0], normals[1]) : Vec3(0.0);
    if (glm::length(along) > kMinSine) {
      direction = glm::dot(direction, along) * along / glm::dot(along, along);
    } else {
      direction -= glm::dot(direction, normals[0]) * normals[0];
    }
    if (glm::length(direction) < 1.0 - kMaxLoss) return;
    directions_[end] = glm::normalize(direction);
    isMoved_[end] = 1;
  }

  const Model* model_;
  std::vector<std::uint8_t> usable_;
  std::vector<EndTangents>* tangents_;
  std::vector<std::uint8_t> isFree_;                ///< per end
  std::vector<std::uint8_t> isMoved_;               ///< per end: has a tangent that is not given
  std::vector<Vec3> directions_;                    ///< per end: unit tangent away from its point
  std::vector<std::uint32_t> uses_;                 ///< per line: patches at it
  std::vector<std::vector<std::uint32_t>> planes_;  ///< per line: planar patches at it
  std::vector<std::vector<End>>
      beside_;  ///< per end: the other ends at the corners of smooth patches
  std::vector<Corner> corners_;
  std::vector<std::vector<Link>> links_;     ///< per corner
  std::vector<std::vector<Vec3>> planesAt_;  ///< per end: normals of the planes it should lie in
};

}  // namespace

std::vector<EndTangents> endTangents(const Model& model,
                                     std::span<const std::uint8_t> usableLines) {
  std::vector<EndTangents> tangents(model.lines.size());
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    if (usableLines[i] == 0) continue;
    tangents[i] = {givenTangent(line, line.startTangent), givenTangent(line, line.endTangent)};
  }
  TangentSolver solver(model, usableLines, tangents);
  if (solver.findFreeEnds()) solver.solve();
  return tangents;
}

}  // namespace tetrafront
