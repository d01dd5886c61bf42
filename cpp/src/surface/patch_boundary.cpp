#include "surface/patch_boundary.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/ids.h"
#include "base/sort.h"
#include "model/patch_projection.h"
#include "search/quadtree.h"

namespace tetrafront {

namespace {

/// Straight lines of a patch whose ends are this near to one common straight line, relative to
/// its length, are one: their nodes are collinear up to the rounding of their coordinates.
constexpr double kSameStraight = 1e-9;

/// A straight line of the plane that some line of the boundary runs along.
struct Carrier {
  Vec2 from;
  Vec2 direction;  ///< not normalised
};

/// Numbers the straight lines; collinear ones get one number. Each line stands in a tree at its
/// direction and its distance from the middle, where lines that may be collinear with it are near.
class Carriers {
 public:
  /// All lines are within `region`.
  explicit Carriers(const PlaneBox& region)
      : middle_(0.5 * (region.low + region.high)),
        extent_(glm::length(region.high - region.low)),
        tree_({{0.0, -extent_}, {kHalfTurn, extent_}}) {}

  /// The first that both ends are on; O(log n) where few are parallel and near each other.
  std::uint32_t numberOf(const Vec2& from, const Vec2& to) {
    const Vec2 own = dualOf(from, to - from);
    gather(own, glm::length(to - from));
    for (const std::uint32_t i : near_)
      if (isOn(carriers_[i], from) && isOn(carriers_[i], to)) return i;
    const auto number = static_cast<std::uint32_t>(carriers_.size());
    carriers_.push_back({from, to - from});
    tree_.insert(number, PlaneBox::of(own, own));
    return number;
  }

 private:
  /// Half a turn, as directions are measured: 0 to the right, 1 upwards.
  static constexpr double kHalfTurn = 2.0;
  /// Two lines that differ by more than this in direction may be collinear only if one is so short
  /// that its direction means nothing.
  static constexpr double kAnyDirection = 0.1;
  /// Relative to the region: what rounding does to directions and distances.
  static constexpr double kRounding = 1e-12;

  /// Direction, from 0 to kHalfTurn, and signed distance of the middle.
  [[nodiscard]] Vec2 dualOf(const Vec2& from, Vec2 direction) const {
    if (direction.y < 0.0 || (direction.y == 0.0 && direction.x < 0.0)) direction = -direction;
    const double share = direction.y / (std::fabs(direction.x) + direction.y);
    const Vec2 normal = Vec2(-direction.y, direction.x) / glm::length(direction);
    return {direction.x >= 0.0 ? share : kHalfTurn - share, glm::dot(from - middle_, normal)};
  }

  /// Those a line may be collinear with, ascending.
  void gather(const Vec2& own, double length) {
    // A carrier is no longer than the region; its ends may be off by kSameStraight of that.
    const double turn = 4.0 * kSameStraight * extent_ / length + kRounding;
    const Vec2 slack(turn, extent_ * (2.0 * turn + 2.0 * kSameStraight));
    near_.clear();
    if (turn > kAnyDirection) {
      tree_.query({{0.0, -extent_}, {kHalfTurn, extent_}}, near_);
    } else {
      tree_.query({own - slack, own + slack}, near_);
      // Directions just short of half a turn are those just beyond none, seen the other way.
      for (const double round : {-kHalfTurn, kHalfTurn}) {
        const Vec2 turned(own.x + round, -own.y);
        tree_.query({turned - slack, turned + slack}, near_);
      }
    }
    stableSort(near_);
  }

  static bool isOn(const Carrier& carrier, const Vec2& place) {
    const Vec2 offset = place - carrier.from;
    const double area = carrier.direction.x * offset.y - carrier.direction.y * offset.x;
    return std::fabs(area) <= kSameStraight * glm::dot(carrier.direction, carrier.direction);
  }

  Vec2 middle_;
  double extent_;
  Quadtree tree_;
  std::vector<Carrier> carriers_;
  std::vector<std::uint32_t> near_;
};

PlaneBox regionOf(const PlanarMesh& mesh) {
  PlaneBox region = PlaneBox::of(mesh.plane.front(), mesh.plane.front());
  for (const Vec2& node : mesh.plane) region.include(node);
  return region;
}

/// Lays one loop out after the other.
class BoundaryBuilder {
 public:
  BoundaryBuilder(const ResolvedModel& model, const Patch& patch, const PatchSurface& surface,
                  const SizeField& field, const DividedLines& lines)
      : model_(&model), patch_(&patch), surface_(&surface), field_(&field), lines_(&lines) {
    if (hasCurvedHoles(patch)) projection_.emplace(surface);
  }

