#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "boundary/boundary.h"
#include "base/sort.h"
#include "boundary/surface_checks.h"
#include "boundary/edge_table.h"
#include "repair/hole_filling.h"
#include "repair/sliver_splitting.h"
#include "boundary/surface_access.h"
#include "boundary/half_faces.h"
#include "repair/weld.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {

/// A surface under repair: its nodes keep their given numbers until the end.
class SurfaceRepairer::Impl {
 public:
  Impl(std::span<const double> points, std::span<const std::uint32_t> triangles,
       const RepairOptions& options)
      : options_(options) {
    mesh_.points.assign(points.begin(), points.end());
    mesh_.triangles.assign(triangles.begin(), triangles.end());
    origin_.resize(triangles.size() / 3);
    for (std::uint32_t t = 0; t < origin_.size(); ++t) origin_[t] = t;
    isWelded_.resize(points.size() / 3, 0);
  }

  bool advance(std::uint32_t budget);

  [[nodiscard]] double fraction() const {
    const double within = check_ ? check_->fraction() : 0.0;
    return (static_cast<double>(stage_) + within) / static_cast<double>(Stage::kDone);
  }
  [[nodiscard]] const SurfaceRepair& result() const { return result_; }

 private:
  using Triangle = std::array<std::uint32_t, 3>;
  enum class Stage : std::uint8_t {
    kNumbers,
    kWeld,
    kRepeating,
    kDuplicates,
    kDissolve,
    kSlivers,
    kNewDuplicates,
    kFill,
    kTurn,
    kTake,
    kDone
  };

  /// One step of the present stage; whether that is over.
  bool step(std::uint32_t budget);
  [[nodiscard]] Stage nextStage() const;

  /// Where coordinates or indices are broken, the result is what was given.
  void refuseInvalidNumbers();
  bool weld(std::uint32_t budget);
  bool fill(std::uint32_t budget);
  bool turn(std::uint32_t budget);
  /// With the nodes that are used only, in their order.
  void take();

  [[nodiscard]] Triangle nodesOfTriangle(std::uint32_t t) const {
    const std::size_t i = 3 * std::size_t{t};
    return {mesh_.triangles[i], mesh_.triangles[i + 1], mesh_.triangles[i + 2]};
  }
  void put(std::uint32_t t, const Triangle& nodes) {
    std::copy(nodes.begin(), nodes.end(), &mesh_.triangles[3 * std::size_t{t}]);
  }
  [[nodiscard]] std::uint32_t triangleCount() const {
    return static_cast<std::uint32_t>(mesh_.triangles.size() / 3);
  }
  void add(RepairKind kind, std::uint32_t first, std::uint32_t second, const Vec3& place) {
    changes_.push_back({kind, first, second, place});
  }
  void addAt(RepairKind kind, std::uint32_t triangle, std::uint32_t second);

  void removeWithRepeatedNodes();
  void splitSlivers();
  void removeSlivers();
  void removeDuplicates();
  void keep(const std::vector<std::uint8_t>& isGone);
  void orientIfManifold();
  void listFlipped();

  RepairOptions options_;
  Stage stage_ = Stage::kNumbers;
  SurfaceMesh mesh_;
  std::vector<std::uint32_t> origin_;
  std::vector<std::uint8_t> isWelded_;  ///< nodes that are others now
  std::vector<RepairChange> changes_;
  std::optional<NodeWelder> welder_;
  std::optional<HoleFiller> filler_;
  SurfaceMesh outward_;  ///< turned by the boundary check
  std::optional<BoundaryCheck> check_;
  SurfaceRepair result_;
};

bool SurfaceRepairer::Impl::advance(std::uint32_t budget) {
  if (stage_ != Stage::kDone && step(budget)) stage_ = nextStage();
  return stage_ == Stage::kDone;
}

bool SurfaceRepairer::Impl::step(std::uint32_t budget) {
  switch (stage_) {
    case Stage::kNumbers:
      refuseInvalidNumbers();
      return true;
    case Stage::kWeld:
      return weld(budget);
    case Stage::kRepeating:
      removeWithRepeatedNodes();
      return true;
    case Stage::kDuplicates:
    case Stage::kNewDuplicates:
      removeDuplicates();
      return true;
    case Stage::kDissolve:
      splitSlivers();
      return true;
    case Stage::kSlivers:
      removeSlivers();
      return true;
    case Stage::kFill:
      return fill(budget);
    case Stage::kTurn:
      return turn(budget);
    case Stage::kTake:
      take();
      return true;
    case Stage::kDone:
      return true;
  }
  return true;
}

