#include "model/joined_solids.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace tetrafront {
namespace {

/// Joins items of different solids that have the same key and pass a comparison: each to at most one item of another solid.
template <class Key>
class ItemJoiner {
 public:
  /// Returns the first item with the same key for which `isSame` holds and that no solid of `solids` uses; the item itself if there
  /// is none.
  template <class IsSame>
  std::uint32_t join(std::uint32_t item, const Key& key, const std::set<std::uint32_t>& solids,
                     const IsSame& isSame) {
    std::vector<Kept>& known = kept_[key];
    const auto entry = std::ranges::find_if(known, [&](const Kept& other) {
      return std::ranges::none_of(solids,
                                  [&](std::uint32_t one) { return other.solids.contains(one); }) &&
             isSame(other.item);
    });
    if (entry == known.end()) {
      known.push_back({item, solids});
      return item;
    }
    entry->solids.insert(solids.begin(), solids.end());
    return entry->item;
  }

 private:
  struct Kept {
    std::uint32_t item = 0;
    std::set<std::uint32_t> solids;
  };
  std::map<Key, std::vector<Kept>> kept_;
};

using Solids = std::vector<std::set<std::uint32_t>>;

/// Replaces vertices, edges and faces of a model, one kind after the other.
class SolidJoiner {
 public:
  explicit SolidJoiner(TrimmedModel model)
      : ofVertices_(model.vertices.size()), ofEdges_(model.edges.size()) {
    joined_.model = std::move(model);
    findUsers();
  }

  JoinedSolids take() {
    joinVertices();
    joinEdges();
    joinFaces();
    return std::move(joined_);
  }

 private:
  /// Finds the solids that use each vertex and each edge.
  void findUsers() {
    const TrimmedModel& model = joined_.model;
    for (const TrimmedFace& face : model.faces) {
      for (const std::vector<Coedge>& loop : face.loops) {
        for (const Coedge& coedge : loop) {
          const TrimmedEdge& edge = model.edges[coedge.edge];
          for (const std::uint32_t solid : {face.solid, face.otherSolid}) {
            if (solid == TrimmedFace::kNone) continue;
            ofEdges_[coedge.edge].insert(solid);
            ofVertices_[edge.start].insert(solid);
            ofVertices_[edge.end].insert(solid);
          }
        }
      }
    }
  }

  void joinVertices() {
    TrimmedModel& model = joined_.model;
    ItemJoiner<std::array<double, 3>> joiner;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t v = 0; v < model.vertices.size(); ++v) {
      const Vec3& position = model.vertices[v];
      kept.push_back(joiner.join(v, {position.x, position.y, position.z}, ofVertices_[v],
                                 [](std::uint32_t) { return true; }));
    }
    for (TrimmedEdge& edge : model.edges) {
      edge.start = kept[edge.start];
      edge.end = kept[edge.end];
    }
  }

  void joinEdges() {
    TrimmedModel& model = joined_.model;
    ItemJoiner<std::pair<std::array<std::uint32_t, 2>, std::array<double, 2>>> joiner;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t e = 0; e < model.edges.size(); ++e) {
      const TrimmedEdge& edge = model.edges[e];
      const auto hasSameCurve = [&](std::uint32_t other) {
        const std::optional<std::uint32_t>& curve = model.edges[other].curve;
        if (!edge.curve || !curve) return edge.curve == curve;
        return model.curves[*edge.curve] == model.curves[*curve];
      };
      const std::uint32_t first = joiner.join(e, {{edge.start, edge.end}, {edge.first, edge.last}},
                                              ofEdges_[e], hasSameCurve);
      kept.push_back(first);
      TrimmedEdge& joined = model.edges[first];
      joined.tolerance = std::max(joined.tolerance, edge.tolerance);
    }
    for (TrimmedFace& face : model.faces) {
      for (std::vector<Coedge>& loop : face.loops) {
        for (Coedge& coedge : loop) coedge.edge = kept[coedge.edge];
      }
    }
  }

  void joinFaces() {
    TrimmedModel& model = joined_.model;
    ItemJoiner<std::vector<std::uint32_t>> joiner;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
      const TrimmedFace& face = model.faces[f];
      const bool isFree = face.otherSolid == TrimmedFace::kNone;
      const auto isOtherSide = [&](std::uint32_t other) {
        const TrimmedFace& before = model.faces[other];
        return isFree && before.otherSolid == TrimmedFace::kNone &&
               before.reversed != face.reversed &&
               model.surfaces[before.surface] == model.surfaces[face.surface];
      };
      kept.push_back(joiner.join(f, edgesOf(face), {face.solid}, isOtherSide));
      if (kept.back() != f) model.faces[kept.back()].otherSolid = face.solid;
    }
    std::vector<TrimmedFace> faces;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
      if (kept[f] != f) continue;
      faces.push_back(std::move(model.faces[f]));
      joined_.givenFaces.push_back(f);
    }
    model.faces = std::move(faces);
  }

  static std::vector<std::uint32_t> edgesOf(const TrimmedFace& face) {
    std::vector<std::uint32_t> edges;
    for (const std::vector<Coedge>& loop : face.loops) {
      for (const Coedge& coedge : loop) edges.push_back(coedge.edge);
    }
    std::ranges::sort(edges);
    return edges;
  }

  JoinedSolids joined_;
  Solids ofVertices_;  ///< solids that use each vertex
  Solids ofEdges_;     ///< solids that use each edge
};

}  // namespace

JoinedSolids joinSolids(TrimmedModel model) { return SolidJoiner(std::move(model)).take(); }

}  // namespace tetrafront
