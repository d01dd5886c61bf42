#pragma once

/// @file Changes to the rules of the front, to see what each rule is good for.

namespace tetrafront {

/// Rules of a recorded run (trace.h), or of a polygon that is filled (plane_fill.h), where edges take the place of
/// faces. By default, they are those of every run.
struct FrontExperiment {
  /// Relaxes the rules for a face that cannot be completed. Otherwise such a face is left to recovery at once.
  bool relaxation = true;
  /// Factor, from 0 to 10, of the distance below which a new node is too close to a face. With 0, only exact
  /// crossings count, and nodes may be arbitrarily close to faces.
  double tolerance = 1.0;
  /// Compares every face of the front with the search region of each base face, as a program without a search
  /// structure does. The mesh stays the same; a run of N elements takes time that grows as N times the front's size.
  bool linearSearch = false;
};

}  // namespace tetrafront
