/// @file Layers along walls: the loop of metric and adaptation.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "adapt/adapt_input.h"
#include "adapt/adapt_start.h"
#include "adapt/metric_background.h"
#include "base/diagnostics.h"
#include "base/sort.h"
#include "base/tool_job.h"
#include "field/check_background_grid.h"
#include "geom/cube_root.h"
#include "layers/layer_metric.h"
#include "layers/layer_statistics.h"
#include "metric/mesh_metric.h"
#include "metric/metric.h"
#include "optimize/given_mesh.h"
#include "tetrafront/wall_layers.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

constexpr std::size_t kNodesPerUnit = 2;

/// The cycles end when the number of elements changes by less than this part.
constexpr double kSettled = 0.03;

struct MakerInput {
  AdaptInput mesh;
  MetricMesh background;
  AdaptOptions adaptation;
  std::vector<PatchLayers> walls;
  LayerOptions layers;
  bool isStopped = false;
};

bool areUsable(std::span<const PatchLayers> walls, const LayerOptions& options) {
  const auto isValid = [](const PatchLayers& wall) {
    return wall.firstHeight > 0.0 && std::isfinite(wall.firstHeight) && wall.growth >= 1.0 &&
           std::isfinite(wall.growth) && wall.count >= 1;
  };
  std::vector<std::uint32_t> patches;
  for (const PatchLayers& wall : walls) patches.push_back(wall.patch);
  sortUnique(patches);
  return !walls.empty() && patches.size() == walls.size() && std::ranges::all_of(walls, isValid) &&
         options.maxAspect >= 1.0 && options.maxAspect <= kMaxAspect && options.growth > 0.0 &&
         options.cycles >= 1;
}

/// Makes the layers of one job.
class LayerCycles {
 public:
  explicit LayerCycles(MakerInput& input) : input_(input) {}

  Task<LayeredMesh> run(Work& work) {
    out_.adaptation.isReadable = isUsable(input_.mesh) && isUsable(input_.adaptation) &&
                                 areUsable(input_.walls, input_.layers) &&
                                 (input_.background.points.empty() || isUsable(input_.background));
    if (!out_.adaptation.isReadable) co_return std::move(out_);
    current_.points = input_.mesh.points;
    current_.tetrahedra = input_.mesh.tetrahedra;
    current_.regions = input_.mesh.regions;
    work.beginPart(0.02);
    co_await prepareBoundary(work, input_.mesh.triangles, input_.mesh.trianglePatch);
    if (anyError(out_.adaptation.diagnostics)) co_return std::move(out_);
    work.beginPart(0.04);
    co_await prepareBackground(work);
    if (anyError(out_.adaptation.diagnostics)) co_return std::move(out_);
    work.beginPart(0.98);
    co_await repeat(work);
    if (anyError(out_.adaptation.diagnostics)) {
      LayeredMesh failed;
      failed.adaptation.diagnostics = std::move(out_.adaptation.diagnostics);
      failed.adaptation.isReadable = true;
      co_return failed;
    }
    out_.adaptation.isPartial = input_.isStopped;
    work.beginPart(1.0);
    co_await describeLayers(work, input_.walls, out_);
    co_return std::move(out_);
  }

 private:
  /// Finds the boundary of the current mesh, which has these triangles.
  Task<> prepareBoundary(Work& work, std::span<const std::uint32_t> triangles,
                         std::span<const std::uint32_t> trianglePatch) {
    current_.regions.resize(countTetrahedra(current_), 0);
    work.beginPart(0.7);
    const GivenMesh given = co_await prepareGivenMesh(work, current_, triangles);
    out_.adaptation.diagnostics = given.diagnostics;
    if (anyError(given.diagnostics)) co_return;
    work.beginPart(1.0);
    StartFaces faces = co_await findStartFaces(work, given, triangles, trianglePatch);
    boundary_ = std::move(faces.boundary);
    // The elements are oriented from here on.
    current_ = given.mesh;
  }

  /// Without given sizes, those of the mesh apply, the same in all directions.
  Task<> prepareBackground(Work& work) {
    MetricMesh& background = input_.background;
    if (background.points.empty()) {
      background.points = current_.points;
      background.tetrahedra = current_.tetrahedra;
      work.beginPart(0.3);
      background.metrics = co_await impliedMetrics(work, current_);
      for (std::size_t i = 0; i < countNodes(current_); ++i) {
        const double root = cubeRoot(densityOf(tensorAt(background.metrics, i)));
        putTensor(background.metrics, i, SymmetricTensor::isotropic(root * root));
      }
    }
    const BackgroundGrid grid = locatorGridOf(background);
    work.beginPart(0.4);
    out_.adaptation.diagnostics = co_await checkBackgroundGrid(work, grid);
    if (anyError(out_.adaptation.diagnostics)) co_return;
    work.beginPart(1.0);
    MetricBackground base = co_await MetricBackground::build(work, grid, background.metrics);
    base_.emplace(std::move(base));
  }

