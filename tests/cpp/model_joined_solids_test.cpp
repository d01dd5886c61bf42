// Solids that share faces, edges and vertices.

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "model/joined_solids.h"
#include "model/model_numbers.h"
#include "support/trimmed_models.h"

namespace tetrafront::testing {
namespace {

/// Solids in one model, as readModel() puts them together.
TrimmedModel together(const std::vector<TrimmedSolid>& solids) {
  std::vector<double> numbers;
  for (const TrimmedSolid& solid : solids) {
    const std::vector<double> own = numbersOf(solid.model);
    numbers.insert(numbers.end(), own.begin(), own.end());
  }
  const std::optional<ReadModel> read = readModel(numbers);
  EXPECT_TRUE(read && read->isSound);
  return read->model;
}

struct Used {
  std::set<std::uint32_t> edges;
  std::set<std::uint32_t> vertices;
};

Used usedIn(const TrimmedModel& model) {
  Used used;
  for (const TrimmedFace& face : model.faces) {
    for (const std::vector<Coedge>& loop : face.loops) {
      for (const Coedge& coedge : loop) {
        used.edges.insert(coedge.edge);
        used.vertices.insert({model.edges[coedge.edge].start, model.edges[coedge.edge].end});
      }
    }
  }
  return used;
}

TEST(JoinedSolids, HaveTheSharedFaceOnce) {
  const std::vector<TrimmedSolid> solids{trimmedPlate(4.0, 0.5, 1.0), trimmedCylinder(1.0, 0.5)};
  const TrimmedModel apart = together(solids);
  const JoinedSolids joined = joinSolids(apart);
  ASSERT_EQ(apart.faces.size(), 10U);
  ASSERT_EQ(joined.model.faces.size(), 9U);
  std::vector<TrimmedFace> shared;
  for (const TrimmedFace& face : joined.model.faces) {
    if (face.otherSolid != TrimmedFace::kNone) shared.push_back(face);
  }
  ASSERT_EQ(shared.size(), 1U);
  EXPECT_EQ(joined.model.surfaces[shared[0].surface].kind, SurfaceKind::kCylinder);
  EXPECT_EQ(shared[0].solid, 0U);
  EXPECT_EQ(shared[0].otherSolid, 1U);
  // Both circles and the seam, with their two vertices.
  EXPECT_EQ(usedIn(joined.model).edges.size() + 3, usedIn(apart).edges.size());
  EXPECT_EQ(usedIn(joined.model).vertices.size() + 2, usedIn(apart).vertices.size());
  ASSERT_EQ(joined.givenFaces.size(), 9U);
  for (std::size_t f = 0; f < joined.givenFaces.size(); ++f)
    EXPECT_EQ(joined.model.faces[f].surface, apart.faces[joined.givenFaces[f]].surface);
}

TEST(JoinedSolids, ThatOverlapKeepTheirFaces) {
  const TrimmedSolid box = trimmedBox(Vec3(0.0), Vec3(1.0));
  const JoinedSolids joined = joinSolids(together({box, box}));
  EXPECT_EQ(joined.model.faces.size(), 12U);
  for (const TrimmedFace& face : joined.model.faces) EXPECT_EQ(face.otherSolid, TrimmedFace::kNone);
}

TEST(JoinedSolids, ThatTouchAtAnEdgeShareIt) {
  const JoinedSolids joined = joinSolids(
      together({trimmedBox(Vec3(0.0), Vec3(1.0)), trimmedBox({1.0, 1.0, 0.0}, {2.0, 2.0, 1.0})}));
  EXPECT_EQ(joined.model.faces.size(), 12U);
  EXPECT_EQ(usedIn(joined.model).edges.size(), 23U);
  EXPECT_EQ(usedIn(joined.model).vertices.size(), 14U);
}

TEST(JoinedSolids, KeepVerticesOfOneSolidApart) {
  TrimmedModel model = trimmedBox(Vec3(0.0), Vec3(1.0)).model;
  model.vertices[1] = model.vertices[0];
  EXPECT_EQ(usedIn(joinSolids(model).model).vertices.size(), 8U);
}

}  // namespace
}  // namespace tetrafront::testing
