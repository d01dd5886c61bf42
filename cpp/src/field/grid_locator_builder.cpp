#include "field/grid_locator_builder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "base/free_memory.h"
#include "base/ids.h"
#include "field/grid_access.h"
#include "field/grid_gradation.h"
#include "field/tensor_limits.h"
#include "metric/metric.h"
#include "topology/face_table.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

/// A position this far outside the grid, relative to the grid's extent, lies on its border: input
/// files store rounded decimals, and the evaluation of lines and patches rounds a few times.
constexpr double kBorderRounding = 1e-10;

/// Steps after which a walk is abandoned: a straight path crosses about n^(1/3) tetrahedra.
constexpr std::uint32_t kFreeSteps = 64;
constexpr std::uint32_t kStepsPerLayer = 4;

/// Returns the smallest integer whose cube is at least n.
std::uint32_t cubeRootUp(std::size_t n) {
  std::uint32_t root = 1;
  while (std::size_t{root} * root * root < n) ++root;
  return root;
}

}  // namespace

/// The steps of buildGridLocator().
class GridLocatorBuilder {
 public:
  GridLocatorBuilder(BackgroundGrid grid, double growth) : growth_(growth) {
    made_.grid_ = std::move(grid);
    made_.maxSteps_ = kFreeSteps + kStepsPerLayer * cubeRootUp(tetrahedronCount());
  }

  [[nodiscard]] std::size_t nodeCount() const { return made_.grid_.nodes.size(); }
  [[nodiscard]] std::size_t tetrahedronCount() const { return made_.grid_.tetrahedra.size(); }

  void extend(GridNodeId id) {
    const BackgroundNode& node = nodeOf(made_.grid_, id);
    low_ = glm::min(low_, node.position);
    high_ = glm::max(high_, node.position);
    isStretched_ = isStretched_ || node.stretching != 1.0;
    hasSecond_ = hasSecond_ || secondOf(made_.grid_, id).stretching != 1.0;
  }

  void endExtent() {
    const Vec3 extent = high_ - low_;
    made_.slack_ = kBorderRounding * std::max({extent.x, extent.y, extent.z});
    isStretched_ = isStretched_ || hasSecond_;
    if (!hasSecond_) freeMemory(made_.grid_.secondStretchings);
    if (isStretched_) made_.tensors_.reserve(nodeCount());
    made_.sizes_.reserve(nodeCount());
    made_.frames_.reserve(tetrahedronCount());
  }

  [[nodiscard]] bool isStretched() const { return isStretched_; }

  void addTensor(GridNodeId node) {
    const BackgroundNode& own = nodeOf(made_.grid_, node);
    made_.tensors_.push_back(hasSecond_ ? sizeTensor(own, secondOf(made_.grid_, node))
                                        : sizeTensor(own));
  }

  Task<> limitGrowth(Work& work) {
    return isStretched_ ? limitTensors(work, made_.grid_, growth_, made_.tensors_)
                        : limitSizes(work, made_.grid_, growth_);
  }

  /// The last step that needs the tensor of the node: with second stretchings, its logarithm replaces it.
  void addSize(GridNodeId node) {
    double& size = nodeOf(made_.grid_, node).size;
    if (isStretched_ && growth_ > 0.0) {
      const std::array<double, 3> sizes = principalAxes(made_.tensors_[node.index()]).values;
      size = std::min(size, std::min({sizes[0], sizes[1], sizes[2]}));
    }
    made_.sizes_.push_back(size);
    if (!hasSecond_) return;
    SymmetricTensor& tensor = made_.tensors_[node.index()];
    tensor = logarithmOf(tensor);
  }

  void addFrame(GridTetId tet) {
    const auto [origin, b, c, d] = cornersOf(made_.grid_, tet);
    const Vec3 u = b - origin;
    const Vec3 v = c - origin;
    const Vec3 w = d - origin;
    const double volume = glm::dot(u, glm::cross(v, w));  // either sign: it cancels
    made_.frames_.push_back(
        {origin,
         {glm::cross(v, w) / volume, glm::cross(w, u) / volume, glm::cross(u, v) / volume},
         {}});
  }

