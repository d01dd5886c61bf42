/// The optimizer: costs compared with their definitions, operators with their contracts, and whole
/// runs with the tests' validator and the target angles.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <string>

#include "base/fingerprint.h"
#include "boundary/boundary.h"
#include "field/size_tensor.h"
#include "optimize/density.h"
#include "optimize/edge_removal.h"
#include "optimize/element_cost.h"
#include "optimize/element_improver.h"
#include "optimize/last_resort_improver.h"
#include "optimize/locality.h"
#include "optimize/mesh_score.h"
#include "optimize/node_moves.h"
#include "optimize/optimizer.h"
#include "optimize/tet_complex.h"
#include "quality/metrics.h"
#include "support/hard_shapes.h"
#include "support/mesh_validator.h"
#include "support/models.h"
#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"

namespace tetrafront {
namespace {

const std::array<Vec3, 4> kRegular{Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1),
                                   Vec3(-1, -1, 1)};

double costOf(const ElementCost<>& cost, const std::array<Vec3, 4>& t) {
  return cost(t[0], t[1], t[2], t[3]);
}

std::array<Vec3, 4> randomElement(testing::Random& random) {
  for (;;) {
    std::array<Vec3, 4> t{random.inBox(), random.inBox(), random.inBox(), random.inBox()};
    const double volume = measureTetrahedron(t[0], t[1], t[2], t[3]).volume;
    if (volume < 0.0) std::swap(t[2], t[3]);
    if (std::fabs(volume) > 1e-4) return t;
  }
}

TEST(ElementCost, IsZeroForTheRegularElementAndGrowsAwayFromIt) {
  for (const Measure measure : {Measure::kBulk, Measure::kFinish}) {
    const ElementCost cost(measure);
    EXPECT_NEAR(costOf(cost, kRegular), 0.0, 1e-12);
    testing::Random random(1);
    for (int i = 0; i < 1000; ++i) EXPECT_GE(costOf(cost, randomElement(random)), -1e-12);
  }
}

TEST(ElementCost, RejectsDegenerateAndInvertedElements) {
  std::array<Vec3, 4> flat = kRegular;
  flat[3] = (flat[0] + flat[1] + flat[2]) * (1.0 / 3.0);
  std::array<Vec3, 4> inverted = kRegular;
  std::swap(inverted[0], inverted[1]);
  for (const Measure measure : {Measure::kBulk, Measure::kFinish, Measure::kDihedral}) {
    EXPECT_EQ(costOf(ElementCost(measure), flat), kInvalidCost);
    EXPECT_EQ(costOf(ElementCost(measure), inverted), kInvalidCost);
  }
}

TEST(ElementCost, DihedralCostIsAtMostOneExactlyWhenBothTargetsAreMet) {
  testing::Random random(2);
  const ElementCost cost(Measure::kDihedral, kTargets18And150);
  int met = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto t = randomElement(random);
    const TetrahedronMeasures measures = measureTetrahedron(t[0], t[1], t[2], t[3]);
    const double least = std::acos(measures.largestCosine) * 180.0 / std::numbers::pi;
    const double greatest = std::acos(measures.smallestCosine) * 180.0 / std::numbers::pi;
    if (std::fabs(least - 18.0) < 1e-6 || std::fabs(greatest - 150.0) < 1e-6) continue;
    const bool isMet = least > 18.0 && greatest < 150.0;
    ASSERT_EQ(costOf(cost, t) <= 1.0, isMet) << least << " " << greatest;
    met += isMet ? 1 : 0;
  }
  EXPECT_GT(met, 200);
}

/// Polishing may improve any shape, but no further element may fall below 30 or exceed 135 degrees,
/// and none may become worse than the worst.
TEST(ElementCost, WithinAnglesShapesDoNotCompensateAnAngleOutOfRange) {
  testing::Random random(5);
  const ElementCost within(Measure::kWithin, kTargets18And150);
  const ElementCost missing(Measure::kDihedral, kTargets30And135);
  const ElementCost beyond(Measure::kDihedral, kTargets18And150);
  double dearestGood = 0.0;
  double cheapestMissed = kInvalidCost;
  for (int i = 0; i < 5000; ++i) {
    const auto t = randomElement(random);
    const double cost = costOf(within, t);
    ASSERT_EQ(cost >= kInvalidCost, costOf(beyond, t) > 1.0);
    if (cost >= kInvalidCost) continue;
    if (costOf(missing, t) > 1.0) {
      cheapestMissed = std::min(cheapestMissed, cost);
    } else {
      dearestGood = std::max(dearestGood, cost);
    }
  }
  constexpr double kMaxInACavity = 500.0;
  EXPECT_GT(dearestGood, 0.0);
  EXPECT_LT(dearestGood * kMaxInACavity, cheapestMissed);
}

