/// Layers along walls are as thin as asked for, meet in corners and gaps, and leave the body as it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "support/mesh_validator.h"
#include "support/slices.h"
#include "tetrafront/wall_layers.h"

namespace tetrafront::testing {
namespace {

using Position = std::array<double, 3>;
using CellIndex = std::array<int, 3>;

/// How a body is made of cells, each divided into six tetrahedra.
struct CellBody {
  CellIndex cells{};
  std::function<bool(const CellIndex&)> has = [](const CellIndex& /*cell*/) { return true; };
  /// From cell units to the body; positions that coincide are one node.
  std::function<Position(const Position&)> map;
  /// Patch of a boundary triangle by its centroid in cell units.
  std::function<std::uint32_t(const Position&)> patch;
};

/// The side of the block of cells that a centroid lies on: 0 and 1 across x, 2 and 3 across y, 4 and 5 across z; else 6.
std::uint32_t sideOfBlock(const CellIndex& cells, const Position& at) {
  for (std::uint32_t side = 0; side < 6; ++side) {
    const double plane = side % 2 == 0 ? 0.0 : cells[side / 2];
    if (std::fabs(at[side / 2] - plane) < 1e-9) return side;
  }
  return 6;
}

class CellMesher {
 public:
  explicit CellMesher(const CellBody& body) : body_(body) {
    CellIndex cell{};
    for (cell[0] = 0; cell[0] < body.cells[0]; ++cell[0]) {
      for (cell[1] = 0; cell[1] < body.cells[1]; ++cell[1]) {
        for (cell[2] = 0; cell[2] < body.cells[2]; ++cell[2])
          if (body.has(cell)) divide(cell);
      }
    }
    for (const auto& [nodes, face] : faces_) {
      if (face.count != 1) continue;
      input_.triangles.insert(input_.triangles.end(), face.nodes.begin(), face.nodes.end());
      input_.trianglePatch.push_back(body.patch(face.centroid));
    }
  }
  [[nodiscard]] const AdaptInput& input() const { return input_; }

 private:
  struct Face {
    int count = 0;
    std::array<std::uint32_t, 3> nodes{};
    Position centroid{};
  };

  std::uint32_t nodeAt(const CellIndex& corner) {
    const Position at = body_.map({double(corner[0]), double(corner[1]), double(corner[2])});
    const auto [found, isNew] = nodes_.try_emplace(at, static_cast<std::uint32_t>(nodes_.size()));
    if (isNew) input_.points.insert(input_.points.end(), at.begin(), at.end());
    return found->second;
  }

  void divide(const CellIndex& cell) {
    std::array<std::size_t, 3> order{0, 1, 2};
    do {
      CellIndex corner = cell;
      std::array<std::uint32_t, 4> nodes{nodeAt(corner)};
      std::array<CellIndex, 4> corners{corner};
      for (std::size_t k = 0; k < 3; ++k) {
        ++corner[order[k]];
        corners[k + 1] = corner;
        nodes[k + 1] = nodeAt(corner);
      }
      input_.tetrahedra.insert(input_.tetrahedra.end(), nodes.begin(), nodes.end());
      for (std::size_t k = 0; k < 4; ++k) addFace(nodes, corners, k);
    } while (std::next_permutation(order.begin(), order.end()));
  }

  void addFace(const std::array<std::uint32_t, 4>& nodes, const std::array<CellIndex, 4>& corners,
               std::size_t opposite) {
    Face face{1, {}, {}};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (k == opposite) continue;
      face.nodes[count++] = nodes[k];
      for (std::size_t i = 0; i < 3; ++i) face.centroid[i] += corners[k][i] / 3.0;
    }
    std::array<std::uint32_t, 3> key = face.nodes;
    std::sort(key.begin(), key.end());
    const auto [found, isNew] = faces_.try_emplace(key, face);
    if (!isNew) ++found->second.count;
  }

