/// @file Measures the time of the front, and the share of the crossing test in it, for
/// docs/PAPER.md and docs/BENCHMARKS.md. Runs only the volume front, on the boundary and the
/// background grid that the benchmarks write.
///
///     front_clock layered|smallest-first on|off < BOUNDARY_AND_GRID
///
/// The second argument turns the face filters of the crossing test on or off. Input, as text:
/// number of nodes, triangles, grid nodes and grid tetrahedra; x y z per node; three nodes per
/// triangle; x y z size per grid node; four grid nodes per tetrahedron. Without grid nodes, sizes
/// follow from the boundary's edges. Prints `name value` lines; times are processor times, the
/// minimum of several runs. Exit status: 0 done, 1 not completed, 2 invalid input.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "boundary/boundary.h"
#include "field/check_background_grid.h"
#include "field/grid_locator.h"
#include "field/size_field.h"
#include "field/size_octree.h"
#include "volume/volume_mesher.h"

namespace {

/// Number of runs. The minimum of their times counts, because other processes only increase a time.
constexpr int kRuns = 7;

struct Problem {
  tetrafront::SurfaceMesh boundary;
  tetrafront::BackgroundGrid grid;
};

bool readProblem(std::istream& in, Problem& problem) {
  std::size_t nodes = 0;
  std::size_t triangles = 0;
  std::size_t gridNodes = 0;
  std::size_t tetrahedra = 0;
  if (!(in >> nodes >> triangles >> gridNodes >> tetrahedra)) return false;
  problem.boundary.points.resize(3 * nodes);
  for (double& coordinate : problem.boundary.points) in >> coordinate;
  problem.boundary.triangles.resize(3 * triangles);
  for (std::uint32_t& node : problem.boundary.triangles) in >> node;
  problem.grid.nodes.resize(gridNodes);
  for (tetrafront::BackgroundNode& node : problem.grid.nodes)
    in >> node.position.x >> node.position.y >> node.position.z >> node.size;
  problem.grid.tetrahedra.resize(tetrahedra);
  for (auto& tetrahedron : problem.grid.tetrahedra) {
    for (std::uint32_t& node : tetrahedron) in >> node;
  }
  return !in.fail();
}

std::vector<tetrafront::Vec3> nodesOf(const tetrafront::SurfaceMesh& surface) {
  std::vector<tetrafront::Vec3> nodes;
  for (std::size_t i = 0; i < surface.points.size(); i += 3)
    nodes.emplace_back(surface.points[i], surface.points[i + 1], surface.points[i + 2]);
  return nodes;
}

tetrafront::SizeField fieldOf(const Problem& problem, const tetrafront::MeshOptions& options) {
  if (!problem.grid.nodes.empty())
    return tetrafront::SizeField::fromGrid(
        tetrafront::GridLocator(problem.grid, options.gradation - 1.0));
  return tetrafront::SizeField::fromOctree(tetrafront::SizeOctree(
      nodesOf(problem.boundary), problem.boundary.triangles, options.growth, 0.0));
}

struct Timing {
  tetrafront::MeshStatus status = tetrafront::MeshStatus::kRunning;
  std::uint32_t tetrahedra = 0;
  tetrafront::FrontCounters counters;
  double seconds = 0.0;  ///< processor time
  double share = 0.0;    ///< share of the crossing test, with a ClockTrace
};

/// Makes steps whose crossing tests are timed, and keeps those of the last front.
class ClockMaker final : public tetrafront::FrontMaker {
 public:
  using Advance = tetrafront::TracedFrontAdvance<tetrafront::ClockTrace>;

  [[nodiscard]] std::unique_ptr<tetrafront::FrontAdvance> make(tetrafront::Front& front,
                                                               tetrafront::Elements& elements,
                                                               const tetrafront::SizeField& field,
                                                               bool filters) const override {
    auto made = std::make_unique<Advance>(front, elements, field, filters);
    last_ = made.get();
    return made;
  }
  [[nodiscard]] double secondsInCrossingTest() const {
    return std::chrono::duration<double>(last_->trace().inCrossingTest).count();
  }

 private:
  mutable const Advance* last_ = nullptr;
};

Timing runFront(const Problem& problem, const tetrafront::SizeField& field,
                const tetrafront::MeshOptions& options, const ClockMaker* clock) {
  const tetrafront::PlainFrontMaker plain;
  const std::clock_t begin = std::clock();
  tetrafront::VolumeMesher mesher(
      problem.boundary, field, options,
      clock ? *clock : static_cast<const tetrafront::FrontMaker&>(plain));
  tetrafront::Job<tetrafront::MeshStatus> job(
      [&mesher](tetrafront::Work& work) { return mesher.run(work); });
  job.finish();
  const std::clock_t spent = std::clock() - begin;
  Timing timing;
  timing.status = mesher.status();
  timing.tetrahedra = mesher.tetrahedronCount();
  timing.counters = mesher.counters();
  timing.seconds = static_cast<double>(spent) / CLOCKS_PER_SEC;
  if (clock != nullptr) timing.share = clock->secondsInCrossingTest() / timing.seconds;
  return timing;
}

Timing quickest(const Problem& problem, const tetrafront::SizeField& field,
                const tetrafront::MeshOptions& options, const ClockMaker* clock) {
  Timing best;
  best.seconds = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    const Timing timing = runFront(problem, field, options, clock);
    if (timing.seconds < best.seconds) best = timing;
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view order = argc == 3 ? argv[1] : "";
  const std::string_view filters = argc == 3 ? argv[2] : "";
  if ((order != "layered" && order != "smallest-first") || (filters != "on" && filters != "off")) {
    std::fprintf(stderr, "usage: front_clock layered|smallest-first on|off < BOUNDARY_AND_GRID\n");
    return 2;
  }
  Problem problem;
  if (!readProblem(std::cin, problem)) {
    std::fprintf(stderr, "standard input: not a boundary and a background grid\n");
    return 2;
  }
  std::vector<tetrafront::Diagnostic> findings;
  const tetrafront::Boundary closed = tetrafront::closeBoundary(
      problem.boundary, tetrafront::BoundarySource::kGivenSurface, findings);
  const bool hasGrid = !problem.grid.nodes.empty();
  if (!closed.isValid || (hasGrid && !tetrafront::checkBackgroundGrid(problem.grid).empty())) {
    std::fprintf(stderr, "standard input: the boundary or the background grid cannot be used\n");
    return 2;
  }
  tetrafront::MeshOptions options;
  options.order = order == "layered" ? tetrafront::FrontOrder::kLayered
                                     : tetrafront::FrontOrder::kSmallestFirst;
  options.filters = filters == "on";
  const tetrafront::SizeField field = fieldOf(problem, options);
  const Timing plain = quickest(problem, field, options, nullptr);
  const ClockMaker clock;
  const Timing clocked = quickest(problem, field, options, &clock);
  const auto per = [](std::uint64_t part, std::uint64_t whole) {
    return static_cast<double>(part) / static_cast<double>(std::max<std::uint64_t>(whole, 1));
  };
  std::printf("tetrahedra %u\nseconds %.6f\n", plain.tetrahedra, plain.seconds);
  std::printf("crossingShare %.4f\n", clocked.share);
  std::printf("facesPerCheck %.2f\n",
              per(plain.counters.facesTested, plain.counters.candidatesTried));
  std::printf("analysedPerCheck %.2f\n",
              per(plain.counters.facesAnalysed, plain.counters.candidatesTried));
  return plain.status == tetrafront::MeshStatus::kDone ? 0 : 1;
}