/// One more element out of range makes a mesh worse, even if its worst angles are the same and its mean is better.
TEST(MeshScore, CountsTheElementsOutOfRange) {
  // A regular element and a flat one, far from each other.
  VolumeMesh mesh;
  for (const Vec3& p : kRegular) mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
  for (const Vec3& p : kRegular) mesh.points.insert(mesh.points.end(), {p.x + 9.0, p.y, 0.1 * p.z});
  mesh.tetrahedra = {0, 1, 2, 3, 4, 5, 6, 7};
  TetComplex complex(toTetMesh(mesh, 8));
  Job<> finding([&complex](Work& work) { return complex.findNeighbours(work); });
  finding.finish();
  /// Returns the score of a mesh with the given numbers of copies of the two elements.
  const auto scoreOf = [&](int regular, int flat) {
    MeshScore score;
    for (int i = 0; i < regular; ++i) score.add<PlainSpace>(complex, TetId(0U));
    for (int i = 0; i < flat; ++i) score.add<PlainSpace>(complex, TetId(1U));
    return score;
  };
  EXPECT_TRUE(scoreOf(10, 2).isNoWorseThan(scoreOf(10, 2)));
  EXPECT_TRUE(scoreOf(10, 1).isNoWorseThan(scoreOf(10, 2)));
  EXPECT_FALSE(scoreOf(90, 3).isNoWorseThan(scoreOf(10, 2)));
  EXPECT_FALSE(scoreOf(9, 2).isNoWorseThan(scoreOf(10, 2)));
  EXPECT_FALSE(scoreOf(10, 1).isNoWorseThan(scoreOf(10, 0)));
}

/// Returns the mesh of a closed surface after the front, or after the exact fill, which makes few
/// interior nodes or none.
struct Filled {
  VolumeMesh mesh;
  SurfaceMesh surface;
  [[nodiscard]] TetMesh tetMesh() const { return toTetMesh(mesh, surface.points.size() / 3); }
};

