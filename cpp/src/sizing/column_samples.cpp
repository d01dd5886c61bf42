#include "sizing/column_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/ids.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Columns per axis, before any is divided.
constexpr std::uint32_t kColumns = 16;
/// Samples along the extent of the surface, before any column is divided.
constexpr std::uint32_t kSteps = 64;
constexpr std::uint32_t kMaxDivisions = 5;
/// Limits of the active columns and of the samples in one interval. Meshes that exceed them have too many elements
/// anyway.
constexpr std::size_t kMaxColumns = 4096;
constexpr double kMaxSamples = 256.0;
/// A column is divided if its smallest size / distance of columns is less than this: sizes grow by about 0.3 per unit
/// of distance, so far smaller ones may be hidden between two columns.
constexpr double kHiddenRatio = 0.3;
/// A column is not divided if its largest size / smallest size is at most this.
constexpr double kUniformRatio = 1.5;
/// Position of a column in its cell of the grid of columns, so that columns miss the edges and diagonals of regular
/// surfaces.
constexpr std::array<double, 2> kOffset{0.4871, 0.5347};

}  // namespace

ColumnSamples::ColumnSamples(const SurfaceMesh& surface, const SizeField& field)
    : surface_(surface), field_(field) {
  low_ = high_ = pointOf(surface, NodeId(surface.triangles.front()));
  for (const std::uint32_t node : surface.triangles) {
    low_ = glm::min(low_, pointOf(surface, NodeId(node)));
    high_ = glm::max(high_, pointOf(surface, NodeId(node)));
  }
  const Vec3 extent = high_ - low_;
  for (std::size_t k = 0; k < 2; ++k) {
    if (extent[static_cast<int>(axes_[k])] < extent[static_cast<int>(axes_[2])]) {
      std::swap(axes_[k], axes_[2]);
    }
  }
}

double ColumnSamples::across(std::size_t axis, double column) const {
  const auto k = static_cast<int>(axes_[axis]);
  return low_[k] + (high_[k] - low_[k]) * (column + kOffset[axis]) / perAxis_;
}

double ColumnSamples::meanDensity() {
  double length = 0.0;
  double integral = 0.0;
  double area = 1.0;
  std::vector<std::uint32_t> active(kColumns * kColumns);
  for (std::uint32_t i = 0; i < active.size(); ++i) active[i] = i;
  const auto along = static_cast<int>(axes_[2]);
  double step = (high_[along] - low_[along]) / kSteps;
  double reach = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto axis = static_cast<int>(axes_[k]);
    reach = std::max(reach, kHiddenRatio * (high_[axis] - low_[axis]) / kColumns);
  }
  for (std::uint32_t division = 0; division <= kMaxDivisions && !active.empty(); ++division) {
    cross(kColumns << division, active);
    const bool canDivide = division < kMaxDivisions && 4 * active.size() <= kMaxColumns;
    std::vector<std::uint32_t> divided;
    for (std::uint32_t slot = 0; slot < active.size(); ++slot) {
      const Column column = integrate(active[slot], slot, step);
      if (canDivide && column.length > 0.0 && column.minSize < reach &&
          column.maxSize > kUniformRatio * column.minSize) {
        const std::uint32_t x = active[slot] % perAxis_;
        const std::uint32_t y = active[slot] / perAxis_;
        for (std::uint32_t child = 0; child < 4; ++child) {
          divided.push_back((2 * y + child / 2) * 2 * perAxis_ + 2 * x + child % 2);
        }
        continue;
      }
      length += area * column.length;
      integral += area * column.integral;
    }
    active = std::move(divided);
    area *= 0.25;
    step *= 0.5;
    reach *= 0.5;
  }
  return length > 0.0 ? integral / length : densityAtTriangles();
}

double ColumnSamples::densityAtTriangles() {
  double area = 0.0;
  double integral = 0.0;
  for (std::uint32_t t = 0; t < surface_.triangles.size() / 3; ++t) {
    const std::array<Vec3, 3> corners = cornersOf(surface_, TriangleId(t));
    const double twiceArea =
        glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    area += twiceArea;
    integral += twiceArea / field_.tensorAt(middle, hint_).determinant();
  }
  return integral / area;
}

