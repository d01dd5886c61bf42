/// Recovery without a front that advances: an enlarged pocket can be restored, and open pockets are
/// filled to their exact volume, with the same boundary.

#include "volume/pocket_filler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "geom/dyadic.h"
#include "geom/predicates.h"
#include "support/hard_shapes.h"
#include "support/shapes.h"
#include "volume/enlarged_pocket.h"

namespace tetrafront {
namespace {

using Faces = std::set<std::pair<NodeTriple, std::uint32_t>>;

constexpr std::uint32_t kRegion = 3;

/// A front that has not advanced yet, with the objects that recovery needs.
struct PocketFixture {
  explicit PocketFixture(const SurfaceMesh& surface)
      : front(1.0, Vec3(-100.0), FrontOrder::kLayered), index(elements) {
    for (std::uint32_t i = 0; i < testing::nodeCount(surface); ++i) {
      front.addNode(testing::pointOf(surface, i), 0);
    }
    for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
      const std::uint32_t* n = surface.triangles.data() + t;
      front.addFace({NodeId(n[0]), NodeId(n[2]), NodeId(n[1])}, kRegion, FieldHint{}, false);
    }
  }

  void fill(std::uint32_t budget) {
    PocketSet pockets(front, findPockets(front));
    PocketFiller filler(front, elements, index, pockets);
    while (!filler.isDone()) filler.work(budget);
  }

  /// Removes one element and returns its pocket.
  PocketId removeElement(TetId element, PocketSet& pockets) {
    elements.remove(element);
    std::vector<FaceId> faces;
    for (const NodeTriple& face : innerFaces(elements.nodes[element.index()])) {
      faces.push_back(front.addFace(face, kRegion, FieldHint{}, false));
    }
    std::sort(faces.begin(), faces.end());
    return pockets.add(std::move(faces));
  }

  [[nodiscard]] Faces activeFaces() const {
    Faces faces;
    for (const FaceId id : front.activeFaces()) {
      faces.emplace(smallestFirst(front.face(id).nodes), front.face(id).region);
    }
    return faces;
  }

  Front front;
  Elements elements;
  ElementIndex index;
};

/// Returns six times the volume that a closed set of faces encloses, exactly. The faces are
/// counter-clockwise seen from inside.
Dyadic enclosedBy(const Front& front, const Faces& faces) {
  const DyadicVec3 origin = toDyadic(Vec3(0.0));
  Dyadic sum;
  for (const auto& [n, region] : faces) {
    sum = sum - determinant(origin, toDyadic(front.node(n[0])), toDyadic(front.node(n[1])),
                            toDyadic(front.node(n[2])));
  }
  return sum;
}

Dyadic volumeOf(const Front& front, const NodeQuad& n) {
  return determinant(toDyadic(front.node(n[0])), toDyadic(front.node(n[1])),
                     toDyadic(front.node(n[2])), toDyadic(front.node(n[3])));
}

/// Returns the faces that only one element has, seen from inside. Fails if two elements have the
/// same face with the same orientation.
Faces boundaryOf(const Elements& elements) {
  Faces faces;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (elements.removed[e] != 0) continue;
    for (const NodeTriple& face : innerFaces(elements.nodes[e])) {
      if (faces.erase({smallestFirst(reversed(face)), elements.regions[e]}) > 0) continue;
      EXPECT_TRUE(faces.emplace(smallestFirst(face), elements.regions[e]).second);
    }
  }
  return faces;
}

