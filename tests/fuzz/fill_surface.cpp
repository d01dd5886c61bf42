/// @file libFuzzer's target for given surfaces. The bytes select a valid surface and damage it, so
/// that a few bytes suffice to reach deep into the mesher. Every run must end with a known status,
/// the inspection must agree with the run on which surfaces can be filled, and a finished mesh must
/// be valid. `npm run fuzz` builds this target if clang has libFuzzer.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/mesh_validator.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"
#include "tetrafront/surface_tools.h"

namespace {

using namespace tetrafront;

/// Reads the fuzzer's bytes as numbers; returns zeros when they are used up.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> data) : data_(data) {}

  [[nodiscard]] bool isEmpty() const { return data_.empty(); }

  std::uint8_t byte() {
    if (data_.empty()) return 0;
    const std::uint8_t first = data_.front();
    data_ = data_.subspan(1);
    return first;
  }

  std::uint32_t below(std::size_t count) {
    const std::uint32_t high = byte();
    return count == 0 ? 0 : static_cast<std::uint32_t>((high << 8 | byte()) % count);
  }

  double number() {
    constexpr std::array kSpecial{0.0,
                                  -0.0,
                                  1e-300,
                                  1e300,
                                  5e-324,
                                  0x1p-40,
                                  1e30,
                                  std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::quiet_NaN()};
    const std::uint8_t kind = byte();
    if (kind < kSpecial.size()) return kSpecial[kind];
    if (kind < 192)
      return (below(4097) - 1024.0) / 1024.0;  // on a lattice: causes degenerate positions
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    return std::bit_cast<double>(bits);
  }

 private:
  std::span<const std::uint8_t> data_;
};

SurfaceMesh soundSurface(std::uint8_t choice) {
  switch (choice % 8) {
    case 0:
      return testing::gridCube(1);
    case 1:
      return testing::gridCube(2);
    case 2:
      return testing::geodesicSphere(2);
    case 3:
      return testing::cubeWithCubicCavity(2, 1);
    case 4:
      return testing::schoenhardtPrism(30.0);
    case 5:
      return testing::cubesSharingEdge();
    case 6:
      return testing::nestedSpheres(2, 1);
    default:
      return testing::thinPlate(2, 0.05);
  }
}

void ruin(SurfaceMesh& surface, Bytes& bytes) {
  std::vector<double>& points = surface.points;
  std::vector<std::uint32_t>& triangles = surface.triangles;
  const std::size_t t = 3 * std::size_t{bytes.below(triangles.size() / 3)};
  switch (bytes.byte() % 6) {
    case 0:
      points[bytes.below(points.size())] = bytes.number();
      break;
    case 1:
      points[bytes.below(points.size())] += bytes.number();
      break;
    case 2:
      if (t < triangles.size())
        triangles[t + bytes.byte() % 3] = bytes.below(points.size() / 3 + 1);
      break;
    case 3:
      if (t < triangles.size()) triangles.erase(triangles.begin() + t, triangles.begin() + t + 3);
      break;
    case 4:
      for (int i = 0; i < 3; ++i) triangles.push_back(bytes.below(points.size() / 3));
      break;
    default:
      if (t < triangles.size()) std::swap(triangles[t], triangles[t + 1]);
  }
}

MeshOptions optionsFrom(Bytes& bytes) {
  MeshOptions options;
  const std::uint8_t switches = bytes.byte();
  options.order = (switches & 1) != 0 ? FrontOrder::kSmallestFirst : FrontOrder::kLayered;
  options.filters = (switches & 2) == 0;
  options.exactFillOnly = (switches & 4) != 0;
  options.optimization = static_cast<Optimization>(switches >> 3 & 3);
  if ((switches & 32) != 0) options.size = bytes.number();
  if ((switches & 64) != 0) options.innerShells = InnerShells::kRegions;
  options.maxTetrahedra = 20'000;
  return options;
}

void demand(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

bool isFillable(const SurfaceMesh& surface, InnerShells innerShells) {
  SurfaceInspector inspector(surface.points, surface.triangles, {.innerShells = innerShells});
  while (!inspector.advance(1000)) {
  }
  return inspector.result().isFillable;
}

void fill(const SurfaceMesh& surface, const MeshOptions& options) {
  const bool canBeFilled = isFillable(surface, options.innerShells);
  MeshRun run(surface.points, surface.triangles, options);
  MeshStatus status = MeshStatus::kRunning;
  while (status == MeshStatus::kRunning) status = run.advance(1000);
  demand(status != MeshStatus::kCancelled, "cancelled by nobody");
  demand(status != MeshStatus::kInvalidInput || !run.diagnostics().empty(), "refused for nothing");
  if (status != MeshStatus::kDone) return;
  demand(canBeFilled, "filled what inspection refuses");
  const std::string complaint = testing::complaintAbout(run.volume(), run.surface());
  demand(complaint.empty(), complaint);
}

void repair(const SurfaceMesh& surface, Bytes& bytes) {
  const RepairOptions options{.weldDistance = bytes.byte() / 256.0, .maxHoleEdges = 20};
  const SurfaceRepair repaired = repairSurface(surface.points, surface.triangles, options);
  const std::size_t nodes = repaired.points.size() / 3;
  demand(repaired.origin.size() * 3 == repaired.triangles.size(), "a triangle without an origin");
  if (!repaired.diagnostics.empty()) return;
  for (const std::uint32_t node : repaired.triangles) demand(node < nodes, "a node out of range");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes({data, size});
  const MeshOptions options = optionsFrom(bytes);
  SurfaceMesh surface = soundSurface(bytes.byte());
  Bytes forRepair = bytes;
  while (!bytes.isEmpty()) ruin(surface, bytes);
  fill(surface, options);
  repair(surface, forRepair);
  return 0;
}