Filled fill(const SurfaceMesh& surface, bool exactFillOnly = false) {
  MeshOptions options;
  options.optimization = Optimization::kNone;
  options.exactFillOnly = exactFillOnly;
  MeshRun run(surface.points, surface.triangles, options);
  while (run.advance(10000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  return {run.volume(), run.surface()};
}

constexpr double kSize = 0.2;

TetComplex complexOf(const Filled& filled, const ElementCost<>& cost) {
  TetComplex complex(filled.tetMesh());
  Job<> finding([&complex](Work& work) { return complex.findNeighbours(work); });
  finding.finish();
  for (std::size_t i = 0; i < complex.nodeCount(); ++i)
    complex.setTarget<PlainSpace>(NodeId(i), kSize);
  complex.recomputeCosts(cost, 0, complex.slotCount());
  return complex;
}

std::uint64_t fingerprintOf(const VolumeMesh& mesh) {
  Fingerprint fingerprint;
  fingerprint.add(mesh.points);
  fingerprint.add(mesh.tetrahedra);
  return fingerprint.value();
}

double totalCost(const TetComplex& complex) {
  double sum = 0.0;
  for (std::size_t t = 0; t < complex.slotCount(); ++t) {
    if (complex.isLive(TetId(t))) sum += complex.cost(TetId(t));
  }
  return sum;
}

TEST(EdgeRemoval, LowersTheCostAsReportedAndKeepsTheMeshValid) {
  const Filled filled = fill(testing::geodesicSphere(4));
  for (const bool fans : {false, true}) {
    const ElementCost cost(Measure::kBulk);
    TetComplex complex = complexOf(filled, cost);
    EdgeRemoval removal(complex);
    int swaps = 0;
    for (std::size_t t = 0; t < complex.slotCount(); ++t) {
      for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
        EdgeRing ring;
        if (!complex.isLive(TetId(t)) || !findRing(complex, TetId(t), e, 7, ring)) continue;
        const double before = totalCost(complex);
        if (!removal.improve(ring, cost, {fans, 1e-4})) continue;
        ++swaps;
        ASSERT_LT(totalCost(complex), before);
      }
    }
    EXPECT_GT(swaps, 20);
    EXPECT_EQ(testing::complaintAbout(toVolumeMesh(complex.toMesh()), filled.surface), "");
  }
}

TEST(EdgeSplitter, AndNodeCollapserKeepTheMeshValid) {
  const Filled filled = fill(testing::gridCube(4));
  const ElementCost cost(Measure::kBulk);
  TetComplex complex = complexOf(filled, cost);
  EdgeSplitter splitter(complex);
  splitter.collect(0, complex.slotCount(), 0);
  splitter.sortCollected();
  const std::size_t splits = splitter.splitSome(0, splitter.collected(), cost);
  EXPECT_GT(splits, 0U);
  EXPECT_EQ(testing::complaintAbout(toVolumeMesh(complex.toMesh()), filled.surface), "");
  NodeCollapser collapser(complex);
  collapser.collect(0, complex.nodeCount(), 0);
  collapser.sortCollected();
  const double before = totalCost(complex);
  EXPECT_GT(collapser.collapseSome(0, collapser.collected(), cost), 0U);
  EXPECT_LT(totalCost(complex), before);
  EXPECT_EQ(testing::complaintAbout(toVolumeMesh(complex.toMesh()), filled.surface), "");
}

TEST(TetComplex, UndoesATrialExactly) {
  const Filled filled = fill(testing::geodesicSphere(5));
  const ElementCost cost(Measure::kBulk);
  TetComplex complex = complexOf(filled, cost);
  EdgeRemoval removal(complex);
  EdgeSplitter splitter(complex);
  NodeMover mover(complex);
  const std::uint64_t before = fingerprintOf(toVolumeMesh(complex.toMesh()));
  const double costBefore = totalCost(complex);
  int trials = 0;
  for (std::size_t t = 0; t < complex.slotCount(); t += 7) {
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      EdgeRing ring;
      if (!findRing(complex, TetId(t), e, 9, ring) || !ring.closed) continue;
      complex.beginTrial();
      const bool made =
          e % 2 == 0 ? removal.force(ring, cost) : !splitter.force(ring, cost).isNone();
      if (made) {
        for (std::size_t i = 0; i < ring.nodeCount; ++i) {
          mover.improve(ring.nodes[i], MoveKind::kCircumcentres, cost);
        }
        ++trials;
      }
      complex.takeBack();
    }
  }
  EXPECT_GT(trials, 100);
  EXPECT_EQ(fingerprintOf(toVolumeMesh(complex.toMesh())), before);
  EXPECT_EQ(totalCost(complex), costBefore);
  // This fails if neighbours or elements at nodes were not restored.
  for (const NodeId node : IdRange<NodeId>(complex.nodeCount())) {
    mover.improve(node, MoveKind::kCircumcentres, cost);
  }
  EXPECT_EQ(testing::complaintAbout(toVolumeMesh(complex.toMesh()), filled.surface), "");
}

/// Returns the total cost of the elements that miss the targets.
double badness(const TetComplex& complex) {
  double sum = 0.0;
  for (std::size_t t = 0; t < complex.slotCount(); ++t) {
    if (complex.isLive(TetId(t)) && complex.cost(TetId(t)) > 1.0) sum += complex.cost(TetId(t));
  }
  return sum;
}

/// A mesh with all operators of the improver.
struct Workshop {
  TetComplex complex;
  EdgeRemoval<> removal{complex};
  EdgeSplitter<> splitter{complex};
  NodeCollapser<> collapser{complex};
  NodeMover<> mover{complex};
  ElementImprover<> repair{complex, removal, splitter, collapser, mover};
};

TEST(ElementImprover, NeverLeavesAWorseMesh) {
  const Filled filled = fill(testing::geodesicSphere(5));
  const ElementCost cost(Measure::kDihedral, kTargets30And135);
  Workshop workshop{complexOf(filled, cost)};
  TetComplex& complex = workshop.complex;
  ElementImprover<>& repair = workshop.repair;
  repair.allowCompounds(100);
  const double atFirst = badness(complex);
  double before = atFirst;
  for (std::size_t t = 0; t < complex.slotCount(); ++t) {
    if (!complex.isLive(TetId(t)) || complex.cost(TetId(t)) <= 1.0) continue;
    repair.improve(TetId(t), cost);
    const double now = badness(complex);
    ASSERT_LE(now, before * (1.0 + 1e-12));
    before = now;
  }
  EXPECT_LT(before, 0.2 * atFirst);
  EXPECT_EQ(testing::complaintAbout(toVolumeMesh(complex.toMesh()), filled.surface), "");
}

