/// @file Binds the engine to JavaScript; the only file that uses embind. It declares, converts and
/// forwards, and contains no logic of its own. No exception leaves it: a call that fails reports
/// the reason in failure() and returns an empty value.

#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "inspection_records.h"
#include "model_arrays.h"
#include "records.h"
#include "statistics_record.h"
#include "tetrafront/covering_grid.h"
#include "tetrafront/grid_from_mesh.h"
#include "tetrafront/mesh_inspection.h"
#include "tetrafront/mesher.h"
#include "tetrafront/preview.h"
#include "tetrafront/size_proposals.h"
#include "tetrafront/surface_tools.h"
#include "typed_arrays.h"

namespace tetrafront::border {
namespace {

MeshOptions toOptions(const Options& options) {
  MeshOptions result;
  result.size = options.size;
  result.growth = options.growth;
  result.gradation = options.gradation;
  result.innerShells = static_cast<InnerShells>(options.innerShells);
  result.order = static_cast<FrontOrder>(options.order);
  result.filters = options.filters;
  result.optimization = static_cast<Optimization>(options.optimization);
  result.exactFillOnly = options.exactFillOnly;
  return result;
}

/// Returns the result of `work`. If `work` throws, stores the reason in `failure` and returns
/// `otherwise`.
template <class Result, class Work>
Result guarded(std::string& failure, Result otherwise, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    failure = "out of memory";
  } catch (const std::exception& error) {
    failure = error.what();
  } catch (...) {
    failure = "unknown exception";
  }
  return otherwise;
}

/// MeshRun for JavaScript. After a failure, its methods return empty values.
class Run {
 public:
  Run(const ModelArrays& arrays, const Options& options) {
    start([&] { return MeshRun{toModel(arrays), toGrid(arrays.grid), toOptions(options)}; });
  }

  Run(const Float64Array& points, const Uint32Array& triangles, const GridArrays& grid,
      const Options& options) {
    start([&] {
      const auto xyz = copyIn<double>(points);
      const auto corners = copyIn<std::uint32_t>(triangles);
      return MeshRun{xyz, corners, toGrid(grid), toOptions(options)};
    });
  }

  std::uint32_t advance(std::uint32_t budget) {
    return static_cast<std::uint32_t>(
        read(MeshStatus::kInvalidInput, [&](MeshRun& run) { return run.advance(budget); }));
  }

  void cancel() {
    read(0, [](MeshRun& run) { return run.cancel(), 0; });
  }

  ProgressRecord progress() {
    return read(ProgressRecord{}, [](MeshRun& run) {
      const Progress p = run.progress();
      return ProgressRecord{.phase = static_cast<std::uint32_t>(p.phase),
                            .fraction = p.fraction,
                            .nodes = p.nodes,
                            .triangles = p.triangles,
                            .tetrahedra = p.tetrahedra,
                            .frontFaces = p.frontFaces,
                            .expectedTetrahedra = p.expectedTetrahedra,
                            .exactFillFraction = p.exactFillFraction};
    });
  }

  DiagnosticArrays diagnostics() {
    return read(DiagnosticArrays{}, [](MeshRun& run) { return toArrays(run.diagnostics()); });
  }

  SurfaceArrays surface() {
    return read(SurfaceArrays{}, [](MeshRun& run) {
      const SurfaceMesh& mesh = run.surface();
      return SurfaceArrays{.points = copyOut(mesh.points),
                           .triangles = copyOut(mesh.triangles),
                           .trianglePatch = copyOut(mesh.trianglePatch),
                           .triangleRegions = copyOut(mesh.triangleRegions),
                           .sides = copyOut(mesh.sides),
                           .sideLine = copyOut(mesh.sideLine)};
    });
  }

  VolumeArrays volume() {
    return read(VolumeArrays{}, [](MeshRun& run) {
      const VolumeMesh mesh = run.volume();
      return VolumeArrays{.points = copyOut(mesh.points),
                          .tetrahedra = copyOut(mesh.tetrahedra),
                          .regions = copyOut(mesh.regions),
                          .front = copyOut(mesh.front)};
    });
  }

