/// @file Fills a closed surface with the native engine, for profiling, benchmarks and comparison
/// with the WebAssembly build. Reads an .off file, meshes it and prints the results. Users have
/// `npx tetrafront` instead, which reads and writes common formats.
///
///     fill SURFACE.off [SIZE] [--optimization=none|fast|default|thorough]
///          [--order=layered|smallest-first] [--filters=on|off] [--remesh=on|off]
///          [--max-volume=VOLUME] [--interior=auto|front|lattice] [--threads=COUNT]
///
/// Prints `name value` lines. Seconds are processor time, which other work on the machine hardly
/// affects; wallSeconds alone is time of the clock. Bytes are the peak resident size above the size after the surface was read. Exit
/// status: 0 done, 1 not completed, 2 invalid arguments or input.

#include <sys/resource.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "tetrafront/mesher.h"
#include "tetrafront/remesh.h"
#include "tetrafront/threads.h"

namespace {

struct Surface {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
};

/// Converts the whole text to a number. std::from_chars rounds correctly on all platforms, and a
/// fingerprint depends on the last bit.
std::optional<double> numberIn(std::string_view text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end) return {};
  return number;
}

/// Reads at most as many entries as the header declares, so memory grows with the actual content.
std::optional<Surface> readOff(const char* path) {
  std::ifstream file(path);
  std::string magic;
  std::size_t points = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  if (!(file >> magic >> points >> faces >> edges) || magic != "OFF") return {};
  Surface surface;
  std::string word;
  for (std::size_t point = 0; point < points; ++point) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(file >> word)) return {};
      const std::optional<double> coordinate = numberIn(word);
      if (!coordinate) return {};
      surface.points.push_back(*coordinate);
    }
  }
  for (std::size_t face = 0; face < faces; ++face) {
    int corners = 0;
    std::array<std::uint32_t, 3> nodes{};
    if (!(file >> corners >> nodes[0] >> nodes[1] >> nodes[2]) || corners != 3) return {};
    surface.triangles.insert(surface.triangles.end(), nodes.begin(), nodes.end());
  }
  return surface;
}

const char* nameOf(tetrafront::MeshStatus status) {
  switch (status) {
    case tetrafront::MeshStatus::kRunning:
      return "running";
    case tetrafront::MeshStatus::kDone:
      return "done";
    case tetrafront::MeshStatus::kStalled:
      return "stalled";
    case tetrafront::MeshStatus::kCancelled:
      return "cancelled";
    case tetrafront::MeshStatus::kInvalidInput:
      return "invalid-input";
  }
  return "unknown";
}

/// Returns the text after `name` and "=" if `argument` begins with them.
std::optional<std::string_view> valueOf(std::string_view argument, std::string_view name) {
  if (!argument.starts_with(name) || !argument.substr(name.size()).starts_with('=')) return {};
  return argument.substr(name.size() + 1);
}

template <class Value, std::size_t N>
bool choose(Value& option, std::string_view chosen,
            const std::array<std::pair<std::string_view, Value>, N>& choices) {
  for (const auto& [name, value] : choices) {
    if (name != chosen) continue;
    option = value;
    return true;
  }
  return false;
}

using tetrafront::FrontOrder;
using tetrafront::Interior;
using tetrafront::Optimization;
constexpr std::array<std::pair<std::string_view, Optimization>, 4> kOptimizations{
    {{"none", Optimization::kNone},
     {"fast", Optimization::kFast},
     {"default", Optimization::kDefault},
     {"thorough", Optimization::kThorough}}};
constexpr std::array<std::pair<std::string_view, FrontOrder>, 2> kOrders{
    {{"layered", FrontOrder::kLayered}, {"smallest-first", FrontOrder::kSmallestFirst}}};
constexpr std::array<std::pair<std::string_view, Interior>, 3> kInteriors{
    {{"front", Interior::kFront}, {"lattice", Interior::kLattice}, {"auto", Interior::kAuto}}};
constexpr std::array<std::pair<std::string_view, bool>, 2> kSwitch{{{"on", true}, {"off", false}}};

constexpr double kMaxThreads = 256.0;

struct Options {
  tetrafront::MeshOptions mesh;
  bool remesh = false;
  unsigned threads = 1;
};

/// Returns false, after printing the reason, if the argument is not an option.
bool readArgument(std::string_view argument, Options& all) {
  tetrafront::MeshOptions& options = all.mesh;
  if (const auto level = valueOf(argument, "--optimization")) {
    if (choose(options.optimization, *level, kOptimizations)) return true;
  } else if (const auto order = valueOf(argument, "--order")) {
    if (choose(options.order, *order, kOrders)) return true;
  } else if (const auto interior = valueOf(argument, "--interior")) {
    if (choose(options.interior, *interior, kInteriors)) return true;
  } else if (const auto filters = valueOf(argument, "--filters")) {
    if (choose(options.filters, *filters, kSwitch)) return true;
  } else if (const auto remesh = valueOf(argument, "--remesh")) {
    if (choose(all.remesh, *remesh, kSwitch)) return true;
  } else if (const auto threads = valueOf(argument, "--threads")) {
    const double count = numberIn(*threads).value_or(0.0);
    all.threads = count >= 1.0 && count <= kMaxThreads ? static_cast<unsigned>(count) : 0;
    if (all.threads == count) return true;
  } else if (const auto volume = valueOf(argument, "--max-volume")) {
    options.maxVolume = numberIn(*volume).value_or(0.0);
    if (options.maxVolume > 0.0 && std::isfinite(options.maxVolume)) return true;
  } else {
    options.size = numberIn(argument).value_or(0.0);
    if (options.size > 0.0 && std::isfinite(options.size)) return true;
    std::fprintf(stderr, "%.*s: not an element size; give a finite number above 0\n",
                 static_cast<int>(argument.size()), argument.data());
    return false;
  }
  std::fprintf(stderr, "%.*s: unknown option or value; run without arguments for the usage\n",
               static_cast<int>(argument.size()), argument.data());
  return false;
}

