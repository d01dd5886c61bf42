#include "tetrafront/mesh_adaptation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "adapt/adapt_input.h"
#include "adapt/adapt_result.h"
#include "adapt/adapt_schedule.h"
#include "adapt/adapt_start.h"
#include "adapt/metric_background.h"
#include "adapt/restart.h"
#include "adapt/true_boundary.h"
#include "base/diagnostics.h"
#include "base/tool_job.h"
#include "field/check_background_grid.h"
#include "model/model_numbers.h"
#include "optimize/given_mesh.h"
#include "quality/verify_mesh.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Cosine of the smallest angle of a crease where the boundary approximates the faces of a model: these are smooth, so only coarse
/// triangles have angles inside a patch.
constexpr double kCreaseInFace = 0.5;

/// A background mesh with more unit edges than this part is nearly adapted to its metrics.
constexpr double kAdaptedUnitEdges = 0.5;

/// What MeshAdapter was given.
struct AdapterInput {
  AdaptInput mesh;
  MetricMesh background;
  AdaptOptions options;
  bool isStopped = false;  ///< the member that makeToolJob() sets
};

bool isUsable(const AdapterInput& input) {
  return isUsable(input.mesh) && isUsable(input.background) && isUsable(input.options);
}

/// Returns whether a mesh has one region, no face that is kept inside and no node where it touches itself.
bool isOneBody(const GivenMesh& mesh, std::span<const std::uint8_t> isRepeated) {
  const std::vector<std::uint32_t>& regions = mesh.surface.triangleRegions;
  bool hasInside = mesh.regionOfPart.size() > 1 ||
                   std::ranges::find(isRepeated, std::uint8_t{1}) != isRepeated.end();
  for (std::size_t t = 0; 2 * t < regions.size(); ++t)
    hasInside = hasInside || regions[2 * t + 1] != SurfaceMesh::kNoRegion;
  return !hasInside;
}

/// Makes and improves the mesh of one job.
class Adaptation {
 public:
  explicit Adaptation(AdapterInput& input) : input_(input) {}

  Task<MeshAdaptation> run(Work& work) {
    out_.isReadable = isUsable(input_);
    if (!out_.isReadable) co_return std::move(out_);
    VolumeMesh mesh;
    mesh.points = input_.mesh.points;
    mesh.tetrahedra = input_.mesh.tetrahedra;
    mesh.regions = input_.mesh.regions;
    mesh.regions.resize(countTetrahedra(mesh), 0);
    work.beginPart(0.02);
    const GivenMesh given = co_await prepareGivenMesh(work, mesh, input_.mesh.triangles);
    out_.diagnostics = given.diagnostics;
    if (anyError(out_.diagnostics)) co_return std::move(out_);
    const BackgroundGrid grid = locatorGridOf(input_.background);
    work.beginPart(0.025);
    out_.diagnostics = co_await checkBackgroundGrid(work, grid);
    if (anyError(out_.diagnostics)) co_return std::move(out_);
    work.beginPart(0.03);
    MetricBackground background =
        co_await MetricBackground::build(work, grid, input_.background.metrics);
    work.beginPart(0.04);
    StartFaces faces =
        co_await findStartFaces(work, given, input_.mesh.triangles, input_.mesh.trianglePatch);
    const std::vector<std::uint8_t> isRepeated = nodesInSeveralSets(given, faces);
    for (std::size_t i = 0; i < isRepeated.size(); ++i) faces.isFixed[i] |= isRepeated[i];
    const std::optional<ReadModel> model =
        input_.mesh.model.empty() ? std::nullopt : readModel(input_.mesh.model);
    FeatureRules rules;
    if (model) rules.creaseCosine = kCreaseInFace;
    ReferenceSurface reference(faces.boundary, rules);
    work.beginPart(0.05);
    co_await reference.prepare(work);
    std::optional<TrueBoundary> truth;
    if (model) truth.emplace(reference, *model, input_.mesh.modelTriangles);
    work.beginPart(0.055);
    if (truth) co_await truth->prepare(work);
    const BoundaryGuide guide(reference, faces.isFixed, truth ? &*truth : nullptr);
    AdaptStart start = makeStart(given, faces, placesOnReference(guide));
    work.beginPart(0.06);
    out_.before = co_await measure(work, start.mesh, guide, background);
    RestartMesh restart;
    work.beginPart(0.08);
    if (isOneBody(given, isRepeated))
      restart = co_await findRestart(work, input_.background, guide);
    if (restart.fits) {
      restart.given.regionOfPart = given.regionOfPart;
      AdaptStart other = makeStart(restart.given, restart.faces, restart.places);
      work.beginPart(0.09);
      const MetricStatistics found = co_await measure(work, other.mesh, guide, background);
      restart.fits = found.unitEdges > out_.before.unitEdges;
      if (restart.fits && found.unitEdges > kAdaptedUnitEdges) background.setAdapted();
      if (restart.fits) start = std::move(other);
    }
    work.beginPart(0.98);
    co_await adapt(work, start.mesh, guide, background);
    work.beginPart(1.0);
    co_await finishWith(work, start, restart.fits ? restart.given : given, guide);
    co_return std::move(out_);
  }

