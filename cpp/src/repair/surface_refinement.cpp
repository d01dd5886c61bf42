#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "base/ids.h"
#include "search/indexed_heap.h"
#include "boundary/boundary_report.h"
#include "boundary/surface_checks.h"
#include "boundary/edge_table.h"
#include "preview/check_input.h"
#include "sizing/expected_count.h"
#include "boundary/surface_access.h"
#include "sizing/target_sizes.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {
namespace {

/// Edges are halved that are longer, in wanted lengths: the halves are as much too short as these
/// were too long.
constexpr double kMaxLength = 1.4142135623730951;
/// Area of the triangles that come out, in squares of wanted lengths: right and isosceles ones have
/// between a quarter and a half.
constexpr double kTypicalArea = 0.36;
/// There are as many tetrahedra to each triangle of most bodies, and more; only thin ones have fewer.
constexpr std::uint32_t kTetrahedraPerTriangle = 4;

}  // namespace

/// A surface whose edges are halved, the longest first. Half-edge 3t + k runs from corner k of
/// triangle t to the next; those of one edge, however many, are linked.
class SurfaceRefiner::Impl {
 public:
  Impl(std::span<const double> points, std::span<const std::uint32_t> triangles,
       BackgroundGrid grid, const MeshOptions& options, double volume)
      : grid_(std::move(grid)), options_(options), volume_(volume) {
    mesh_.points.assign(points.begin(), points.end());
    mesh_.triangles.assign(triangles.begin(), triangles.end());
    given_ = static_cast<std::uint32_t>(triangles.size() / 3);
    origin_.resize(given_);
    for (std::uint32_t t = 0; t < origin_.size(); ++t) origin_[t] = t;
  }

  bool advance(std::uint32_t budget);

  [[nodiscard]] double fraction() const {
    if (stage_ == Stage::kDone) return 1.0;
    if (stage_ != Stage::kSplit || !(expected_ > 0.0)) return 0.0;
    return std::min(1.0, static_cast<double>(origin_.size()) / expected_);
  }
  [[nodiscard]] const SurfaceRefinement& result() const { return result_; }

 private:
  enum class Stage : std::uint8_t {
    kCheck,
    kCheckGrid,
    kSizes,
    kEstimate,
    kInside,
    kEdges,
    kMeasure,
    kSplit,
    kDone
  };

  [[nodiscard]] Stage step(std::uint32_t budget);
  [[nodiscard]] Stage check();
  [[nodiscard]] Stage checkGrid(std::uint32_t budget);
  [[nodiscard]] Stage askSizes(std::uint32_t budget);
  [[nodiscard]] Stage estimate(std::uint32_t budget);
  [[nodiscard]] Stage estimateInside();
  [[nodiscard]] Stage linkEdges();
  [[nodiscard]] Stage measure(std::uint32_t budget);
  [[nodiscard]] Stage split(std::uint32_t budget);
  [[nodiscard]] Stage refuse(double triangles);
  [[nodiscard]] Stage refuseAs(std::vector<Entity> entities, double expected, double most);
  [[nodiscard]] Stage finish();
  void add(const std::vector<Diagnostic>& found) {
    result_.diagnostics.insert(result_.diagnostics.end(), found.begin(), found.end());
  }

  [[nodiscard]] std::uint32_t triangleCount() const {
    return static_cast<std::uint32_t>(origin_.size());
  }
  /// As many as are given are never too many: that is the mesher's to say.
  [[nodiscard]] double maxTriangles() const {
    return std::max(static_cast<double>(options_.maxTetrahedra) / kTetrahedraPerTriangle,
                    static_cast<double>(given_));
  }

  void measureEdge(std::uint32_t edge);
  [[nodiscard]] bool isLonger(std::uint32_t edge, std::uint32_t other) const {
    return spans_[edge] != spans_[other] ? spans_[edge] > spans_[other] : edge < other;
  }
  [[nodiscard]] std::uint32_t longestOf(std::uint32_t triangle) const;
  [[nodiscard]] std::uint32_t longestAround(std::uint32_t edge) const;
  [[nodiscard]] double lengthInside(std::uint32_t triangle, std::uint32_t edge);
  [[nodiscard]] double needOf(std::uint32_t edge);
  void want(std::uint32_t edge, double length);
  void lookAt(std::uint32_t triangle);
  std::uint32_t addEdge(std::uint32_t from, std::uint32_t to);
  void link(std::uint32_t edge, std::uint32_t halfEdge);
  void relink(std::uint32_t edge, std::uint32_t halfEdge, std::uint32_t by);
  void bisect(std::uint32_t edge);