/// No element can meet the targets: every change is tried until one around the element is kept.
TEST(LastResortImprover, RetriesOnlyChangedElements) {
  constexpr DihedralTargets kBeyondTheRegular{0.6, 0.6};
  const Filled filled = fill(testing::geodesicSphere(2));
  const ElementCost cost(Measure::kDihedral, kBeyondTheRegular);
  Workshop workshop{complexOf(filled, cost)};
  auto& [complex, removal, splitter, collapser, mover, repair] = workshop;
  LastResortImprover rescue(complex, removal, splitter, collapser, mover, repair);
  const TetId tet(std::size_t{0});
  const auto attemptsOfAPass = [&] {
    constexpr std::size_t kMany = 100000;
    complex.beginPass();
    rescue.allow(kMany);
    rescue.begin(tet);
    int tries = 0;
    while (rescue.tryOne(cost)) ++tries;
    return tries;
  };
  // The element stays as long as its nodes stay; its surroundings settle.
  int turns = 0;
  std::uint64_t before = 0;
  for (std::uint64_t now = 1; now != before && turns < 50; ++turns) {
    ASSERT_TRUE(complex.isLive(tet));
    before = fingerprintOf(toVolumeMesh(complex.toMesh()));
    EXPECT_GT(attemptsOfAPass(), 0);
    now = fingerprintOf(toVolumeMesh(complex.toMesh()));
  }
  ASSERT_LT(turns, 50);
  EXPECT_EQ(attemptsOfAPass(), 0);
  complex.beginPass();
  complex.markChanged(tet);
  EXPECT_GT(attemptsOfAPass(), 0);
}

/// A hollow of 20 faces around the origin, with nodes moved at random.
Hollow<> shakenHollow(std::uint64_t seed) {
  testing::Random random(seed);
  const SurfaceMesh surface = testing::geodesicSphere(1);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < surface.points.size(); i += 3) {
    points.push_back(Vec3(surface.points[i], surface.points[i + 1], surface.points[i + 2]) +
                     random.inBox(0.1));
  }
  Hollow<> hollow;
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    hollow.add(points[surface.triangles[t]], points[surface.triangles[t + 1]],
               points[surface.triangles[t + 2]]);
  }
  return hollow;
}

TEST(NodeMoves, NewtonStepsConvergeToAZeroSlope) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const bool squareRoot : {true, false}) {
      Hollow<> hollow = shakenHollow(seed);
      const ElementCost cost(squareRoot ? Measure::kBulk : Measure::kFinish);
      Vec3 position(0.1, -0.05, 0.08);
      for (int i = 0; i < 20; ++i) {
        Vec3 step(0.0);
        if (!newtonStep(hollow, position, squareRoot, step)) break;
        if (hollow.costAt(position + step, cost, kInvalidCost) >=
            hollow.costAt(position, cost, kInvalidCost)) {
          break;
        }
        position += step;
      }
      constexpr double kStep = 1e-4;
      const double here = hollow.costAt(position, cost, kInvalidCost);
      for (int k = 0; k < 3; ++k) {
        for (const double sign : {-1.0, 1.0}) {
          Vec3 beside = position;
          beside[k] += sign * kStep;
          EXPECT_GT(hollow.costAt(beside, cost, kInvalidCost), here) << "seed " << seed;
        }
      }
    }
  }
}

TEST(NodeMoves, CircumcentreMeanDoesNotDependOnTheApex) {
  Hollow<> hollow = shakenHollow(3);
  const Vec3 one = circumcentreMean(hollow, Vec3(0.1, 0.0, 0.0));
  const Vec3 other = circumcentreMean(hollow, Vec3(-0.05, 0.12, 0.02));
  EXPECT_LT(glm::length(one), 0.3);
  EXPECT_LT(glm::length(other - one), 1e-12);
  const Vec3 by(3.0, -2.0, 1.0);
  Hollow<> moved;
  for (std::size_t i = 0; i < hollow.size(); ++i) {
    moved.add(hollow.face(i)[0] + by, hollow.face(i)[1] + by, hollow.face(i)[2] + by);
  }
  const Vec3 there = circumcentreMean(moved, Vec3(0.1, 0.0, 0.0) + by);
  EXPECT_LT(glm::length(there - by - one), 1e-12) << there.x << " " << one.x;
}

TEST(NodeMoves, LoweringTheWorstNeverRaisesIt) {
  const ElementCost cost(Measure::kDihedral, kTargets30And135);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Hollow<> hollow = shakenHollow(seed);
    Vec3 position(0.3, 0.2, -0.1);
    const double before = hollow.costAt(position, cost, kInvalidCost);
    if (before >= kInvalidCost) continue;
    double worst = before;
    lowerWorst(hollow, cost, 5, position, worst);
    EXPECT_LE(worst, before);
    EXPECT_NEAR(hollow.costAt(position, cost, kInvalidCost), worst, 1e-9 * worst);
  }
}