/// Returns true if the faces pass every edge equally often in both directions.
bool isClosed(const Faces& faces) {
  std::map<std::pair<NodeId, NodeId>, int> passed;
  for (const auto& [n, region] : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId from = n[k];
      const NodeId to = n[(k + 1) % 3];
      passed[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  return std::ranges::all_of(passed, [](const auto& edge) { return edge.second == 0; });
}

std::vector<std::pair<const char*, SurfaceMesh>> hardSurfaces() {
  return {{"cube", testing::gridCube(3)},
          {"Schoenhardt's prism", testing::schoenhardtPrism(50.0)},
          {"tower", testing::schoenhardtTower(4, 45.0)},
          {"cavity", testing::cubeWithCubicCavity(3, 2)},
          {"needles", testing::needlePlate(1, 16, 0.05)}};
}

TEST(PocketFiller, FillsTheExactVolumeAndKeepsTheBoundary) {
  for (const auto& [name, surface] : hardSurfaces()) {
    SCOPED_TRACE(name);
    PocketFixture fixture(surface);
    const Faces given = fixture.activeFaces();
    const Dyadic enclosed = enclosedBy(fixture.front, given);
    fixture.fill(1000);
    EXPECT_EQ(fixture.front.activeCount(), 0U);
    EXPECT_EQ(boundaryOf(fixture.elements), given);
    Dyadic filled;
    for (std::size_t e = 0; e < fixture.elements.size(); ++e) {
      if (fixture.elements.removed[e] != 0) continue;
      const Dyadic volume = volumeOf(fixture.front, fixture.elements.nodes[e]);
      EXPECT_EQ(volume.sign(), 1) << "element " << e;
      filled = filled + volume;
    }
    EXPECT_TRUE(filled == enclosed) << filled.toDouble() << " of " << enclosed.toDouble();
  }
}

TEST(PocketFiller, GivesTheSameMeshForAnySlices) {
  const SurfaceMesh surface = testing::schoenhardtTower(4, 45.0);
  PocketFixture once(surface);
  once.fill(1'000'000);
  PocketFixture often(surface);
  often.fill(1);
  EXPECT_EQ(once.elements.nodes, often.elements.nodes);
  EXPECT_EQ(once.elements.removed, often.elements.removed);
  ASSERT_EQ(once.front.nodes().size(), often.front.nodes().size());
  for (std::size_t i = 0; i < once.front.nodes().size(); ++i) {
    EXPECT_EQ(once.front.node(NodeId(i)), often.front.node(NodeId(i))) << "node " << i;
  }
}

/// The limit counts work, so what is left open does not depend on the slices.
TEST(PocketFiller, LeavesItsPocketsOpenAtItsCostLimit) {
  for (const std::uint32_t budget : {1U, 1'000'000U}) {
    PocketFixture fixture(testing::needlePlate(1, 16, 0.05));
    const Faces given = fixture.activeFaces();
    PocketSet pockets(fixture.front, findPockets(fixture.front));
    PocketFiller filler(fixture.front, fixture.elements, fixture.index, pockets, 100);
    std::size_t slices = 0;
    while (!filler.isDone() && slices < 10'000) {
      filler.work(budget);
      ++slices;
    }
    EXPECT_TRUE(filler.isDone()) << "slices of " << budget;
    EXPECT_EQ(fixture.elements.liveCount(), 0U) << "slices of " << budget;
    EXPECT_EQ(fixture.activeFaces(), given) << "slices of " << budget;
  }
}

TEST(PocketFiller, ClosesAPocketAmongElements) {
  PocketFixture fixture(testing::gridCube(3));
  const Faces given = fixture.activeFaces();
  fixture.fill(1000);
  const std::size_t before = fixture.elements.liveCount();
  PocketSet pockets(fixture.front, {});
  fixture.removeElement(TetId(fixture.elements.size() / 2), pockets);
  PocketFiller filler(fixture.front, fixture.elements, fixture.index, pockets);
  while (!filler.isDone()) filler.work(100);
  EXPECT_EQ(fixture.front.activeCount(), 0U);
  EXPECT_EQ(fixture.elements.liveCount(), before);
  EXPECT_EQ(boundaryOf(fixture.elements), given);
  ASSERT_EQ(filler.made().size(), 1U);
  EXPECT_EQ(filler.made().front().elements.last, fixture.elements.size());
}

/// Enlarges and restores a pocket by `rings` rings around every tenth element.
void expectPocketsEnlargeAndRestore(const SurfaceMesh& surface, std::uint32_t rings) {
  PocketFixture fixture(surface);
  fixture.fill(1000);
  for (std::size_t e = 0; e < fixture.elements.size(); e += 10) {
    if (fixture.elements.removed[e] != 0) continue;
    PocketSet pockets(fixture.front, {});
    const PocketId pocket = fixture.removeElement(TetId(e), pockets);
    const PocketId other =
        fixture.removeElement(TetId(e + 1 < fixture.elements.size() ? e + 1 : 0), pockets);
    const Faces facesBefore = fixture.activeFaces();
    const std::vector<std::uint8_t> removedBefore = fixture.elements.removed;
    const std::vector<NodeId> nodes = pockets.nodes(pocket);
    std::vector<TetId> around = fixture.index.around(nodes, rings, fixture.elements.size());
    const std::size_t removed = around.size();
    const EnlargedPocket enlarged(fixture.front, fixture.elements, pockets, pocket,
                                  std::move(around));
    EXPECT_EQ(enlarged.removedElements(), removed);
    EXPECT_TRUE(pockets.faces(pocket).empty());

    // The active faces must enclose exactly the removed elements.
    const Faces facesNow = fixture.activeFaces();
    EXPECT_TRUE(isClosed(facesNow)) << "around element " << e;
    Dyadic open;
    for (std::size_t i = 0; i < fixture.elements.size(); ++i) {
      if (fixture.elements.removed[i] == 0) continue;
      open = open + volumeOf(fixture.front, fixture.elements.nodes[i]);
    }
    EXPECT_TRUE(enclosedBy(fixture.front, facesNow) == open) << "around element " << e;
    EXPECT_EQ(enlarged.facesNow(fixture.front, pockets), enlarged.faces());
    EXPECT_EQ(enlarged.faces().size() + pockets.faces(other).size(), facesNow.size());

    enlarged.restore(fixture.front, fixture.elements, pockets);
    EXPECT_EQ(fixture.activeFaces(), facesBefore) << "around element " << e;
    EXPECT_EQ(fixture.elements.removed, removedBefore);
    EXPECT_EQ(pockets.nodes(pocket), nodes);
    EXPECT_EQ(pockets.faces(pocket).size() + pockets.faces(other).size(), facesBefore.size());

    // Close the pockets for the next element.
    for (const FaceId face : fixture.front.activeFaces()) fixture.front.removeFace(face);
    for (std::size_t i = e; i < fixture.elements.size(); ++i) {
      if (fixture.elements.removed[i] != 0) fixture.elements.restore(TetId(i));
    }
    if (fixture.elements.removed[0] != 0) fixture.elements.restore(TetId(0U));
  }
}

TEST(EnlargedPocket, EnclosesTheRemovedElementsAndRestoresThem) {
  for (const std::uint32_t rings : {1U, 2U, 100U}) {
    SCOPED_TRACE(rings);
    expectPocketsEnlargeAndRestore(testing::gridCube(3), rings);
    expectPocketsEnlargeAndRestore(testing::schoenhardtTower(4, 45.0), rings);
  }
}

}  // namespace
}  // namespace tetrafront
