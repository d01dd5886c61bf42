/// @file The native engine on a closed surface, for profiling, benchmarks and comparison with the
/// WebAssembly build: reads an .off file, fills it, prints what came out. Users have
/// `npx tetrafront` instead, which reads and writes real formats.
///
///     fill SURFACE.off [SIZE]
///
/// Prints `name value` lines. Exit status: 0 done, 1 not completed, 2 bad arguments or input.

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "tetrafront/mesher.h"

namespace {

struct Surface {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
};

/// The whole text as a number. std::from_chars rounds correctly everywhere; a fingerprint depends on
/// the last bit.
std::optional<double> numberIn(std::string_view text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end) return {};
  return number;
}

/// The counts in the file's head only say how much to read: memory grows with what is there.
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
  if (argc == 3) {
    options.size = numberIn(argv[2]).value_or(0.0);
    if (!(options.size > 0.0) || !std::isfinite(options.size)) {
      std::fprintf(stderr, "%s: not an element size; give a finite number above 0\n", argv[2]);
      return 2;
    }
  }

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
