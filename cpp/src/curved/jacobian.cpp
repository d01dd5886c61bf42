#include "curved/jacobian.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

#include "geom/coordinates.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

using Coefficients = std::array<double, kJacobianCoefficients>;
using Index = std::uint8_t;

/// The coefficients belong to the products of three barycentric coordinates i <= j <= k, in lexicographic order.
struct CoefficientTable {
  std::array<std::array<std::array<Index, 4>, 4>, 4> of{};  ///< of three corners, in any order
  std::array<double, kJacobianCoefficients> weight{};       ///< 1 / number of their orders
};

constexpr CoefficientTable makeCoefficientTable() {
  CoefficientTable table;
  std::array<int, kJacobianCoefficients> orders{};
  Index next = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i; j < 4; ++j) {
      for (std::size_t k = j; k < 4; ++k) table.of[i][j][k] = next++;
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t low = std::min({i, j, k});
        const std::size_t high = std::max({i, j, k});
        const Index index = table.of[low][i + j + k - low - high][high];
        table.of[i][j][k] = index;
        ++orders[index];
      }
    }
  }
  for (std::size_t c = 0; c < kJacobianCoefficients; ++c) table.weight[c] = 1.0 / orders[c];
  return table;
}

constexpr CoefficientTable kCoefficients = makeCoefficientTable();

/// Index of the coefficient at each corner.
constexpr std::array<Index, 4> kCornerCoefficients{
    kCoefficients.of[0][0][0], kCoefficients.of[1][1][1], kCoefficients.of[2][2][2],
    kCoefficients.of[3][3][3]};

/// Number of halvings after which a piece is not divided further.
constexpr int kMaxDepth = 30;
/// Number of pieces after which none is divided further.
constexpr int kMaxPieces = 2000;
/// Tolerance of a bound, as a fraction of the largest magnitude at the corners.
constexpr double kBoundTolerance = 5e-4;

/// Returns the middle of the edge between two corners, or the corner if they are the same.
const Vec3& middleOf(const QuadraticTet& tet, std::size_t i, std::size_t j) {
  constexpr std::array<std::array<Index, 4>, 4> kEdgeOf{
      {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}}};
  return i == j ? tet.corners[i] : tet.middles[kEdgeOf[i][j]];
}

/// Coefficients of the polynomial on one half of a piece: the values along a line from corner `a` to corner `b`.
template <std::size_t kDegree>
void halveLine(const Coefficients& from, const std::array<Index, kDegree + 1>& line,
               Coefficients& nearA, Coefficients& nearB) {
  std::array<double, kDegree + 1> values;
  for (std::size_t i = 0; i <= kDegree; ++i) values[i] = from[line[i]];
  nearA[line[0]] = values[0];
  nearB[line[kDegree]] = values[kDegree];
  for (std::size_t step = 1; step <= kDegree; ++step) {
    for (std::size_t i = 0; i + step <= kDegree; ++i) values[i] = 0.5 * (values[i] + values[i + 1]);
    nearA[line[step]] = values[0];
    nearB[line[kDegree - step]] = values[kDegree - step];
  }
}

/// Halves a piece at the middle of an edge (de Casteljau).
void halve(const Coefficients& from, const TetEdge& edge, Coefficients& nearA,
           Coefficients& nearB) {
  const auto& of = kCoefficients.of;
  const std::size_t a = edge.from;
  const std::size_t b = edge.to;
  const std::size_t c = edge.left;
  const std::size_t d = edge.right;
  nearA = from;
  nearB = from;
  halveLine<3>(from, {of[a][a][a], of[a][a][b], of[a][b][b], of[b][b][b]}, nearA, nearB);
  for (const std::size_t other : {c, d}) {
    halveLine<2>(from, {of[other][a][a], of[other][a][b], of[other][b][b]}, nearA, nearB);
    halveLine<1>(from, {of[other][other][a], of[other][other][b]}, nearA, nearB);
  }
  halveLine<1>(from, {of[c][d][a], of[c][d][b]}, nearA, nearB);
}

/// Returns how far the polynomial is from linear along an edge.
double bendAlong(const Coefficients& from, const TetEdge& edge) {
  double bend = 0.0;
  for (std::size_t other = 0; other < 4; ++other) {
    const auto& of = kCoefficients.of[other];
    bend =
        std::max(bend, std::fabs(from[of[edge.from][edge.from]] -
                                 2.0 * from[of[edge.from][edge.to]] + from[of[edge.to][edge.to]]));
  }
  return bend;
}