/// Returns the peak resident size of this process.
std::size_t greatestResidentBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return static_cast<std::size_t>(usage.ru_maxrss);
#else
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
#endif
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Remeshes the surface and prints the result; leaves a surface that cannot be remeshed as it is.
void remesh(Surface& surface, double size) {
  tetrafront::RemeshOptions options;
  options.size = size;
  const double begin = processorSeconds();
  tetrafront::SurfaceRemesher remesher(surface.points, surface.triangles, {}, {}, options);
  while (!remesher.advance(4096U)) {
  }
  const tetrafront::SurfaceRemesh& result = remesher.result();
  std::printf("remeshSeconds %.6f\n", processorSeconds() - begin);
  if (result.triangles.empty()) return;
  surface.points = result.points;
  surface.triangles = result.triangles;
  std::printf("smallestAngle %.4f\ndeviation %g\n", result.smallestAngle, result.deviation);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(
        stderr,
        "usage: fill SURFACE.off [SIZE] [--optimization=none|fast|default|thorough]\n"
        "       [--order=layered|smallest-first] [--filters=on|off] [--remesh=on|off]\n"
        "       [--max-volume=VOLUME] [--interior=auto|front|lattice] [--threads=COUNT]\n");
    return 2;
  }
  std::optional<Surface> surface = readOff(argv[1]);
  if (!surface) {
    std::fprintf(stderr, "%s: cannot be read as an OFF file of triangles\n", argv[1]);
    return 2;
  }
  Options options;
  for (int i = 2; i < argc; ++i) {
    if (!readArgument(argv[i], options)) return 2;
  }
  if (options.remesh) remesh(*surface, options.mesh.size);

  constexpr std::uint32_t kBudget = 4096;
  const std::size_t bytesBefore = greatestResidentBytes();
  tetrafront::MeshRun run(surface->points, surface->triangles, options.mesh);
  tetrafront::useThreads(run, options.threads);
  std::array<double, tetrafront::kPhaseCount> phaseSeconds{};
  const auto wallBegin = std::chrono::steady_clock::now();
  const double begin = processorSeconds();
  for (bool running = true; running;) {
    const auto phase = static_cast<std::size_t>(run.progress().phase);
    const double before = processorSeconds();
    running = run.advance(kBudget) == tetrafront::MeshStatus::kRunning;
    phaseSeconds[phase] += processorSeconds() - before;
  }
  const double total = processorSeconds() - begin;
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wallBegin;
  const std::size_t bytes = greatestResidentBytes() - bytesBefore;
  const auto secondsOf = [&](tetrafront::Phase phase) {
    return phaseSeconds[static_cast<std::size_t>(phase)];
  };

  const tetrafront::Progress progress = run.progress();
  const tetrafront::QualitySummary quality = run.quality();
  std::printf("status %s\n", nameOf(run.status()));
  std::printf("estimated %u\n", progress.expectedTetrahedra);
  std::printf("triangles %u\npoints %u\ntetrahedra %u\n", progress.triangles, progress.nodes,
              progress.tetrahedra);
  std::printf("lattice %u\n", run.latticeCount());
  std::printf("seconds %.6f\ncheckSeconds %.6f\n", total, secondsOf(tetrafront::Phase::kCheck));
  std::printf("wallSeconds %.6f\n", wall.count());
  std::printf("volumeSeconds %.6f\n", secondsOf(tetrafront::Phase::kVolume));
  std::printf("optimizeSeconds %.6f\n", secondsOf(tetrafront::Phase::kOptimize));
  std::printf("verifySeconds %.6f\n", secondsOf(tetrafront::Phase::kVerify));
  std::printf("bytes %zu\n", bytes);
  std::printf("minDihedral %.4f\nmaxDihedral %.4f\n", quality.minDihedral, quality.maxDihedral);
  std::printf("meanRadiusRatio %.4f\n", quality.meanRadiusRatio);
  std::printf("fingerprint %016llx\n", static_cast<unsigned long long>(run.fingerprint()));
  for (const tetrafront::Diagnostic& diagnostic : run.diagnostics()) {
    std::printf("diagnostic %d\n", static_cast<int>(diagnostic.code));
  }
  if (run.status() == tetrafront::MeshStatus::kDone) return 0;
  return run.status() == tetrafront::MeshStatus::kInvalidInput ? 2 : 1;
}
