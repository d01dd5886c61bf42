/// @file The narrow door between the engine and JavaScript, and the only file that knows embind.
/// It declares, converts and forwards; it decides nothing. Nothing thrown here crosses the border:
/// a call that fails says so in failure() and returns an empty value.

#include <emscripten/bind.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "model_arrays.h"
#include "tetrafront/mesher.h"
#include "typed_arrays.h"

namespace tetrafront::border {
namespace {

struct Options {
  double size = 0.0;
  double growth = 0.0;
  double gradation = 0.0;
  std::uint32_t order = 0;
  std::uint32_t optimization = 0;
};

struct DiagnosticRecord {
  std::uint32_t code = 0;
  std::uint32_t severity = 0;
  Uint32Array entities{emscripten::val::undefined()};
  Float64Array place{emscripten::val::undefined()};
  Float64Array values{emscripten::val::undefined()};
};

/// A JavaScript array of DiagnosticRecord.
EMSCRIPTEN_DECLARE_VAL_TYPE(DiagnosticRecords)
/// A JavaScript string; std::string as a field would be declared as anything string-like.
EMSCRIPTEN_DECLARE_VAL_TYPE(Text)

struct SurfaceArrays {
  Float64Array points = copyOut(std::vector<double>{});
  Uint32Array triangles = copyOut(std::vector<std::uint32_t>{});
  Uint32Array trianglePatch = triangles;
  Uint32Array sides = triangles;
  Uint32Array sideLine = triangles;
};

struct VolumeArrays {
  Float64Array points = copyOut(std::vector<double>{});
  Uint32Array tetrahedra = copyOut(std::vector<std::uint32_t>{});
  Uint32Array regions = tetrahedra;
  Uint32Array front = tetrahedra;
};

struct ProgressRecord {
  std::uint32_t phase = 0;
  double fraction = 0.0;
  std::uint32_t points = 0;
  std::uint32_t triangles = 0;
  std::uint32_t tetrahedra = 0;
  std::uint32_t frontFaces = 0;
};

struct PreviewArrays {
  Float64Array linePoints = copyOut(std::vector<double>{});
  Uint32Array lineOffsets = copyOut(std::vector<std::uint32_t>{});
  Float64Array patchPoints = linePoints;
  Uint32Array patchTriangles = lineOffsets;
  Uint32Array patchOffsets = lineOffsets;
  DiagnosticRecords diagnostics{emscripten::val::array()};
  Text failure{emscripten::val("")};
};

/// FrontCounters as JavaScript numbers, exact up to 2^53.
struct CounterRecord {
  double pops = 0.0;
  double gatheredFaces = 0.0;
  double candidatesTried = 0.0;
  double facesTested = 0.0;
  double facesAnalysed = 0.0;
  double exactPredicates = 0.0;
};

MeshOptions toOptions(const Options& options) {
  MeshOptions result;
  result.size = options.size;
  result.growth = options.growth;
  result.gradation = options.gradation;
  result.order = static_cast<FrontOrder>(options.order);
  result.optimization = static_cast<Optimization>(options.optimization);
  return result;
}

DiagnosticRecord toRecord(const Diagnostic& diagnostic) {
  std::vector<std::uint32_t> entities;
  for (const Entity& entity : diagnostic.entities) {
    entities.push_back(static_cast<std::uint32_t>(entity.kind));
    entities.push_back(entity.index);
  }
  std::vector<double> place;
  if (diagnostic.hasPlace) {
    place = {diagnostic.place.x, diagnostic.place.y, diagnostic.place.z};
  }
  return {.code = static_cast<std::uint32_t>(diagnostic.code),
          .severity = static_cast<std::uint32_t>(diagnostic.severity),
          .entities = copyOut(entities),
          .place = copyOut(place),
          .values = copyOut(diagnostic.values)};
}

DiagnosticRecords toRecords(const std::vector<Diagnostic>& diagnostics) {
  auto records = emscripten::val::array();
  for (const Diagnostic& diagnostic : diagnostics) {
    records.call<void>("push", toRecord(diagnostic));
  }
  return DiagnosticRecords{records};
}

/// Sixteen hexadecimal digits: a 64-bit number does not fit a JavaScript number.
std::string toHex(std::uint64_t value) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4) {
    *digit = kDigits[value & 15];
  }
  return text;
}

/// Runs `work`; whatever it throws is put into `failure` in words and `otherwise` is returned.
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

/// MeshRun as JavaScript sees it. After a failure it answers with empty values.
class Run {
 public:
  Run(const ModelArrays& arrays, const Options& options) {
    start([&] { return MeshRun{toModel(arrays), toGrid(arrays), toOptions(options)}; });
  }

