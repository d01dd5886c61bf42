/// @file Meshes the drawn model of a project file in one uniform size with the native engine, for comparison with the
/// WebAssembly build. Users have `npx tetrafront` instead.
///
///     mesh_model PROJECT.json SIZE
///
/// Prints `name value` lines. Exit status: 0 done, 1 not completed, 2 invalid arguments or input.

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <system_error>

#include "support/gallery.h"
#include "tetrafront/mesher.h"

namespace {

int meshModel(const char* path, double size) {
  tetrafront::MeshOptions options;
  options.size = size;
  tetrafront::MeshRun run(tetrafront::testing::readGalleryModel(path).model, {}, options);
  constexpr std::uint32_t kBudget = 4096;
  while (run.advance(kBudget) == tetrafront::MeshStatus::kRunning) {
  }
  std::printf("tetrahedra %u\n", run.progress().tetrahedra);
  std::printf("fingerprint %016llx\n", static_cast<unsigned long long>(run.fingerprint()));
  if (run.status() == tetrafront::MeshStatus::kDone) return 0;
  return run.status() == tetrafront::MeshStatus::kInvalidInput ? 2 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  double size = 0.0;
  const char* const text = argc == 3 ? argv[2] : "";
  const char* const end = text + std::strlen(text);
  const std::from_chars_result read = std::from_chars(text, end, size);
  if (read.ec != std::errc() || read.ptr != end || !(size > 0.0) || !std::isfinite(size)) {
    std::fprintf(stderr, "usage: mesh_model PROJECT.json SIZE\n");
    return 2;
  }
  try {
    return meshModel(argv[1], size);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: cannot be read as a project: %s\n", argv[1], error.what());
    return 2;
  }
}