  /// Calls use(nodes, face) for the faces of the tetrahedron.
  template <class Use>
  void forEachFace(GridTetId tet, const Use& use) const {
    const GridNodeQuad nodes = nodesOf(made_.grid_, tet);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& [a, b, c] = kFaceCorners[i];
      use({nodes[a], nodes[b], nodes[c]}, GridTetFace(tet, i));
    }
  }

  /// The tetrahedra have a common face.
  void join(GridTetFace one, GridTetFace other) {
    neighbourAcross(one) = other.tet();
    neighbourAcross(other) = one.tet();
  }

  [[nodiscard]] Box boxOf(GridTetId tet) const {
    const auto [a, b, c, d] = cornersOf(made_.grid_, tet);
    Box box = Box::of(a, b, c);
    box.include(d);
    return box;
  }

  [[nodiscard]] GridLocator take(BoxTree tree) {
    made_.tree_ = std::move(tree);
    made_.isLogarithmic_ = hasSecond_;
    freeMemory(made_.grid_.secondStretchings);
    return std::move(made_);
  }

 private:
  [[nodiscard]] GridTetId& neighbourAcross(GridTetFace face) {
    return made_.frames_[face.tet().index()].neighbours[face.corner()];
  }

  double growth_;
  GridLocator made_;
  bool isStretched_ = false;
  bool hasSecond_ = false;
  Vec3 low_{std::numeric_limits<double>::max()};
  Vec3 high_{-std::numeric_limits<double>::max()};
};

Task<GridLocator> buildGridLocator(Work& work, const BackgroundGrid& grid, double growth) {
  GridLocatorBuilder builder(grid, growth);
  const std::size_t nodes = builder.nodeCount();
  const std::size_t tetrahedra = builder.tetrahedronCount();
  work.beginPart(0.05);
  co_await work.forEachId<GridNodeId>(
      nodes, [&](GridNodeId node) { builder.extend(node); }, kGridVisitsPerUnit);
  builder.endExtent();
  if (builder.isStretched()) {
    work.beginPart(0.1);
    co_await work.forEachId<GridNodeId>(
        nodes, [&](GridNodeId node) { builder.addTensor(node); }, kGridVisitsPerUnit);
  }
  work.beginPart(0.35);
  if (growth > 0.0) co_await builder.limitGrowth(work);
  work.beginPart(0.4);
  co_await work.forEachId<GridNodeId>(
      nodes, [&](GridNodeId node) { builder.addSize(node); }, kGridVisitsPerUnit);

  work.beginPart(0.5);
  co_await work.forEachId<GridTetId>(
      tetrahedra, [&](GridTetId tet) { builder.addFrame(tet); }, kGridVisitsPerUnit);
  work.beginPart(0.65);
  auto faces = co_await listFaces<GridTetFace, GridNodeId>(
      work, nodes, tetrahedra,
      [&builder](std::size_t tet, const auto& use) { builder.forEachFace(GridTetId(tet), use); },
      kGridVisitsPerUnit);
  work.beginPart(0.75);
  co_await work.forEachId<GridNodeId>(
      nodes,
      [&](GridNodeId node) {
        faces.forEachGroup(node, [&](const auto& group) {
          if (group.size() > 1) builder.join(group[0].owner, group[1].owner);
        });
      },
      kGridVisitsPerUnit);
  faces = FaceTable<GridTetFace, GridNodeId>(0);

  work.beginPart(0.8);
  std::vector<Box> boxes;
  boxes.reserve(tetrahedra);
  co_await work.forEachId<GridTetId>(
      tetrahedra, [&](GridTetId tet) { boxes.push_back(builder.boxOf(tet)); }, kGridVisitsPerUnit);
  work.beginPart(1.0);
  BoxTree tree = co_await BoxTree::build(work, std::move(boxes), kGridVisitsPerUnit);
  co_return builder.take(std::move(tree));
}

}  // namespace tetrafront