  Task<> repeat(Work& work) {
    std::optional<LayerMetric> layers(std::in_place, boundary_, input_.walls, input_.layers,
                                      base_->maxSize());
    const std::uint32_t cycles = input_.layers.cycles;
    for (std::uint32_t cycle = 0; cycle < cycles; ++cycle) {
      const double begin = static_cast<double>(cycle) / cycles;
      work.beginPart(begin + 0.1 / cycles);
      MetricMesh target{current_.points, current_.tetrahedra, {}};
      co_await measure(work, *layers, target.metrics);
      work.beginPart(begin + 1.0 / cycles);
      // A mesh that is done is better than one that is cut off.
      if (input_.isStopped && out_.cycles > 0) break;
      const std::uint32_t before = countTetrahedra(current_);
      co_await adaptTo(work, std::move(target));
      if (anyError(out_.adaptation.diagnostics)) co_return;
      ++out_.cycles;
      // If stopped, the first adaptation still checks the mesh, and ends soon.
      if (input_.isStopped) break;
      const std::uint32_t after = countTetrahedra(current_);
      const double change = std::fabs(static_cast<double>(after) - before);
      if (!isLimited_ && change < kSettled * before) break;
      if (input_.mesh.model.empty()) continue;
      // The walls are those of the mesh, whose nodes are on the faces of the model.
      co_await prepareBoundary(work, out_.adaptation.triangles, out_.adaptation.trianglePatch);
      if (anyError(out_.adaptation.diagnostics)) co_return;
      layers.emplace(boundary_, input_.walls, input_.layers, base_->maxSize());
    }
  }

  /// Computes the metric at the nodes of the mesh.
  Task<> measure(Work& work, const LayerMetric& layers, std::vector<double>& metrics) {
    isLimited_ = false;
    work.beginPart(0.1);
    const std::vector<double> own = co_await impliedMetrics(work, current_);
    metrics.assign(own.size(), 0.0);
    GridTetId at{0U};
    work.beginPart(0.7);
    co_await work.forEachId<NodeId>(
        countNodes(current_),
        [&](NodeId node) {
          const Vec3 position = pointOf(current_, node);
          const SymmetricTensor base = base_->at(position, at);
          putTensor(metrics, node.index(),
                    layers.at(position, base, tensorAt(own, node.index()), isLimited_));
        },
        kNodesPerUnit);
    work.beginPart(0.8);
    const MeshEdges edges = co_await edgesOf(work, current_);
    work.beginPart(1.0);
    double growth = input_.layers.growth;
    for (const PatchLayers& wall : input_.walls) growth = std::max(growth, wall.growth - 1.0);
    co_await limitGrowth(work, current_, edges, growth, metrics);
  }

  Task<> adaptTo(Work& work, MetricMesh target) {
    MeshAdapter adapter(input_.mesh, std::move(target), input_.adaptation);
    while (!adapter.advance(work.remaining())) {
      if (input_.isStopped) adapter.stop();
      work.setFraction(adapter.fraction());
      co_await work.yield();
    }
    const MetricStatistics first = out_.adaptation.before;
    out_.adaptation = adapter.result();
    if (out_.cycles > 0) out_.adaptation.before = first;
    current_.points = out_.adaptation.points;
    current_.tetrahedra = out_.adaptation.tetrahedra;
    current_.regions = out_.adaptation.regions;
  }

  MakerInput& input_;
  LayeredMesh out_;
  VolumeMesh current_;
  SurfaceMesh boundary_;
  std::optional<MetricBackground> base_;
  bool isLimited_ = false;
};

Task<LayeredMesh> makeLayers(Work& work, MakerInput& input) {
  LayerCycles cycles(input);
  LayeredMesh made = co_await cycles.run(work);
  co_return made;
}

}  // namespace

LayerMaker::LayerMaker(AdaptInput mesh, MetricMesh background, const AdaptOptions& adaptation,
                       std::vector<PatchLayers> walls, const LayerOptions& options)
    : SlicedTool(makeToolJob<LayeredMesh>(MakerInput{std::move(mesh), std::move(background),
                                                     adaptation, std::move(walls), options, false},
                                          makeLayers)) {}

}  // namespace tetrafront