/// The one after the present that the options ask for.
SurfaceRepairer::Impl::Stage SurfaceRepairer::Impl::nextStage() const {
  const bool isRefused = !result_.diagnostics.empty();
  if (isRefused) return Stage::kDone;
  for (auto stage = static_cast<std::uint8_t>(stage_);;) {
    switch (const auto next = static_cast<Stage>(++stage)) {
      case Stage::kWeld:
        if (options_.weldDistance >= 0.0) return next;
        break;
      case Stage::kRepeating:
      case Stage::kDuplicates:
      case Stage::kDissolve:
      case Stage::kSlivers:
      case Stage::kNewDuplicates:
        if (options_.removesTriangles) return next;
        break;
      case Stage::kFill:
        if (options_.fillsUpTo > 0) return next;
        break;
      case Stage::kTurn:
        if (options_.turns) return next;
        break;
      default:
        return next;
    }
  }
}

void SurfaceRepairer::Impl::refuseInvalidNumbers() {
  BoundaryReport report(mesh_, BoundarySource::kGivenSurface);
  checkNumbers(mesh_, report);
  result_.diagnostics = report.take();
  if (result_.diagnostics.empty()) return;
  result_.points = std::move(mesh_.points);
  result_.triangles = std::move(mesh_.triangles);
  result_.origin = std::move(origin_);
}

void SurfaceRepairer::Impl::addAt(RepairKind kind, std::uint32_t triangle, std::uint32_t second) {
  const std::array<Vec3, 3> p = cornersOf(mesh_, triangle);
  add(kind, origin_[triangle], second, (p[0] + p[1] + p[2]) / 3.0);
}

bool SurfaceRepairer::Impl::weld(std::uint32_t budget) {
  if (!welder_) welder_.emplace(mesh_.points, options_.weldDistance);
  if (!welder_->advance(budget)) return false;
  const std::vector<std::uint32_t>& target = welder_->targets();
  for (std::uint32_t i = 0; i < target.size(); ++i) {
    if (target[i] == i) continue;
    isWelded_[i] = 1;
    add(RepairKind::kWeldedNode, i, target[i], pointOf(mesh_, i));
  }
  for (std::uint32_t& node : mesh_.triangles) node = target[node];
  welder_.reset();
  return true;
}

void SurfaceRepairer::Impl::keep(const std::vector<std::uint8_t>& isGone) {
  std::uint32_t kept = 0;
  for (std::uint32_t t = 0; t < isGone.size(); ++t) {
    if (isGone[t] != 0) continue;
    const Triangle nodes = nodesOfTriangle(t);
    put(kept, nodes);
    origin_[kept++] = origin_[t];
  }
  mesh_.triangles.resize(3 * std::size_t{kept});
  origin_.resize(kept);
}

void SurfaceRepairer::Impl::removeWithRepeatedNodes() {
  std::vector<std::uint8_t> isGone(triangleCount(), 0);
  for (std::uint32_t t = 0; t < isGone.size(); ++t) {
    const auto [a, b, c] = nodesOfTriangle(t);
    if (a != b && b != c && c != a) continue;
    isGone[t] = 1;
    addAt(RepairKind::kRemovedTriangle, t, kNoOrigin);
  }
  keep(isGone);
}

/// Those beside others that have area; the shape is the same.
void SurfaceRepairer::Impl::splitSlivers() {
  for (const auto& [sliver, other, middle] : splitBesideSlivers(mesh_)) {
    add(RepairKind::kSplitTriangle, origin_[sliver], origin_[other], pointOf(mesh_, middle));
    origin_[sliver] = origin_[other];
  }
}

void SurfaceRepairer::Impl::removeSlivers() {
  std::vector<std::uint8_t> isGone(triangleCount(), 0);
  for (std::uint32_t t = 0; t < isGone.size(); ++t) {
    if (!isSliver(mesh_, t)) continue;
    isGone[t] = 1;
    addAt(RepairKind::kRemovedTriangle, t, kNoOrigin);
  }
  keep(isGone);
}

void SurfaceRepairer::Impl::removeDuplicates() {
  std::vector<std::pair<Triangle, std::uint32_t>> byNodes;
  for (std::uint32_t t = 0; t < triangleCount(); ++t) {
    byNodes.emplace_back(sorted(nodesOfTriangle(t)), t);
  }
  stableSort(byNodes);
  std::vector<std::uint32_t> sameAs(triangleCount(), kNoOrigin);
  for (std::size_t i = 1; i < byNodes.size(); ++i) {
    if (byNodes[i].first != byNodes[i - 1].first) continue;
    const std::uint32_t before = byNodes[i - 1].second;
    sameAs[byNodes[i].second] = sameAs[before] == kNoOrigin ? before : sameAs[before];
  }
  std::vector<std::uint8_t> isGone(triangleCount(), 0);
  for (std::uint32_t t = 0; t < isGone.size(); ++t) {
    if (sameAs[t] == kNoOrigin) continue;
    isGone[t] = 1;
    addAt(RepairKind::kRemovedDuplicate, t, origin_[sameAs[t]]);
  }
  keep(isGone);
}

