#include "volume/volume_mesher.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "geom/measure.h"
#include "volume/stall_diagnostic.h"

namespace tetrafront {
namespace {

/// Share of the time before the first step.
constexpr double kSetUpShare = 0.02;

Vec3 boundaryNode(const SurfaceMesh& surface, NodeId node) {
  const double* p = surface.points.data() + 3 * node.index();
  return {p[0], p[1], p[2]};
}

NodeTriple boundaryTriangle(const SurfaceMesh& surface, std::size_t triangle) {
  const std::uint32_t* n = surface.triangles.data() + 3 * triangle;
  return {NodeId(n[0]), NodeId(n[1]), NodeId(n[2])};
}

double rootMeanSquareEdge(const SurfaceMesh& surface, std::size_t triangle) {
  const NodeTriple n = boundaryTriangle(surface, triangle);
  double squares = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = boundaryNode(surface, n[(k + 1) % 3]) - boundaryNode(surface, n[k]);
    squares += glm::dot(edge, edge);
  }
  return std::sqrt(squares / 3.0);
}

double medianSize(const SurfaceMesh& surface) {
  std::vector<double> sizes;
  sizes.reserve(surface.triangles.size() / 3);
  for (std::size_t t = 0; t < surface.triangles.size() / 3; ++t) {
    sizes.push_back(rootMeanSquareEdge(surface, t));
  }
  if (sizes.empty()) return 1.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle > 0.0 ? *middle : 1.0;
}

Vec3 lowestCorner(const SurfaceMesh& surface) {
  Vec3 low = surface.points.empty() ? Vec3(0.0) : boundaryNode(surface, NodeId(0U));
  for (std::size_t i = 0; i < surface.points.size() / 3; ++i) {
    low = glm::min(low, boundaryNode(surface, NodeId(i)));
  }
  return low;
}

}  // namespace

VolumeMesher::VolumeMesher(const SurfaceMesh& boundary, const SizeField& field,
                           const MeshOptions& options, const FrontMaker& maker,
                           const NodeNames& names)
    : boundary_(boundary),
      field_(field),
      front_(medianSize(boundary), lowestCorner(boundary), options.order),
      advance_(maker.make(front_, elements_, field, options.filters)),
      watch_(field, boundary.triangles.size() / 3, options.maxTetrahedra),
      recovery_(front_, elements_, *advance_, options.order, options.exactFillOnly),
      exactFillOnly_(options.exactFillOnly),
      boundaryNodes_(boundary.points.size() / 3),
      names_(names) {
  for (std::size_t i = 0; i < boundaryNodes_; ++i) {
    front_.addNode(boundaryNode(boundary, NodeId(i)), 0);
  }
}

Task<MeshStatus> VolumeMesher::run(Work& work) {
  work.beginPart(0.5);
  const bool isGood = co_await advanceFront(work);
  work.beginPart(1.0);
  if (isGood) co_await recover(work);
  co_return status_;
}

Task<bool> VolumeMesher::advanceFront(Work& work) {
  work.beginPart(kSetUpShare);
  co_await setUp(work);
  work.beginPart(1.0);
  advance_->recordBegin(names_);
  while (!front_.isQueueEmpty() && watch_.isRunning()) {
    const std::uint64_t cost = advance_->advance(work.remaining(), watch_);
    work.setFraction(watch_.fraction(elements_));
    co_await work.spend(static_cast<std::size_t>(cost));
  }
  if (triangleCount() > 0) {
    openShare_ = static_cast<double>(front_.activeCount()) / static_cast<double>(triangleCount());
  }
  diagnostics_ = watch_.diagnostics(front_, elements_);
  if (watch_.end() == FrontWatch::End::kOutsideGrid) {
    end(MeshStatus::kInvalidInput);
  } else if (!watch_.isRunning()) {
    end(MeshStatus::kStalled);
  }
  co_return watch_.isRunning();
}

Task<> VolumeMesher::setUp(Work& work) {
  const Vec3 origin = triangleCount() > 0 ? boundaryNode(boundary_, NodeId(0U)) : Vec3(0.0);
  co_await work.forEachBlock(triangleCount(), [this, origin](std::size_t first, std::size_t last) {
    for (nextTriangle_ = first; nextTriangle_ < last; ++nextTriangle_) {
      addTriangle(nextTriangle_, origin);
    }
  });
  watch_.begin(front_, enclosedVolume_);
}

