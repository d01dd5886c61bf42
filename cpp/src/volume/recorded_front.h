#pragma once

/// @file The steps of the front as recorded ones.

#include "volume/front_advance.h"

namespace tetrafront {

class RecordingFrontMaker final : public FrontMaker {
 public:
  /// The recorder must outlive the fronts.
  RecordingFrontMaker(StepRecorder& recorder, const FrontExperiment& experiment)
      : recorder_(recorder), experiment_(experiment) {}

  [[nodiscard]] std::unique_ptr<FrontAdvance> make(Front& front, Elements& elements,
                                                   const SizeField& field,
                                                   bool filters) const override;

 private:
  StepRecorder& recorder_;
  FrontExperiment experiment_;
};

}  // namespace tetrafront