void ColumnSamples::cross(std::uint32_t columnsPerAxis, const std::vector<std::uint32_t>& active) {
  perAxis_ = columnsPerAxis;
  slots_.assign(std::size_t{perAxis_} * perAxis_, kNoIndex);
  for (std::uint32_t slot = 0; slot < active.size(); ++slot) slots_[active[slot]] = slot;
  crossings_.assign(active.size(), {});
  for (std::uint32_t t = 0; t < surface_.triangles.size() / 3; ++t) {
    if (!surface_.isInterface(t)) crossTriangle(t);
  }
}

void ColumnSamples::crossTriangle(std::uint32_t triangle) {
  const std::array<Vec3, 3> corners = cornersOf(surface_, TriangleId(triangle));
  const auto u = static_cast<int>(axes_[0]);
  const auto v = static_cast<int>(axes_[1]);
  const auto w = static_cast<int>(axes_[2]);
  std::array<std::int64_t, 2> first{};
  std::array<std::int64_t, 2> last{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto axis = static_cast<int>(axes_[k]);
    const double perLength = perAxis_ / (high_[axis] - low_[axis]);
    const double low = std::min({corners[0][axis], corners[1][axis], corners[2][axis]});
    const double high = std::max({corners[0][axis], corners[1][axis], corners[2][axis]});
    first[k] = std::max<std::int64_t>(
        0, static_cast<std::int64_t>(std::ceil((low - low_[axis]) * perLength - kOffset[k])));
    last[k] = std::min<std::int64_t>(
        perAxis_ - 1,
        static_cast<std::int64_t>(std::floor((high - low_[axis]) * perLength - kOffset[k])));
  }
  const auto side = [&](const Vec3& a, const Vec3& b, double x, double y) {
    return (b[u] - a[u]) * (y - a[v]) - (b[v] - a[v]) * (x - a[u]);
  };
  for (std::int64_t j = first[1]; j <= last[1]; ++j) {
    const double y = across(1, static_cast<double>(j));
    for (std::int64_t i = first[0]; i <= last[0]; ++i) {
      const std::uint32_t slot = slots_[static_cast<std::size_t>(j * perAxis_ + i)];
      if (slot == kNoIndex) continue;
      const double x = across(0, static_cast<double>(i));
      const double a = side(corners[1], corners[2], x, y);
      const double b = side(corners[2], corners[0], x, y);
      const double c = side(corners[0], corners[1], x, y);
      const bool isLeft = a > 0.0 && b > 0.0 && c > 0.0;
      if (!isLeft && !(a < 0.0 && b < 0.0 && c < 0.0)) continue;
      const double depth =
          (a * corners[0][w] + b * corners[1][w] + c * corners[2][w]) / (a + b + c);
      crossings_[slot].push_back({depth, isLeft ? 1 : -1});
    }
  }
}

/// Integrates along one column. Returns nothing if its crossings are inconsistent because it passes through an edge.
ColumnSamples::Column ColumnSamples::integrate(std::uint32_t column, std::uint32_t slot,
                                               double step) {
  std::vector<Crossing>& crossings = crossings_[slot];
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    for (std::size_t j = i; j > 0 && crossings[j].depth < crossings[j - 1].depth; --j) {
      std::swap(crossings[j], crossings[j - 1]);
    }
  }
  Vec3 at(0.0);
  const std::uint32_t row = column / perAxis_;
  at[static_cast<int>(axes_[0])] = across(0, column - row * perAxis_);
  at[static_cast<int>(axes_[1])] = across(1, row);
  Column interior;
  interior.minSize = std::numeric_limits<double>::max();
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding += crossings[i].winding;
    const double length = crossings[i + 1].depth - crossings[i].depth;
    if (winding == 0 || !(length > 0.0)) continue;
    const auto samples =
        static_cast<std::uint32_t>(std::min(std::ceil(length / step), kMaxSamples));
    const double sampleLength = length / samples;
    for (std::uint32_t k = 0; k < samples; ++k) {
      at[static_cast<int>(axes_[2])] = crossings[i].depth + (k + 0.5) * sampleLength;
      const SymmetricTensor target = field_.tensorAt(at, hint_);
      const double size = meanSizeOf(target);
      interior.integral += sampleLength / target.determinant();
      interior.minSize = std::min(interior.minSize, size);
      interior.maxSize = std::max(interior.maxSize, size);
    }
    interior.length += length;
  }
  const bool isConsistent = crossings.empty() || winding + crossings.back().winding == 0;
  return isConsistent ? interior : Column{};
}

}  // namespace tetrafront
