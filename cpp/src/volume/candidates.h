#pragma once

/// @file Step F5.2 (Löhner & Parikh 1988, section 2): which nodes are tried to complete a base face, and in which order.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"
#include "volume/crossing.h"
#include "volume/ideal_point.h"
#include "volume/neighbourhood.h"
#include "volume/rules.h"
#include "volume/search_region.h"

namespace tetrafront {

/// The terms of a candidate's score beside the shape of its element.
struct ScoreTerms {
  std::uint8_t closed = 0;  ///< existing node: edges of the base at which it meets a face, 0 to 3
  bool isWedge = false;     ///< existing node: the apex of a face that forms a wedge with the base
  std::uint8_t height = 0;  ///< new node: index in kHeights
  bool hasLowWeight = false;  ///< new node: its weight is kLowNewNodeWeight
};

struct Candidate {
  static constexpr LocalNode kNewNode = 0xffffffffU;
  double score;
  LocalNode node;  ///< local index, or kNewNode
  ScoreTerms terms;
  Vec3 unitPosition;
};

/// The apexes of the faces that share an edge with the base face.
class EdgeNeighbours {
 public:
  /// Finds them in the neighbourhood. A face that folds over the base with a dihedral angle below
  /// 90 degrees on the empty side forms a wedge with it. Its apex must be a candidate, wherever it
  /// is. Extends the region to all wedge apexes; returns true if it grew, so that the neighbourhood
  /// must be gathered again.
  bool find(const Neighbourhood& around, const BaseFace& base, SearchRegion& region);

  /// Returns the number of edges of the base face at which there is a face with this apex, 0 to 3.
  [[nodiscard]] std::uint8_t edgesClosedBy(LocalNode node) const { return edgesClosed_[node]; }
  [[nodiscard]] bool isWedgeApex(LocalNode node) const;

 private:
  std::vector<std::uint8_t> edgesClosed_;
  std::array<LocalNode, 3> wedgeApexes_{};
  std::size_t wedgeCount_ = 0;
};

class CandidateList {
 public:
  /// Ranks existing nodes and, if the class permits, new ones on the line from the base's centroid
  /// to the ideal point.
  void rank(const Neighbourhood& around, const CrossingTest& crossing, const BaseFace& base,
            const IdealPoint& ideal, const EdgeNeighbours& neighbours, const RuleClass& rules,
            const RuleVariant& variant);

  /// Number of candidates ranked.
  [[nodiscard]] std::size_t size() const { return candidates_.size(); }

  /// Returns the best candidate not returned yet, or nullptr. O(number of candidates).
  const Candidate* next();

 private:
  void offerExisting(const Neighbourhood& around, const CrossingTest& crossing,
                     const BaseFace& base, const IdealPoint& ideal,
                     const EdgeNeighbours& neighbours, const RuleClass& rules);
  void offerNew(const Neighbourhood& around, const BaseFace& base, const IdealPoint& ideal,
                const RuleClass& rules, double weight);

  std::vector<Candidate> candidates_;
  std::size_t taken_ = 0;
};

}  // namespace tetrafront
