#pragma once

/// @file What is done about a stall. When no face can be completed under any rule, the pockets
/// left are closed one by one: by joining them to one interior point (star), else by taking the
/// elements around them away and letting the front try again there under other rules (reopening,
/// Löhner's practice). A reopened place that does not close is put back exactly as it was. What is
/// left then goes to the exact fill. All budgets are counts, so the outcome never depends on the
/// machine's speed.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "search/incidence.h"
#include "tetrafront/status.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/front_advance.h"
#include "volume/pocket_fill.h"
#include "volume/pockets.h"

namespace tetrafront {

template <class Trace>
class Recovery {
 public:
  enum class State : std::uint8_t { kRunning, kClosed, kStalled };

  /// `fillOnly`: nothing but the exact fill is tried.
  Recovery(Front& front, Elements& elements, FrontAdvance<Trace>& advance, FrontOrder order,
           bool fillOnly)
      : front_(front),
        elements_(elements),
        advance_(advance),
        order_(order),
        stage_(fillOnly ? Stage::kFindUnfilled : Stage::kFindPockets) {}

  /// Works on for about `budget` steps of the front. To be called when nothing is queued.
  State advance(std::uint32_t budget);

  /// What the mesh as it is now has of each rung, without what a larger place has taken away again.
  /// O(elements).
  [[nodiscard]] RecoverySummary summary() const;

 private:
  enum class Stage : std::uint8_t {
    kFindPockets,   ///< the pockets of the next pass
    kStar,          ///< the first pass: each pocket from one point
    kCount,         ///< incidence of the elements, first round
    kIndex,         ///< and second
    kReopen,        ///< the other passes: choose a pocket and open the place
    kRefront,       ///< fill it again
    kFindUnfilled,  ///< the pockets that are left after all passes
    kFill,          ///< each by the exact fill
    kFinished
  };

  /// A face as it was before a place was reopened.
  struct FaceRecord {
    std::uint32_t region;
    FieldHint hint;
    std::uint8_t ruleClass;
  };
  /// A place that has been reopened and is being filled again.
  struct Attempt {
    std::map<NodeTriple, FaceRecord> facesBefore;
    std::vector<TetId> removedElements;
    std::size_t elementsBefore = 0;
    std::size_t nodesBefore = 0;
    std::set<NodeTriple> foreignFaces;  ///< active faces that do not bound the reopened place
    std::uint64_t costLeft = 0;
  };
  /// From `first` up to before `last`.
  struct Range {
    std::size_t first = 0;
    std::size_t last = 0;
  };
  struct MadeByFill {
    Range elements;
    Range nodes;
  };
  using FaceMap = std::map<NodeTriple, FaceId>;

  /// One piece of work; returns what it cost, in faces taken from the front.
  std::size_t work(std::uint32_t budget);
  [[nodiscard]] bool anyIsLeft(const Range& made) const;
  void findPocketsOfPass();
  std::size_t starNext();
  bool star(const Pocket& pocket);
  void beginPass();
  std::size_t indexElements(std::uint32_t budget);
  std::size_t reopenNext();
  void reopen(const std::vector<Pocket>& pockets, std::size_t chosen, const FaceMap& active);
  [[nodiscard]] std::vector<TetId> elementsAround(const Pocket& pocket, std::uint32_t rings,
                                                  std::size_t enough) const;
  std::vector<FaceId> takeAway(const std::vector<Pocket>& pockets, std::size_t chosen,
                               FaceMap active);
  std::size_t refront(std::uint32_t budget);
  void finishAttempt();
  [[nodiscard]] bool onlyForeignLeft(const FaceMap& active) const;
  void putBack();
  std::vector<FaceId> openPlace(const std::vector<Pocket>& pockets, std::size_t chosen,
                                const FaceMap& active, std::vector<TetId> removed);
  std::size_t fillNext(std::uint32_t budget);
  void beginFill();
  std::vector<FaceId> takeFilled();
  void queueOpenPlaces(std::vector<FaceId> open);
  void nextToFill();
  void beginOrder(unsigned order);
  void tryNextOrder();
  /// What looking at all active faces costs, in faces taken from the front.
  [[nodiscard]] std::size_t lookCost() const;

  Front& front_;
  Elements& elements_;
  FrontAdvance<Trace>& advance_;
  FrontOrder order_;
  Stage stage_;
  /// 0 is the star pass; then one per number of rings and variant of the rules.
  std::uint32_t pass_ = 0;
  std::vector<Pocket> pockets_;  ///< of the pass
  /// One face of each pocket that was there when the pass began.
  std::vector<NodeTriple> queue_;
  std::size_t nextInQueue_ = 0;
  Incidence elementsAtNode_;
  std::size_t indexedElements_ = 0;
  std::size_t nextToIndex_ = 0;
  Attempt attempt_;
  std::uint64_t cost_ = 0;       ///< of all attempts
  std::vector<Range> starred_;   ///< elements of each star
  std::vector<Range> reopened_;  ///< and of each reopened place
  std::optional<PocketFill> fill_;
  /// In which its nodes are inserted; see ExactFill::kOrders.
  unsigned fillOrder_ = 0;
  /// Taken away around the pocket at the head of the queue.
  std::uint32_t fillRings_ = 0;
  std::size_t removedToFill_ = 0;  ///< how many elements that is
  std::uint32_t partFills_ = 0;
  std::vector<MadeByFill> filled_;
};

extern template class Recovery<NullTrace>;
extern template class Recovery<ClockTrace>;
extern template class Recovery<StepTrace>;

}  // namespace tetrafront
