#pragma once

/// @file The last step of recovery: the exact fill of one pocket after the other. If doubles cannot
/// hold an interior point, the volume around it stays open. Only this volume is tried again, with
/// the elements around it and in other orders. Mostly this succeeds, because the mesh around it is
/// a different one. Pockets that resist are enlarged more and more, at last to everything that is
/// connected.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "volume/element_index.h"
#include "volume/elements.h"
#include "volume/enlarged_pocket.h"
#include "volume/front.h"
#include "volume/pocket_fill.h"

namespace tetrafront {

class PocketFiller {
 public:
  /// Everything except the pockets in `pockets` must be filled.
  /// `maxCost` limits all tries together, in units of ExactFill; without it, the limit grows with the pockets. At the limit,
  /// the remaining pockets stay open.
  PocketFiller(Front& front, Elements& elements, ElementIndex& index, PocketSet& pockets,
               std::optional<std::uint64_t> maxCost = {});

  /// Does work that costs about `budget` steps of the front; returns the actual cost.
  std::size_t work(std::uint32_t budget);
  [[nodiscard]] bool isDone() const { return stack_.empty(); }
  /// Estimated progress, 0 to 1, from the faces of the pockets. It decreases if a pocket needs more
  /// tries.
  [[nodiscard]] double fraction() const;

  struct Made {
    IndexRange elements;
    IndexRange nodes;
  };
  /// Elements and nodes made by each fill. Filling a larger pocket may have removed them again.
  [[nodiscard]] const std::vector<Made>& made() const { return made_; }

 private:
  /// How a pocket is tried.
  struct Try {
    std::uint32_t triesMade;  ///< number of first tries made
    std::uint32_t rings;      ///< rings of elements removed with the pocket
    unsigned order;           ///< see ExactFill::kOrders
    /// number of elements removed in the previous try, with half as many rings
    std::optional<std::size_t> removed = {};
    bool isLargest = false;    ///< more rings have no more elements
    bool isLastRound = false;  ///< of all orders, without a cost limit
  };
  /// Share of a pocket in the estimate of progress.
  struct Weight {
    double faces = 0.0;
    double remaining = 1.0;  ///< share that failed tries have left to be done
  };

  std::size_t begin();
  void push(PocketId pocket);
  void pop();
  void finish();
  std::vector<FaceId> apply();
  void queueOpen(std::vector<FaceId> open, Try tried);
  bool prepareNext(Try& now) const;
  void giveUp();
  [[nodiscard]] bool canFillPartially(const Try& now) const;

  Front& front_;
  Elements& elements_;
  ElementIndex& index_;
  PocketSet& pockets_;
  std::vector<PocketId> stack_;  ///< the next pocket is the last entry
  std::vector<Try> tries_;       ///< per pocket
  std::vector<Weight> weights_;  ///< per pocket
  double totalFaces_ = 0.0;      ///< of all pockets so far
  double waitingFaces_ = 0.0;    ///< of the pockets in stack_
  std::optional<EnlargedPocket> enlarged_;
  std::optional<PocketFill> fill_;
  ExactFill::State fillState_ = ExactFill::State::kRunning;
  std::uint32_t partialFillsLeft_;
  std::uint64_t costLeft_;  ///< of all further tries, in units of ExactFill
  std::vector<Made> made_;
};

}  // namespace tetrafront
