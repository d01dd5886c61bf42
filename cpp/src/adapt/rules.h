#pragma once

/// @file Limits that several parts of an adaptation share.

namespace tetrafront {

/// Elements below this quality count as flat: they could hardly be improved again, so no change makes one.
inline constexpr double kFlatQuality = 1e-4;

}  // namespace tetrafront