  Float64Array front() {
    return read(copyOut(std::vector<double>{}), [](MeshRun& run) { return copyOut(run.front()); });
  }

  QualitySummary quality() {
    return read(QualitySummary{}, [](MeshRun& run) { return run.quality(); });
  }

  StatisticsRecord statistics() {
    return read(StatisticsRecord{}, [](MeshRun& run) { return toRecord(run.statistics()); });
  }

  PatchSummaries patches() {
    return read(PatchSummaries{emscripten::val::array()},
                [](MeshRun& run) { return toSummaries(run.patchSummaries()); });
  }

  RecoverySummary recovery() {
    return read(RecoverySummary{}, [](MeshRun& run) { return run.recovery(); });
  }

  CounterRecord counters() {
    return read(CounterRecord{}, [](MeshRun& run) {
      const FrontCounters c = run.counters();
      return CounterRecord{.pops = static_cast<double>(c.pops),
                           .gatheredFaces = static_cast<double>(c.gatheredFaces),
                           .candidatesTried = static_cast<double>(c.candidatesTried),
                           .facesTested = static_cast<double>(c.facesTested),
                           .facesAnalysed = static_cast<double>(c.facesAnalysed),
                           .exactPredicates = static_cast<double>(c.exactPredicates)};
    });
  }

  bool hasFoundNothingBetter() {
    return read(false, [](MeshRun& run) { return run.hasFoundNothingBetter(); });
  }

  std::string fingerprint() {
    return read(std::string{}, [](MeshRun& run) { return toHex(run.fingerprint()); });
  }

  [[nodiscard]] std::string failure() const { return failure_; }

 private:
  template <class Make>
  void start(const Make& make) {
    run_ = guarded(failure_, std::unique_ptr<MeshRun>{},
                   [&] { return std::make_unique<MeshRun>(make()); });
  }

  template <class Result, class Work>
  Result read(Result otherwise, const Work& work) {
    if (!run_ || !failure_.empty()) return otherwise;
    return guarded(failure_, std::move(otherwise), [&] { return work(*run_); });
  }

  std::unique_ptr<MeshRun> run_;
  std::string failure_;
};

/// Tool that works in slices, for JavaScript. After a failure, it counts as finished and its result
/// is empty.
template <class Tool, class Record>
class Stepwise {
 public:
  template <class... Arguments>
  explicit Stepwise(const Arguments&... arguments) {
    tool_ = guarded(failure_, std::unique_ptr<Tool>{},
                    [&] { return std::make_unique<Tool>(arguments()...); });
  }

  bool advance(std::uint32_t budget) {
    if (!tool_ || !failure_.empty()) return true;
    return guarded(failure_, true, [&] { return tool_->advance(budget); });
  }

  double fraction() {
    if (!tool_ || !failure_.empty()) return 1.0;
    return tool_->fraction();
  }

  Record result() {
    if (!tool_ || !failure_.empty()) return {};
    return guarded(failure_, Record{}, [&] { return toRecord(tool_->result()); });
  }

  [[nodiscard]] std::string failure() const { return failure_; }

