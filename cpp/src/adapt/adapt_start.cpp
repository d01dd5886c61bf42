#include "adapt/adapt_start.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/sort.h"
#include "topology/face_table.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

void addOuterFace(const GivenMesh& given, const PatchTable& patches, ElementFace face,
                  StartFaces& out) {
  out.beyond[face.index()] = Beyond::patch(SmoothPatchId(out.outer.size()));
  out.outer.push_back(face);
  std::array<std::uint32_t, 3> origins{};
  const NodeTriple nodes = nodesOf(given.mesh, face);
  for (std::size_t k = 0; k < 3; ++k) {
    out.boundary.triangles.push_back(nodes[k].value);
    origins[k] = given.nodeOrigin[nodes[k].index()];
  }
  out.boundary.trianglePatch.push_back(patches.patchOf(origins));
}

}  // namespace

PatchTable::PatchTable(std::span<const std::uint32_t> triangles,
                       std::span<const std::uint32_t> patches) {
  for (std::size_t t = 0; 3 * t < triangles.size(); ++t) {
    entries_.push_back(
        {sorted(std::array{triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]}),
         patches.empty() ? 0U : patches[t]});
  }
  stableSort(entries_, [](const Entry& a, const Entry& b) { return a.nodes < b.nodes; });
}

std::uint32_t PatchTable::patchOf(const std::array<std::uint32_t, 3>& nodes) const {
  const std::array<std::uint32_t, 3> wanted = sorted(nodes);
  const auto found = std::ranges::lower_bound(entries_, wanted, {}, &Entry::nodes);
  return found != entries_.end() && found->nodes == wanted ? found->patch : 0;
}

Task<StartFaces> findStartFaces(Work& work, const GivenMesh& given,
                                std::span<const std::uint32_t> triangles,
                                std::span<const std::uint32_t> trianglePatch) {
  const VolumeMesh& mesh = given.mesh;
  StartFaces out;
  out.beyond.resize(mesh.tetrahedra.size());
  out.boundary.points = mesh.points;
  out.isFixed.assign(countNodes(mesh), 0);
  const PatchTable patches(triangles, trianglePatch);
  work.beginPart(0.8);
  FaceTable<ElementFace> table = co_await listFaces<ElementFace>(
      work, countNodes(mesh), countTetrahedra(mesh), [&mesh](std::size_t item, const auto& use) {
        for (std::size_t k = 0; k < 4; ++k) {
          const ElementFace face(TetId(item), k);
          use(nodesOf(mesh, face), face);
        }
      });
  work.beginPart(1.0);
  co_await work.forEachId<NodeId>(countNodes(mesh), [&](NodeId node) {
    table.forEachGroup(node, [&](std::span<const FaceTable<ElementFace>::Face> owners) {
      const ElementFace one = owners[0].owner;
      if (owners.size() == 1) return addOuterFace(given, patches, one, out);
      const ElementFace other = owners[1].owner;
      if (mesh.regions[one.tet().index()] == mesh.regions[other.tet().index()]) {
        out.beyond[one.index()] = Beyond(other.tet());
        out.beyond[other.index()] = Beyond(one.tet());
        return;
      }
      for (const NodeId kept : nodesOf(mesh, one)) out.isFixed[kept.index()] = 1;
    });
  });
  co_return out;
}

namespace {

/// Divides the elements at each node into sets that are connected over faces.
class NodeSplitter {
 public:
  NodeSplitter(const GivenMesh& given, const StartFaces& faces, AdaptStart& start)
      : given_(given), faces_(faces), start_(start) {}

  void run() {
    const std::size_t elements = countTetrahedra(given_.mesh);
    std::vector<std::uint32_t> begins(countNodes(given_.mesh) + 1, 0);
    const std::vector<std::uint32_t>& corners = given_.mesh.tetrahedra;
    for (const std::uint32_t node : corners) ++begins[node + 1];
    for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
    std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
    std::vector<std::uint32_t> at(corners.size());
    for (std::uint32_t c = 0; c < corners.size(); ++c) at[next[corners[c]]++] = c;
    start_.mesh.elements.resize(elements);
    for (const NodeId node : IdRange<NodeId>(countNodes(given_.mesh))) {
      const std::span<const std::uint32_t> own(at.data() + begins[node.index()],
                                               at.data() + begins[node.index() + 1]);
      for (const std::uint32_t corner : own) {
        if (start_.mesh.elements[corner / 4].nodes[corner % 4].isNone()) addSet(node, corner);
      }
    }
  }

 private:
  /// Makes a node for the elements around `node` that are connected to the one with `corner`.
  void addSet(NodeId node, std::uint32_t corner) {
    const NodeId made(start_.origin.size());
    start_.origin.push_back(node);
    start_.mesh.nodes.emplace_back();
    stack_.assign(1, corner);
    while (!stack_.empty()) {
      const std::uint32_t at = stack_.back();
      stack_.pop_back();
      NodeId& own = start_.mesh.elements[at / 4].nodes[at % 4];
      if (own == made) continue;
      own = made;
      for (std::uint32_t k = 0; k < 4; ++k) {
        const Beyond beyond = faces_.beyond[at / 4 * 4 + k];
        if (k == at % 4 || !beyond.isElement()) continue;
        const std::uint32_t first = 4 * beyond.element().value;
        for (std::uint32_t j = first; j < first + 4; ++j) {
          if (given_.mesh.tetrahedra[j] == node.value) stack_.push_back(j);
        }
      }
    }
  }

  const GivenMesh& given_;
  const StartFaces& faces_;
  AdaptStart& start_;
  std::vector<std::uint32_t> stack_;
};

}  // namespace

std::vector<std::uint8_t> nodesInSeveralSets(const GivenMesh& given, const StartFaces& faces) {
  AdaptStart start;
  NodeSplitter(given, faces, start).run();
  std::vector<std::uint8_t> isRepeated(countNodes(given.mesh), 0);
  for (std::size_t i = 1; i < start.origin.size(); ++i) {
    // The nodes of one origin follow each other.
    if (start.origin[i] == start.origin[i - 1]) isRepeated[start.origin[i].index()] = 1;
  }
  return isRepeated;
}

BoundaryPlaces placesOnReference(const BoundaryGuide& guide) {
  const ReferenceSurface& reference = guide.reference();
  BoundaryPlaces out;
  for (const NodeId node : IdRange<NodeId>(countNodes(reference.mesh())))
    out.nodes.push_back(guide.placeOf(node));
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(reference.mesh())))
    out.patches.push_back(reference.patchOf(t));
  return out;
}

AdaptStart makeStart(const GivenMesh& given, const StartFaces& faces,
                     const BoundaryPlaces& places) {
  AdaptStart start;
  NodeSplitter(given, faces, start).run();
  for (const NodeId node : IdRange<NodeId>(start.origin.size())) {
    const NodeId origin = start.origin[node.index()];
    AdaptNode& made = start.mesh.node(node);
    made.point = pointOf(given.mesh, origin);
    made.place = places.nodes[origin.index()];
    made.changed = start.mesh.now;
  }
  for (const TetId id : IdRange<TetId>(start.mesh.elements.size())) {
    AdaptElement& element = start.mesh.element(id);
    for (std::size_t k = 0; k < 4; ++k) {
      AdaptNode& node = start.mesh.node(element.nodes[k]);
      node.element = id;
      node.part = given.mesh.regions[id.index()];
      const Beyond beyond = faces.beyond[4 * id.index() + k];
      element.beyond[k] =
          beyond.isPatch() ? Beyond::patch(places.patches[beyond.patch().index()]) : beyond;
    }
  }
  return start;
}

}  // namespace tetrafront
