#include "field/grid_locator_builder.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "base/budget.h"
#include "base/ids.h"
#include "base/sort.h"
#include "field/grid_access.h"
#include "field/grid_gradation.h"
#include "field/tensor_limits.h"
#include "geom/tetrahedron.h"

namespace tetrafront {
namespace {

/// A position this far outside the grid, relative to the grid's extent, lies on its border: input
/// files store rounded decimals, and the evaluation of lines and patches rounds a few times.
constexpr double kBorderRounding = 1e-10;

/// Steps after which a walk is abandoned: a straight path crosses about n^(1/3) tetrahedra.
constexpr std::uint32_t kFreeSteps = 64;
constexpr std::uint32_t kStepsPerLayer = 4;

/// Tetrahedra per unit of budget: visiting one costs far less than a step of the front.
constexpr std::size_t kTetrahedraPerBudget = 8;

/// Returns the smallest integer whose cube is at least n.
std::uint32_t cubeRootUp(std::size_t n) {
  std::uint32_t root = 1;
  while (std::size_t{root} * root * root < n) ++root;
  return root;
}

}  // namespace

class GridLocatorBuilder::Impl {
 public:
  Impl(BackgroundGrid grid, double growth) : growth_(growth) {
    made_.grid_ = std::move(grid);
    made_.maxSteps_ = kFreeSteps + kStepsPerLayer * cubeRootUp(tetrahedra().size());
    begin(Stage::kExtent, nodes().size());
  }

  bool advance(std::uint32_t budget) {
    if (stage_ == Stage::kDone) return true;
    const std::size_t share = scaledBudget(budget, kTetrahedraPerBudget);
    if (stage_ == Stage::kLimits) {
      if (!limitSome(share)) return false;
    } else if (stage_ == Stage::kTree) {
      if (!tree_->advance(share)) return false;
    } else {
      const std::size_t last = next_ + std::min(share, end_ - next_);
      for (; next_ < last; ++next_) workOn(next_);
      if (next_ < end_) return false;
    }
    endStage();
    return stage_ == Stage::kDone;
  }

  GridLocator take() { return std::move(made_); }

 private:
  enum class Stage : std::uint8_t {
    kExtent,
    kTensors,
    kLimits,
    kSizes,
    kFrames,
    kFaces,
    kNeighbours,
    kBoxes,
    kTree,
    kDone
  };
  /// A face of a tetrahedron, listed at its lowest node.
  struct Face {
    GridNodeId middle;
    GridNodeId highest;
    GridTetFace owner;
  };

  [[nodiscard]] std::vector<BackgroundNode>& nodes() { return made_.grid_.nodes; }
  [[nodiscard]] std::vector<std::array<std::uint32_t, 4>>& tetrahedra() {
    return made_.grid_.tetrahedra;
  }
  void begin(Stage stage, std::size_t end) {
    stage_ = stage;
    next_ = 0;
    end_ = end;
  }

  void workOn(std::size_t i) {
    switch (stage_) {
      case Stage::kExtent:
        lower_ = glm::min(lower_, nodes()[i].position);
        upper_ = glm::max(upper_, nodes()[i].position);
        isStretched_ = isStretched_ || nodes()[i].stretching != 1.0;
        break;
      case Stage::kTensors:
        made_.tensors_.push_back(sizeTensor(nodes()[i]));
        break;
      case Stage::kSizes:
        setSize(GridNodeId(i));
        break;
      case Stage::kFrames:
        setFrame(GridTetId(i));
        break;
      case Stage::kFaces:
        insertFaces(GridTetId(i));
        break;
      case Stage::kNeighbours:
        linkFacesAt(GridNodeId(i));
        break;
      case Stage::kBoxes:
        setBox(GridTetId(i));
        break;
      case Stage::kLimits:
      case Stage::kTree:
      case Stage::kDone:
        break;
    }
  }

  void endStage() {
    switch (stage_) {
      case Stage::kExtent: {
        const Vec3 extent = upper_ - lower_;
        made_.slack_ = kBorderRounding * std::max({extent.x, extent.y, extent.z});
        if (isStretched_) made_.tensors_.reserve(nodes().size());
        return begin(Stage::kTensors, isStretched_ ? nodes().size() : 0);
      }
      case Stage::kTensors:
        if (growth_ > 0.0) {
          if (isStretched_) {
            tensorLimiter_.emplace(made_.grid_, growth_, made_.tensors_);
          } else {
            sizeLimiter_.emplace(made_.grid_, growth_);
          }
        }
        return begin(Stage::kLimits, 0);
      case Stage::kLimits:
        sizeLimiter_.reset();
        tensorLimiter_.reset();
        made_.sizes_.reserve(nodes().size());
        return begin(Stage::kSizes, nodes().size());
      case Stage::kSizes:
        made_.frames_.reserve(tetrahedra().size());
        faces_ = NodeLists<Face, GridNodeId>(nodes().size());
        return begin(Stage::kFrames, tetrahedra().size());
      case Stage::kFrames:
        faces_.endCounting();
        return begin(Stage::kFaces, tetrahedra().size());
      case Stage::kFaces:
        return begin(Stage::kNeighbours, nodes().size());
      case Stage::kNeighbours:
        faces_ = {};
        boxes_.reserve(tetrahedra().size());
        return begin(Stage::kBoxes, tetrahedra().size());
      case Stage::kBoxes:
        tree_.emplace(std::move(boxes_));
        return begin(Stage::kTree, 0);
      case Stage::kTree:
        made_.tree_ = tree_->take();
        tree_.reset();
        return begin(Stage::kDone, 0);
      case Stage::kDone:
        break;
    }
  }

