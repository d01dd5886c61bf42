/// @file Adapts a mesh with the native engine, for profiling and comparison with the WebAssembly build. Users have
/// `npx tetrafront adapt` instead, which reads and writes common formats.
///
///     adapt_mesh MESH.mesh BACKGROUND.mesh BACKGROUND.sol OUT.mesh [QUALITY [SWEEPS]]
///
/// Reads and writes the vertices, triangles and tetrahedra of Medit files; metrics are those of a solution file with one
/// symmetric tensor per vertex. Prints `name value` lines; seconds are processor time. Exit status: 0 done, 1 failed,
/// 2 invalid arguments or input.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tetrafront/mesh_adaptation.h"

namespace {

/// Reads `count` rows of numbers into `out`, all but the last of each row.
template <class Value>
bool readRows(std::ifstream& file, std::size_t perRow, std::vector<Value>& out,
              std::vector<std::uint32_t>& last) {
  std::size_t count = 0;
  if (!(file >> count)) return false;
  std::string word;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < perRow; ++k) {
      if (!(file >> word)) return false;
      const double number = std::strtod(word.c_str(), nullptr);
      out.push_back(static_cast<Value>(perRow == 3 && sizeof(Value) == 8 ? number : number - 1.0));
    }
    if (!(file >> word)) return false;
    last.push_back(static_cast<std::uint32_t>(std::strtoul(word.c_str(), nullptr, 10)));
  }
  return true;
}

bool readMesh(const char* path, tetrafront::AdaptInput& mesh) {
  std::ifstream file(path);
  std::string word;
  std::vector<std::uint32_t> unused;
  while (file >> word) {
    if (word == "Vertices" && !readRows(file, 3, mesh.points, unused)) return false;
    if (word == "Triangles" && !readRows(file, 3, mesh.triangles, mesh.trianglePatch)) return false;
    if (word == "Tetrahedra" && !readRows(file, 4, mesh.tetrahedra, mesh.regions)) return false;
  }
  return !mesh.tetrahedra.empty();
}

/// Reads metrics; Medit's order is that of the lower triangle, xx xy yy xz yz zz.
bool readMetrics(const char* path, std::vector<double>& metrics) {
  std::ifstream file(path);
  std::string word;
  while (file >> word && word != "SolAtVertices") {
  }
  std::size_t count = 0;
  int solutions = 0;
  int type = 0;
  if (!(file >> count >> solutions >> type) || solutions != 1 || type != 3) return false;
  for (std::size_t i = 0; i < count; ++i) {
    double m[6];
    for (double& number : m) {
      if (!(file >> word)) return false;
      number = std::strtod(word.c_str(), nullptr);
    }
    metrics.insert(metrics.end(), {m[0], m[1], m[3], m[2], m[4], m[5]});
  }
  return true;
}

bool writeMesh(const char* path, const tetrafront::MeshAdaptation& mesh) {
  std::FILE* const file = std::fopen(path, "w");
  if (file == nullptr) return false;
  std::fprintf(file, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n",
               mesh.points.size() / 3);
  for (std::size_t i = 0; i < mesh.points.size(); i += 3)
    std::fprintf(file, "%.17g %.17g %.17g 0\n", mesh.points[i], mesh.points[i + 1],
                 mesh.points[i + 2]);
  std::fprintf(file, "Triangles\n%zu\n", mesh.trianglePatch.size());
  for (std::size_t t = 0; t < mesh.trianglePatch.size(); ++t)
    std::fprintf(file, "%u %u %u %u\n", mesh.triangles[3 * t] + 1, mesh.triangles[3 * t + 1] + 1,
                 mesh.triangles[3 * t + 2] + 1, mesh.trianglePatch[t]);
  std::fprintf(file, "Tetrahedra\n%zu\n", mesh.regions.size());
  for (std::size_t t = 0; t < mesh.regions.size(); ++t)
    std::fprintf(file, "%u %u %u %u %u\n", mesh.tetrahedra[4 * t] + 1,
                 mesh.tetrahedra[4 * t + 1] + 1, mesh.tetrahedra[4 * t + 2] + 1,
                 mesh.tetrahedra[4 * t + 3] + 1, mesh.regions[t]);
  std::fprintf(file, "End\n");
  return std::fclose(file) == 0;
}

void print(const char* when, const tetrafront::MetricStatistics& s) {
  std::printf("%s tetrahedra %u unitEdges %.4f peaked %.4f lengths %.3f %.3f quality %.4f %.4f\n",
              when, s.tetrahedra, s.unitEdges, s.peakedEdges, s.shortest, s.longest, s.leastQuality,
              s.meanQuality);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr,
                 "usage: adapt_mesh MESH.mesh BACKGROUND.mesh BACKGROUND.sol OUT.mesh [QUALITY "
                 "[SWEEPS]]\n");
    return 2;
  }
  tetrafront::AdaptInput mesh;
  tetrafront::AdaptInput grid;
  tetrafront::MetricMesh background;
  if (!readMesh(argv[1], mesh) || !readMesh(argv[2], grid) ||
      !readMetrics(argv[3], background.metrics)) {
    std::fprintf(stderr, "a file cannot be read\n");
    return 2;
  }
  background.points = std::move(grid.points);
  background.tetrahedra = std::move(grid.tetrahedra);
  tetrafront::AdaptOptions options;
  if (argc > 5) options.leastQuality = std::strtod(argv[5], nullptr);
  if (argc > 6) options.sweeps = static_cast<std::uint32_t>(std::strtoul(argv[6], nullptr, 10));
  const std::clock_t begin = std::clock();
  tetrafront::MeshAdapter adapter(std::move(mesh), std::move(background), options);
  while (!adapter.advance(4096U)) {
  }
  const tetrafront::MeshAdaptation& result = adapter.result();
  std::printf("seconds %.2f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  for (const tetrafront::Diagnostic& diagnostic : result.diagnostics)
    std::printf("diagnostic %d\n", static_cast<int>(diagnostic.code));
  print("before", result.before);
  print("after", result.after);
  if (result.points.empty()) return 1;
  return writeMesh(argv[4], result) ? 0 : 1;
}
