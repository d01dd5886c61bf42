#include "tetrafront/size_samples.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/diagnostics.h"
#include "base/resumable.h"
#include "base/task.h"
#include "base/tool_job.h"
#include "boundary/boundary.h"
#include "geom/cube_root.h"
#include "preview/check_input.h"
#include "sizing/expected_count.h"
#include "sizing/target_sizes.h"

namespace tetrafront {
namespace {

/// Positions per unit of work: one query of the field costs far less than one step of the front.
constexpr std::size_t kPositionsPerUnit = 16;

struct SampleInput {
  Model model;
  BodySurfaces bodies;
  BackgroundGrid grid;
  MeshOptions options;
  std::vector<double> positions;
};

/// Appends the triangles of the bodies to a surface.
void append(SurfaceMesh& surface, const BodySurfaces& bodies) {
  const auto nodes = static_cast<std::uint32_t>(surface.points.size() / 3);
  surface.points.insert(surface.points.end(), bodies.points.begin(), bodies.points.end());
  for (const std::uint32_t node : bodies.triangles) surface.triangles.push_back(nodes + node);
  surface.trianglePatch.assign(surface.triangles.size() / 3, 0);
}

/// Returns the sizes of a surface with bodies, as a run finds them; nothing if they are invalid.
Task<std::optional<SizeField>> fieldOfBodies(Work& work, const SurfaceMesh& surface,
                                             const SampleInput& input) {
  const std::vector<Diagnostic> found = co_await checkTargetGrid(work, input.grid, input.options);
  if (anyError(found) || surface.triangles.empty()) co_return std::nullopt;
  TargetSizes target(surface, input.grid, input.options, EdgeSizes::kCount);
  co_await work.finish(target);
  co_return target.take();
}

Task<> sampleField(Work& work, const SizeField& field, const std::vector<double>& positions,
                   std::vector<double>& sizes) {
  sizes.reserve(positions.size() / 3);
  FieldHint hint;
  const auto visit = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 at(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
      sizes.push_back(cubeRoot(field.tensorAt(at, hint).determinant()));
    }
  };
  co_await work.forEachBlock(positions.size() / 3, visit, kPositionsPerUnit);
}

Task<SizeSamples> takeSamples(Work& work, const SampleInput& input) {
  SizeSamples samples;
  work.beginPart(0.5);
  CheckedInput checked = co_await checkInput(work, input.model, input.grid, input.options);
  std::optional<SizeField> field = std::move(checked.field);
  SurfaceMesh surface = std::move(checked.boundary);
  // Drawn patches that enclose nothing yet cannot be meshed with the bodies.
  bool isClosed = !surface.triangles.empty() || input.model.patches.empty();
  if (!input.bodies.triangles.empty()) {
    work.beginPart(0.8);
    append(surface, input.bodies);
    BoundaryCheck boundary(surface, BoundarySource::kDrawnPatches, input.options.innerShells);
    co_await work.finish(boundary);
    isClosed = isClosed && boundary.result().isValid;
    if (boundary.result().isValid) {
      std::optional<SizeField> ofBodies = co_await fieldOfBodies(work, surface, input);
      field = std::move(ofBodies);
    }
  }
  if (!field) co_return samples;
  work.beginPart(1.0);
  co_await sampleField(work, *field, input.positions, samples.sizes);
  if (!isClosed || surface.triangles.empty()) co_return samples;
  // The samples of a drawn model may face inward as a whole.
  const double expected = tetrahedraWithin(std::fabs(enclosedVolume(surface)), surface, *field);
  samples.tetrahedra = cappedCount(expected);
  co_return samples;
}

}  // namespace

SizeSampler::SizeSampler(Model model, BodySurfaces bodies, BackgroundGrid grid,
                         const MeshOptions& options, std::vector<double> positions)
    : SlicedTool(
          makeToolJob<SizeSamples>(SampleInput{std::move(model), std::move(bodies), std::move(grid),
                                               options, std::move(positions)},
                                   takeSamples)) {}

SizeSamples sampleSizes(const Model& model, const BodySurfaces& bodies, const BackgroundGrid& grid,
                        const MeshOptions& options, const std::vector<double>& positions) {
  SizeSampler sampler(model, bodies, grid, options, positions);
  finish(sampler);
  return sampler.result();
}

}  // namespace tetrafront
