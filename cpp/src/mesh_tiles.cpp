/// @file Lends tiles of a run to other engines, and optimizes tiles of another one.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "base/task.h"
#include "field/size_field.h"
#include "mesh_run.h"
#include "optimize/tile_runner.h"
#include "optimize/tiles.h"
#include "tetrafront/tile_host.h"
#include "topology/tet_mesh.h"

namespace tetrafront {
namespace {

TileMesh toTileMesh(const TetMesh& mesh) {
  TileMesh tile;
  tile.regions = mesh.regions;
  tile.isFixed = mesh.isFixed;
  tile.points.reserve(3 * mesh.points.size());
  for (const Vec3& point : mesh.points) {
    tile.points.insert(tile.points.end(), {point.x, point.y, point.z});
  }
  tile.tetrahedra.reserve(4 * mesh.tetrahedra.size());
  for (const NodeQuad& nodes : mesh.tetrahedra) {
    for (const NodeId node : nodes) tile.tetrahedra.push_back(node.value);
  }
  return tile;
}

TetMesh ofTileMesh(const TileMesh& tile) {
  TetMesh mesh;
  mesh.regions = tile.regions;
  mesh.isFixed = tile.isFixed;
  mesh.points.reserve(tile.isFixed.size());
  for (std::size_t i = 0; i + 2 < tile.points.size(); i += 3) {
    mesh.points.emplace_back(tile.points[i], tile.points[i + 1], tile.points[i + 2]);
  }
  mesh.tetrahedra.reserve(tile.regions.size());
  for (std::size_t i = 0; i + 3 < tile.tetrahedra.size(); i += 4) {
    mesh.tetrahedra.push_back({NodeId(tile.tetrahedra[i]), NodeId(tile.tetrahedra[i + 1]),
                               NodeId(tile.tetrahedra[i + 2]), NodeId(tile.tetrahedra[i + 3])});
  }
  return mesh;
}

/// Returns whether the lengths of the arrays agree and exactly `fixedNodes` nodes are fixed.
bool canBeResult(const TileMesh& tile, std::size_t fixedNodes) {
  const std::size_t nodes = tile.isFixed.size();
  return tile.points.size() == 3 * nodes && tile.tetrahedra.size() == 4 * tile.regions.size() &&
         std::ranges::all_of(tile.tetrahedra, [&](std::uint32_t node) { return node < nodes; }) &&
         static_cast<std::size_t>(std::ranges::count(tile.isFixed, std::uint8_t{1})) == fixedNodes;
}

}  // namespace

std::uint32_t TileHost::waitingCount() const {
  return static_cast<std::uint32_t>(run_.impl_->lender().waitingCount());
}

bool TileHost::isWaiting() const { return run_.impl_->lender().isWaitingForLent(); }

std::vector<std::uint8_t> TileHost::steps() const {
  const TileSteps* steps = run_.impl_->lender().steps();
  if (steps == nullptr) return {};
  ByteWriter writer;
  writer(steps->level, steps->field);
  return writer.take();
}

LentTile TileHost::lend() {
  TileLender& lender = run_.impl_->lender();
  const std::optional<std::uint32_t> id = lender.lend();
  return id ? LentTile{*id, toTileMesh(lender.lentTile(*id)->mesh)} : LentTile{};
}

bool TileHost::giveBack(std::uint32_t id, const TileMesh& result) {
  TileLender& lender = run_.impl_->lender();
  const Tile* tile = lender.lentTile(id);
  if (tile == nullptr) return true;
  if (!canBeResult(result, tile->nodeOf.size())) {
    lender.withdraw(id);
    return false;
  }
  lender.giveBack(id, ofTileMesh(result));
  return true;
}

void TileHost::withdraw(std::uint32_t id) { run_.impl_->lender().withdraw(id); }

class TileOptimizer::Impl {
 public:
  explicit Impl(std::span<const std::uint8_t> steps) {
    ByteReader reader(steps);
    reader(steps_.level, field_);
  }

  void begin(const TileMesh& tile) {
    job_.reset();
    mesh_ = ofTileMesh(tile);
    job_.emplace([this](Work& work) { return steps_.run(work, mesh_); });
  }
  bool advance(std::uint32_t budget) {
    if (job_ && job_->advance(budget)) job_.reset();
    return !job_;
  }
  [[nodiscard]] TileMesh result() const { return toTileMesh(mesh_); }

 private:
  SizeField field_ = SizeField::uniform(1.0);
  TileSteps steps_{field_, Optimization::kNone};
  TetMesh mesh_;
  std::optional<Job<>> job_;  ///< the last member: its tasks use the others
};

TileOptimizer::TileOptimizer(std::span<const std::uint8_t> steps)
    : impl_(std::make_unique<Impl>(steps)) {}
TileOptimizer::TileOptimizer(TileOptimizer&&) noexcept = default;
TileOptimizer& TileOptimizer::operator=(TileOptimizer&&) noexcept = default;
TileOptimizer::~TileOptimizer() = default;

void TileOptimizer::begin(const TileMesh& tile) { impl_->begin(tile); }
bool TileOptimizer::advance(std::uint32_t budget) { return impl_->advance(budget); }
TileMesh TileOptimizer::result() const { return impl_->result(); }

}  // namespace tetrafront