  Run(const Float64Array& points, const Uint32Array& triangles, const Options& options) {
    start([&] {
      const auto xyz = copyIn<double>(points);
      const auto corners = copyIn<std::uint32_t>(triangles);
      return MeshRun{xyz, corners, toOptions(options)};
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
                            .points = p.points,
                            .triangles = p.triangles,
                            .tetrahedra = p.tetrahedra,
                            .frontFaces = p.frontFaces};
    });
  }

  DiagnosticRecords diagnostics() {
    return read(DiagnosticRecords{emscripten::val::array()},
                [](MeshRun& run) { return toRecords(run.diagnostics()); });
  }

  SurfaceArrays surface() {
    return read(SurfaceArrays{}, [](MeshRun& run) {
      const SurfaceMesh& mesh = run.surface();
      return SurfaceArrays{.points = copyOut(mesh.points),
                           .triangles = copyOut(mesh.triangles),
                           .trianglePatch = copyOut(mesh.trianglePatch),
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

  QualitySummary quality() {
    return read(QualitySummary{}, [](MeshRun& run) { return run.quality(); });
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

PreviewArrays preview(const ModelArrays& arrays) {
  std::string failure;
  PreviewArrays result = guarded(failure, PreviewArrays{}, [&] {
    const ModelPreview drawn = previewModel(toModel(arrays), toGrid(arrays));
    return PreviewArrays{.linePoints = copyOut(drawn.linePoints),
                         .lineOffsets = copyOut(drawn.lineOffsets),
                         .patchPoints = copyOut(drawn.patchPoints),
                         .patchTriangles = copyOut(drawn.patchTriangles),
                         .patchOffsets = copyOut(drawn.patchOffsets),
                         .diagnostics = toRecords(drawn.diagnostics),
                         .failure = Text{emscripten::val("")}};
  });
  result.failure = Text{emscripten::val(failure)};
  return result;
}

/// As raw pointers, which embind hands over to JavaScript; there delete() ends their life.
Run* meshModel(const ModelArrays& arrays, const Options& options) {
  return std::make_unique<Run>(arrays, options).release();
}

Run* fillSurface(const Float64Array& points, const Uint32Array& triangles, const Options& options) {
  return std::make_unique<Run>(points, triangles, options).release();
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
  register_type<DiagnosticRecords>("DiagnosticRecord[]");
  register_type<Text>("string");

  value_object<ModelArrays>("ModelArrays")
      .field("points", &ModelArrays::points)
      .field("lineTypes", &ModelArrays::lineTypes)
      .field("lineOffsets", &ModelArrays::lineOffsets)
      .field("linePoints", &ModelArrays::linePoints)
      .field("patchTypes", &ModelArrays::patchTypes)
      .field("patchOffsets", &ModelArrays::patchOffsets)
      .field("loopOffsets", &ModelArrays::loopOffsets)
      .field("loopLines", &ModelArrays::loopLines)
      .field("gridNodes", &ModelArrays::gridNodes)
      .field("gridTetrahedra", &ModelArrays::gridTetrahedra)
      .field("sourceTypes", &ModelArrays::sourceTypes)
      .field("sourceValues", &ModelArrays::sourceValues)
      .field("overhang", &ModelArrays::overhang);
  value_object<Options>("Options")
      .field("size", &Options::size)
      .field("growth", &Options::growth)
      .field("gradation", &Options::gradation)
      .field("order", &Options::order)
      .field("optimization", &Options::optimization);
  value_object<DiagnosticRecord>("DiagnosticRecord")
      .field("code", &DiagnosticRecord::code)
      .field("severity", &DiagnosticRecord::severity)
      .field("entities", &DiagnosticRecord::entities)
      .field("place", &DiagnosticRecord::place)
      .field("values", &DiagnosticRecord::values);
  value_object<SurfaceArrays>("SurfaceArrays")
      .field("points", &SurfaceArrays::points)
      .field("triangles", &SurfaceArrays::triangles)
      .field("trianglePatch", &SurfaceArrays::trianglePatch)
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
      .field("points", &ProgressRecord::points)
      .field("triangles", &ProgressRecord::triangles)
      .field("tetrahedra", &ProgressRecord::tetrahedra)
      .field("frontFaces", &ProgressRecord::frontFaces);
  value_object<PreviewArrays>("PreviewArrays")
      .field("linePoints", &PreviewArrays::linePoints)
      .field("lineOffsets", &PreviewArrays::lineOffsets)
      .field("patchPoints", &PreviewArrays::patchPoints)
      .field("patchTriangles", &PreviewArrays::patchTriangles)
      .field("patchOffsets", &PreviewArrays::patchOffsets)
      .field("diagnostics", &PreviewArrays::diagnostics)
      .field("failure", &PreviewArrays::failure);
  value_object<QualitySummary>("QualitySummary")
      .field("minDihedral", &QualitySummary::minDihedral)
      .field("maxDihedral", &QualitySummary::maxDihedral)
      .field("minRadiusRatio", &QualitySummary::minRadiusRatio)
      .field("meanRadiusRatio", &QualitySummary::meanRadiusRatio)
      .field("volume", &QualitySummary::volume);
  value_object<RecoverySummary>("RecoverySummary")
      .field("relaxed", &RecoverySummary::relaxed)
      .field("starred", &RecoverySummary::starred)
      .field("reopened", &RecoverySummary::reopened);
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
      .function("quality", &Run::quality)
      .function("recovery", &Run::recovery)
      .function("counters", &Run::counters)
      .function("fingerprint", &Run::fingerprint)
      .function("failure", &Run::failure);

  function("meshModel", &meshModel, allow_raw_pointers());
  function("fillSurface", &fillSurface, allow_raw_pointers());
  function("preview", &preview);
}