/// Far from the best position the sum falls by much, and no element is inverted, even if one is so
/// flat that the eighth power of its cost exceeds the cost of an invalid element.
TEST(NodeMoves, LoweringThePowersLowersTheirSum) {
  const ElementCost cost(Measure::kDihedral, kTargets30And135);
  const auto sum = [&](Hollow<>& hollow, const Vec3& position) {
    double powers = 0.0;
    for (std::size_t i = 0; i < hollow.size(); ++i) {
      powers += std::pow(hollow.costOf(i, position, cost), 8.0);
    }
    return powers;
  };
  int tried = 0;
  int flat = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Hollow<> hollow = shakenHollow(seed);
    const Vec3 inside(0.3, 0.2, -0.1);
    const auto& [a, b, c] = hollow.face(0);
    const Vec3 nearFace = inside + ((a + b + c) / 3.0 - inside) * 0.9999;
    for (Vec3 position : {inside, nearFace}) {
      const double before = sum(hollow, position);
      if (hollow.costAt(position, cost, kInvalidCost) >= kInvalidCost) continue;
      ++tried;
      flat += before > kInvalidCost ? 1 : 0;
      EXPECT_TRUE(lowerPowers(hollow, cost, 20, position));
      EXPECT_LT(sum(hollow, position), 0.5 * before);
      EXPECT_LT(hollow.costAt(position, cost, kInvalidCost), kInvalidCost);
    }
  }
  EXPECT_GT(tried - flat, 20);
  EXPECT_GT(flat, 20);
}

/// Returns the tensor T of a stretching by 6 along a slanted direction.
SymmetricTensor slantedTensor() {
  BackgroundNode node;
  node.size = 0.4;
  node.stretching = 6.0;
  node.direction = Vec3(1.0, 0.5, -0.8);
  return sizeTensor(node).inverse();
}

/// The cost of a stretched element is the cost, in plain space, of its image under T.
TEST(StretchedSpace, CostsAreMeasuredInTheMetric) {
  const SymmetricTensor toUnit = slantedTensor();
  testing::Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const auto t = randomElement(random);
    for (const Measure measure : {Measure::kBulk, Measure::kFinish, Measure::kDihedral}) {
      const double here = ElementCost<StretchedSpace>(measure)(t[0], t[1], t[2], t[3], toUnit);
      const double there =
          ElementCost(measure)(toUnit * t[0], toUnit * t[1], toUnit * t[2], toUnit * t[3]);
      ASSERT_NEAR(here, there, 1e-7 * (1.0 + there));
    }
  }
}

/// Compares with central differences, which are accurate where a single angle is the worst: almost
/// everywhere.
template <class Space>
void expectSlopesOfTheCost(const typename Space::Frame& frame) {
  testing::Random random(11);
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const auto t = randomElement(random);
    const ElementCost<Space> cost(Measure::kDihedral, kTargets30And135);
    const auto costAt = [&](const Vec3& apex) { return cost(apex, t[1], t[2], t[3], frame); };
    const double here = costAt(t[0]);
    if (here > 1e4) continue;
    const auto slope = cost.slopeOf(t[0], t[1], t[2], t[3], frame);
    EXPECT_EQ(slope.cost, here);
    constexpr double kStep = 1e-7;
    Vec3 differences(0.0);
    Vec3 bend(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step(0.0);
      step[axis] = kStep;
      const double forth = costAt(t[0] + step);
      const double back = costAt(t[0] - step);
      differences[axis] = (forth - back) / (2.0 * kStep);
      bend[axis] = (forth + back - 2.0 * here) / kStep;
    }
    const double steepness = glm::length(slope.gradient);
    if (glm::length(bend) > 1e-3 * steepness) continue;  // two angles are the worst
    ++compared;
    EXPECT_LT(glm::length(differences - slope.gradient), 2e-3 * steepness) << "element " << i;
  }
  EXPECT_GT(compared, 300);
}

TEST(ElementCost, SlopesAreDerivativesOfTheCost) { expectSlopesOfTheCost<PlainSpace>({}); }

TEST(StretchedSpace, SlopesAreDerivativesOfTheCost) {
  expectSlopesOfTheCost<StretchedSpace>(slantedTensor());
}