bool SurfaceRepairer::Impl::fill(std::uint32_t budget) {
  if (!filler_) filler_.emplace(mesh_, std::min(options_.fillsUpTo, kMostHoleEdges));
  if (!filler_->advance(budget)) return false;
  for (const FilledHole& hole : filler_->filled()) {
    Vec3 place(0.0);
    for (std::uint32_t t = 0; t < hole.triangles; ++t) {
      const std::array<Vec3, 3> p = cornersOf(mesh_, hole.firstTriangle + t);
      place += (p[0] + p[1] + p[2]) / (3.0 * hole.triangles);
    }
    add(RepairKind::kFilledHole, hole.firstTriangle, hole.triangles, place);
  }
  origin_.resize(triangleCount(), kNoOrigin);
  filler_.reset();
  return true;
}

/// As the boundary check does it; where that refuses, triangles at least agree with each other.
bool SurfaceRepairer::Impl::turn(std::uint32_t budget) {
  if (!check_) {
    outward_ = mesh_;
    check_.emplace(outward_, BoundarySource::kGivenSurface, options_.enclosed);
  }
  if (!check_->advance(budget)) return false;
  if (!check_->result().valid) {
    outward_ = mesh_;
    orientIfManifold();
  }
  check_.reset();
  listFlipped();
  mesh_.triangles = std::move(outward_.triangles);
  return true;
}

/// With crowded edges nobody knows who the neighbours are, and nothing is turned.
void SurfaceRepairer::Impl::orientIfManifold() {
  const EdgeTable edges(outward_.triangles, outward_.points.size() / 3, {});
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    if (edges.halfEdgesOf(e).size() > 2) return;
  }
  static_cast<void>(orientConsistently(outward_, edges));
}

void SurfaceRepairer::Impl::listFlipped() {
  for (std::uint32_t t = 0; t < triangleCount(); ++t) {
    const std::size_t second = 3 * std::size_t{t} + 1;
    const bool isTurned = mesh_.triangles[second] != outward_.triangles[second];
    if (isTurned && origin_[t] != kNoOrigin) addAt(RepairKind::kTurnedTriangle, t, kNoOrigin);
  }
}

void SurfaceRepairer::Impl::take() {
  constexpr std::uint32_t kUnused = 0xffffffffU;
  std::vector<std::uint32_t> number(mesh_.points.size() / 3, kUnused);
  for (const std::uint32_t node : mesh_.triangles) number[node] = 0;
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    const Vec3 p = pointOf(mesh_, i);
    if (number[i] == kUnused) {
      if (isWelded_[i] == 0) add(RepairKind::kDroppedNode, i, kNoOrigin, p);
      continue;
    }
    number[i] = count++;
    result_.points.insert(result_.points.end(), {p.x, p.y, p.z});
  }
  for (std::uint32_t& node : mesh_.triangles) node = number[node];
  result_.triangles = std::move(mesh_.triangles);
  result_.origin = std::move(origin_);
  for (std::uint8_t kind = 0; kind <= static_cast<std::uint8_t>(RepairKind::kTurnedTriangle);
       ++kind) {
    std::copy_if(changes_.begin(), changes_.end(), std::back_inserter(result_.changes),
                 [kind](const RepairChange& change) {
                   return static_cast<std::uint8_t>(change.kind) == kind;
                 });
  }
}

SurfaceRepairer::SurfaceRepairer(std::span<const double> points,
                                 std::span<const std::uint32_t> triangles,
                                 const RepairOptions& options)
    : impl_(std::make_unique<Impl>(points, triangles, options)) {}
SurfaceRepairer::SurfaceRepairer(SurfaceRepairer&&) noexcept = default;
SurfaceRepairer& SurfaceRepairer::operator=(SurfaceRepairer&&) noexcept = default;
SurfaceRepairer::~SurfaceRepairer() = default;

bool SurfaceRepairer::advance(std::uint32_t budget) { return impl_->advance(std::max(budget, 1U)); }
double SurfaceRepairer::fraction() const { return impl_->fraction(); }
const SurfaceRepair& SurfaceRepairer::result() const { return impl_->result(); }

SurfaceRepair repairSurface(std::span<const double> points,
                            std::span<const std::uint32_t> triangles,
                            const RepairOptions& options) {
  constexpr std::uint32_t kSlice = 1U << 16U;
  SurfaceRepairer repairer(points, triangles, options);
  while (!repairer.advance(kSlice)) {
  }
  return repairer.result();
}

}  // namespace tetrafront
