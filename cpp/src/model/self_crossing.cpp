#include "model/self_crossing.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/sort.h"
#include "base/tolerance.h"
#include "search/box_tree.h"

namespace tetrafront {
namespace {

/// Limit of comparisons, plus a number per piece. More are needed only if two passages run side by
/// side within a tiny fraction of their length; such a line passes, because it does not cross
/// itself.
constexpr std::size_t kMaxComparisons = 50'000;
constexpr std::size_t kMaxComparisonsPerPiece = 200;
/// Halvings of a piece; after these its ends coincide.
constexpr int kMaxDepth = 48;

/// One cubic piece by its control points (Bézier); their hull contains it.
struct Piece {
  std::array<Vec3, 4> control;
  int depth = 0;

  [[nodiscard]] Vec3 low() const {
    return glm::min(glm::min(control[0], control[1]), glm::min(control[2], control[3]));
  }
  [[nodiscard]] Vec3 high() const {
    return glm::max(glm::max(control[0], control[1]), glm::max(control[2], control[3]));
  }
};

struct Halves {
  Piece first;
  Piece second;
};

/// Halves the piece by de Casteljau's algorithm.
Halves halve(const Piece& piece) {
  const auto& [a, b, c, d] = piece.control;
  const Vec3 ab = 0.5 * (a + b);
  const Vec3 bc = 0.5 * (b + c);
  const Vec3 cd = 0.5 * (c + d);
  const Vec3 abc = 0.5 * (ab + bc);
  const Vec3 bcd = 0.5 * (bc + cd);
  const Vec3 middle = 0.5 * (abc + bcd);
  return {{{a, ab, abc, middle}, piece.depth + 1}, {{middle, bcd, cd, d}, piece.depth + 1}};
}

/// Returns whether the piece runs forward in `direction` all along.
bool runsForward(const Piece& piece, const Vec3& direction) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 step = piece.control[i + 1] - piece.control[i];
    if (step != Vec3(0.0) && !(glm::dot(step, direction) > 0.0)) return false;
  }
  return true;
}

Vec3 directionOf(const Piece& piece) {
  const Vec3 chord = piece.control[3] - piece.control[0];
  const double length = glm::length(chord);
  return length > 0.0 ? chord / length : Vec3(0.0);
}

std::vector<Piece> piecesOf(const Curve& curve) {
  std::vector<Piece> pieces;
  const std::span<const double> knots = curve.knots();
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double third = (knots[i + 1] - knots[i]) / 3.0;
    const Curve::Sample from = curve.sample(knots[i]);
    const Curve::Sample to = curve.sample(knots[i + 1]);
    pieces.push_back({{from.position, from.position + third * from.derivative,
                       to.position - third * to.derivative, to.position}});
  }
  return pieces;
}

class CrossingSearch {
 public:
  explicit CrossingSearch(const Curve& curve)
      : pieces_(piecesOf(curve)),
        isClosed_(curve.start() == curve.end()),
        comparisonsLeft_(kMaxComparisons + kMaxComparisonsPerPiece * pieces_.size()) {
    Vec3 low = pieces_.front().low();
    Vec3 high = pieces_.front().high();
    for (const Piece& piece : pieces_) {
      low = glm::min(low, piece.low());
      high = glm::max(high, piece.high());
    }
    reach_ = Tolerance::ofBox(low, high).coincidence();
  }