TEST(StretchedSpace, MovesAreMadeInTheMetric) {
  const SymmetricTensor toUnit = slantedTensor();
  const SymmetricTensor toSpace = toUnit.inverse();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Hollow<> unit = shakenHollow(seed);
    Hollow<StretchedSpace> hollow;
    for (std::size_t i = 0; i < unit.size(); ++i) {
      const auto& [a, b, c] = unit.face(i);
      hollow.add(toSpace * a, toSpace * b, toSpace * c, toUnit);
    }
    const Vec3 position(0.1, -0.05, 0.08);
    const auto expectSame = [&](const Vec3& here, const Vec3& there) {
      EXPECT_LT(glm::length(toUnit * here - there), 1e-9) << "seed " << seed;
    };
    expectSame(circumcentreMean(hollow, toSpace * position), circumcentreMean(unit, position));
    for (const bool squareRoot : {true, false}) {
      Vec3 here(0.0);
      Vec3 there(0.0);
      ASSERT_TRUE(newtonStep(unit, position, squareRoot, there));
      ASSERT_TRUE(newtonStep(hollow, toSpace * position, squareRoot, here));
      expectSame(here, there);
    }
    double worstHere = 0.0;
    double worstThere = 0.0;
    Vec3 here = toSpace * position;
    Vec3 there = position;
    const bool fellHere =
        lowerWorst(hollow, ElementCost<StretchedSpace>(Measure::kDihedral), 1, here, worstHere);
    EXPECT_EQ(lowerWorst(unit, ElementCost(Measure::kDihedral), 1, there, worstThere), fellHere);
    EXPECT_NEAR(worstHere, worstThere, 1e-9 * worstThere) << "seed " << seed;
  }
}

struct Goal {
  std::string name;
  SurfaceMesh surface;
  double leastDihedral;
  double greatestDihedral;
  double meanRadiusRatio;
};
void PrintTo(const Goal& goal, std::ostream* out) { *out << goal.name; }

class OptimizedSurface : public ::testing::TestWithParam<Goal> {};

