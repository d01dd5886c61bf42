/// Steps of the front on a few faces, small enough to compute the expected outcome by hand: which
/// candidates are ranked, which one is accepted, and what becomes of a face that fails.

#include "volume/front_advance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <vector>

#include "geom/predicates.h"
#include "support/trace_reader.h"
#include "volume/ideal_point.h"

namespace tetrafront {
namespace {

using testing::TraceStep;

const double kTriangleHeight = std::sqrt(0.75);
const Vec3 kCentroid(0.5, kTriangleHeight / 3.0, 0.0);

/// A front with an equilateral base face of edge 1 in the plane z = 0, whose empty side is above.
struct BaseFixture {
  BaseFixture() {
    a = front.addNode({0.0, 0.0, 0.0}, 4);
    b = front.addNode({1.0, 0.0, 0.0}, 5);
    c = front.addNode({0.5, kTriangleHeight, 0.0}, 3);
    base = front.addFace({a, b, c}, kRegion, {}, true);
    const NodeTriple nodes{a, b, c};
    const BaseFace face = describeBase(front, nodes, space);
    ideal = placeIdealPoint(face, space.targetEdge());
  }

  /// A face with its first node at `position` and the others far away.
  NodeId addLooseNode(const Vec3& position) {
    const NodeId node = front.addNode(position, 0);
    const NodeId right = front.addNode(position + Vec3(5.0, 0.0, 5.0), 0);
    const NodeId left = front.addNode(position + Vec3(0.0, 5.0, 5.0), 0);
    front.addFace({node, right, left}, kRegion, {}, false);
    return node;
  }

  /// Candidates over the base under a rule class, the best first.
  std::vector<Candidate> candidates(const RuleClass& rules) {
    const NodeTriple nodes{a, b, c};
    const BaseFace face = describeBase(front, nodes, space);
    SearchRegion region(space, {front.node(a), front.node(b), front.node(c)}, ideal.position,
                        rules.searchRadius * ideal.size, front.extent());
    hasGrown = false;
    const auto gather = [&] {
      around.gather(front, nodes, region, ideal.position);
      around.mapTo(space);
      crossing.setBase();
      return neighbours.find(around, face, region);
    };
    while (gather()) hasGrown = true;
    CandidateList list;
    list.rank(around, crossing, face, ideal, neighbours, rules, RuleVariant{});
    std::vector<Candidate> ranked;
    while (const Candidate* candidate = list.next()) ranked.push_back(*candidate);
    return ranked;
  }

  [[nodiscard]] const Candidate* find(const std::vector<Candidate>& ranked, NodeId node) const {
    const auto found = std::ranges::find_if(ranked, [&](const Candidate& candidate) {
      return candidate.node != Candidate::kNewNode && around.nodeId(candidate.node) == node;
    });
    return found == ranked.end() ? nullptr : &*found;
  }

  [[nodiscard]] double heightAt(double factor) const { return ideal.height * factor; }