/// The polynomial is linear if it does not bend along any edge. The coefficients bound it tightly then.
const TetEdge& mostBentEdge(const Coefficients& from) {
  const TetEdge* most = kTetEdges.data();
  double bend = -1.0;
  for (const TetEdge& edge : kTetEdges) {
    const double own = bendAlong(from, edge);
    if (own > bend) {
      bend = own;
      most = &edge;
    }
  }
  return *most;
}

double leastAtCorners(const Coefficients& from) {
  double least = from[kCornerCoefficients[0]];
  for (const Index corner : kCornerCoefficients) least = std::min(least, from[corner]);
  return least;
}

/// Returns a lower bound of the polynomial without rounding errors, at most `tolerance` below its least value unless its sign
/// with respect to `level` is not known otherwise.
double lowerBound(const Coefficients& whole, double tolerance, double level) {
  struct Piece {
    Coefficients coefficients;
    double bound;
    int depth;
  };
  const auto leastOf = [](const Coefficients& from) { return *std::ranges::min_element(from); };
  double least = leastAtCorners(whole);
  const double firstBound = leastOf(whole);
  if (firstBound == least) return least;
  std::array<Piece, kMaxDepth + 1> open;
  open[0] = {whole, firstBound, 0};
  std::size_t count = 1;
  int pieces = 1;
  double bound = std::numeric_limits<double>::infinity();
  while (count > 0) {
    const Piece piece = open[--count];
    const bool isClose =
        piece.bound >= least - tolerance && (piece.bound > level || least <= level);
    if (isClose || piece.depth == kMaxDepth || pieces >= kMaxPieces) {
      bound = std::min(bound, piece.bound);
      continue;
    }
    Piece& first = open[count];
    Piece& second = open[count + 1];
    halve(piece.coefficients, mostBentEdge(piece.coefficients), first.coefficients,
          second.coefficients);
    for (Piece* half : {&first, &second}) {
      half->bound = leastOf(half->coefficients);
      half->depth = piece.depth + 1;
      least = std::min(least, leastAtCorners(half->coefficients));
    }
    // The last one is next.
    if (first.bound < second.bound) std::swap(first, second);
    count += 2;
    ++pieces;
  }
  return bound;
}

}  // namespace

JacobianPolynomial jacobianOf(const QuadraticTet& tet) {
  // Column k of J is the sum of x_i * columns[i][k] over the barycentric coordinates x_i.
  std::array<std::array<Vec3, 3>, 4> columns;
  double largest = 0.0;
  for (std::size_t k = 1; k < 4; ++k) {
    const Vec3 chord = tet.corners[k] - tet.corners[0];
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 difference = middleOf(tet, i, k) - middleOf(tet, i, 0);
      columns[i][k - 1] = 4.0 * difference - chord;
      largest = std::max(largest, 4.0 * magnitudeOf(difference) + magnitudeOf(chord));
    }
  }
  JacobianPolynomial result;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec3 normal = glm::cross(columns[i][0], columns[j][1]);
      for (std::size_t k = 0; k < 4; ++k) {
        result.coefficients[kCoefficients.of[i][j][k]] += glm::dot(normal, columns[k][2]);
      }
    }
  }
  for (std::size_t c = 0; c < kJacobianCoefficients; ++c) {
    result.coefficients[c] *= kCoefficients.weight[c];
  }
  // With u = 2^-53 and L = `largest`: a component of a column has an error of at most 2.1 u L. A determinant is a sum of
  // six products of three components, with at most 13 further roundings in the sum of six determinants and its mean. The error of a
  // coefficient is below 6 (3 x 2.1 + 13) u L^3 < 120 u L^3. A halving rounds three times, each value by at most 6.1 u L^3.
  // 30 halvings add less than 550 u L^3.
  constexpr double kUnitRounding = 0x1p-53;
  result.error = 704.0 * kUnitRounding * largest * largest * largest;
  return result;
}

double scaledJacobian(const QuadraticTet& tet) {
  const JacobianPolynomial polynomial = jacobianOf(tet);
  Coefficients negated;
  std::ranges::transform(polynomial.coefficients, negated.begin(), std::negate<>());
  double largest = 0.0;
  for (const Index corner : kCornerCoefficients) {
    largest = std::max(largest, std::fabs(negated[corner]));
  }
  const double tolerance = kBoundTolerance * largest;
  const double least =
      lowerBound(polynomial.coefficients, tolerance, polynomial.error) - polynomial.error;
  const double most =
      polynomial.error - lowerBound(negated, tolerance, std::numeric_limits<double>::infinity());
  const double scale = std::max(most, -least);
  return scale > 0.0 ? least / scale : 0.0;
}

}  // namespace tetrafront
