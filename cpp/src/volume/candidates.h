#pragma once

/// @file Step F5.2: which nodes are offered to complete a base face, and in which order.

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

struct Candidate {
  static constexpr LocalNode kNewNode = 0xffffffffU;
  double score;
  LocalNode node;     ///< in the neighbourhood, or kNewNode
  Vec3 unitPosition;  ///< in unit space
};

/// The nodes of faces that share a side with the base face.
class EdgeNeighbours {
 public:
  /// Finds them in the neighbourhood. Faces that fold over the base with a dihedral angle below
  /// 90 degrees on the empty side form a wedge with it; their apexes must be offered, wherever
  /// they are. The region is made to hold those apexes; returns true if it grew, when the
  /// neighbourhood must be gathered again.
  bool find(const Neighbourhood& around, const BaseFace& base, SearchRegion& region);

  /// How many sides of the base face a face with this apex stands on.
  [[nodiscard]] std::uint8_t edgesClosedBy(LocalNode node) const { return edgesClosed_[node]; }
  [[nodiscard]] bool isWedgeApex(LocalNode node) const;

 private:
  std::vector<std::uint8_t> edgesClosed_;
  std::array<LocalNode, 3> wedgeApexes_{};
  std::size_t wedgeCount_ = 0;
};

class CandidateList {
 public:
  /// Ranks existing nodes and, where the class allows it, new ones on the line from the base's
  /// centroid to the ideal point.
  void rank(const Neighbourhood& around, const CrossingTest& crossing, const BaseFace& base,
            const IdealPoint& ideal, const EdgeNeighbours& neighbours, const RuleClass& rules,
            const RuleVariant& variant);

  /// The best of those not taken yet, or nullptr. O(number of candidates).
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