  static constexpr std::uint32_t kRegion = 7;
  Front front{1.0, Vec3(-20.0), FrontOrder::kLayered};
  NodeId a;
  NodeId b;
  NodeId c;
  FaceId base;
  UnitSpace space = UnitSpace::plain(1.0);
  IdealPoint ideal{};
  Neighbourhood around;
  CrossingTest crossing{around, true};
  EdgeNeighbours neighbours;
  bool hasGrown = false;
};

const RuleClass& kStrict = kRuleClasses[0];

TEST(Candidates, AreNewNodesOnTheLineToTheIdealPointFromTheTop) {
  BaseFixture fixture;
  const std::vector<Candidate> ranked = fixture.candidates(kStrict);
  ASSERT_EQ(ranked.size(), kHeights.size());
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    EXPECT_EQ(ranked[i].node, Candidate::kNewNode);
    const Vec3 expected = kCentroid + Vec3(0.0, 0.0, fixture.heightAt(kHeights.at(i)));
    EXPECT_LT(glm::length(ranked[i].unitPosition - expected), 1e-12) << "height " << i;
  }
  EXPECT_LT(glm::length(ranked[0].unitPosition - fixture.ideal.position), 1e-12);
}

TEST(Candidates, KeepNewNodesAwayFromExistingOnes) {
  BaseFixture fixture;
  const NodeId node = fixture.addLooseNode(kCentroid + Vec3(0.0, 0.0, 0.9));
  const std::vector<Candidate> ranked = fixture.candidates(kStrict);
  // Nodes at more than 0.55 of the ideal height are nearer than 0.8 h times their factor.
  ASSERT_EQ(ranked.size(), 3U);
  EXPECT_EQ(fixture.find(ranked, node), ranked.data());
  EXPECT_NEAR(ranked[1].unitPosition.z, fixture.heightAt(0.55), 1e-12);
  EXPECT_NEAR(ranked[2].unitPosition.z, fixture.heightAt(0.4), 1e-12);
}

TEST(Candidates, ComeFromTheSearchRadius) {
  for (const double distance : {0.89, 0.91}) {
    BaseFixture fixture;
    const Vec3 above(0.0, 0.0, distance * fixture.ideal.size);
    const NodeId node = fixture.addLooseNode(fixture.ideal.position + above);
    const bool isOffered = fixture.find(fixture.candidates(kStrict), node) != nullptr;
    EXPECT_EQ(isOffered, distance < kStrict.searchRadius) << "distance " << distance;
  }
}

TEST(Candidates, AreNotTooFlatAndNotBehindTheBase) {
  BaseFixture fixture;
  const NodeId flat = fixture.addLooseNode(kCentroid + Vec3(0.0, 0.0, 0.02));
  const NodeId behind = fixture.addLooseNode(kCentroid + Vec3(0.0, 0.0, -0.05));
  EXPECT_EQ(fixture.find(fixture.candidates(kStrict), flat), nullptr);
  EXPECT_NE(fixture.find(fixture.candidates(kRuleClasses[3]), flat), nullptr);
  for (const RuleClass& rules : kRuleClasses) {
    EXPECT_EQ(fixture.find(fixture.candidates(rules), behind), nullptr);
  }
}

/// Two nodes that mirror each other, of which one meets a face at an edge of the base.
TEST(Candidates, GetABonusForEachFaceTheyMeet) {
  BaseFixture fixture;
  const NodeId right = fixture.front.addNode({0.75 + 0.1 * kTriangleHeight, 0.483, 0.75}, 0);
  fixture.front.addFace({fixture.c, fixture.b, right}, BaseFixture::kRegion, {}, false);
  const NodeId left = fixture.addLooseNode({0.25 - 0.1 * kTriangleHeight, 0.483, 0.75});
  const std::vector<Candidate> ranked = fixture.candidates(kStrict);
  const Candidate* meets = fixture.find(ranked, right);
  const Candidate* isLoose = fixture.find(ranked, left);
  ASSERT_NE(meets, nullptr);
  ASSERT_NE(isLoose, nullptr);
  EXPECT_EQ(fixture.neighbours.edgesClosedBy(meets->node), 1);
  EXPECT_NEAR(meets->score / isLoose->score, std::pow(1.0 + kClosingBonus, 3), 1e-9);
}

/// Equal scores are ordered by index, so that the result does not depend on the sorting method.
TEST(Candidates, AreOrderedByIndexIfTheirScoresAreEqual) {
  BaseFixture fixture;
  const Vec3 position = kCentroid + Vec3(0.0, 0.0, 0.9);
  for (int i = 0; i < 3; ++i) fixture.addLooseNode(position);
  const std::vector<Candidate> ranked = fixture.candidates(kStrict);
  ASSERT_GE(ranked.size(), 3U);
  EXPECT_EQ(ranked[0].score, ranked[2].score);
  EXPECT_LT(ranked[0].node, ranked[1].node);
  EXPECT_LT(ranked[1].node, ranked[2].node);
}

/// The apex of a face that folds over the base at 60 degrees, far beyond the search radius.
TEST(Candidates, BeginWithTheApexOfAWedge) {
  BaseFixture fixture;
  const NodeId apex = fixture.front.addNode({0.5, 1.5, 3.0 * kTriangleHeight}, 0);
  fixture.front.addFace({fixture.b, fixture.a, apex}, BaseFixture::kRegion, {}, false);
  const std::vector<Candidate> ranked = fixture.candidates(kStrict);
  EXPECT_TRUE(fixture.hasGrown) << "all faces that the element could cross must be gathered";
  ASSERT_FALSE(ranked.empty());
  EXPECT_EQ(fixture.find(ranked, apex), ranked.data());
  EXPECT_GT(ranked[0].score, kWedgeBonus);
  EXPECT_LT(ranked[0].score, kPocketBonus);
}

TEST(Candidates, BeginWithTheNodeThatFillsAPocketHoweverFlat) {
  BaseFixture fixture;
  const NodeId apex = fixture.front.addNode(kCentroid + Vec3(0.0, 0.0, 1e-6), 0);
  fixture.front.addFace({fixture.c, fixture.b, apex}, BaseFixture::kRegion, {}, false);
  fixture.front.addFace({fixture.a, fixture.c, apex}, BaseFixture::kRegion, {}, false);
  fixture.front.addFace({fixture.b, fixture.a, apex}, BaseFixture::kRegion, {}, false);
  const std::vector<Candidate> ranked = fixture.candidates(kStrict);
  ASSERT_FALSE(ranked.empty());
  EXPECT_EQ(fixture.find(ranked, apex), ranked.data());
  EXPECT_GT(ranked[0].score, kPocketBonus);
}

/// The front around the base, and what advances it.
struct AdvanceFixture : BaseFixture {
  Elements elements;
  SizeField field = SizeField::uniform(1.0);
  StepRecorder recorder;
  TracedFrontAdvance<RecordingTrace> advance{front, elements, field, true,
                                             RecordingTrace(recorder)};
  bool hasBegun = false;
  std::vector<TraceStep> events;