  void addLoop(std::size_t loop) {
    const auto firstNode = static_cast<std::uint32_t>(boundary.mesh.plane.size());
    const std::size_t firstSide = boundary.origins.size();
    boundary.loops.push_back(static_cast<std::uint32_t>(firstSide));
    const Loop& drawn = patch_->loops[loop];
    for (std::size_t position = 0; position < drawn.size(); ++position) addLine(loop, position);
    const auto endNode = static_cast<std::uint32_t>(boundary.mesh.plane.size());
    for (std::uint32_t node = firstNode; node < endNode; ++node) {
      const std::uint32_t next = node + 1 == endNode ? firstNode : node + 1;
      boundary.mesh.sides.insert(boundary.mesh.sides.end(), {node, next});
    }
    const bool counterClockwise = area(firstNode, endNode) > 0.0;
    if (counterClockwise != (loop == 0)) reverse(firstSide);
    // The plane is oriented by the outer loop's lines.
    if (loop == 0) boundary.inverted = !counterClockwise;
  }

  /// Tells which nodes are on which straight lines, once all loops are there.
  void tagStraights() {
    Carriers carriers(regionOf(boundary.mesh));
    std::size_t firstLine = 0;
    for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop) {
      tagStraightsOf(loop, firstLine, carriers);
      firstLine += patch_->loops[loop].size();
    }
  }

  PatchBoundary boundary;

 private:
  /// Adds the line's nodes but the last, which is the next line's first.
  void addLine(std::size_t loop, std::size_t position) {
    const OrientedLine& line = patch_->loops[loop][position];
    const LineDivision& division = lines_->divisions[line.line];
    const std::vector<std::uint32_t>& nodes = lines_->nodes[line.line];
    const bool backward = line.reversed != model_->flipped(line.line);
    lineStarts_.push_back(static_cast<std::uint32_t>(boundary.mesh.plane.size()));
    const auto count = static_cast<std::uint32_t>(division.sideCount());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t at = backward ? count - i : i;
      const double t = backward ? 1.0 - division.parameters[at] : division.parameters[at];
      const Vec3& place = division.nodes[at];
      const Vec2 plane = loop > 0 && projection_ ? projection_->project(place).plane
                                                 : surface_->boundaryToPlane(position, t, place);
      boundary.mesh.addNode(plane, place, field_->sizeAt(place, hint_));
      boundary.mesh.aliases.back() = nodes[at];
      boundary.origins.push_back({line.line, backward ? at - 1 : at});
    }
  }

  void tagStraightsOf(std::size_t loop, std::size_t firstLine, Carriers& carriers) {
    const std::size_t lineCount = patch_->loops[loop].size();
    const std::uint32_t firstNode = lineStarts_[firstLine];
    const auto endNode = firstLine + lineCount < lineStarts_.size()
                             ? lineStarts_[firstLine + lineCount]
                             : static_cast<std::uint32_t>(boundary.mesh.plane.size());
    for (std::size_t position = 0; position < lineCount; ++position) {
      if (!surface_->straightInPlane(loop, position)) continue;
      const std::uint32_t from = lineStarts_[firstLine + position];
      const bool last = position + 1 == lineCount;
      const std::uint32_t to = last ? firstNode : lineStarts_[firstLine + position + 1];
      const std::uint32_t straight =
          carriers.numberOf(boundary.mesh.plane[from], boundary.mesh.plane[to]);
      for (std::uint32_t node = from; node < (last ? endNode : to); ++node) tag(node, straight);
      tag(to, straight);
    }
  }

  void tag(std::uint32_t node, std::uint32_t straight) {
    PlanarMesh::Straights& tags = boundary.mesh.straights[node];
    if (tags[0] == straight || tags[1] == straight) return;
    tags[tags[0] == kNoIndex ? 0 : 1] = straight;
  }

  [[nodiscard]] double area(std::uint32_t firstNode, std::uint32_t endNode) const {
    double sum = 0.0;
    const Vec2 origin = boundary.mesh.plane[firstNode];
    for (std::uint32_t node = firstNode + 1; node + 1 < endNode; ++node) {
      const Vec2 a = boundary.mesh.plane[node] - origin;
      const Vec2 b = boundary.mesh.plane[node + 1] - origin;
      sum += a.x * b.y - a.y * b.x;
    }
    return sum;
  }

  void reverse(std::size_t firstSide) {
    for (std::size_t side = firstSide; side < boundary.origins.size(); ++side)
      std::swap(boundary.mesh.sides[2 * side], boundary.mesh.sides[2 * side + 1]);
  }

  const ResolvedModel* model_;
  const Patch* patch_;
  const PatchSurface* surface_;
  const SizeField* field_;
  const DividedLines* lines_;
  std::optional<PatchProjection> projection_;
  std::vector<std::uint32_t> lineStarts_;  ///< first node of each line so far, all loops
  FieldHint hint_;
};

