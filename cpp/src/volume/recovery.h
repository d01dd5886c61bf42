#pragma once

/// @file What is done about a stall. When no face can be completed under any rule, the pockets
/// left are closed one by one: by joining them to one interior point (star), else by taking the
/// elements around them away and letting the front try again there under other rules (reopening,
/// Löhner's practice). A reopened place that does not close is put back exactly as it was. All
/// budgets are counts, so the outcome never depends on the machine's speed.

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "search/incidence.h"
#include "tetrafront/status.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/front_advance.h"
#include "volume/pockets.h"

namespace tetrafront {

template <class Trace>
class Recovery {
 public:
  enum class State : std::uint8_t { kRunning, kClosed, kStalled };

  Recovery(Front& front, Elements& elements, FrontAdvance<Trace>& advance, FrontOrder order)
      : front_(front), elements_(elements), advance_(advance), order_(order) {}

  /// Works on for about `budget` faces taken from the front. To be called when nothing is queued.
  State advance(std::uint32_t budget);

  [[nodiscard]] std::uint32_t starred() const { return starred_; }
  [[nodiscard]] std::uint32_t reopened() const { return reopened_; }

 private:
  enum class Stage : std::uint8_t { kStar, kChoose, kRefront, kFinished };

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
    std::uint64_t popsLeft = 0;
  };

  void starAll();
  bool star(const Pocket& pocket);
  void chooseAndReopen();
  void startPass();
  void reopen(const Pocket& pocket);
  [[nodiscard]] std::vector<TetId> elementsAround(const Pocket& pocket, std::uint32_t rings) const;
  std::vector<FaceId> takeAway(const std::vector<TetId>& elements, const Pocket& pocket);
  void refront(std::uint32_t& budget);
  void finishAttempt();
  void putBack();

  Front& front_;
  Elements& elements_;
  FrontAdvance<Trace>& advance_;
  FrontOrder order_;
  Stage stage_ = Stage::kStar;
  std::uint32_t pass_ = 0;
  /// One face of each pocket that was there when the pass began, and the next to try.
  std::vector<NodeTriple> queue_;
  std::size_t nextInQueue_ = 0;
  Incidence elementsAtNode_;
  std::size_t indexedElements_ = 0;
  Attempt attempt_;
  std::uint32_t starred_ = 0;
  std::uint32_t reopened_ = 0;
};

extern template class Recovery<NullTrace>;
extern template class Recovery<StepTrace>;

}  // namespace tetrafront