  CellBody body_;
  AdaptInput input_;
  std::map<Position, std::uint32_t> nodes_;
  std::map<std::array<std::uint32_t, 3>, Face> faces_;
};

/// A box with its sides as patches 0 to 5; patch 4 is the floor, 5 the roof.
AdaptInput box(const CellIndex& cells, const Position& size) {
  return CellMesher({.cells = cells,
                     .map =
                         [&](const Position& at) {
                           Position scaled{};
                           for (std::size_t k = 0; k < 3; ++k)
                             scaled[k] = size[k] * at[k] / cells[k];
                           return scaled;
                         },
                     .patch = [&](const Position& at) { return sideOfBlock(cells, at); }})
      .input();
}

/// A channel of length 2 and width 0.5 over a step: the floor is at z = 0.5 up to x = 1, then at 0; the roof at 1. The floor with
/// the step is patch 6.
AdaptInput step() {
  const CellIndex cells{8, 2, 4};
  return CellMesher({.cells = cells,
                     .has = [](const CellIndex& at) { return at[0] >= 4 || at[2] >= 2; },
                     .map = [](const Position& at) -> Position {
                       return {0.25 * at[0], 0.25 * at[1], 0.25 * at[2]};
                     },
                     .patch =
                         [&](const Position& at) {
                           const std::uint32_t side = sideOfBlock(cells, at);
                           return side == 4 ? 6 : side;
                         }})
      .input();
}

constexpr int kAroundHole = 32;
constexpr double kHoleRadius = 0.3;

/// The square [-1, 1] x [-1, 1] x [0, 0.1] with a round hole, patch 6.
AdaptInput plateWithHole() {
  const CellIndex cells{kAroundHole, 4, 1};
  const auto map = [&](const Position& at) -> Position {
    const double angle = 2.0 * M_PI * std::fmod(at[0], kAroundHole) / kAroundHole;
    const double part = at[1] / cells[1];
    const double edge = 1.0 / std::max(std::fabs(std::cos(angle)), std::fabs(std::sin(angle)));
    const double radius = kHoleRadius * (1.0 - part) + part * edge;
    return {radius * std::cos(angle), radius * std::sin(angle), 0.1 * at[2]};
  };
  const auto patch = [&](const Position& at) -> std::uint32_t {
    const std::uint32_t side = sideOfBlock(cells, at);
    return side == 2 ? 6 : side;
  };
  return CellMesher({.cells = cells, .map = map, .patch = patch}).input();
}

LayeredMesh layered(const AdaptInput& input, const std::vector<PatchLayers>& walls,
                    const LayerOptions& options = {}, std::uint32_t budget = 1U << 16) {
  LayerMaker maker(input, {}, {}, walls, options);
  slicesOf(maker, budget);
  return maker.result();
}

Position pointAt(const std::vector<double>& points, std::uint32_t node) {
  return {points[3 * node], points[3 * node + 1], points[3 * node + 2]};
}

Position minus(const Position& a, const Position& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Position crossOf(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dotOf(const Position& a, const Position& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// An element with arithmetic of its own.
struct MeasuredElement {
  std::array<Position, 4> corners;
  std::array<std::uint32_t, 4> nodes;

  [[nodiscard]] double volume() const {
    return dotOf(minus(corners[1], corners[0]),
                 crossOf(minus(corners[2], corners[0]), minus(corners[3], corners[0]))) /
           6.0;
  }
  [[nodiscard]] double extent(std::size_t axis) const {
    const auto [low, high] =
        std::minmax({corners[0][axis], corners[1][axis], corners[2][axis], corners[3][axis]});
    return high - low;
  }
  [[nodiscard]] double centre(std::size_t axis) const {
    return 0.25 * (corners[0][axis] + corners[1][axis] + corners[2][axis] + corners[3][axis]);
  }
};

std::vector<MeasuredElement> elementsOf(const MeshAdaptation& made) {
  std::vector<MeasuredElement> elements(made.tetrahedra.size() / 4);
  for (std::size_t t = 0; t < elements.size(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) {
      elements[t].nodes[k] = made.tetrahedra[4 * t + k];
      elements[t].corners[k] = pointAt(made.points, elements[t].nodes[k]);
    }
  }
  return elements;
}

double volumeOfAll(const MeshAdaptation& made) {
  double sum = 0.0;
  for (const MeasuredElement& element : elementsOf(made)) sum += element.volume();
  return sum;
}

/// Mean of volume / area for the elements above the triangles of a patch, times 3: their height.
double meanHeightAbove(const MeshAdaptation& made, std::uint32_t patch) {
  std::set<std::array<std::uint32_t, 3>> faces;
  for (std::size_t t = 0; t < made.trianglePatch.size(); ++t) {
    if (made.trianglePatch[t] != patch) continue;
    std::array<std::uint32_t, 3> nodes{made.triangles[3 * t], made.triangles[3 * t + 1],
                                       made.triangles[3 * t + 2]};
    std::sort(nodes.begin(), nodes.end());
    faces.insert(nodes);
  }
  double sum = 0.0;
  double count = 0.0;
  for (const MeasuredElement& element : elementsOf(made)) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t a = (k + 1) % 4;
      const std::size_t b = (k + 2) % 4;
      const std::size_t c = (k + 3) % 4;
      std::array<std::uint32_t, 3> nodes{element.nodes[a], element.nodes[b], element.nodes[c]};
      std::sort(nodes.begin(), nodes.end());
      if (faces.count(nodes) == 0) continue;
      const Position normal = crossOf(minus(element.corners[b], element.corners[a]),
                                      minus(element.corners[c], element.corners[a]));
      sum += 6.0 * element.volume() / std::sqrt(dotOf(normal, normal));
      count += 1.0;
    }
  }
  return sum / count;
}

/// Mean extent along an axis of the elements with centroids in a range, weighted by their volumes.
double meanExtent(const MeshAdaptation& made, std::size_t axis, double from, double to) {
  double sum = 0.0;
  double volume = 0.0;
  for (const MeasuredElement& element : elementsOf(made)) {
    if (element.centre(axis) < from || element.centre(axis) > to) continue;
    sum += element.volume() * element.extent(axis);
    volume += element.volume();
  }
  return sum / volume;
}

void expectValidLayers(const LayeredMesh& made) {
  const MeshAdaptation& mesh = made.adaptation;
  ASSERT_TRUE(mesh.isReadable);
  ASSERT_TRUE(mesh.diagnostics.empty());
  VolumeMesh volume;
  volume.points = mesh.points;
  volume.tetrahedra = mesh.tetrahedra;
  volume.regions = mesh.regions;
  SurfaceMesh surface;
  surface.triangles = mesh.triangles;
  const std::uint32_t nodes = *std::max_element(mesh.triangles.begin(), mesh.triangles.end()) + 1;
  surface.points.assign(mesh.points.begin(), mesh.points.begin() + 3 * std::ptrdiff_t{nodes});
  EXPECT_EQ(complaintAbout(volume, surface), "");
}

void expectFirstHeight(const LayeredMesh& made, const PatchLayers& wall) {
  const double height = meanHeightAbove(made.adaptation, wall.patch);
  EXPECT_GT(height, 0.75 * wall.firstHeight);
  EXPECT_LT(height, 1.25 * wall.firstHeight);
  const auto own = std::ranges::find(made.walls, wall.patch, &PatchLayersMade::patch);
  ASSERT_NE(own, made.walls.end());
  EXPECT_NEAR(own->meanFirstHeight, height, 1e-9 * height);
}

TEST(WallLayers, HaveAnAspectOfAThousand) {
  const AdaptInput body = box({5, 5, 5}, {1.0, 1.0, 1.0});
  const PatchLayers floor{.patch = 4, .firstHeight = 2e-4, .growth = 1.3, .count = 12};
  const LayeredMesh made = layered(body, {floor});
  expectValidLayers(made);
  EXPECT_NEAR(volumeOfAll(made.adaptation), 1.0, 1e-12);
  EXPECT_GT(made.adaptation.after.unitEdges, 0.985);
  EXPECT_GT(made.adaptation.after.leastQuality, 0.4);
  EXPECT_GT(made.largestAspect, 800.0);
  expectFirstHeight(made, floor);
  const double thickness = 2e-4 * (std::pow(1.3, 12) - 1.0) / 0.3;
  ASSERT_EQ(made.walls.size(), 1U);
  EXPECT_NEAR(made.walls[0].thickness, thickness, 1e-12);
  // Elements near the last layer are as much higher than those near the first as the layers are.
  const double low = meanExtent(made.adaptation, 2, 0.0, 0.05 * thickness);
  const double high = meanExtent(made.adaptation, 2, 0.7 * thickness, thickness);
  const double expected = (2e-4 + 0.3 * 0.85 * thickness) / (2e-4 + 0.3 * 0.025 * thickness);
  EXPECT_GT(high / low, 0.65 * expected);
  EXPECT_LT(high / low, 1.5 * expected);
  // The triangles of a side are thin at the floor, too.
  double lowest = 1.0;
  for (std::size_t c = 0; c < made.adaptation.triangles.size(); ++c) {
    const Position at = pointAt(made.adaptation.points, made.adaptation.triangles[c]);
    if (made.adaptation.trianglePatch[c / 3] == 0 && at[2] > 0.0) lowest = std::min(lowest, at[2]);
  }
  EXPECT_LT(lowest, 1.5 * floor.firstHeight);
}

TEST(WallLayers, MeetAtConcaveAndConvexEdges) {
  const PatchLayers wall{.patch = 6, .firstHeight = 0.01, .growth = 1.3, .count = 5};
  const LayeredMesh made = layered(step(), {wall});
  expectValidLayers(made);
  EXPECT_NEAR(volumeOfAll(made.adaptation), 0.75, 1e-12);
  EXPECT_GT(made.adaptation.after.unitEdges, 0.985);
  EXPECT_GT(made.adaptation.after.leastQuality, 0.4);
  expectFirstHeight(made, wall);
  // At both edges, elements are thin in both directions across the edge, and not along it.
  for (const double edge : {0.0, 0.5}) {
    double width = 0.0;
    double count = 0.0;
    double longest = 0.0;
    for (const MeasuredElement& element : elementsOf(made.adaptation)) {
      if (std::hypot(element.centre(0) - 1.0, element.centre(2) - edge) > 0.02) continue;
      width += element.extent(0) + element.extent(2);
      longest = std::max(longest, element.extent(1));
      count += 2.0;
    }
    ASSERT_GT(count, 0.0) << edge;
    EXPECT_LT(width / count, 3.0 * wall.firstHeight) << edge;
    EXPECT_GT(longest, 8.0 * wall.firstHeight) << edge;
  }
}

TEST(WallLayers, OfOppositeWallsMeetInANarrowGap) {
  constexpr double kGap = 0.06;
  const AdaptInput body = box({5, 5, 1}, {1.0, 1.0, kGap});
  const PatchLayers floor{.patch = 4, .firstHeight = 0.004, .growth = 1.2, .count = 12};
  const PatchLayers roof{.patch = 5, .firstHeight = 0.004, .growth = 1.2, .count = 12};
  LayerOptions options;
  options.maxAspect = 20.0;
  const LayeredMesh made = layered(body, {floor, roof}, options);
  expectValidLayers(made);
  EXPECT_NEAR(volumeOfAll(made.adaptation), kGap, 1e-12);
  EXPECT_GT(made.adaptation.after.unitEdges, 0.985);
  EXPECT_GT(made.adaptation.after.leastQuality, 0.4);
  EXPECT_GT(made.walls[0].thickness, 2.0 * kGap);
  expectFirstHeight(made, floor);
  expectFirstHeight(made, roof);
  for (std::size_t m = 0; m < made.adaptation.metrics.size(); m += 6) {
    const double* const at = &made.adaptation.metrics[m];
    const auto [least, most] = std::minmax({at[0], at[3], at[5]});
    EXPECT_LT(std::sqrt(most / least), 1.1 * options.maxAspect);
  }
  // In the middle, the size is that of both layers at half of the gap.
  const double middle = 0.004 + 0.2 * 0.5 * kGap;
  const double extent = meanExtent(made.adaptation, 2, 0.45 * kGap, 0.55 * kGap);
  EXPECT_GT(extent, 0.7 * middle);
  EXPECT_LT(extent, 1.6 * middle);
}

TEST(WallLayers, FollowARoundHole) {
  const PatchLayers wall{.patch = 6, .firstHeight = 0.005, .growth = 1.3, .count = 5};
  const AdaptInput body = plateWithHole();
  const LayeredMesh made = layered(body, {wall});
  expectValidLayers(made);
  const double hole =
      0.5 * kAroundHole * kHoleRadius * kHoleRadius * std::sin(2.0 * M_PI / kAroundHole);
  EXPECT_NEAR(volumeOfAll(made.adaptation), 0.1 * (4.0 - hole), 1e-4);
  EXPECT_GT(made.adaptation.after.unitEdges, 0.98);
  EXPECT_GT(made.adaptation.after.leastQuality, 0.35);
  expectFirstHeight(made, wall);
}

TEST(WallLayers, IgnoreABorderBetweenCoplanarPatches) {
  const PatchLayers floor{.patch = 4, .firstHeight = 0.005, .growth = 1.3, .count = 4};
  AdaptInput body = box({4, 4, 4}, {1.0, 1.0, 1.0});
  const LayeredMesh whole = layered(body, {floor});
  for (std::size_t t = 0; t < body.trianglePatch.size(); ++t) {
    double x = 0.0;
    for (std::size_t k = 0; k < 3; ++k) x += body.points[3 * body.triangles[3 * t + k]] / 3.0;
    if (body.trianglePatch[t] == 4 && x < 0.5) body.trianglePatch[t] = 7;
  }
  PatchLayers half = floor;
  half.patch = 7;
  const LayeredMesh halves = layered(body, {floor, half});
  expectValidLayers(halves);
  expectFirstHeight(halves, half);
  EXPECT_LT(halves.adaptation.after.tetrahedra, 1.3 * whole.adaptation.after.tetrahedra);
}

TEST(WallLayers, DoNotDependOnTheSlices) {
  const PatchLayers floor{.patch = 4, .firstHeight = 0.01, .growth = 1.3, .count = 4};
  const AdaptInput body = box({2, 2, 2}, {1.0, 1.0, 1.0});
  const LayeredMesh one = layered(body, {floor});
  const LayeredMesh other = layered(body, {floor}, {}, 7);
  EXPECT_EQ(one.adaptation.points, other.adaptation.points);
  EXPECT_EQ(one.adaptation.tetrahedra, other.adaptation.tetrahedra);
  EXPECT_EQ(one.cycles, other.cycles);
}

TEST(WallLayers, AreAValidMeshWhereverTheyAreStopped) {
  const PatchLayers floor{.patch = 4, .firstHeight = 0.01, .growth = 1.3, .count = 4};
  for (const int calls : {2, 40, 200}) {
    LayerMaker maker(box({2, 2, 2}, {1.0, 1.0, 1.0}), {}, {}, {floor}, {});
    for (int i = 0; i < calls; ++i) maker.advance(100);
    maker.stop();
    while (!maker.advance(100)) {
    }
    EXPECT_TRUE(maker.result().adaptation.isPartial) << calls;
    expectValidLayers(maker.result());
  }
}

TEST(WallLayers, RefuseWhatIsNoLayer) {
  const AdaptInput body = box({2, 2, 2}, {1.0, 1.0, 1.0});
  const PatchLayers sound{.patch = 4, .firstHeight = 0.01, .growth = 1.3, .count = 4};
  std::vector<PatchLayers> wrong(4, sound);
  wrong[0].firstHeight = 0.0;
  wrong[1].growth = 0.9;
  wrong[2].count = 0;
  wrong[3].firstHeight = std::nan("");
  for (const PatchLayers& wall : wrong) {
    const LayeredMesh made = layered(body, {wall});
    EXPECT_FALSE(made.adaptation.isReadable);
    EXPECT_TRUE(made.adaptation.tetrahedra.empty());
  }
  EXPECT_FALSE(layered(body, {}).adaptation.isReadable);
}

}  // namespace
}  // namespace tetrafront::testing