  BackgroundGrid grid_;
  MeshOptions options_;
  double volume_;
  Stage stage_ = Stage::kCheck;
  SurfaceMesh mesh_;
  std::uint32_t given_ = 0;  ///< triangles
  std::vector<std::uint32_t> origin_;
  std::optional<BackgroundGridCheck> ofGrid_;
  std::optional<TargetSizes> wanted_;
  std::optional<SizeField> field_;
  FieldHint hint_;
  std::uint32_t next_ = 0;
  double expected_ = 0.0;
  double maxExpected_ = 0.0;
  std::uint32_t largest_ = 0;

  std::vector<std::uint32_t> edgeOf_;    ///< of a half-edge
  std::vector<std::uint32_t> nextHalf_;  ///< on the same edge
  std::vector<std::uint32_t> firstHalf_;
  std::vector<std::array<std::uint32_t, 2>> ends_;
  std::vector<double> lengths_;  ///< of edges, in wanted lengths; 0 where no double lies between
  std::vector<double>
      spans_;  ///< by which the longest of a triangle is found: plain, unless stretched
  IndexedHeap waiting_;
  std::vector<double> needs_;  ///< of edges that wait
  std::vector<std::uint32_t> around_;
  SurfaceRefinement result_;
};

bool SurfaceRefiner::Impl::advance(std::uint32_t budget) {
  if (stage_ != Stage::kDone) stage_ = step(budget);
  return stage_ == Stage::kDone;
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::step(std::uint32_t budget) {
  switch (stage_) {
    case Stage::kCheck:
      return check();
    case Stage::kCheckGrid:
      return checkGrid(budget);
    case Stage::kSizes:
      return askSizes(budget);
    case Stage::kEstimate:
      return estimate(budget);
    case Stage::kInside:
      return estimateInside();
    case Stage::kEdges:
      return linkEdges();
    case Stage::kMeasure:
      return measure(budget);
    case Stage::kSplit:
      return split(budget);
    case Stage::kDone:
      break;
  }
  return Stage::kDone;
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::check() {
  BoundaryReport report(mesh_, BoundarySource::kGivenSurface);
  checkNumbers(mesh_, report);
  for (std::uint32_t t = 0; t < triangleCount() && !report.hasErrors(); ++t) {
    const std::uint32_t* n = &mesh_.triangles[3 * std::size_t{t}];
    if (n[0] == n[1] || n[1] == n[2] || n[2] == n[0]) {
      report.addTriangle(DiagnosticCode::kDegenerateTriangle, t);
    }
  }
  result_.diagnostics = report.take();
  add(checkOptions(options_));
  ofGrid_.emplace(targetSizeCheck(grid_, options_));
  return Stage::kCheckGrid;
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::checkGrid(std::uint32_t budget) {
  if (!ofGrid_->advance(budget)) return stage_;
  add(ofGrid_->take());
  ofGrid_.reset();
  if (anyError(result_.diagnostics) || !hasTargetSizes(grid_, options_)) return finish();
  wanted_.emplace(mesh_, grid_, options_, EdgeSizes::kIgnored);
  return Stage::kSizes;
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::askSizes(std::uint32_t budget) {
  if (!wanted_->advance(budget)) return stage_;
  result_.diagnostics = wanted_->diagnostics();
  if (!result_.diagnostics.empty()) return finish();
  field_ = wanted_->take();
  wanted_.reset();
  return Stage::kEstimate;
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::estimate(std::uint32_t budget) {
  const std::uint32_t last = next_ + std::min(budget, triangleCount() - next_);
  for (; next_ < last; ++next_) {
    const auto [a, b, c] = cornersOf(mesh_, next_);
    const SymmetricTensor toUnit = field_->wantedTensorAt((a + b + c) / 3.0, hint_).inverse();
    const Vec3 ab = toUnit * (b - a);
    const Vec3 ac = toUnit * (c - a);
    const double longest = std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
    const double area = 0.5 * glm::length(glm::cross(ab, ac));
    const double expected = longest <= kMaxLength ? 1.0 : std::max(1.0, area / kTypicalArea);
    expected_ += expected;
    if (expected > maxExpected_) {
      maxExpected_ = expected;
      largest_ = next_;
    }
  }
  if (next_ < triangleCount()) return stage_;
  return expected_ <= maxTriangles() ? Stage::kInside : refuse(expected_);
}

/// As a run estimates what it will make, of which the triangles here can only ask for more.
SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::estimateInside() {
  if (!(volume_ > 0.0)) return Stage::kEdges;
  const double expected = tetrahedraWithin(volume_, mesh_, *field_);
  const auto most = static_cast<double>(options_.maxTetrahedra);
  return expected <= most ? Stage::kEdges : refuseAs({}, expected, most);
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::linkEdges() {
  const EdgeTable edges(mesh_.triangles, mesh_.points.size() / 3, {});
  edgeOf_.resize(mesh_.triangles.size());
  nextHalf_.resize(mesh_.triangles.size());
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halves = edges.halfEdgesOf(e);
    const HalfEdgeNodes nodes = nodesOf(mesh_.triangles, halves.front());
    const std::uint32_t edge = addEdge(nodes.from, nodes.to);
    for (const std::uint32_t half : halves) link(edge, half);
  }
  next_ = 0;
  return Stage::kMeasure;
}

/// First all edges, then what edges do not see of their triangles.
SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::measure(std::uint32_t budget) {
  const auto edges = static_cast<std::uint32_t>(ends_.size());
  const std::uint32_t all = edges + triangleCount();
  const std::uint32_t last = next_ + std::min(budget, all - next_);
  for (; next_ < last; ++next_) {
    if (next_ >= edges) {
      lookAt(next_ - edges);
      continue;
    }
    measureEdge(next_);
  }
  return next_ < all ? stage_ : Stage::kSplit;
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::split(std::uint32_t budget) {
  for (std::uint32_t i = 0; i < budget; ++i) {
    if (waiting_.empty()) return finish();
    if (static_cast<double>(triangleCount()) > maxTriangles()) return refuse(triangleCount());
    const std::uint32_t edge = waiting_.pop();
    const double need = needOf(edge);
    if (!(need > kMaxLength)) continue;
    // Only the longest edge of all its triangles is halved: no angle gets small but where one was.
    const std::uint32_t longest = longestAround(edge);
    waiting_.remove(longest);
    bisect(longest);
    if (longest != edge) want(edge, need);
  }
  return stage_;
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::refuse(double triangles) {
  return refuseAs({{EntityKind::kTriangle, largest_}}, triangles, maxTriangles());
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::refuseAs(std::vector<Entity> entities,
                                                           double expected, double most) {
  Diagnostic tooMany;
  tooMany.code = DiagnosticCode::kTooManyElements;
  tooMany.entities = std::move(entities);
  tooMany.values = {counted(expected), most};
  result_.diagnostics = {tooMany};
  return finish();
}

SurfaceRefiner::Impl::Stage SurfaceRefiner::Impl::finish() {
  if (result_.diagnostics.empty()) {
    result_.points = std::move(mesh_.points);
    result_.triangles = std::move(mesh_.triangles);
    result_.origin = std::move(origin_);
  }
  origin_ = {};
  return Stage::kDone;
}

void SurfaceRefiner::Impl::measureEdge(std::uint32_t edge) {
  const Vec3 a = pointOf(mesh_, ends_[edge][0]);
  const Vec3 b = pointOf(mesh_, ends_[edge][1]);
  lengths_[edge] = metricLength(*field_, a, b, hint_);
  spans_[edge] = field_->isStretched() ? lengths_[edge] : glm::length(b - a);
  want(edge, lengths_[edge]);
}

std::uint32_t SurfaceRefiner::Impl::longestOf(std::uint32_t triangle) const {
  const std::uint32_t* edges = &edgeOf_[3 * std::size_t{triangle}];
  std::uint32_t longest = edges[0];
  if (isLonger(edges[1], longest)) longest = edges[1];
  if (isLonger(edges[2], longest)) longest = edges[2];
  return longest;
}

/// From triangle to triangle over ever longer edges, until one is the longest on all its sides.
std::uint32_t SurfaceRefiner::Impl::longestAround(std::uint32_t edge) const {
  for (std::uint32_t before = kNoIndex; before != edge;) {
    before = edge;
    for (std::uint32_t h = firstHalf_[before]; h != kNoIndex; h = nextHalf_[h]) {
      const std::uint32_t longest = longestOf(h / 3);
      if (isLonger(longest, edge)) edge = longest;
    }
  }
  return edge;
}

/// As the middle of the triangle sees the edge.
double SurfaceRefiner::Impl::lengthInside(std::uint32_t triangle, std::uint32_t edge) {
  const auto [a, b, c] = cornersOf(mesh_, triangle);
  const Vec3 along = pointOf(mesh_, ends_[edge][1]) - pointOf(mesh_, ends_[edge][0]);
  return metricLengthAt(*field_, (a + b + c) / 3.0, along, hint_);
}

double SurfaceRefiner::Impl::needOf(std::uint32_t edge) {
  double need = lengths_[edge];
  if (!(need > 0.0)) return need;
  for (std::uint32_t h = firstHalf_[edge]; h != kNoIndex; h = nextHalf_[h]) {
    if (longestOf(h / 3) == edge) need = std::max(need, lengthInside(h / 3, edge));
  }
  return need;
}

void SurfaceRefiner::Impl::want(std::uint32_t edge, double length) {
  if (!(length > kMaxLength) || !(lengths_[edge] > 0.0)) return;
  if (waiting_.contains(edge)) {
    if (!(length > needs_[edge])) return;
    waiting_.remove(edge);
  }
  needs_[edge] = length;
  // Doubles above 0 are ordered as their bits are.
  waiting_.push(edge, ~std::bit_cast<std::uint64_t>(length));
}

void SurfaceRefiner::Impl::lookAt(std::uint32_t triangle) {
  const std::uint32_t longest = longestOf(triangle);
  want(longest, lengthInside(triangle, longest));
}

std::uint32_t SurfaceRefiner::Impl::addEdge(std::uint32_t from, std::uint32_t to) {
  const auto edge = static_cast<std::uint32_t>(ends_.size());
  ends_.push_back({from, to});
  firstHalf_.push_back(kNoIndex);
  lengths_.push_back(0.0);
  spans_.push_back(0.0);
  needs_.push_back(0.0);
  waiting_.reserveIds(ends_.size());
  return edge;
}

void SurfaceRefiner::Impl::link(std::uint32_t edge, std::uint32_t halfEdge) {
  edgeOf_[halfEdge] = edge;
  nextHalf_[halfEdge] = firstHalf_[edge];
  firstHalf_[edge] = halfEdge;
}

/// In the place of `halfEdge` its edge has `by`.
void SurfaceRefiner::Impl::relink(std::uint32_t edge, std::uint32_t halfEdge, std::uint32_t by) {
  std::uint32_t* at = &firstHalf_[edge];
  while (*at != halfEdge) at = &nextHalf_[*at];
  *at = by;
  nextHalf_[by] = nextHalf_[halfEdge];
  edgeOf_[by] = edge;
}

/// And with it each of its triangles.
void SurfaceRefiner::Impl::bisect(std::uint32_t edge) {
  const auto [a, b] = ends_[edge];
  const Vec3 from = pointOf(mesh_, a);
  const Vec3 to = pointOf(mesh_, b);
  const Vec3 middle = 0.5 * from + 0.5 * to;
  if (middle == from || middle == to) {
    lengths_[edge] = 0.0;
    spans_[edge] = 0.0;
    return;
  }
  const auto m = static_cast<std::uint32_t>(mesh_.points.size() / 3);
  mesh_.points.insert(mesh_.points.end(), {middle.x, middle.y, middle.z});
  ++result_.splitEdges;
  around_.clear();
  for (std::uint32_t h = firstHalf_[edge]; h != kNoIndex; h = nextHalf_[h]) around_.push_back(h);
  const std::uint32_t second = addEdge(m, b);
  ends_[edge] = {a, m};
  firstHalf_[edge] = kNoIndex;
  measureEdge(edge);
  measureEdge(second);
  for (const std::uint32_t half : around_) {
    const std::uint32_t t = half / 3;
    const std::uint32_t added = triangleCount();
    const std::uint32_t after = nextCorner(half);
    const std::uint32_t last = nextCorner(after);
    const std::uint32_t head = mesh_.triangles[after];
    const std::uint32_t apex = mesh_.triangles[last];
    const std::uint32_t shift = 3 * (added - t);
    origin_.push_back(origin_[t]);
    mesh_.triangles.resize(mesh_.triangles.size() + 3);
    edgeOf_.resize(mesh_.triangles.size());
    nextHalf_.resize(mesh_.triangles.size());
    mesh_.triangles[after] = m;
    mesh_.triangles[half + shift] = m;
    mesh_.triangles[after + shift] = head;
    mesh_.triangles[last + shift] = apex;
    relink(edgeOf_[after], after, after + shift);
    const bool isAlong = head == b;
    link(isAlong ? edge : second, half);
    link(isAlong ? second : edge, half + shift);
    const std::uint32_t across = addEdge(m, apex);
    link(across, after);
    link(across, last + shift);
    measureEdge(across);
  }
  for (const std::uint32_t half : around_) lookAt(half / 3);
  for (auto t = static_cast<std::uint32_t>(triangleCount() - around_.size()); t < triangleCount();
       ++t) {
    lookAt(t);
  }
}

SurfaceRefiner::SurfaceRefiner(std::span<const double> points,
                               std::span<const std::uint32_t> triangles, BackgroundGrid grid,
                               const MeshOptions& options, double volume)
    : impl_(std::make_unique<Impl>(points, triangles, std::move(grid), options, volume)) {}
SurfaceRefiner::SurfaceRefiner(SurfaceRefiner&&) noexcept = default;
SurfaceRefiner& SurfaceRefiner::operator=(SurfaceRefiner&&) noexcept = default;
SurfaceRefiner::~SurfaceRefiner() = default;

bool SurfaceRefiner::advance(std::uint32_t budget) { return impl_->advance(std::max(budget, 1U)); }
double SurfaceRefiner::fraction() const { return impl_->fraction(); }
const SurfaceRefinement& SurfaceRefiner::result() const { return impl_->result(); }

}  // namespace tetrafront
