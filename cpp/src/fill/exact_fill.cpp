#include "fill/exact_fill.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "fill/boundary_point_removal.h"
#include "fill/boundary_recovery.h"
#include "fill/fill_mesh.h"
#include "fill/interior_point_rounding.h"
#include "fill/outside_removal.h"
#include "fill/point_insertion.h"
#include "fill/sector_separation.h"

namespace tetrafront {
namespace {

/// Signs per unit of the budget.
constexpr std::uint64_t kWorkPerUnit = 20;
/// What touching this many tetrahedra in a row costs, in signs.
constexpr std::uint64_t kTouchedPerSign = 4;

using EdgeOrder = BoundaryRecovery::EdgeOrder;
/// Where each stage ends on the way, 0 to 1. Bodies that take long are those of needles, where most of the time
/// goes to the edges and to the points that had to be put on them.
constexpr double kInsertEnd = 0.1;
constexpr double kEdgesEnd = 0.4;
constexpr double kTrianglesEnd = 0.5;
constexpr double kClearBoundaryEnd = 0.75;

double between(double from, double to, double part) { return from + (to - from) * part; }

double share(std::size_t done, std::size_t all) {
  return all == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(all);
}

constexpr std::array<EdgeOrder, 3> kEdgeOrders{EdgeOrder::kLongestFirst, EdgeOrder::kAsNumbered,
                                               EdgeOrder::kShortestFirst};

}  // namespace

class ExactFill::Impl {
 public:
  Impl(FillTask task, unsigned order, std::uint64_t limit)
      : task_(std::move(task)), order_(order), limit_(limit) {}

  State advance(std::uint32_t budget) {
    const std::uint64_t all = kWorkPerUnit * std::max(budget, 1U);
    const std::uint64_t before = work();
    touched_ = 0;
    while (stage_ != Stage::kDone && stage_ != Stage::kFailed &&
           work() - before + touched_ / kTouchedPerSign < all) {
      step();
      // Looked at after each step, so that it does not depend on the slices.
      if (stage_ != Stage::kDone && work() / kWorkPerUnit > limit_) stage_ = Stage::kFailed;
    }
    if (stage_ == Stage::kFailed) return State::kFailed;
    if (stage_ != Stage::kDone) return State::kRunning;
    return result_.openFaces.empty() && result_.openTriangles.empty() ? State::kDone
                                                                      : State::kPartial;
  }

  [[nodiscard]] const FillResult& result() const { return result_; }

  [[nodiscard]] double fraction() const {
    switch (stage_) {
      case Stage::kBegin:
        return 0.0;
      case Stage::kInsert:
        return between(0.0, kInsertEnd, share(next_, insertion_->count()));
      case Stage::kEdges:
        return between(kInsertEnd, kEdgesEnd, recovery_->edgesFraction());
      case Stage::kTriangles:
        return between(kEdgesEnd, kTrianglesEnd, share(next_, recovery_->triangleCount()));
      case Stage::kDropOutside:
      case Stage::kSeparate:
        return kTrianglesEnd;
      case Stage::kClearBoundary:
        return between(kTrianglesEnd, kClearBoundaryEnd, clearing_->fraction());
      case Stage::kClearInterior:
        return between(kClearBoundaryEnd, 1.0, interior_->fraction());
      case Stage::kDone:
      case Stage::kFailed:
        break;
    }
    return 1.0;
  }

 private:
  enum class Stage : std::uint8_t {
    kBegin,
    kInsert,
    kEdges,
    kTriangles,
    kDropOutside,
    kSeparate,
    kClearBoundary,
    kClearInterior,
    kDone,
    kFailed
  };

  [[nodiscard]] std::uint64_t work() const { return mesh_.points.work(); }

  void step() {
    switch (stage_) {
      case Stage::kBegin:
        return begin();
      case Stage::kInsert:
        if (next_ == insertion_->count()) return beginRecovery();
        return failUnless(insertion_->insert(next_++));
      case Stage::kEdges:
        return recoverEdges();
      case Stage::kTriangles:
        if (next_ == recovery_->triangleCount()) return beginDropping();
        return failUnless(recovery_->recoverTriangle(next_++));
      case Stage::kDropOutside:
        return dropOutside();
      case Stage::kSeparate:
        return separate();
      case Stage::kClearBoundary:
        return clearBoundary();
      case Stage::kClearInterior:
        return clearInterior();
      case Stage::kDone:
      case Stage::kFailed:
        return;
    }
  }

  void beginStage(Stage stage) {
    stage_ = stage;
    next_ = 0;
  }
  void failUnless(bool good) {
    if (!good) stage_ = Stage::kFailed;
  }

  void begin() {
    if (task_.triangles.empty()) return beginStage(Stage::kDone);
    for (const Vec3& position : task_.positions) mesh_.points.add(position);
    insertion_.emplace(mesh_, order_);
    beginStage(Stage::kInsert);
  }

  void beginRecovery() {
    insertion_.reset();
    recovery_.emplace(mesh_, task_.triangles, kEdgeOrders.at(order_ % kEdgeOrders.size()));
    beginStage(Stage::kEdges);
  }

  void recoverEdges() {
    const BoundaryRecovery::State state = recovery_->recoverNextEdge();
    if (state == BoundaryRecovery::State::kDone) return beginStage(Stage::kTriangles);
    failUnless(state == BoundaryRecovery::State::kRunning);
  }

  void beginDropping() {
    outside_.emplace(mesh_, task_.triangles);
    beginStage(Stage::kDropOutside);
  }