 private:
  std::unique_ptr<Tool> tool_;
  std::string failure_;
};

using Inspection = Stepwise<SurfaceInspector, SurfaceInspectionRecord>;
using VolumeInspection = Stepwise<MeshInspector, MeshInspectionRecord>;
using Repair = Stepwise<SurfaceRepairer, RepairRecord>;
using Refinement = Stepwise<SurfaceRefiner, RefinementRecord>;
using Preview = Stepwise<ModelPreviewer, PreviewRecord>;
using Cover = Stepwise<CoveringGridBuilder, GridRecord>;
using Proposal = Stepwise<SizeProposer, ProposalRecord>;
using BackgroundFromMesh = Stepwise<MeshGridBuilder, GridRecord>;

/// Returns the size of the engine's heap in bytes; it never shrinks.
double memoryBytes() { return static_cast<double>(emscripten_get_heap_size()); }

/// These functions return raw pointers, which embind transfers to JavaScript; call delete() there
/// to destroy the object.
Run* meshModel(const ModelArrays& arrays, const Options& options) {
  return std::make_unique<Run>(arrays, options).release();
}

Run* fillSurface(const Float64Array& points, const Uint32Array& triangles, const GridArrays& grid,
                 const Options& options) {
  return std::make_unique<Run>(points, triangles, grid, options).release();
}

/// Copies an array inside the guarded construction of a tool, so that running out of memory becomes
/// a failure of the tool.
template <class Value, class Array>
auto copiedIn(const Array& array) {
  return [&array] { return copyIn<Value>(array); };
}

Inspection* inspectSurface(const Float64Array& points, const Uint32Array& triangles,
                           int innerShells, std::uint32_t maxDiagnostics) {
  const InspectionOptions options{.innerShells = static_cast<InnerShells>(innerShells),
                                  .maxDiagnostics = maxDiagnostics};
  return std::make_unique<Inspection>(copiedIn<double>(points), copiedIn<std::uint32_t>(triangles),
                                      [&options] { return options; })
      .release();
}

VolumeInspection* inspectMesh(const Float64Array& points, const Uint32Array& tetrahedra,
                              const Uint32Array& regions) {
  return std::make_unique<VolumeInspection>(copiedIn<double>(points),
                                            copiedIn<std::uint32_t>(tetrahedra),
                                            copiedIn<std::uint32_t>(regions))
      .release();
}

Repair* repairSurface(const Float64Array& points, const Uint32Array& triangles,
                      const RepairOptions& options) {
  return std::make_unique<Repair>(copiedIn<double>(points), copiedIn<std::uint32_t>(triangles),
                                  [&options] { return options; })
      .release();
}

Refinement* refineSurface(const Float64Array& points, const Uint32Array& triangles,
                          const GridArrays& grid, const Options& options, double volume) {
  return std::make_unique<Refinement>(
             copiedIn<double>(points), copiedIn<std::uint32_t>(triangles),
             [&grid] { return toGrid(grid); }, [&options] { return toOptions(options); },
             [volume] { return volume; })
      .release();
}

Preview* previewModel(const ModelArrays& arrays, const Options& options) {
  return std::make_unique<Preview>([&arrays] { return toModel(arrays); },
                                   [&arrays] { return toGrid(arrays.grid); },
                                   [&options] { return toOptions(options); })
      .release();
}

Cover* cover(const ModelArrays& arrays, double size, std::uint32_t shape) {
  return std::make_unique<Cover>([&arrays] { return toModel(arrays); }, [size] { return size; },
                                 [shape] { return static_cast<CoverShape>(shape); })
      .release();
}

Proposal* propose(const ModelArrays& arrays, const ProposalOptions& options) {
  return std::make_unique<Proposal>([&arrays] { return toModel(arrays); },
                                    [&options] { return options; })
      .release();
}

BackgroundFromMesh* backgroundFromMesh(const Float64Array& points, const Uint32Array& tetrahedra,
                                       const Float64Array& sizes) {
  const auto mesh = [&] {
    VolumeMesh copy;
    copy.points = copyIn<double>(points);
    copy.tetrahedra = copyIn<std::uint32_t>(tetrahedra);
    return copy;
  };
  return std::make_unique<BackgroundFromMesh>(mesh, copiedIn<double>(sizes)).release();
}

template <class Tool>
void registerStepwise(const char* name) {
  emscripten::class_<Tool>(name)
      .function("advance", &Tool::advance)
      .function("fraction", &Tool::fraction)
      .function("result", &Tool::result)
      .function("failure", &Tool::failure);
}

}  // namespace
}  // namespace tetrafront::border