void VolumeMesher::addTriangle(std::size_t triangle, const Vec3& origin) {
  const NodeTriple n = boundaryTriangle(boundary_, triangle);
  enclosedVolume_ +=
      sixVolumesBelow(origin, front_.node(n[0]), front_.node(n[1]), front_.node(n[2]));
  // Query the size field in the order of the list: consecutive triangles are close to each other,
  // so the walks are short.
  static_cast<void>(field_.covers(front_.node(n[0]), coverHint_));
  front_.addFace(frontFaceOf(boundary_, triangle), boundary_.triangleRegions[2 * triangle],
                 coverHint_, !exactFillOnly_);
}

Task<MeshStatus> VolumeMesher::recover(Work& work) {
  const bool isClosed = co_await recovery_.run(work);
  watch_.lookAtNodes(front_);
  diagnostics_ = watch_.diagnostics(front_, elements_);
  end(!watch_.isRunning() ? MeshStatus::kInvalidInput
      : isClosed          ? MeshStatus::kDone
                          : MeshStatus::kStalled);
  co_return status_;
}

void VolumeMesher::end(MeshStatus status) {
  status_ = status;
  if (status == MeshStatus::kStalled && diagnostics_.empty()) {
    diagnostics_.push_back(describeStall(front_, boundary_));
  }
  advance_->recordEnd();
}

TetMesh VolumeMesher::mesh() const {
  const std::span<const Vec3> nodes = front_.nodes();
  return compacted({nodes.begin(), nodes.end()}, elements_.nodes, elements_.regions);
}

TetMesh VolumeMesher::take() {
  return compacted(front_.takeNodes(), std::move(elements_.nodes), std::move(elements_.regions));
}

/// Returns the mesh without the elements that recovery has removed, and the nodes that only they have.
TetMesh VolumeMesher::compacted(std::vector<Vec3> points, std::vector<NodeQuad> tetrahedra,
                                std::vector<std::uint32_t> regions) const {
  std::vector<std::uint8_t> isFixed = firstFixed(boundaryNodes_, points.size());
  TetMesh mesh{.points = std::move(points),
               .tetrahedra = std::move(tetrahedra),
               .regions = std::move(regions),
               .front = {},
               .isFixed = std::move(isFixed)};
  for (const FaceId face : front_.activeFaces()) mesh.front.push_back(front_.face(face).nodes);
  for (std::size_t t = nextTriangle_; t < triangleCount(); ++t) {
    mesh.front.push_back(frontFaceOf(boundary_, t));
  }
  const auto isLive = [this](TetId tet) { return elements_.removed[tet.index()] == 0; };
  std::vector<std::uint8_t> isUsed(mesh.points.size(), 0);
  for (const TetId tet : IdRange<TetId>(mesh.tetrahedra.size())) {
    if (!isLive(tet)) continue;
    for (const NodeId node : mesh.tetrahedra[tet.index()]) isUsed[node.index()] = 1;
  }
  compact(mesh, [&](NodeId node) { return isUsed[node.index()] != 0; }, isLive);
  return mesh;
}

void VolumeMesher::appendFront(std::vector<double>& corners) const {
  const auto append = [&](const NodeTriple& face) {
    for (const NodeId id : face) {
      const Vec3& position = front_.node(id);
      corners.insert(corners.end(), {position.x, position.y, position.z});
    }
  };
  for (const FaceId face : front_.activeFaces()) append(front_.face(face).nodes);
  for (std::size_t t = nextTriangle_; t < boundary_.triangles.size() / 3; ++t) {
    append(frontFaceOf(boundary_, t));
  }
}

RecoverySummary VolumeMesher::recovery() const {
  RecoverySummary summary = recovery_.summary();
  summary.relaxed = static_cast<std::uint32_t>(advance_->counters().relaxed);
  return summary;
}

FrontCounters VolumeMesher::counters() const {
  const FrontAdvance::Counters made = advance_->counters();
  return {.pops = made.pops,
          .gatheredFaces = made.gatheredFaces,
          .candidatesTried = made.candidatesTried,
          .facesTested = made.facesTested,
          .facesAnalysed = made.facesAnalysed,
          .exactPredicates = made.exactPredicates};
}

}  // namespace tetrafront
