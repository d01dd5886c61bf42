#pragma once

/// @file Divides a region into cubes of a few elements each, and its sizes into classes of nearly constant size.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/task.h"
#include "field/size_field.h"
#include "lattice/free_space.h"
#include "tetrafront/vec3.h"
#include "topology/surface_access.h"

namespace tetrafront {

/// A cube of the survey that may hold a part of the region.
struct SurveyCube {
  Vec3 low;
  Vec3 high;
  std::uint32_t firstClass;  ///< of the sizes in it, from samples
  std::uint32_t lastClass;
};

/// Classes of sizes: those of a class differ by at most a factor of 1.12, so that elements of one size fit all of them within 6 %.
class SizeClasses {
 public:
  static constexpr double kRatio = 1.12;
  static constexpr std::uint32_t kMost = 64;
  static constexpr std::uint32_t kNone = kMost;

  /// The middle of class 0 is `largest`; later classes have smaller sizes.
  explicit SizeClasses(double largest);
  /// Returns the class of a size; kNone if it is too small, or too large.
  [[nodiscard]] std::uint32_t of(double size) const;

 private:
  double upper_;
  std::array<double, kMost> lower_;
};

class SizeSurvey {
 public:
  /// `bounds`: around the region; `space`: its boundary.
  static Task<SizeSurvey> make(Work& work, const Bounds& bounds, const FreeSpace& space,
                               const SizeField& field, std::uint32_t region);

  [[nodiscard]] const std::vector<SurveyCube>& cubes() const { return cubes_; }
  [[nodiscard]] const SizeClasses& classes() const { return classes_; }
  /// Returns the mean size of a class over its elements; 0 if it is expected to have too few elements for an island.
  [[nodiscard]] double meanSizeOf(std::uint32_t sizeClass) const;

 private:
  /// What the cubes of a class hold.
  struct Held {
    double elements = 0.0;
    double lengths = 0.0;  ///< elements times size
  };

  SizeClasses classes_{1.0};
  std::vector<SurveyCube> cubes_;
  std::array<Held, SizeClasses::kMost> held_{};
};

}  // namespace tetrafront
