#pragma once

/// @file The last rung: the exact fill of one pocket after the other. Where points have no position in doubles
/// what is around them stays open, and only that is tried again, with the elements around it and in other
/// orders; most of it is filled so, as the mesh around is another one then. What resists is tried in ever
/// larger positions, in the end in all that hangs together.

#include <cstdint>
#include <limits>
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
  /// All but the pockets left in `pockets` must be filled.
  PocketFiller(Front& front, Elements& elements, ElementIndex& index, PocketSet& pockets);

  /// Works on for about `budget` steps of the front; returns what it took.
  std::size_t work(std::uint32_t budget);
  [[nodiscard]] bool isDone() const { return stack_.empty(); }
  /// How far it is, 0 to 1, estimated by the faces of the pockets; falls where a pocket turns out to take more
  /// tries.
  [[nodiscard]] double fraction() const;

  struct Made {
    IndexRange elements;
    IndexRange nodes;
  };
  /// By each fill; larger ones may have taken it away again.
  [[nodiscard]] const std::vector<Made>& made() const { return made_; }

 private:
  static constexpr std::size_t kNoElements = std::numeric_limits<std::size_t>::max();
  /// What is tried with a pocket.
  struct Try {
    std::uint32_t step;        ///< how many of the first tries have been
    std::uint32_t rings;       ///< of elements taken away with it
    unsigned order;            ///< see ExactFill::kOrders
    std::size_t removed;       ///< how many elements that were with half as many rings
    bool isLargest = false;    ///< more rings have no more elements
    bool isLastRound = false;  ///< of all orders, whatever it costs
  };
  /// By which progress is measured.
  struct Weight {
    double faces = 0.0;
    double left = 1.0;  ///< what tries that failed have left of it
  };

  std::size_t begin();
  void push(PocketId pocket);
  void pop();
  void finish();
  std::vector<FaceId> apply();
  void queueOpen(std::vector<FaceId> open, Try tried);
  bool prepareNext(Try& now) const;
  [[nodiscard]] bool canFillPartially(const Try& now) const;

  Front& front_;
  Elements& elements_;
  ElementIndex& index_;
  PocketSet& pockets_;
  std::vector<PocketId> stack_;  ///< the next one last
  std::vector<Try> tries_;       ///< per pocket
  std::vector<Weight> weights_;  ///< per pocket
  double facesInAll_ = 0.0;      ///< of all pockets there have been
  double facesWaiting_ = 0.0;    ///< of those in stack_
  std::optional<EnlargedPocket> enlarged_;
  std::optional<PocketFill> fill_;
  ExactFill::State fillState_ = ExactFill::State::kRunning;
  std::uint32_t partialFillsLeft_;
  std::vector<Made> made_;
};

}  // namespace tetrafront