 private:
  Task<MetricStatistics> measure(Work& work, AdaptMesh& mesh, const BoundaryGuide& guide,
                                 MetricBackground& background) {
    Badness badness(input_.options.leastQuality);
    AdaptSchedule schedule(mesh, guide, background, badness, 0, input_.isStopped);
    co_await schedule.measureAll(work);
    MetricStatistics found = co_await measureInMetric(work, mesh);
    co_return found;
  }

  Task<> adapt(Work& work, AdaptMesh& mesh, const BoundaryGuide& guide,
               MetricBackground& background) {
    Badness badness(input_.options.leastQuality);
    AdaptSchedule schedule(mesh, guide, background, badness, input_.options.sweeps,
                           input_.isStopped);
    co_await schedule.run(work);
    out_.isPartial = input_.isStopped;
    work.beginPart(1.0);
    out_.after = co_await measureInMetric(work, mesh);
  }

  /// Returns the patches of the kept triangles, in the order of the surface of the given mesh.
  [[nodiscard]] std::vector<std::uint32_t> patchesOfKept(const GivenMesh& given) const;

  Task<> finishWith(Work& work, const AdaptStart& start, const GivenMesh& given,
                    const BoundaryGuide& guide) {
    AdaptedMesh made = takeAdapted(start, given, guide, patchesOfKept(given));
    MeshVerifier verifier(made.mesh, made.surface);
    co_await work.finish(verifier);
    const MeshDefects& defects = verifier.defects();
    const std::uint64_t count = defects.count() - defects.coincidentNodes;
    if (count > 0) {
      out_.diagnostics.push_back(
          diagnose<DiagnosticCode::kVerificationFailed>(count).about(defects.examples));
      co_return;
    }
    out_.points = std::move(made.mesh.points);
    out_.tetrahedra = std::move(made.mesh.tetrahedra);
    for (const std::uint32_t part : made.mesh.regions)
      out_.regions.push_back(given.regionOfPart[part]);
    out_.triangles = std::move(made.surface.triangles);
    out_.trianglePatch = std::move(made.surface.trianglePatch);
    out_.metrics = std::move(made.metrics);
  }

  AdapterInput& input_;
  MeshAdaptation out_;
};

std::vector<std::uint32_t> Adaptation::patchesOfKept(const GivenMesh& given) const {
  const PatchTable patches(input_.mesh.triangles, input_.mesh.trianglePatch);
  std::vector<std::uint32_t> kept;
  for (std::size_t t = 0; 3 * t < given.surface.triangles.size(); ++t) {
    if (given.surface.triangleRegions[2 * t + 1] == SurfaceMesh::kNoRegion) continue;
    std::array<std::uint32_t, 3> nodes{};
    for (std::size_t k = 0; k < 3; ++k)
      nodes[k] = given.nodeOrigin[given.surface.triangles[3 * t + k]];
    kept.push_back(patches.patchOf(nodes));
  }
  return kept;
}

Task<MeshAdaptation> runAdaptation(Work& work, AdapterInput& input) {
  Adaptation adaptation(input);
  MeshAdaptation made = co_await adaptation.run(work);
  co_return made;
}

}  // namespace

MeshAdapter::MeshAdapter(AdaptInput input, MetricMesh background, const AdaptOptions& options)
    : SlicedTool(makeToolJob<MeshAdaptation>(
          AdapterInput{std::move(input), std::move(background), options, false}, runAdaptation)) {}

}  // namespace tetrafront