  bool limitSome(std::size_t budget) {
    if (sizeLimiter_) return sizeLimiter_->advance(budget);
    return !tensorLimiter_ || tensorLimiter_->advance(budget);
  }

  void setSize(GridNodeId node) {
    double& size = nodeOf(made_.grid_, node).size;
    if (isStretched_ && growth_ > 0.0) {
      const std::array<double, 3> sizes = principalAxes(made_.tensors_[node.index()]).values;
      size = std::min(size, std::min({sizes[0], sizes[1], sizes[2]}));
    }
    made_.sizes_.push_back(size);
  }

  /// Builds the frame of the tetrahedron and counts its faces.
  void setFrame(GridTetId tet) {
    const auto [origin, b, c, d] = cornersOf(made_.grid_, tet);
    const Vec3 u = b - origin;
    const Vec3 v = c - origin;
    const Vec3 w = d - origin;
    const double volume = glm::dot(u, glm::cross(v, w));  // either sign: it cancels
    made_.frames_.push_back(
        {origin,
         {glm::cross(v, w) / volume, glm::cross(w, u) / volume, glm::cross(u, v) / volume},
         {}});
    for (std::size_t i = 0; i < 4; ++i) faces_.count(sortedFace({tet, i})[0]);
  }

  [[nodiscard]] std::array<GridNodeId, 3> sortedFace(GridTetFace face) {
    const GridNodeQuad nodes = nodesOf(made_.grid_, face.tet());
    const auto& [a, b, c] = kFaceCorners[face.corner()];
    return sorted(std::array{nodes[a], nodes[b], nodes[c]});
  }

  void insertFaces(GridTetId tet) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [lowest, middle, highest] = sortedFace({tet, i});
      faces_.add(lowest, {middle, highest, {tet, i}});
    }
  }

  [[nodiscard]] GridTetId& neighbourAcross(GridTetFace face) {
    return made_.frames_[face.tet().index()].neighbours[face.corner()];
  }

  void linkFacesAt(GridNodeId node) {
    const std::span<Face> faces = faces_.at(node);
    sortFew(faces, [](const Face& a, const Face& b) {
      return std::tie(a.middle, a.highest, a.owner) < std::tie(b.middle, b.highest, b.owner);
    });
    for (std::size_t i = 1; i < faces.size(); ++i) {
      const Face& a = faces[i - 1];
      const Face& b = faces[i];
      if (a.middle != b.middle || a.highest != b.highest) continue;
      neighbourAcross(a.owner) = b.owner.tet();
      neighbourAcross(b.owner) = a.owner.tet();
      ++i;
    }
  }

  void setBox(GridTetId tet) {
    const auto [a, b, c, d] = cornersOf(made_.grid_, tet);
    boxes_.emplace_back(Box::of(a, b, c)).include(d);
  }

  double growth_;
  GridLocator made_;
  Stage stage_ = Stage::kExtent;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  bool isStretched_ = false;
  Vec3 lower_{std::numeric_limits<double>::max()};
  Vec3 upper_{-std::numeric_limits<double>::max()};
  std::optional<SizeLimiter> sizeLimiter_;
  std::optional<TensorLimiter> tensorLimiter_;
  NodeLists<Face, GridNodeId> faces_;
  std::vector<Box> boxes_;
  std::optional<BoxTreeBuilder> tree_;
};

GridLocatorBuilder::GridLocatorBuilder(BackgroundGrid grid, double growth)
    : impl_(std::make_unique<Impl>(std::move(grid), growth)) {}
GridLocatorBuilder::GridLocatorBuilder(GridLocatorBuilder&&) noexcept = default;
GridLocatorBuilder& GridLocatorBuilder::operator=(GridLocatorBuilder&&) noexcept = default;
GridLocatorBuilder::~GridLocatorBuilder() = default;

bool GridLocatorBuilder::advance(std::uint32_t budget) { return impl_->advance(budget); }
GridLocator GridLocatorBuilder::take() { return impl_->take(); }

}  // namespace tetrafront