  std::uint32_t step(bool mayRelax = true) {
    if (!hasBegun) advance.recordBegin({});
    hasBegun = true;
    const std::uint32_t cost = advance.step(mayRelax);
    std::ranges::copy(testing::readTrace(recorder.takeEvents()), std::back_inserter(events));
    return cost;
  }

  [[nodiscard]] std::vector<TraceStep> stepsOf(TraceStep::Kind kind) const {
    std::vector<TraceStep> steps;
    std::ranges::copy_if(events, std::back_inserter(steps),
                         [&](const TraceStep& step) { return step.kind == kind; });
    return steps;
  }
};

TEST(FrontAdvance, MakesANodeAtTheIdealPointOneLayerDeeper) {
  AdvanceFixture fixture;
  EXPECT_EQ(fixture.step(), 1U);
  ASSERT_EQ(fixture.elements.size(), 1U);
  ASSERT_EQ(fixture.front.nodes().size(), 4U);
  const NodeId apex(3U);
  EXPECT_LT(glm::length(fixture.front.node(apex) - fixture.ideal.position), 1e-12);
  EXPECT_EQ(fixture.front.layer(apex), 4) << "one more than the lowest layer of the base";
  EXPECT_EQ(fixture.elements.nodes[0], (NodeQuad{fixture.a, fixture.b, fixture.c, apex}));
  EXPECT_EQ(fixture.elements.regions[0], BaseFixture::kRegion);
  // The other three faces are those of the element, facing outward.
  ASSERT_EQ(fixture.front.activeCount(), 3U);
  for (const FaceId id : fixture.front.activeFaces()) {
    const NodeTriple& n = fixture.front.face(id).nodes;
    const Vec3 inside = kCentroid + Vec3(0.0, 0.0, 0.1);
    EXPECT_LT(orient3d(fixture.front.node(n[0]), fixture.front.node(n[1]), fixture.front.node(n[2]),
                       inside),
              0);
    EXPECT_EQ(fixture.front.face(id).region, BaseFixture::kRegion);
    EXPECT_EQ(fixture.front.popBase().value < 4U, true) << "new faces are queued";
  }
  EXPECT_TRUE(fixture.front.isQueueEmpty());
}

TEST(FrontAdvance, ClosesAPocketOfFourFaces) {
  AdvanceFixture fixture;
  Front& front = fixture.front;
  const NodeId apex = front.addNode(fixture.ideal.position, 0);
  front.addFace({fixture.c, fixture.b, apex}, BaseFixture::kRegion, {}, true);
  front.addFace({fixture.a, fixture.c, apex}, BaseFixture::kRegion, {}, true);
  front.addFace({fixture.b, fixture.a, apex}, BaseFixture::kRegion, {}, true);
  fixture.step();
  EXPECT_EQ(fixture.elements.size(), 1U);
  EXPECT_EQ(front.nodes().size(), 4U);
  EXPECT_EQ(front.activeCount(), 0U);
  EXPECT_TRUE(front.isQueueEmpty());
  EXPECT_EQ(fixture.advance.counters().relaxed, 0U);
}

/// A face above the base faces it from so near that only an element of low quality fits between
/// them.
void addLid(BaseFixture& fixture) {
  Front& front = fixture.front;
  const Vec3 up(0.0, 0.0, 0.05);
  const NodeId a = front.addNode(front.node(fixture.a) + up, 0);
  const NodeId b = front.addNode(front.node(fixture.b) + up, 0);
  const NodeId c = front.addNode(front.node(fixture.c) + up, 0);
  front.addFace({a, c, b}, BaseFixture::kRegion, {}, false);
}

TEST(FrontAdvance, RequeuesAFaceUnderMoreLenientRules) {
  AdvanceFixture fixture;
  addLid(fixture);
  const FrontAdvance& advance = fixture.advance;
  for (std::uint8_t next = 1; next <= 2; ++next) {
    fixture.step();
    ASSERT_EQ(fixture.elements.size(), 0U);
    EXPECT_EQ(fixture.front.face(fixture.base).ruleClass, next);
    EXPECT_FALSE(fixture.front.isQueueEmpty());
    EXPECT_EQ(advance.counters().relaxedCost, next - 1U) << "the strict step is not relaxed";
  }
  fixture.step();
  EXPECT_EQ(fixture.elements.size(), 1U);
  EXPECT_EQ(advance.counters().relaxed, 1U);
  EXPECT_EQ(advance.counters().pops, 3U);
  EXPECT_EQ(fixture.stepsOf(TraceStep::kPostponed).size(), 2U);
  // Every new node would be beyond the face above.
  for (const TraceStep& step : fixture.stepsOf(TraceStep::kRefused)) {
    EXPECT_NE(step.detail & 3U, static_cast<std::uint32_t>(Refusal::kBehind));
  }
}

/// A large face close above the base, whose own nodes no rule class reaches.
TEST(FrontAdvance, SetsAFaceAsideAfterTheLastRuleClass) {
  AdvanceFixture fixture;
  Front& front = fixture.front;
  const NodeId p = front.addNode({-12.0, -10.0, 0.01}, 0);
  const NodeId q = front.addNode({0.0, 14.0, 0.01}, 0);
  const NodeId r = front.addNode({12.0, -10.0, 0.01}, 0);
  front.addFace({p, q, r}, BaseFixture::kRegion, {}, false);
  for (std::size_t next = 1; next <= kRuleClasses.size(); ++next) {
    ASSERT_FALSE(front.isQueueEmpty());
    fixture.step();
    EXPECT_EQ(front.face(fixture.base).ruleClass, next);
  }
  EXPECT_TRUE(front.isQueueEmpty());
  EXPECT_TRUE(front.face(fixture.base).active);
  EXPECT_EQ(fixture.elements.size(), 0U);
}

TEST(FrontAdvance, SetsARelaxedFaceAsideIfItMayNotRelax) {
  AdvanceFixture fixture;
  addLid(fixture);
  fixture.step();
  ASSERT_FALSE(fixture.front.isQueueEmpty());
  fixture.step(false);
  EXPECT_TRUE(fixture.front.isQueueEmpty());
  EXPECT_EQ(fixture.front.face(fixture.base).ruleClass, 2);
  EXPECT_TRUE(fixture.front.face(fixture.base).active);
  EXPECT_EQ(fixture.elements.size(), 0U);
}

/// A large face above the ideal point, without a node near the base.
TEST(FrontAdvance, KeepsNewNodesAwayFromFaces) {
  AdvanceFixture fixture;
  Front& front = fixture.front;
  const double height = fixture.ideal.height + 0.1;
  const NodeId p = front.addNode({-10.0, -8.0, height}, 0);
  const NodeId q = front.addNode({0.0, 12.0, height}, 0);
  const NodeId r = front.addNode({10.0, -8.0, height}, 0);
  const FaceId ceiling = front.addFace({p, q, r}, BaseFixture::kRegion, {}, false);
  fixture.step();
  ASSERT_EQ(fixture.elements.size(), 1U);
  EXPECT_NEAR(front.nodes().back().z, fixture.heightAt(0.55), 1e-12);
  const std::vector<TraceStep> refused = fixture.stepsOf(TraceStep::kRefused);
  ASSERT_EQ(refused.size(), 3U) << "the three heights above";
  for (const TraceStep& step : refused) {
    EXPECT_EQ(step.detail & 3U, static_cast<std::uint32_t>(Refusal::kTooCloseToFace));
    EXPECT_EQ(step.culprit, ceiling.value);
  }
}

/// Faces around the edge from a to b at random angles, with alternating orientations as in any closed
/// front: a face in the direction of the base is never the first one from the base on.
TEST(FrontAdvance, AFaceOfTheBasesDirectionIsNeverTheNextAroundAnEdge) {
  constexpr int kRounds = 500;
  std::uint32_t state = 1;
  const auto random = [&] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>(state >> 8U) / 0x1p24;
  };
  for (int round = 0; round < kRounds; ++round) {
    BaseFixture fixture;
    Front& front = fixture.front;
    std::array<double, 2> angles{random(), random()};
    std::ranges::sort(angles);
    const auto nodeAt = [&](double part) {
      const double angle = (0.02 + 0.96 * part) * std::numbers::pi;
      const double radius = 0.5 + random();
      return front.addNode({random(), radius * std::cos(angle), radius * std::sin(angle)}, 0);
    };
    if (angles[1] - angles[0] < 0.01) continue;
    const FaceId opposite =
        front.addFace({fixture.b, fixture.a, nodeAt(angles[0])}, BaseFixture::kRegion, {}, false);
    const NodeId apex = nodeAt(angles[1]);
    front.addFace({fixture.a, fixture.b, apex}, BaseFixture::kRegion, {}, false);
    static_cast<void>(fixture.candidates(kRuleClasses.back()));
    LocalNode local = 0;
    while (fixture.around.nodeId(local) != apex) ++local;
    ASSERT_GT(fixture.crossing.volumeSign(local), 0);
    fixture.crossing.setApex(local);
    EXPECT_EQ(fixture.crossing.firstCrossedFace(), opposite) << "round " << round;
  }
}

}  // namespace
}  // namespace tetrafront