TEST_P(OptimizedSurface, IsValidAndMeetsItsAngles) {
  const Goal& goal = GetParam();
  MeshRun run(goal.surface.points, goal.surface.triangles, {});
  while (run.advance(10000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  const QualitySummary quality = run.quality();
  EXPECT_GE(quality.minDihedral, goal.leastDihedral);
  EXPECT_LE(quality.maxDihedral, goal.greatestDihedral);
  EXPECT_GE(quality.meanRadiusRatio, goal.meanRadiusRatio);
}

// The squares of grids consist of right triangles. Their elements cannot be as regular as those of
// drawn models (below), hence the lower ratios.
INSTANTIATE_TEST_SUITE_P(
    Optimize, OptimizedSurface,
    ::testing::Values(
        Goal{"sphere", testing::geodesicSphere(10), 30.0, 135.0, 0.88},
        Goal{"cube", testing::gridCube(12, testing::Diagonals::kAlternating), 30.0, 135.0, 0.87},
        Goal{"torus", testing::torus(1.0, 0.35, 80, 28), 30.0, 135.0, 0.84},
        Goal{"sphericalCavity", testing::cubeWithSphericalCavity(12, 5), 30.0, 135.0, 0.85},
        // No target can be met here, but the mesh must stay valid.
        Goal{"thinPlate", testing::thinPlate(20, 0.002), 0.0, 180.0, 0.0},
        Goal{"schoenhardt", testing::schoenhardtPrism(50.0), 0.5, 180.0, 0.0},
        Goal{"twoCubesSharingAnEdge", testing::cubesSharingEdge(), 30.0, 135.0, 0.5},
        Goal{"shells", testing::nestedSpheres(3, 8), 18.0, 150.0, 0.8}),
    [](const auto& each) { return each.param.name; });

struct DrawnGoal {
  std::string name;
  Model model;
  double size;
  double meanRadiusRatio;
};
void PrintTo(const DrawnGoal& goal, std::ostream* out) { *out << goal.name; }

class OptimizedModel : public ::testing::TestWithParam<DrawnGoal> {};

/// On uniform surfaces with good triangles: angles, shapes and target sizes.
TEST_P(OptimizedModel, MeetsItsAnglesAndSizes) {
  const DrawnGoal& goal = GetParam();
  MeshOptions options;
  options.size = goal.size;
  MeshRun run(goal.model, {}, options);
  while (run.advance(10000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  const QualitySummary quality = run.quality();
  EXPECT_GE(quality.minDihedral, 30.0);
  EXPECT_LE(quality.maxDihedral, 135.0);
  EXPECT_GE(quality.meanRadiusRatio, goal.meanRadiusRatio);
  const QualityStatistics statistics = run.statistics();
  EXPECT_NEAR(statistics.meanEdge, 1.0, 0.12);
  EXPECT_GE(statistics.edgesNearTarget, 0.95);
  EXPECT_EQ(statistics.outOfRange, 0U);
  EXPECT_EQ(statistics.limitedByBoundary, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Optimize, OptimizedModel,
    ::testing::Values(DrawnGoal{"sphere", testing::sphereModel(1.0), 0.12, 0.89},
                      DrawnGoal{"cube", testing::boxModel(Vec3(0.0), Vec3(1.0)), 0.09, 0.88},
                      DrawnGoal{"torus", testing::torusModel(1.0, 0.35), 0.1, 0.88},
                      // With too few interior nodes, measured by the shapes of elements alone.
                      DrawnGoal{"coarseTorus", testing::torusModel(1.0, 0.35), 0.28, 0.85}),
    [](const auto& each) { return each.param.name; });

TEST(MeshOptimizer, DoesNotDependOnHowTheWorkIsSliced) {
  // Interiors that begin without nodes are harder: swaps add elements as they go.
  for (const bool exactFillOnly : {false, true}) {
    const Filled filled = fill(testing::geodesicSphere(5), exactFillOnly);
    const auto optimized = [&](std::uint32_t budget) {
      const SizeField field = SizeField::uniform(0.2);
      MeshOptimizer optimizer(filled.tetMesh(), field, Optimization::kThorough);
      Job<> optimizing([&optimizer](Work& work) { return optimizer.run(work); });
      while (!optimizing.advance(budget)) {
      }
      return fingerprintOf(toVolumeMesh(optimizer.take()));
    };
    const std::uint64_t whole = optimized(10'000'000);
    for (const std::uint32_t budget : {1U, 17U, 999U}) {
      EXPECT_EQ(optimized(budget), whole) << budget << (exactFillOnly ? ", exact fill" : "");
    }
  }
}

/// A layer with 1/15 of the target size in the middle of a cube. Many elements there miss every
/// target, and the attempts to improve them must not take longer than all other work.
TEST(MeshOptimizer, GivesUpEarlyIfALayerIsTooThin) {
  testing::ModelBuilder builder;
  const std::array<double, 4> levels{0.0, 0.5, 0.51, 1.01};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::vector<Vec3> square = testing::squareCorners({0.0, 0.0, levels[i]}, 1.0);
    builder.patch(PatchType::kPlanar, {builder.polygon(square)});
    for (std::size_t k = 0; i > 0 && k < 4; ++k) {
      const Vec3 up(0.0, 0.0, levels[i] - levels[i - 1]);
      const Vec3& a = square[k];
      const Vec3& b = square[(k + 1) % 4];
      builder.patch(PatchType::kPlanar, {builder.polygon({a - up, b - up, b, a})});
    }
  }
  MeshOptions options;
  options.size = 0.15;
  MeshRun run(builder.model, {}, options);
  constexpr std::uint32_t kBudget = 1000;
  double work = 0.0;
  while (run.advance(kBudget) == MeshStatus::kRunning) {
    if (run.progress().phase == Phase::kOptimize) work += kBudget;
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_LT(work, 20.0 * static_cast<double>(run.volume().tetrahedra.size()));
}

/// All triangles of the drum are needles, and no node inside can make the elements next to them better.
TEST(MeshOptimizer, DoesNotMultiplyTheElementsBetweenNeedles) {
  const SurfaceMesh drum = testing::needleDrum(2000, 0);
  const std::size_t before = fill(drum).mesh.tetrahedra.size();
  MeshRun run(drum.points, drum.triangles, {});
  while (run.advance(10000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_LT(run.volume().tetrahedra.size(), 2 * before);
}

TEST(MeshOptimizer, MoreEffortGivesBetterWorstElements) {
  const SurfaceMesh surface = testing::geodesicSphere(8);
  double before = 0.0;
  for (const Optimization level : {Optimization::kNone, Optimization::kFast, Optimization::kDefault,
                                   Optimization::kThorough}) {
    MeshOptions options;
    options.optimization = level;
    MeshRun run(surface.points, surface.triangles, options);
    while (run.advance(10000) == MeshStatus::kRunning) {
    }
    const double least = run.quality().minDihedral;
    EXPECT_GE(least, before - (level == Optimization::kDefault ? 3.0 : 0.0));
    before = least;
  }
  EXPECT_GT(before, 33.0);
}

/// Returns the mean distance between consecutive elements in memory.
double meanStride(const VolumeMesh& mesh) {
  const auto first = [&](std::size_t t) {
    const double* at = &mesh.points[3 * std::size_t{mesh.tetrahedra[4 * t]}];
    return Vec3(at[0], at[1], at[2]);
  };
  const std::size_t count = mesh.tetrahedra.size() / 4;
  double sum = 0.0;
  for (std::size_t t = 1; t < count; ++t) sum += glm::length(first(t) - first(t - 1));
  return sum / static_cast<double>(count);
}

VolumeMesh orderedMesh(TetMesh mesh) {
  Job<> ordering([&mesh](Work& work) { return orderAlongMortonCurve(work, mesh); });
  ordering.finish();
  return toVolumeMesh(std::move(mesh));
}

TEST(OrderAlongMortonCurve, KeepsTheMeshAndGroupsNeighbours) {
  const Filled filled = fill(testing::cubeWithCubicCavity(8, 4));
  VolumeMesh shuffled = filled.mesh;
  testing::Random random(5);
  for (std::size_t t = shuffled.tetrahedra.size() / 4 - 1; t > 0; --t) {
    const auto other = static_cast<std::size_t>(random.between(0.0, static_cast<double>(t)));
    for (std::size_t k = 0; k < 4; ++k) {
      std::swap(shuffled.tetrahedra[4 * t + k], shuffled.tetrahedra[4 * other + k]);
    }
  }
  const VolumeMesh ordered = orderedMesh(toTetMesh(shuffled, filled.surface.points.size() / 3));
  EXPECT_EQ(testing::complaintAbout(ordered, filled.surface), "");
  EXPECT_EQ(ordered.tetrahedra.size(), shuffled.tetrahedra.size());
  EXPECT_EQ(ordered.points.size(), shuffled.points.size());
  EXPECT_LT(meanStride(ordered), 0.4 * meanStride(shuffled));
}

TEST(OrderAlongMortonCurve, DoesNotDependOnHowTheWorkIsSliced) {
  const Filled filled = fill(testing::gridCube(6));
  TetMesh mesh = filled.tetMesh();
  Job<> ordering([&mesh](Work& work) { return orderAlongMortonCurve(work, mesh); });
  std::size_t slices = 1;
  while (!ordering.advance(1)) ++slices;
  EXPECT_GT(slices, filled.mesh.regions.size() / 10);
  EXPECT_EQ(toVolumeMesh(std::move(mesh)).tetrahedra, orderedMesh(filled.tetMesh()).tetrahedra);
}

TEST(MeshOptimizer, KeepsFixedNodesWhereverTheyAre) {
  const Filled filled = fill(testing::gridCube(6));
  TetMesh mesh = filled.tetMesh();
  const std::size_t boundary = filled.surface.points.size() / 3;
  const auto positionsOf = [](const TetMesh& one, const auto& isListed) {
    std::set<std::array<double, 3>> found;
    for (std::size_t i = 0; i < one.points.size(); ++i) {
      if (isListed(i)) found.insert({one.points[i].x, one.points[i].y, one.points[i].z});
    }
    return found;
  };
  const auto areKept = [&](const TetMesh& given, const auto& isListed) {
    const SizeField field = SizeField::uniform(0.2);
    MeshOptimizer optimizer(given, field, Optimization::kDefault);
    Job<> optimizing([&optimizer](Work& work) { return optimizer.run(work); });
    optimizing.finish();
    const TetMesh made = optimizer.take();
    EXPECT_EQ(testing::complaintAbout(toVolumeMesh(made), filled.surface), "");
    return std::ranges::includes(positionsOf(made, [](std::size_t) { return true; }),
                                 positionsOf(given, isListed));
  };
  const auto isListed = [&](std::size_t node) { return node >= boundary && node % 3 == 0; };
  EXPECT_GT(positionsOf(mesh, isListed).size(), 10U);
  EXPECT_FALSE(areKept(mesh, isListed));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (isListed(i)) mesh.isFixed[i] = 1;
  }
  EXPECT_TRUE(areKept(mesh, isListed));
}

TEST(MeshOptimizer, IsValidWheneverItIsStopped) {
  const Filled filled = fill(testing::gridCube(5));
  const SizeField field = SizeField::uniform(0.2);
  MeshOptimizer optimizer(filled.tetMesh(), field, Optimization::kDefault);
  Job<> optimizing([&optimizer](Work& work) { return optimizer.run(work); });
  for (int i = 0; i < 40 && !optimizing.advance(500); ++i) {
    ASSERT_EQ(testing::complaintAbout(toVolumeMesh(optimizer.mesh()), filled.surface), "")
        << "slice " << i;
  }
}

}  // namespace
}  // namespace tetrafront