EMSCRIPTEN_BINDINGS(tetrafront) {
  using namespace emscripten;
  using namespace tetrafront;
  using namespace tetrafront::border;

  register_type<Float64Array>("Float64Array");
  register_type<Uint32Array>("Uint32Array");
  register_type<Uint8Array>("Uint8Array");
  register_type<PatchSummaries>("PatchSummary[]");

  value_object<GridArrays>("GridArrays")
      .field("nodes", &GridArrays::nodes)
      .field("tetrahedra", &GridArrays::tetrahedra)
      .field("sourceTypes", &GridArrays::sourceTypes)
      .field("sourceValues", &GridArrays::sourceValues)
      .field("coverageMargin", &GridArrays::coverageMargin);
  value_object<ModelArrays>("ModelArrays")
      .field("points", &ModelArrays::points)
      .field("lineTypes", &ModelArrays::lineTypes)
      .field("lineOffsets", &ModelArrays::lineOffsets)
      .field("linePoints", &ModelArrays::linePoints)
      .field("patchTypes", &ModelArrays::patchTypes)
      .field("patchOffsets", &ModelArrays::patchOffsets)
      .field("loopOffsets", &ModelArrays::loopOffsets)
      .field("loopLines", &ModelArrays::loopLines)
      .field("grid", &ModelArrays::grid);
  value_object<Options>("Options")
      .field("size", &Options::size)
      .field("growth", &Options::growth)
      .field("gradation", &Options::gradation)
      .field("innerShells", &Options::innerShells)
      .field("order", &Options::order)
      .field("filters", &Options::filters)
      .field("optimization", &Options::optimization)
      .field("exactFillOnly", &Options::exactFillOnly);
  value_object<DiagnosticArrays>("DiagnosticArrays")
      .field("heads", &DiagnosticArrays::heads)
      .field("entities", &DiagnosticArrays::entities)
      .field("positions", &DiagnosticArrays::positions)
      .field("values", &DiagnosticArrays::values);
  value_object<SurfaceArrays>("SurfaceArrays")
      .field("points", &SurfaceArrays::points)
      .field("triangles", &SurfaceArrays::triangles)
      .field("trianglePatch", &SurfaceArrays::trianglePatch)
      .field("triangleRegions", &SurfaceArrays::triangleRegions)
      .field("sides", &SurfaceArrays::sides)
      .field("sideLine", &SurfaceArrays::sideLine);
  value_object<VolumeArrays>("VolumeArrays")
      .field("points", &VolumeArrays::points)
      .field("tetrahedra", &VolumeArrays::tetrahedra)
      .field("regions", &VolumeArrays::regions)
      .field("front", &VolumeArrays::front);
  value_object<ProgressRecord>("ProgressRecord")
      .field("phase", &ProgressRecord::phase)
      .field("fraction", &ProgressRecord::fraction)
      .field("nodes", &ProgressRecord::nodes)
      .field("triangles", &ProgressRecord::triangles)
      .field("tetrahedra", &ProgressRecord::tetrahedra)
      .field("frontFaces", &ProgressRecord::frontFaces)
      .field("expectedTetrahedra", &ProgressRecord::expectedTetrahedra)
      .field("exactFillFraction", &ProgressRecord::exactFillFraction);
  value_object<PreviewRecord>("PreviewRecord")
      .field("linePoints", &PreviewRecord::linePoints)
      .field("lineOffsets", &PreviewRecord::lineOffsets)
      .field("patchPoints", &PreviewRecord::patchPoints)
      .field("patchTriangles", &PreviewRecord::patchTriangles)
      .field("patchOffsets", &PreviewRecord::patchOffsets)
      .field("diagnostics", &PreviewRecord::diagnostics);
  value_object<GridRecord>("GridRecord")
      .field("points", &GridRecord::points)
      .field("sizes", &GridRecord::sizes)
      .field("tetrahedra", &GridRecord::tetrahedra)
      .field("coverageMargin", &GridRecord::coverageMargin);
  value_object<ProposalOptions>("ProposalOptions")
      .field("uniform", &ProposalOptions::uniform)
      .field("smallest", &ProposalOptions::smallest)
      .field("elementsPerCircle", &ProposalOptions::elementsPerCircle)
      .field("elementsPerGap", &ProposalOptions::elementsPerGap)
      .field("growth", &ProposalOptions::growth);
  value_object<ProposalRecord>("ProposalRecord")
      .field("size", &ProposalRecord::size)
      .field("sourceTypes", &ProposalRecord::sourceTypes)
      .field("sourceValues", &ProposalRecord::sourceValues);
  value_object<StatisticsRecord>("StatisticsRecord")
      .field("regions", &StatisticsRecord::regions)
      .field("bins", &StatisticsRecord::bins)
      .field("worst", &StatisticsRecord::worst)
      .field("worstLimited", &StatisticsRecord::worstLimited)
      .field("smallest", &StatisticsRecord::smallest)
      .field("volumeRatio", &StatisticsRecord::volumeRatio)
      .field("meanEdge", &StatisticsRecord::meanEdge)
      .field("meanEdgeOfAchievable", &StatisticsRecord::meanEdgeOfAchievable)
      .field("edgesNearTarget", &StatisticsRecord::edgesNearTarget)
      .field("outOfRange", &StatisticsRecord::outOfRange)
      .field("limitedByBoundary", &StatisticsRecord::limitedByBoundary)
      .field("limitedByEdges", &StatisticsRecord::limitedByEdges)
      .field("limitedByNeedles", &StatisticsRecord::limitedByNeedles)
      .field("limitedByNarrowGaps", &StatisticsRecord::limitedByNarrowGaps);
  value_object<PatchSummary>("PatchSummary")
      .field("patch", &PatchSummary::patch)
      .field("triangles", &PatchSummary::triangles)
      .field("minAngle", &PatchSummary::minAngle)
      .field("meanRadiusRatio", &PatchSummary::meanRadiusRatio)
      .field("meanEdge", &PatchSummary::meanEdge)
      .field("chordDeviation", &PatchSummary::chordDeviation);
  value_object<QualitySummary>("QualitySummary")
      .field("minDihedral", &QualitySummary::minDihedral)
      .field("maxDihedral", &QualitySummary::maxDihedral)
      .field("minRadiusRatio", &QualitySummary::minRadiusRatio)
      .field("meanRadiusRatio", &QualitySummary::meanRadiusRatio)
      .field("volume", &QualitySummary::volume);
  value_object<RepairOptions>("RepairOptions")
      .field("weldDistance", &RepairOptions::weldDistance)
      .field("removeTriangles", &RepairOptions::removeTriangles)
      .field("maxHoleEdges", &RepairOptions::maxHoleEdges)
      .field("orient", &RepairOptions::orient)
      .field(
          "innerShells",
          +[](const RepairOptions& options) { return static_cast<int>(options.innerShells); },
          +[](RepairOptions& options, int innerShells) {
            options.innerShells = static_cast<InnerShells>(innerShells);
          });
  value_object<SurfaceInspectionRecord>("SurfaceInspectionRecord")
      .field("isFillable", &SurfaceInspectionRecord::isFillable)
      .field("isClosed", &SurfaceInspectionRecord::isClosed)
      .field("isManifold", &SurfaceInspectionRecord::isManifold)
      .field("isEmbedded", &SurfaceInspectionRecord::isEmbedded)
      .field("nodes", &SurfaceInspectionRecord::nodes)
      .field("unusedNodes", &SurfaceInspectionRecord::unusedNodes)
      .field("triangles", &SurfaceInspectionRecord::triangles)
      .field("edges", &SurfaceInspectionRecord::edges)
      .field("openEdges", &SurfaceInspectionRecord::openEdges)
      .field("nonManifoldEdges", &SurfaceInspectionRecord::nonManifoldEdges)
      .field("nonManifoldNodes", &SurfaceInspectionRecord::nonManifoldNodes)
      .field("flippedTriangles", &SurfaceInspectionRecord::flippedTriangles)
      .field("regions", &SurfaceInspectionRecord::regions)
      .field("box", &SurfaceInspectionRecord::box)
      .field("area", &SurfaceInspectionRecord::area)
      .field("volume", &SurfaceInspectionRecord::volume)
      .field("edgeLengths", &SurfaceInspectionRecord::edgeLengths)
      .field("shells", &SurfaceInspectionRecord::shells)
      .field("worst", &SurfaceInspectionRecord::worst)
      .field("diagnostics", &SurfaceInspectionRecord::diagnostics);
  value_object<RepairRecord>("RepairRecord")
      .field("points", &RepairRecord::points)
      .field("triangles", &RepairRecord::triangles)
      .field("origin", &RepairRecord::origin)
      .field("kinds", &RepairRecord::kinds)
      .field("subjects", &RepairRecord::subjects)
      .field("positions", &RepairRecord::positions)
      .field("diagnostics", &RepairRecord::diagnostics);
  value_object<RefinementRecord>("RefinementRecord")
      .field("points", &RefinementRecord::points)
      .field("triangles", &RefinementRecord::triangles)
      .field("origin", &RefinementRecord::origin)
      .field("splitEdges", &RefinementRecord::splitEdges)
      .field("diagnostics", &RefinementRecord::diagnostics);
  value_object<MeshInspectionRecord>("MeshInspectionRecord")
      .field("isReadable", &MeshInspectionRecord::isReadable)
      .field("nodes", &MeshInspectionRecord::nodes)
      .field("unusedNodes", &MeshInspectionRecord::unusedNodes)
      .field("tetrahedra", &MeshInspectionRecord::tetrahedra)
      .field("invertedTetrahedra", &MeshInspectionRecord::invertedTetrahedra)
      .field("degenerateTetrahedra", &MeshInspectionRecord::degenerateTetrahedra)
      .field("duplicateTetrahedra", &MeshInspectionRecord::duplicateTetrahedra)
      .field("nonManifoldFaces", &MeshInspectionRecord::nonManifoldFaces)
      .field("overlappingFaces", &MeshInspectionRecord::overlappingFaces)
      .field("coincidentNodes", &MeshInspectionRecord::coincidentNodes)
      .field("edgeLengths", &MeshInspectionRecord::edgeLengths)
      .field("quality", &MeshInspectionRecord::quality)
      .field("statistics", &MeshInspectionRecord::statistics)
      .field("boundary", &MeshInspectionRecord::boundary)
      .field("boundaryRegion", &MeshInspectionRecord::boundaryRegion);
  value_object<RecoverySummary>("RecoverySummary")
      .field("relaxed", &RecoverySummary::relaxed)
      .field("starred", &RecoverySummary::starred)
      .field("remeshed", &RecoverySummary::remeshed)
      .field("filled", &RecoverySummary::filled)
      .field("steinerPoints", &RecoverySummary::steinerPoints);
  value_object<CounterRecord>("CounterRecord")
      .field("pops", &CounterRecord::pops)
      .field("gatheredFaces", &CounterRecord::gatheredFaces)
      .field("candidatesTried", &CounterRecord::candidatesTried)
      .field("facesTested", &CounterRecord::facesTested)
      .field("facesAnalysed", &CounterRecord::facesAnalysed)
      .field("exactPredicates", &CounterRecord::exactPredicates);

  class_<Run>("Run")
      .function("advance", &Run::advance)
      .function("cancel", &Run::cancel)
      .function("progress", &Run::progress)
      .function("diagnostics", &Run::diagnostics)
      .function("surface", &Run::surface)
      .function("volume", &Run::volume)
      .function("front", &Run::front)
      .function("quality", &Run::quality)
      .function("statistics", &Run::statistics)
      .function("patches", &Run::patches)
      .function("recovery", &Run::recovery)
      .function("counters", &Run::counters)
      .function("hasFoundNothingBetter", &Run::hasFoundNothingBetter)
      .function("fingerprint", &Run::fingerprint)
      .function("failure", &Run::failure);

  registerStepwise<Inspection>("Inspection");
  registerStepwise<VolumeInspection>("VolumeInspection");
  registerStepwise<Repair>("Repair");
  registerStepwise<Refinement>("Refinement");
  registerStepwise<Preview>("Preview");
  registerStepwise<Cover>("Cover");
  registerStepwise<Proposal>("Proposal");
  registerStepwise<BackgroundFromMesh>("BackgroundFromMesh");

  function("meshModel", &meshModel, allow_raw_pointers());
  function("fillSurface", &fillSurface, allow_raw_pointers());
  function("inspectSurface", &inspectSurface, allow_raw_pointers());
  function("inspectMesh", &border::inspectMesh, allow_raw_pointers());
  function("repairSurface", &border::repairSurface, allow_raw_pointers());
  function("refineSurface", &refineSurface, allow_raw_pointers());
  function("previewModel", &border::previewModel, allow_raw_pointers());
  function("cover", &cover, allow_raw_pointers());
  function("propose", &propose, allow_raw_pointers());
  function("backgroundFromMesh", &backgroundFromMesh, allow_raw_pointers());
  function("memoryBytes", &memoryBytes);
}