  void dropOutside() {
    ++touched_;
    const OutsideRemoval::State state = outside_->step();
    if (state == OutsideRemoval::State::kRunning) return;
    if (state == OutsideRemoval::State::kFailed) return failUnless(false);
    outside_.reset();
    separation_.emplace(mesh_, recovery_->boundaryPoints());
    recovery_.reset();
    touched_ += mesh_.slotCount();
    beginStage(Stage::kSeparate);
  }

  void separate() {
    if (!separation_->isDone()) {
      touched_ += separation_->step();
      return;
    }
    clearing_.emplace(mesh_, task_.triangles, separation_->points());
    separation_.reset();
    beginStage(Stage::kClearBoundary);
  }

  void clearBoundary() {
    const BoundaryPointRemoval::State state = clearing_->step();
    if (state == BoundaryPointRemoval::State::kRunning) return;
    if (state == BoundaryPointRemoval::State::kFailed) return failUnless(false);
    interior_.emplace(mesh_, clearing_->interiorPoints());
    clearing_.reset();
    beginStage(Stage::kClearInterior);
  }

  void clearInterior() {
    const InteriorPointRounding::State state = interior_->step();
    if (state == InteriorPointRounding::State::kRunning) return;
    takeResult();
    if (result_.tetrahedra.empty()) return failUnless(false);
    beginStage(Stage::kDone);
  }

  void takeResult() {
    std::vector<NodeId> numbers(mesh_.points.size());
    for (std::size_t i = 0; i < task_.positions.size(); ++i) numbers[i] = NodeId(i);
    for (const NodeId node : interior_->points()) {
      if (!mesh_.points.isDouble(node)) continue;
      numbers[node.index()] = NodeId(task_.positions.size() + result_.newPositions.size());
      result_.newPositions.push_back(mesh_.points.position(node));
    }
    std::vector<std::uint8_t> seen(mesh_.slotCount(), 0);
    for (std::size_t i = 0; i < mesh_.slotCount(); ++i) {
      if (mesh_.isLive(TetId(i)) && seen[i] == 0) takePocketAround(TetId(i), seen, numbers);
    }
  }

  /// The tetrahedra joined to one by faces, all of one pocket.
  void takePocketAround(TetId first, std::vector<std::uint8_t>& seen,
                        const std::vector<NodeId>& numbers) {
    std::vector<TetId> pocket{first};
    seen[first.index()] = 1;
    std::uint32_t triangle = kNoFacet;
    for (std::size_t i = 0; i < pocket.size(); ++i) {
      const FillTet& t = mesh_.tet(pocket[i]);
      for (std::size_t k = 0; k < 4; ++k) {
        triangle = std::min(triangle, t.facet[k]);
        const TetId beyond = t.across[k].tet;
        if (beyond.isNone() || seen[beyond.index()] != 0) continue;
        seen[beyond.index()] = 1;
        pocket.push_back(beyond);
      }
    }
    for (const TetId id : pocket) {
      if (isOpen(id)) {
        takeOpenFaces(id, triangle, numbers);
        continue;
      }
      const auto& n = mesh_.tet(id).nodes;
      result_.tetrahedra.push_back({numbers[n[0].index()], numbers[n[1].index()],
                                    numbers[n[2].index()], numbers[n[3].index()]});
      result_.triangleOfTetrahedron.push_back(triangle);
    }
  }

  /// Has it a point that doubles cannot hold?
  [[nodiscard]] bool isOpen(TetId tet) const {
    const auto& n = mesh_.tet(tet).nodes;
    return std::any_of(n.begin(), n.end(),
                       [&](NodeId node) { return !mesh_.points.isDouble(node); });
  }

  void takeOpenFaces(TetId tet, std::uint32_t triangle, const std::vector<NodeId>& numbers) {
    const FillTet& t = mesh_.tet(tet);
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (t.across[k].isNone()) {
        result_.openTriangles.push_back(t.facet[k]);
      } else if (!isOpen(t.across[k].tet)) {
        const NodeTriple n = mesh_.innerFace(tet, k);
        result_.openFaces.push_back(
            {numbers[n[0].index()], numbers[n[1].index()], numbers[n[2].index()]});
        result_.triangleOfOpenFace.push_back(triangle);
      }
    }
  }

  FillTask task_;
  unsigned order_;
  std::uint64_t limit_;
  FillMesh mesh_;
  FillResult result_;
  Stage stage_ = Stage::kBegin;
  std::size_t next_ = 0;
  std::uint64_t touched_ = 0;  ///< tetrahedra, in this slice, without a sign
  std::optional<PointInsertion> insertion_;
  std::optional<BoundaryRecovery> recovery_;
  std::optional<OutsideRemoval> outside_;
  std::optional<SectorSeparation> separation_;
  std::optional<BoundaryPointRemoval> clearing_;
  std::optional<InteriorPointRounding> interior_;
};

ExactFill::ExactFill(FillTask task, unsigned order, std::uint64_t limit)
    : impl_(std::make_unique<Impl>(std::move(task), order, limit)) {}
ExactFill::ExactFill(ExactFill&&) noexcept = default;
ExactFill& ExactFill::operator=(ExactFill&&) noexcept = default;
ExactFill::~ExactFill() = default;

ExactFill::State ExactFill::advance(std::uint32_t budget) { return impl_->advance(budget); }
double ExactFill::fraction() const { return impl_->fraction(); }
const FillResult& ExactFill::result() const { return impl_->result(); }

}  // namespace tetrafront
