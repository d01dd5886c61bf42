#include "optimize/tiles.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include "base/sort.h"
#include "optimize/rules.h"

namespace tetrafront {
namespace {

/// Elements per unit of budget: cutting costs far less than a step of the front.
constexpr std::size_t kCutPerUnit = 32;

/// The tile of elements that are in none, and of nodes that belong to none.
constexpr std::uint32_t kRest = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kUnseen = kRest - 1;

/// An element and the sum of its corners, four times its centroid.
struct Middle {
  Vec3 sum;
  TetId tet;
};

Middle middleOf(const TetMesh& mesh, TetId tet) {
  Middle middle{Vec3(0.0), tet};
  for (const NodeId node : mesh.tetrahedra[tet.index()]) middle.sum += mesh.points[node.index()];
  return middle;
}

/// Returns the axis along which the middles extend most.
int longestAxis(std::span<const Middle> middles) {
  Vec3 low = middles.front().sum;
  Vec3 high = low;
  for (const Middle& middle : middles) {
    low = glm::min(low, middle.sum);
    high = glm::max(high, middle.sum);
  }
  const Vec3 extent = high - low;
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

/// Assigns elements to tiles by cutting across the longest axis again and again, so that the part `cut` lies below. Returns per element
/// its tile: kRest for those that are not among `middles`.
Task<std::vector<std::uint32_t>> tilesOf(Work& work, std::vector<Middle> middles, double cut,
                                         std::size_t elements) {
  std::vector<std::uint32_t> tileOf(elements, kRest);
  std::vector<std::span<Middle>> waiting{std::span(middles)};
  std::uint32_t tiles = 0;
  while (!waiting.empty()) {
    const std::span<Middle> part = waiting.back();
    waiting.pop_back();
    co_await work.spend(part.size() / kCutPerUnit + 1);
    if (part.size() <= kTileElements) {
      for (const Middle& middle : part) tileOf[middle.tet.index()] = tiles;
      ++tiles;
      continue;
    }
    const int axis = longestAxis(part);
    const auto below = static_cast<std::size_t>(cut * static_cast<double>(part.size()));
    std::ranges::nth_element(part, part.begin() + static_cast<std::ptrdiff_t>(below),
                             [axis](const Middle& a, const Middle& b) {
                               return a.sum[axis] != b.sum[axis] ? a.sum[axis] < b.sum[axis]
                                                                 : a.tet < b.tet;
                             });
    waiting.push_back(part.subspan(below));
    waiting.push_back(part.first(below));
  }
  co_return tileOf;
}

/// Returns per node the tile that all its elements are in, if it can move; else kRest.
std::vector<std::uint32_t> ownersOf(const TetMesh& mesh, const std::vector<std::uint32_t>& tileOf) {
  std::vector<std::uint32_t> owners(mesh.points.size(), kUnseen);
  for (const TetId tet : IdRange<TetId>(mesh.tetrahedra.size())) {
    for (const NodeId node : mesh.tetrahedra[tet.index()]) {
      std::uint32_t& owner = owners[node.index()];
      if (owner == kUnseen) owner = tileOf[tet.index()];
      if (owner != tileOf[tet.index()]) owner = kRest;
    }
  }
  for (const NodeId node : IdRange<NodeId>(owners.size())) {
    std::uint32_t& owner = owners[node.index()];
    if (owner == kUnseen || mesh.isFixed[node.index()] != 0) owner = kRest;
  }
  return owners;
}

/// Copies elements, and their nodes as they come, into tiles.
class TileCopy {
 public:
  TileCopy(const TetMesh& mesh, const std::vector<std::uint32_t>& owners,
           const std::vector<NodeId>& restId, std::size_t tiles)
      : mesh_(mesh), owners_(owners), restId_(restId), tiles_(tiles) {}

  /// Begins a tile; its elements must be added before the next one begins.
  void begin(std::uint32_t tile) {
    for (const NodeId node : touched_) localId_[node.index()] = NodeId();
    touched_.clear();
    localId_.resize(mesh_.points.size());
    tile_ = &tiles_[tile];
  }

  void add(TetId tet) {
    NodeQuad nodes = mesh_.tetrahedra[tet.index()];
    for (NodeId& node : nodes) node = localOf(node);
    tile_->mesh.tetrahedra.push_back(nodes);
    tile_->mesh.regions.push_back(mesh_.regions[tet.index()]);
  }

  [[nodiscard]] std::vector<Tile> take() { return std::move(tiles_); }

 private:
  NodeId localOf(NodeId node) {
    NodeId& local = localId_[node.index()];
    if (!local.isNone()) return local;
    touched_.push_back(node);
    TetMesh& mesh = tile_->mesh;
    local = NodeId(mesh.points.size());
    mesh.points.push_back(mesh_.points[node.index()]);
    const bool isFixed = owners_[node.index()] == kRest;
    mesh.isFixed.push_back(isFixed ? 1 : 0);
    if (isFixed) tile_->nodeOf.push_back(restId_[node.index()]);
    return local;
  }

  const TetMesh& mesh_;
  const std::vector<std::uint32_t>& owners_;
  const std::vector<NodeId>& restId_;
  std::vector<Tile> tiles_;
  Tile* tile_ = nullptr;
  std::vector<NodeId> localId_;
  std::vector<NodeId> touched_;
};

/// The elements of each tile, in their order, and then those that are in no tile.
struct Buckets {
  std::vector<TetId> elements;
  std::vector<std::size_t> begins;  ///< where those of each tile begin, and those that are in none
};

Buckets bucketsOf(const std::vector<std::uint32_t>& tileOf) {
  std::size_t tiles = 0;
  for (const std::uint32_t tile : tileOf) {
    if (tile != kRest) tiles = std::max<std::size_t>(tiles, tile + std::size_t{1});
  }
  const auto bucketOf = [&](std::uint32_t tile) { return tile == kRest ? tiles : tile; };
  std::vector<std::size_t> next(tiles + 2, 0);
  for (const std::uint32_t tile : tileOf) ++next[bucketOf(tile) + 1];
  for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  Buckets buckets{std::vector<TetId>(tileOf.size()), {next.begin(), next.end() - 1}};
  for (const TetId tet : IdRange<TetId>(tileOf.size())) {
    buckets.elements[next[bucketOf(tileOf[tet.index()])]++] = tet;
  }
  return buckets;
}

/// Visits the elements that have a node with a mark.
template <class Visit>
void forEachMarked(const TetMesh& mesh, const std::vector<std::uint8_t>& marks, Visit visit) {
  for (const TetId tet : IdRange<TetId>(mesh.tetrahedra.size())) {
    const NodeQuad& nodes = mesh.tetrahedra[tet.index()];
    if (std::ranges::any_of(nodes, [&](NodeId node) { return marks[node.index()] != 0; })) {
      visit(tet);
    }
  }
}

}  // namespace

Task<TiledMesh> TiledMesh::cut(Work& work, const TetMesh& mesh) {
  std::vector<Middle> middles;
  middles.reserve(mesh.tetrahedra.size());
  for (const TetId tet : IdRange<TetId>(mesh.tetrahedra.size())) {
    middles.push_back(middleOf(mesh, tet));
  }
  std::vector<std::uint32_t> tileOf =
      co_await tilesOf(work, std::move(middles), kFirstCut, mesh.tetrahedra.size());
  TiledMesh tiled = co_await make(work, mesh, std::move(tileOf));
  co_return tiled;
}

Task<TiledMesh> TiledMesh::cutSeams(Work& work, const TiledMesh& tiled) {
  const TetMesh mesh = tiled.joined();
  const std::vector<std::uint8_t> seams = tiled.seamsOfJoined();
  std::vector<std::uint8_t> near = seams;
  forEachMarked(mesh, seams, [&](TetId tet) {
    for (const NodeId node : mesh.tetrahedra[tet.index()]) near[node.index()] = 1;
  });
  std::vector<Middle> middles;
  forEachMarked(mesh, near, [&](TetId tet) { middles.push_back(middleOf(mesh, tet)); });
  std::vector<std::uint32_t> tileOf =
      co_await tilesOf(work, std::move(middles), kSecondCut, mesh.tetrahedra.size());
  TiledMesh atSeams = co_await make(work, mesh, std::move(tileOf));
  co_return atSeams;
}

/// Takes a mesh apart into tiles. `tileOf`: per element.
Task<TiledMesh> TiledMesh::make(Work& work, const TetMesh& mesh,
                                std::vector<std::uint32_t> tileOf) {
  const std::vector<std::uint32_t> owners = ownersOf(mesh, tileOf);
  TiledMesh tiled;
  TetMesh& rest = tiled.rest_;
  std::vector<NodeId> restId(mesh.points.size());
  for (const NodeId node : IdRange<NodeId>(mesh.points.size())) {
    if (owners[node.index()] != kRest) continue;
    restId[node.index()] = NodeId(rest.points.size());
    rest.points.push_back(mesh.points[node.index()]);
    rest.isFixed.push_back(mesh.isFixed[node.index()]);
  }
  const Buckets buckets = bucketsOf(tileOf);
  const std::size_t tiles = buckets.begins.size() - 1;
  TileCopy copy(mesh, owners, restId, tiles);
  for (std::uint32_t tile = 0; tile < tiles; ++tile) {
    copy.begin(tile);
    const std::size_t last = buckets.begins[tile + 1];
    for (std::size_t i = buckets.begins[tile]; i < last; ++i) copy.add(buckets.elements[i]);
    co_await work.spend((last - buckets.begins[tile]) / kCutPerUnit + 1);
  }
  tiled.tiles_ = copy.take();
  for (std::size_t i = buckets.begins[tiles]; i < buckets.elements.size(); ++i) {
    const TetId tet = buckets.elements[i];
    NodeQuad nodes = mesh.tetrahedra[tet.index()];
    for (NodeId& node : nodes) node = restId[node.index()];
    rest.tetrahedra.push_back(nodes);
    rest.regions.push_back(mesh.regions[tet.index()]);
  }
  co_return tiled;
}

/// Returns per node of joined() whether it is on a seam: of the rest, but not fixed.
std::vector<std::uint8_t> TiledMesh::seamsOfJoined() const {
  std::vector<std::uint8_t> seams(nodeCount(), 0);
  for (std::size_t node = 0; node < rest_.points.size(); ++node) {
    seams[node] = rest_.isFixed[node] == 0 ? 1 : 0;
  }
  return seams;
}

TetMesh TiledMesh::joined() const {
  TetMesh mesh = rest_;
  mesh.points.reserve(nodeCount());
  mesh.tetrahedra.reserve(tetrahedronCount());
  mesh.regions.reserve(tetrahedronCount());
  for (const auto& [part, nodeOf] : tiles_) {
    std::vector<NodeId> newId;
    newId.reserve(part.points.size());
    std::size_t fixed = 0;
    for (std::size_t node = 0; node < part.points.size(); ++node) {
      if (part.isFixed[node] != 0) {
        newId.push_back(nodeOf[fixed++]);
      } else {
        newId.emplace_back(mesh.points.size());
        mesh.points.push_back(part.points[node]);
      }
    }
    for (NodeQuad nodes : part.tetrahedra) {
      for (NodeId& node : nodes) node = newId[node.index()];
      mesh.tetrahedra.push_back(nodes);
    }
    mesh.regions.insert(mesh.regions.end(), part.regions.begin(), part.regions.end());
  }
  mesh.isFixed.resize(mesh.points.size(), 0);
  return mesh;
}

std::size_t TiledMesh::nodeCount() const {
  std::size_t count = rest_.points.size();
  for (const Tile& tile : tiles_) count += tile.mesh.points.size() - tile.nodeOf.size();
  return count;
}

std::size_t TiledMesh::tetrahedronCount() const {
  std::size_t count = rest_.tetrahedra.size();
  for (const Tile& tile : tiles_) count += tile.mesh.tetrahedra.size();
  return count;
}

}  // namespace tetrafront