  std::optional<Vec3> run() {
    const std::vector<Box> boxes = boxesOfPieces();
    const BoxTree tree(boxes);
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < pieces_.size() && !isSpent(); ++i) {
      if (intersectsItself(pieces_[i])) return position_;
      near.clear();
      tree.visitOverlaps(boxes[i], [&](std::uint32_t k) {
        if (k > i) near.push_back(k);
      });
      stableSort(near);
      if (std::ranges::any_of(near, [&](std::size_t k) { return intersect(i, k); }))
        return position_;
    }
    return std::nullopt;
  }

 private:
  /// Relative to the start, so that the rounding of the boxes is small compared with the line.
  [[nodiscard]] std::vector<Box> boxesOfPieces() const {
    const Vec3 origin = pieces_.front().control[0];
    std::vector<Box> boxes;
    boxes.reserve(pieces_.size());
    for (const Piece& piece : pieces_) {
      const Vec3 low = piece.low() - origin;
      boxes.push_back(Box::of(low, piece.high() - origin, low));
    }
    return boxes;
  }

  bool intersect(std::size_t i, std::size_t k) {
    const bool follows = k == i + 1;
    const bool closes = isClosed_ && i == 0 && k + 1 == pieces_.size();
    // Two pieces that form a closed line share both ends.
    if (follows && closes) return meetAtBothEnds(pieces_[i], pieces_[k]);
    if (follows) return intersectBeyondJoint(pieces_[i], pieces_[k]);
    if (closes) return intersectBeyondJoint(pieces_[k], pieces_[i]);
    return piecesIntersect(pieces_[i], pieces_[k]);
  }

  bool intersectsItself(const Piece& piece) {
    if (!spend() || piece.depth > kMaxDepth) return false;
    if (runsForward(piece, directionOf(piece))) return false;
    const Halves halves = halve(piece);
    return intersectsItself(halves.first) || intersectsItself(halves.second) ||
           intersectBeyondJoint(halves.first, halves.second);
  }

  /// Returns whether two pieces intersect anywhere except where the first ends and the second begins.
  bool intersectBeyondJoint(const Piece& first, const Piece& second) {
    if (!spend() || first.depth > kMaxDepth) return false;
    const Vec3 direction = directionOf(first) + directionOf(second);
    if (runsForward(first, direction) && runsForward(second, direction)) return false;
    const Halves before = halve(first);
    const Halves after = halve(second);
    return piecesIntersect(before.first, after.second) ||
           piecesIntersect(before.first, after.first) ||
           piecesIntersect(before.second, after.second) ||
           intersectBeyondJoint(before.second, after.first);
  }

  bool meetAtBothEnds(const Piece& first, const Piece& second) {
    const Halves before = halve(first);
    const Halves after = halve(second);
    return intersectBeyondJoint(before.second, after.first) ||
           intersectBeyondJoint(after.second, before.first) ||
           piecesIntersect(before.first, after.first) ||
           piecesIntersect(before.second, after.second);
  }

  bool piecesIntersect(const Piece& a, const Piece& b) {
    if (!spend()) return false;
    const Vec3 lowA = a.low();
    const Vec3 highA = a.high();
    const Vec3 lowB = b.low();
    const Vec3 highB = b.high();
    for (int axis = 0; axis < 3; ++axis) {
      if (lowA[axis] > highB[axis] || lowB[axis] > highA[axis]) return false;
    }
    const double sizeA = glm::length(highA - lowA);
    const double sizeB = glm::length(highB - lowB);
    if (sizeA <= reach_ && sizeB <= reach_) {
      position_ = 0.5 * (a.control[0] + b.control[0]);
      return true;
    }
    if (sizeA >= sizeB) {
      const Halves halves = halve(a);
      return piecesIntersect(halves.first, b) || piecesIntersect(halves.second, b);
    }
    const Halves halves = halve(b);
    return piecesIntersect(a, halves.first) || piecesIntersect(a, halves.second);
  }

  [[nodiscard]] bool isSpent() const { return comparisonsLeft_ == 0; }

  /// Counts one comparison; returns false if the limit is reached.
  bool spend() {
    if (isSpent()) return false;
    --comparisonsLeft_;
    return true;
  }

  std::vector<Piece> pieces_;
  bool isClosed_;
  std::size_t comparisonsLeft_;
  double reach_ = 0.0;  ///< passages closer than this intersect
  Vec3 position_{0.0};
};

}  // namespace

std::optional<Vec3> findSelfCrossing(const Curve& curve) {
  switch (curve.type()) {
    case LineType::kStraight:
    case LineType::kArc:
    case LineType::kCircle:
      return std::nullopt;
    case LineType::kParabolic:
    case LineType::kSpline:
    case LineType::kHermite:
      break;
  }
  return CrossingSearch(curve).run();
}

}  // namespace tetrafront
