/// The progress of runs: what a step leaves that ends early is for the steps after it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <vector>

#include "support/random.h"
#include "tetrafront/mesher.h"

namespace tetrafront::testing {
namespace {

struct Surface {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
};

/// A plate of one layer, n squares wide, with nodes that are moved in its two faces: without interior nodes, rounds of the
/// optimization end at once, and hardly anything but repairs helps the elements.
Surface unevenPlate(std::uint32_t n) {
  Random random(43);
  Surface plate;
  const auto moved = [&](std::uint32_t i) {
    return i == 0 || i == n ? i : i + random.between(-0.28, 0.28);
  };
  for (std::uint32_t node = 0; node < 2 * (n + 1) * (n + 1); ++node) {
    const std::array<std::uint32_t, 3> at{node / (n + 1) % (n + 1), node % (n + 1),
                                          node / ((n + 1) * (n + 1))};
    for (const double x : {moved(at[0]), moved(at[1]), static_cast<double>(at[2])}) {
      plate.points.push_back(x);
    }
  }
  const auto node = [n](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return (k * (n + 1) + i) * (n + 1) + j;
  };
  const auto square = [&](const std::array<std::uint32_t, 4>& corner) {
    for (const std::size_t i : {0U, 1U, 2U, 0U, 2U, 3U}) plate.triangles.push_back(corner.at(i));
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      square({node(i, j, 0), node(i, j + 1, 0), node(i + 1, j + 1, 0), node(i + 1, j, 0)});
      square({node(i, j, 1), node(i + 1, j, 1), node(i + 1, j + 1, 1), node(i, j + 1, 1)});
    }
    square({node(i, 0, 0), node(i + 1, 0, 0), node(i + 1, 0, 1), node(i, 0, 1)});
    square({node(i, n, 0), node(i, n, 1), node(i + 1, n, 1), node(i + 1, n, 0)});
    square({node(0, i, 0), node(0, i, 1), node(0, i + 1, 1), node(0, i + 1, 0)});
    square({node(n, i, 0), node(n, i + 1, 0), node(n, i + 1, 1), node(n, i, 1)});
  }
  return plate;
}

struct Report {
  double fraction;
  std::clock_t time;
};

/// Returns the largest difference of the progress from the share of the processor time.
double unevenness(const std::vector<Report>& reports) {
  const auto whole = static_cast<double>(reports.back().time);
  double largest = 0.0;
  for (const auto& [fraction, time] : reports) {
    largest = std::max(largest, std::abs(fraction - static_cast<double>(time) / whole));
  }
  return largest;
}

TEST(MeshRun, ReportsAboutTheShareOfTheTimeInAPlateOfOneLayer) {
  const Surface plate = unevenPlate(60);
  MeshRun run(plate.points, plate.triangles, {});
  std::vector<Report> reports;
  const std::clock_t begin = std::clock();
  constexpr std::uint32_t kBudget = 64;
  MeshStatus status = MeshStatus::kRunning;
  while (status == MeshStatus::kRunning) {
    status = run.advance(kBudget);
    reports.push_back({run.progress().fraction, std::clock() - begin});
  }
  EXPECT_EQ(status, MeshStatus::kDone);
  EXPECT_EQ(reports.back().fraction, 1.0);
  EXPECT_TRUE(std::ranges::is_sorted(reports, {}, &Report::fraction));
  EXPECT_LT(unevenness(reports), 0.45);
}

}  // namespace
}  // namespace tetrafront::testing
