/// @file The native engine on a closed surface, for profiling, benchmarks and comparison with the
/// WebAssembly build: reads an .off file, fills it, prints what came out. Users have
/// `npx tetrafront` instead, which reads and writes real formats.
///
///     fill SURFACE.off [SIZE]
///
/// Prints `name value` lines. Exit status: 0 done, 1 not completed, 2 bad arguments or input.

#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "tetrafront/mesher.h"

namespace {

struct Surface {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
};

std::optional<Surface> readOff(const char* path) {
  std::ifstream file(path);
  std::string magic;
  std::size_t points = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  if (!(file >> magic >> points >> faces >> edges) || magic != "OFF") return {};
  Surface surface;
  surface.points.resize(3 * points);
  surface.triangles.resize(3 * faces);
  for (double& coordinate : surface.points) {
    std::string word;
    if (!(file >> word)) return {};
    // std::from_chars rounds correctly everywhere; a fingerprint depends on the last bit.
    std::from_chars(word.data(), word.data() + word.size(), coordinate);
  }
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    int corners = 3;
    if (i % 3 == 0 && (!(file >> corners) || corners != 3)) return {};
    if (!(file >> surface.triangles[i])) return {};
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

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: fill SURFACE.off [SIZE]\n");
    return 2;
  }
  const std::optional<Surface> surface = readOff(argv[1]);
  if (!surface) {
    std::fprintf(stderr, "%s: cannot be read as an OFF file of triangles\n", argv[1]);
    return 2;
  }
  tetrafront::MeshOptions options;
  if (argc == 3) std::from_chars(argv[2], argv[2] + std::strlen(argv[2]), options.size);

  using Clock = std::chrono::steady_clock;
  constexpr std::uint32_t kBudget = 4096;
  tetrafront::MeshRun run(surface->points, surface->triangles, options);
  double volumeSeconds = 0.0;
  const Clock::time_point begin = Clock::now();
  for (bool running = true; running;) {
    const tetrafront::Phase phase = run.progress().phase;
    const Clock::time_point before = Clock::now();
    running = run.advance(kBudget) == tetrafront::MeshStatus::kRunning;
    const std::chrono::duration<double> spent = Clock::now() - before;
    if (phase == tetrafront::Phase::kVolume) volumeSeconds += spent.count();
  }
  const std::chrono::duration<double> total = Clock::now() - begin;

  const tetrafront::Progress progress = run.progress();
  const tetrafront::QualitySummary quality = run.quality();
  std::printf("status %s\n", nameOf(run.status()));
  std::printf("triangles %u\npoints %u\ntetrahedra %u\n", progress.triangles, progress.points,
              progress.tetrahedra);
  std::printf("seconds %.6f\nvolumeSeconds %.6f\n", total.count(), volumeSeconds);
  std::printf("minDihedral %.4f\nmaxDihedral %.4f\n", quality.minDihedral, quality.maxDihedral);
  std::printf("meanRadiusRatio %.4f\n", quality.meanRadiusRatio);
  std::printf("fingerprint %016llx\n", static_cast<unsigned long long>(run.fingerprint()));
  for (const tetrafront::Diagnostic& diagnostic : run.diagnostics()) {
    std::printf("diagnostic %d\n", static_cast<int>(diagnostic.code));
  }
  if (run.status() == tetrafront::MeshStatus::kDone) return 0;
  return run.status() == tetrafront::MeshStatus::kInvalidInput ? 2 : 1;
}