bool sidesTouch(const PlanarMesh& mesh, std::uint32_t first, std::uint32_t second) {
  const std::uint32_t a = mesh.sides[2 * std::size_t{first}];
  const std::uint32_t b = mesh.sides[2 * std::size_t{first} + 1];
  const std::uint32_t c = mesh.sides[2 * std::size_t{second}];
  const std::uint32_t d = mesh.sides[2 * std::size_t{second} + 1];
  if (b == c && a == d) return true;
  if (b == c) return segmentsOverlap(mesh, b, a, d);
  if (a == d) return segmentsOverlap(mesh, a, b, c);
  return segmentsTouch(mesh, a, b, c, d);
}

std::vector<std::uint32_t> findTouchingSides(const PlanarMesh& mesh) {
  Quadtree tree(regionOf(mesh));
  std::vector<std::uint32_t> touching;
  std::vector<std::uint32_t> near;
  const auto count = static_cast<std::uint32_t>(mesh.sides.size() / 2);
  for (std::uint32_t side = 0; side < count; ++side) {
    const PlaneBox box = PlaneBox::of(mesh.plane[mesh.sides[2 * std::size_t{side}]],
                                      mesh.plane[mesh.sides[2 * std::size_t{side} + 1]]);
    near.clear();
    tree.query(box, near);
    for (const std::uint32_t other : near)
      if (sidesTouch(mesh, other, side)) touching.insert(touching.end(), {other, side});
    tree.insert(side, box);
  }
  return touching;
}

/// The sides from `from` up to `to`, of one loop.
struct SideRange {
  std::uint32_t from;
  std::uint32_t to;
};

SideRange sidesOfLoop(const PatchBoundary& boundary, std::size_t loop) {
  const bool last = loop + 1 == boundary.loops.size();
  return {boundary.loops[loop],
          last ? static_cast<std::uint32_t>(boundary.origins.size()) : boundary.loops[loop + 1]};
}

/// Even-odd rule on a ray in the first direction, by exact turns; no side touches the place.
bool isInside(const PlanarMesh& mesh, std::uint32_t node, const SideRange& loop) {
  const Vec2& place = mesh.plane[node];
  bool inside = false;
  for (std::uint32_t side = loop.from; side < loop.to; ++side) {
    const std::uint32_t a = mesh.sides[2 * std::size_t{side}];
    const std::uint32_t b = mesh.sides[2 * std::size_t{side} + 1];
    const bool rises = mesh.plane[b].y > mesh.plane[a].y;
    if ((mesh.plane[a].y > place.y) == (mesh.plane[b].y > place.y)) continue;
    if ((orient2d(mesh.plane[a], mesh.plane[b], place) > 0) == rises) inside = !inside;
  }
  return inside;
}

/// Sides of an inverted outer loop; of holes outside it or in each other, and their counterparts.
std::vector<std::uint32_t> findMisplacedSides(const PatchBoundary& boundary) {
  std::vector<std::uint32_t> misplaced;
  const auto add = [&](const SideRange& range) {
    for (std::uint32_t side = range.from; side < range.to; ++side) misplaced.push_back(side);
  };
  if (boundary.inverted) add(sidesOfLoop(boundary, 0));
  for (std::size_t hole = 1; hole < boundary.loops.size(); ++hole) {
    const SideRange sides = sidesOfLoop(boundary, hole);
    const std::uint32_t node = boundary.mesh.sides[2 * std::size_t{sides.from}];
    for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop) {
      if (loop == hole) continue;
      const SideRange other = sidesOfLoop(boundary, loop);
      if (isInside(boundary.mesh, node, other) == (loop == 0)) continue;
      add(sides);
      add(other);
    }
  }
  return misplaced;
}

}  // namespace

PatchBoundary layOutBoundary(const ResolvedModel& model, const Patch& patch,
                             const PatchSurface& surface, const SizeField& field,
                             const DividedLines& lines) {
  BoundaryBuilder builder(model, patch, surface, field, lines);
  for (std::size_t loop = 0; loop < patch.loops.size(); ++loop) builder.addLoop(loop);
  builder.tagStraights();
  builder.boundary.mesh.boundaryCount =
      static_cast<std::uint32_t>(builder.boundary.mesh.plane.size());
  return std::move(builder.boundary);
}

std::vector<std::uint32_t> findInvalidSides(const PatchBoundary& boundary) {
  std::vector<std::uint32_t> faulty = findTouchingSides(boundary.mesh);
  if (faulty.empty()) faulty = findMisplacedSides(boundary);
  sortUnique(faulty);
  return faulty;
}

}  // namespace tetrafront
