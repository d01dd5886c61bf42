#include "tetrafront/grid_from_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/ids.h"

namespace tetrafront {
namespace {

/// Target size / mean edge length of the mesh that it leads to.
constexpr double kSizePerEdge = 0.9;

/// Coverage margin: on a curved patch, another mesh has nodes outside the triangles of this one.
/// Allows for the bulge over an edge that spans 100 degrees of a circle.
constexpr double kOverhang = 0.25;

constexpr std::array<std::pair<std::size_t, std::size_t>, 6> kEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

Vec3 placeOf(const VolumeMesh& mesh, std::uint32_t node) {
  const std::size_t i = 3 * std::size_t{node};
  return {mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
}

}  // namespace

/// Visits the elements to average the edge lengths at each node, then the nodes, then the elements
/// again to add them to the grid. Leaves out nodes without elements.
class MeshGridBuilder::Impl {
 public:
  Impl(VolumeMesh mesh, std::vector<double> sizes)
      : mesh_(std::move(mesh)),
        sizes_(std::move(sizes)),
        numbers_(mesh_.points.size() / 3, kNoIndex),
        elements_(mesh_.tetrahedra.size() / 4) {
    if (sizes_.empty()) {
      edges_.assign(numbers_.size(), 0.0);
      counts_.assign(numbers_.size(), 0);
    }
    grid_.coverageMargin = kOverhang;
    grid_.nodes.reserve(numbers_.size());
    grid_.tetrahedra.reserve(elements_);
  }

  bool advance(std::uint32_t budget) {
    const std::size_t last = next_ + std::min<std::size_t>(budget, steps() - next_);
    for (; next_ < last; ++next_) step(next_);
    return next_ == steps();
  }
  [[nodiscard]] double fraction() const {
    return steps() == 0 ? 1.0 : static_cast<double>(next_) / static_cast<double>(steps());
  }
  [[nodiscard]] const BackgroundGrid& result() const { return grid_; }

 private:
  [[nodiscard]] std::size_t steps() const { return 2 * elements_ + numbers_.size(); }

  void step(std::size_t number) {
    if (number < elements_) return readElement(number);
    const std::size_t after = number - elements_;
    if (after < numbers_.size()) return addNode(static_cast<std::uint32_t>(after));
    addElement(after - numbers_.size());
  }

  [[nodiscard]] std::uint32_t nodeOf(std::size_t element, std::size_t corner) const {
    return mesh_.tetrahedra[4 * element + corner];
  }

  /// An edge counts once per element, so interior edges, which have more elements, have more
  /// weight.
  void readElement(std::size_t element) {
    for (std::size_t k = 0; k < 4; ++k) numbers_[nodeOf(element, k)] = 0;
    if (!sizes_.empty()) return;
    for (const auto& [i, j] : kEdges) {
      const std::uint32_t a = nodeOf(element, i);
      const std::uint32_t b = nodeOf(element, j);
      const double length = glm::length(placeOf(mesh_, a) - placeOf(mesh_, b));
      edges_[a] += length;
      edges_[b] += length;
      ++counts_[a];
      ++counts_[b];
    }
  }

  void addNode(std::uint32_t i) {
    if (numbers_[i] == kNoIndex) return;
    numbers_[i] = static_cast<std::uint32_t>(grid_.nodes.size());
    BackgroundNode node;
    node.position = placeOf(mesh_, i);
    node.size = sizes_.empty() ? kSizePerEdge * (edges_[i] / counts_[i]) : sizes_[i];
    grid_.nodes.push_back(node);
  }

  void addElement(std::size_t element) {
    const auto n = [&](std::size_t corner) { return numbers_[nodeOf(element, corner)]; };
    grid_.tetrahedra.push_back({n(0), n(1), n(2), n(3)});
  }

  VolumeMesh mesh_;
  std::vector<double> sizes_;
  std::vector<std::uint32_t>
      numbers_;                        ///< per node of the mesh: its index in the grid, or kNoIndex
  std::vector<double> edges_;          ///< per node: sum of its edge lengths
  std::vector<std::uint32_t> counts_;  ///< per node: number of its edges
  std::size_t elements_;
  std::size_t next_ = 0;
  BackgroundGrid grid_;
};

MeshGridBuilder::MeshGridBuilder(VolumeMesh mesh, std::vector<double> sizes)
    : impl_(std::make_unique<Impl>(std::move(mesh), std::move(sizes))) {}
MeshGridBuilder::MeshGridBuilder(MeshGridBuilder&&) noexcept = default;
MeshGridBuilder& MeshGridBuilder::operator=(MeshGridBuilder&&) noexcept = default;
MeshGridBuilder::~MeshGridBuilder() = default;

bool MeshGridBuilder::advance(std::uint32_t budget) { return impl_->advance(std::max(budget, 1U)); }
double MeshGridBuilder::fraction() const { return impl_->fraction(); }
const BackgroundGrid& MeshGridBuilder::result() const { return impl_->result(); }

BackgroundGrid gridFromMesh(const VolumeMesh& mesh, std::span<const double> sizes) {
  MeshGridBuilder gridder(mesh, {sizes.begin(), sizes.end()});
  while (!gridder.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  return gridder.result();
}

}  // namespace tetrafront
